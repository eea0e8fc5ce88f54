//! Encoding layers as OpenEXR.

use super::Picture;
use crate::failure::Failure;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer as Part, LayerAttributes, WritableImage,
};
use std::io::Cursor;

/// A channel: a number for each pixel, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layer {
    /// As OpenEXR has it: a layer's name, a point, and the channel's.
    pub(crate) name: &'static str,
    /// As many as there are pixels.
    pub(crate) values: Vec<f32>,
}

/// The bytes of an OpenEXR file with the picture in R, G and B, and the layers: 32-bit floats, one part.
///
/// # Errors
/// When they cannot be encoded.
pub(crate) fn encode_layers(picture: &Picture, layers: Vec<Layer>) -> Result<Vec<u8>, Failure> {
    let size = (picture.width as usize, picture.height as usize);
    let of = |channel: usize| picture.pixels.iter().map(|p| p.to_array()[channel]).collect();
    let radiance = ["R", "G", "B"].into_iter().zip(0..).map(|(name, i)| Layer { name, values: of(i) });
    let channels = radiance.chain(layers).map(|l| AnyChannel::new(l.name, FlatSamples::F32(l.values)));
    let channels = AnyChannels::sort(channels.collect());
    let part = Part::new(size, LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels);
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(part)
        .write()
        .to_buffered(&mut file)
        .map_err(|e| Failure::new(format!("cannot encode the layers: {e}")))?;
    Ok(file.into_inner())
}
