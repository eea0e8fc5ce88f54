//! The properties of a plugin: each is asked for by name, and what nobody asked for is refused.

use super::context::Context;
use super::element::Element;
use super::{transform, value};
use crate::Rgb;
use crate::load::{LoadError, Problem};
use glam::{DMat4, DVec3};
use std::borrow::ToOwned;
use std::format;
use std::vec::Vec;

/// The tags of properties.
const TAGS: [&str; 9] =
    ["float", "integer", "boolean", "string", "rgb", "spectrum", "point", "vector", "transform"];

/// White of equal energy at every wavelength, as linear sRGB: what Mitsuba makes of a single-valued
/// spectrum that is emitted. (`XYZ = (1, 1, 1)` through the matrix of IEC 61966-2-1.)
const EQUAL_ENERGY: Rgb = Rgb::new(1.204_79, 0.948_29, 0.908_92);

/// The properties and nested objects of a plugin.
#[derive(Debug)]
pub(super) struct Properties<'e> {
    element: &'e Element,
    taken: Vec<bool>,
    asked: Vec<&'static str>,
}

impl<'e> Properties<'e> {
    /// The children of a plugin's element.
    pub(super) fn new(element: &'e Element) -> Result<Self, LoadError> {
        for (i, child) in element.children.iter().enumerate() {
            if !TAGS.contains(&child.tag.as_str()) {
                continue;
            }
            let name = child.required("name")?;
            let same = |c: &&Element| TAGS.contains(&c.tag.as_str()) && c.attribute("name") == Some(name);
            if let Some(first) = element.children[..i].iter().find(same) {
                let what = format!("property \"{name}\" is given twice");
                return Err(child.error(Problem::Conflict { what, first: first.at.clone() }));
            }
        }
        Ok(Self { element, taken: [false].repeat(element.children.len()), asked: Vec::new() })
    }

    /// The child that holds a property, when it is there and has one of the tags.
    fn take(
        &mut self,
        name: &'static str,
        tags: &[&str],
        expected: &'static str,
    ) -> Result<Option<&'e Element>, LoadError> {
        self.asked.push(name);
        let is_it = |c: &Element| TAGS.contains(&c.tag.as_str()) && c.attribute("name") == Some(name);
        let Some(i) = self.element.children.iter().position(is_it) else { return Ok(None) };
        self.taken[i] = true;
        let child = &self.element.children[i];
        if !tags.contains(&child.tag.as_str()) {
            return Err(child.error(Problem::Type { name: name.to_owned(), expected }));
        }
        if child.tag != "transform" {
            child.no_children()?;
            let known: &[&str] = match child.tag.as_str() {
                "point" | "vector" => &["name", "value", "x", "y", "z"],
                _ => &["name", "value"],
            };
            child.only_attributes(known)?;
        }
        Ok(Some(child))
    }

    /// A number.
    pub(super) fn float(&mut self, name: &'static str) -> Result<Option<f64>, LoadError> {
        let child = self.take(name, &["float", "integer"], "a <float>")?;
        child.map(|c| value::number(c, "value")).transpose()
    }

    /// A number, or what holds when it is not given.
    pub(super) fn float_or(&mut self, name: &'static str, default: f64) -> Result<f64, LoadError> {
        Ok(self.float(name)?.unwrap_or(default))
    }

    /// A whole number from 0.
    pub(super) fn count(&mut self, name: &'static str) -> Result<Option<u32>, LoadError> {
        let child = self.take(name, &["integer"], "an <integer>")?;
        child.map(value::count).transpose()
    }

    /// A number of segments of a path.
    pub(super) fn depth(&mut self, name: &'static str) -> Result<Option<u32>, LoadError> {
        let child = self.take(name, &["integer"], "an <integer>")?;
        child.map(value::depth).transpose()
    }

    /// True or false; false when it is not given.
    pub(super) fn flag(&mut self, name: &'static str) -> Result<bool, LoadError> {
        self.flag_or(name, false)
    }

    /// True or false, or what holds when it is not given.
    pub(super) fn flag_or(&mut self, name: &'static str, default: bool) -> Result<bool, LoadError> {
        let Some(child) = self.take(name, &["boolean"], "a <boolean>")? else { return Ok(default) };
        match child.required("value")? {
            "true" => Ok(true),
            "false" => Ok(false),
            _ => Err(value::bad(child, "value", "true or false")),
        }
    }

    /// A text, with the element that holds it.
    pub(super) fn text(&mut self, name: &'static str) -> Result<Option<(&'e Element, &'e str)>, LoadError> {
        let child = self.take(name, &["string"], "a <string>")?;
        child.map(|c| Ok((c, c.required("value")?))).transpose()
    }

    /// The element of a number or a text.
    pub(super) fn float_or_text(&mut self, name: &'static str) -> Result<Option<&'e Element>, LoadError> {
        self.take(name, &["float", "integer", "string"], "a <float> or <string>")
    }

    /// Three coordinates.
    pub(super) fn vector(&mut self, name: &'static str) -> Result<Option<DVec3>, LoadError> {
        let child = self.take(name, &["point", "vector"], "a <point> or <vector>")?;
        child.map(|c| value::coordinates(c, None)).transpose()
    }

    /// A transform with the element that holds it.
    pub(super) fn transform(
        &mut self,
        name: &'static str,
    ) -> Result<Option<(&'e Element, DMat4)>, LoadError> {
        let child = self.take(name, &["transform"], "a <transform>")?;
        child
            .map(|c| {
                c.only_attributes(&["name"])?;
                Ok((c, transform::read(c)?))
            })
            .transpose()
    }

    /// The texture, or the reference to one, that is given for a property.
    pub(super) fn texture(&mut self, name: &'static str) -> Result<Option<&'e Element>, LoadError> {
        let named = |c: &Element| c.attribute("name") == Some(name);
        let is_it = |c: &Element| matches!(c.tag.as_str(), "texture" | "ref") && named(c);
        let Some(i) = self.element.children.iter().position(is_it) else { return Ok(None) };
        self.asked.push(name);
        self.taken[i] = true;
        let child = &self.element.children[i];
        let is_property = |c: &&Element| TAGS.contains(&c.tag.as_str()) && named(c);
        match self.element.children.iter().find(is_property) {
            Some(first) => {
                let what = format!("property \"{name}\" is given twice");
                Err(child.error(Problem::Conflict { what, first: first.at.clone() }))
            }
            None => Ok(Some(child)),
        }
    }

    /// A reflectance.
    pub(super) fn reflectance(&mut self, name: &'static str) -> Result<Option<Rgb>, LoadError> {
        self.colour(name, Rgb::WHITE)
    }

    /// A quantity of light; 1 when it is not given.
    pub(super) fn emission(&mut self, name: &'static str) -> Result<Rgb, LoadError> {
        Ok(self.colour(name, EQUAL_ENERGY)?.unwrap_or(Rgb::WHITE))
    }

    /// A colour; a single-valued spectrum of 1 is `spectrum`.
    fn colour(&mut self, name: &'static str, spectrum: Rgb) -> Result<Option<Rgb>, LoadError> {
        let tags = ["rgb", "spectrum", "float"];
        let Some(child) = self.take(name, &tags, "an <rgb>, <spectrum> or <float>")? else {
            return Ok(None);
        };
        match child.tag.as_str() {
            "rgb" => value::colour(child),
            "spectrum" if child.required("value")?.contains(':') => {
                let what = "a spectrum of several wavelengths".to_owned();
                Err(child.error(Problem::NotSupported { what, instead: "write <rgb>" }))
            }
            "spectrum" => Ok(spectrum * value::number(child, "value")? as f32),
            _ => Ok(Rgb::splat(value::number(child, "value")? as f32)),
        }
        .map(Some)
    }

    /// Nested objects with one of the tags.
    pub(super) fn nested(&mut self, tags: &[&'static str]) -> Vec<&'e Element> {
        self.asked.extend(tags);
        let mut found = Vec::new();
        for (child, taken) in self.element.children.iter().zip(&mut self.taken) {
            if tags.contains(&child.tag.as_str()) {
                *taken = true;
                found.push(child);
            }
        }
        found
    }

    /// The only nested object with one of the tags; two are an error.
    pub(super) fn single(&mut self, tags: &[&'static str]) -> Result<Option<&'e Element>, LoadError> {
        match self.nested(tags).as_slice() {
            [] => Ok(None),
            [only] => Ok(Some(only)),
            [first, second, ..] => {
                let what = format!("only one <{}> belongs here", tags[0]);
                Err(second.error(Problem::Conflict { what, first: first.at.clone() }))
            }
        }
    }

    /// Accepts properties that make no difference here.
    pub(super) fn ignore(&mut self, names: &[&'static str]) {
        self.asked.extend(names);
        for (child, taken) in self.element.children.iter().zip(&mut self.taken) {
            *taken |= TAGS.contains(&child.tag.as_str())
                && child.attribute("name").is_some_and(|n| names.contains(&n));
        }
    }

    /// Refuses what nobody has asked for.
    pub(super) fn finish(self, context: &mut Context<'_>) -> Result<(), LoadError> {
        for (child, _) in self.element.children.iter().zip(&self.taken).filter(|(_, taken)| !**taken) {
            let error = if TAGS.contains(&child.tag.as_str()) {
                let name = child.attribute("name").unwrap_or_default();
                child.error(Problem::unknown("property", name, &self.asked))
            } else if child.tag == "texture" {
                let instead = "give the property one value for the whole surface";
                child.error(Problem::NotSupported { what: "a texture".to_owned(), instead })
            } else {
                child.error(Problem::unknown("element", &child.tag, &self.asked))
            };
            context.tolerate(Err::<(), _>(error))?;
        }
        Ok(())
    }
}
