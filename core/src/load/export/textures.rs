//! Textures in Mitsuba's words, their pictures as files beside the scene.

use super::file::write_whole;
use super::names::Names;
use super::xml::Xml;
use super::{ExportError, digits};
use crate::Rgb;
use crate::build::{Image, TexelBuffer, TextureDescription};
use crate::load::{ImageError, write_exr};
use crate::texture::{Interpolation, Kind, Pattern, UvTransform, Wrap};
use ::image::ImageEncoder;
use ::image::codecs::png::PngEncoder;
use std::format;
use std::io::{self, Cursor, Write};
use std::path::Path;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;

/// The pictures that have been written.
#[derive(Debug)]
pub(super) struct Pictures<'p> {
    /// The scene's file.
    path: &'p Path,
    stem: &'p str,
    files: Names,
    written: Vec<(Arc<TexelBuffer>, Rgb, String)>,
}

impl<'p> Pictures<'p> {
    pub(super) fn new(path: &'p Path, stem: &'p str) -> Self {
        Self { path, stem, files: Names::default(), written: Vec::new() }
    }

    /// A colour, or the texture that replaces it, times `scale`.
    pub(super) fn colour(
        &mut self,
        xml: &mut Xml,
        name: &str,
        own: Rgb,
        texture: Option<(&TextureDescription, Rgb)>,
    ) -> Result<(), ExportError> {
        let Some((texture, scale)) = texture else {
            xml.rgb(name, own);
            return Ok(());
        };
        match texture.pattern.kind() {
            Kind::Constant(colour) => xml.rgb(name, colour * scale),
            Kind::Checkerboard(colours) => {
                checkerboard(xml, name, colours.map(|c| c * scale), &texture.pattern)
            }
            Kind::Picture { width, height, interpolation, wrap } => {
                let Some(texels) = &texture.texels else { return Ok(()) };
                let file = self.file(texels, scale, [width, height])?;
                xml.open("texture", &[("type", "bitmap"), ("name", name)]);
                xml.property("string", "filename", &file);
                if !(matches!(**texels, TexelBuffer::Srgb8(_)) && scale == Rgb::WHITE) {
                    xml.property("boolean", "raw", "true");
                }
                if interpolation == Interpolation::Nearest {
                    xml.property("string", "filter_type", "nearest");
                }
                match wrap {
                    Wrap::Repeat => {}
                    Wrap::Mirror => xml.property("string", "wrap_mode", "mirror"),
                    Wrap::Clamp => xml.property("string", "wrap_mode", "clamp"),
                }
                transform(xml, texture.pattern.transform());
                xml.close("texture");
            }
        }
        Ok(())
    }

    /// The file of some texels times `scale`, written when it is not there.
    fn file(&mut self, texels: &Arc<TexelBuffer>, scale: Rgb, size: [u32; 2]) -> Result<String, ExportError> {
        let known = |(t, s, _): &&(Arc<TexelBuffer>, Rgb, String)| Arc::ptr_eq(t, texels) && *s == scale;
        if let Some((.., file)) = self.written.iter().find(known) {
            return Ok(file.clone());
        }
        let (bytes, extension) = encoded(texels, scale, size);
        let file = self.files.unique(&format!("{}-texture", self.stem)) + extension;
        write_whole(&self.path.with_file_name(&file), |out| out.write_all(&bytes?))?;
        self.written.push((texels.clone(), scale, file.clone()));
        Ok(file)
    }
}

/// A PNG file of what has 8 bits and is not scaled, else an OpenEXR file.
fn encoded(
    texels: &TexelBuffer,
    scale: Rgb,
    [width, height]: [u32; 2],
) -> (io::Result<Vec<u8>>, &'static str) {
    match texels {
        TexelBuffer::Srgb8(codes) | TexelBuffer::Linear8(codes) if scale == Rgb::WHITE => {
            let mut bytes = Vec::new();
            let encoder = PngEncoder::new(&mut bytes);
            let result =
                encoder.write_image(codes.as_flattened(), width, height, ::image::ExtendedColorType::Rgb8);
            (result.map(|()| bytes).map_err(|e| io::Error::other(e.to_string())), ".png")
        }
        _ => {
            let all = texels.texels();
            let image = Image { width, height, texels: (0..all.len()).map(|i| all.get(i) * scale).collect() };
            let mut bytes = Cursor::new(Vec::new());
            let result =
                write_exr(&image, &mut bytes).map_err(|e: ImageError| io::Error::other(e.to_string()));
            (result.map(|()| bytes.into_inner()), ".exr")
        }
    }
}

fn checkerboard(xml: &mut Xml, name: &str, [first, second]: [Rgb; 2], pattern: &Pattern) {
    xml.open("texture", &[("type", "checkerboard"), ("name", name)]);
    xml.rgb("color0", first);
    xml.rgb("color1", second);
    transform(xml, pattern.transform());
    xml.close("texture");
}

fn transform(xml: &mut Xml, to_uv: UvTransform) {
    if to_uv == UvTransform::IDENTITY {
        return;
    }
    let [u, v] = to_uv.rows().map(|[a, b, c]| [a, b, 0.0, c].map(|x| digits(f64::from(x))).join(" "));
    xml.open("transform", &[("name", "to_uv")]);
    xml.empty("matrix", &[("value", &format!("{u}  {v}  0 0 1 0  0 0 0 1"))]);
    xml.close("transform");
}
