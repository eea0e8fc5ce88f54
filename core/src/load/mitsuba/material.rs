//! The materials of a scene: those with an id once, equal ones without an id once.

use super::bsdf;
use super::context::Context;
use super::element::Element;
use crate::build::Material;
use crate::load::LoadError;
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::string::String;
use std::vec::Vec;

/// The materials gathered so far.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) list: Vec<Material>,
    by_id: BTreeMap<String, usize>,
}

impl Materials {
    /// The index of the material that a `<bsdf>` or a `<ref>` describes.
    pub(super) fn index(&mut self, context: &mut Context<'_>, element: &Element) -> Result<usize, LoadError> {
        if element.tag == "ref" {
            let target = context.referent(element)?;
            return self.index_of(context, target);
        }
        self.index_of(context, element)
    }

    fn index_of(&mut self, context: &mut Context<'_>, element: &Element) -> Result<usize, LoadError> {
        let id = element.attribute("id");
        if let Some(index) = id.and_then(|id| self.by_id.get(id)) {
            return Ok(*index);
        }
        let only_bsdf = element.tag == "bsdf";
        if !only_bsdf {
            let what = std::format!("a <{}> as the material of a shape", element.tag);
            let problem = crate::load::Problem::NotSupported { what, instead: "refer to a <bsdf>" };
            return Err(element.error(problem));
        }
        let material = bsdf::read(context, element)?;
        let name = id.unwrap_or_default().to_owned();
        if let Some(id) = id {
            self.by_id.insert(id.to_owned(), self.list.len());
        }
        Ok(self.add(Material { name, ..material }))
    }

    /// The index of what a surface without a `<bsdf>` has.
    pub(super) fn default(&mut self, element: &Element, emits: bool) -> Result<usize, LoadError> {
        let bsdf = bsdf::default(emits).map_err(|e| element.error(e))?;
        Ok(self.add(Material { name: String::new(), bsdf, textures: <[_; 2]>::default() }))
    }

    fn add(&mut self, material: Material) -> usize {
        let same = |m: &Material| material.name.is_empty() && *m == material;
        if let Some(index) = self.list.iter().position(same) {
            return index;
        }
        self.list.push(material);
        self.list.len() - 1
    }
}
