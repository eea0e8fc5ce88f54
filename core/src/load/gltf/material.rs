//! Materials: metallic-roughness, and what a surface emits.

use super::document::{Material as Written, Metal, TextureInfo};
use super::log::Log;
use super::source::{Source, entry};
use super::texture::{Pictures, uv_set};
use crate::Rgb;
use crate::bsdf::{AnyBsdf, MetallicRoughness, TwoSided};
use crate::build::{Emission, Material, MaterialTextures};
use crate::light::LightError;
use crate::load::Problem;
use std::collections::{BTreeMap, BTreeSet};
use std::format;
use std::string::String;
use std::vec::Vec;

/// What a primitive has to know of its material.
#[derive(Debug, Clone)]
pub(super) struct Known {
    /// Index into the description's materials.
    pub(super) index: usize,
    pub(super) emission: Option<Emission>,
    /// The set of texture coordinates that its textures are on.
    pub(super) uv_set: Option<u32>,
}

/// The materials that are used.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) list: Vec<Material>,
    known: BTreeMap<Option<usize>, Known>,
    names: BTreeSet<String>,
    pictures: Pictures,
}

impl Materials {
    /// The material of a primitive; the default one when it names none.
    pub(super) fn get(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        index: Option<usize>,
    ) -> Result<Known, Problem> {
        if let Some(known) = self.known.get(&index) {
            return Ok(known.clone());
        }
        let default = Written::default();
        let written = match index {
            Some(index) => entry(&source.document.materials, "materials", index)?,
            None => &default,
        };
        let item = index.map_or_else(|| "the default material".into(), |i| format!("materials[{i}]"));
        self.warn(log, &item, written);
        let known = self.read(source, log, written)?;
        self.known.insert(index, known.clone());
        Ok(known)
    }

    /// Says what is left out.
    fn warn(&self, log: &mut Log<'_>, item: &str, written: &Written) {
        if written.alpha_mode.as_deref().is_some_and(|mode| mode != "OPAQUE") {
            log.warn(item, "may be transparent in places; it is taken as opaque");
        }
        if written.normal_texture.is_some() {
            log.warn(item, "its normal map is left out");
        }
    }

    /// Both sides reflect, also where the back would not be drawn: what is looked at from inside is not
    /// black. What it emits is radiance (W m⁻² sr⁻¹), as Blender writes and reads it; the front emits, and
    /// the back when the material is double-sided.
    fn read(&mut self, source: &Source<'_>, log: &mut Log<'_>, written: &Written) -> Result<Known, Problem> {
        let metal = &written.pbr_metallic_roughness;
        let [r, g, b, _] = metal.base_color_factor;
        let bsdf = MetallicRoughness::new(Rgb::new(r, g, b), metal.metallic_factor, metal.roughness_factor)?;
        let uv_set = common_set([
            metal.base_color_texture.as_ref(),
            metal.metallic_roughness_texture.as_ref(),
            written.emissive_texture.as_ref(),
        ])?;
        let emission = self.emission(source, log, written)?;
        let textures = self.textures(source, log, metal)?;
        let name = self.unique(written.name.as_deref());
        let bsdf = TwoSided::both(AnyBsdf::MetallicRoughness(bsdf));
        self.list.push(Material { name, bsdf, textures: [textures.clone(), textures] });
        Ok(Known { index: self.list.len() - 1, emission, uv_set })
    }

    fn textures(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        metal: &Metal,
    ) -> Result<MaterialTextures, Problem> {
        let mut read = |info: &Option<TextureInfo>, colour| {
            info.as_ref().map(|info| self.pictures.texture(source, log, info, colour)).transpose()
        };
        Ok(MaterialTextures {
            diffuse: read(&metal.base_color_texture, true)?,
            roughness: read(&metal.metallic_roughness_texture, false)?,
            ..MaterialTextures::default()
        })
    }

    fn emission(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        written: &Written,
    ) -> Result<Option<Emission>, Problem> {
        let strength = written.extensions.emissive.as_ref().map_or(1.0, |e| e.emissive_strength);
        let radiance = Rgb::from(written.emissive_factor) * strength;
        if !radiance.is_valid() {
            return Err(LightError::NegativeEmission { emission: radiance }.into());
        }
        if radiance.is_black() {
            return Ok(None);
        }
        let texture = match &written.emissive_texture {
            Some(info) => Some(self.pictures.texture(source, log, info, true)?),
            None => None,
        };
        Ok(Some(Emission { radiance, texture, two_sided: written.double_sided }))
    }

    /// A name that no other material has: only the first of several keeps it.
    fn unique(&mut self, name: Option<&str>) -> String {
        let name = name.unwrap_or_default();
        if self.names.insert(name.into()) { name.into() } else { String::new() }
    }
}

/// The set of texture coordinates that all textures are on.
fn common_set(textures: [Option<&TextureInfo>; 3]) -> Result<Option<u32>, Problem> {
    let mut sets = textures.into_iter().flatten().map(uv_set);
    let first = sets.next();
    if sets.all(|set| Some(set) == first) {
        return Ok(first);
    }
    let what = "a material whose textures are on different sets of texture coordinates".into();
    Err(Problem::NotSupported { what, instead: "put its textures on one set" })
}
