//! The narrowest types that hold a scene.

use super::super::ExportError;
use super::expression::{list, number, rgb, shape, shape_name, vector};
use crate::Rgb;
use crate::bsdf::{AnyBsdf, TwoSided};
use crate::light::{AnyLight, AreaLight, Emitter, Sides};
use crate::material::AnyMaterial;
use crate::scene::AnyScene;
use crate::shape::AnyShape;
use glam::Vec3;
use std::format;
use std::string::{String, ToString};

/// Which types a scene needs: the name of the only kind that it has, or `None` for the enum of all.
pub(super) struct Narrow {
    shape: Option<&'static str>,
    light: Option<&'static str>,
    bsdf: Option<&'static str>,
    /// A surface has a model on its back.
    two_sided: bool,
}

/// The only name; the first of `none` when there is no name at all.
fn only(mut names: impl Iterator<Item = &'static str>, none: &'static str) -> Option<&'static str> {
    let first = names.next().unwrap_or(none);
    names.all(|name| name == first).then_some(first)
}

impl Narrow {
    pub(super) fn new(scene: &AnyScene<'_>) -> Result<Self, ExportError> {
        for light in scene.lights() {
            light_expression(light)?;
        }
        let mut sides = std::vec::Vec::new();
        for material in scene.materials() {
            let TwoSided { front, back } = plain(material)?;
            sides.extend([Some(front), back]);
        }
        Ok(Self {
            shape: only(scene.surfaces().iter().map(|s| shape_name(&s.shape)), "Triangle"),
            light: only(scene.lights().iter().map(light_name), "Constant"),
            bsdf: only(sides.iter().flatten().map(bsdf_name), "Lambert"),
            two_sided: sides.iter().skip(1).step_by(2).any(Option::is_some),
        })
    }

    /// The type of the shapes.
    pub(super) fn shape(&self) -> &'static str {
        self.shape.unwrap_or("AnyShape")
    }

    /// The type of the lights.
    pub(super) fn light(&self) -> String {
        match self.light {
            None => "AnyLight<'static>".to_string(),
            Some(name @ ("Rectangle" | "Disk" | "Sphere" | "Triangle" | "Cylinder")) => {
                format!("AreaLight<{name}>")
            }
            Some(name) => name.to_string(),
        }
    }

    /// The type of the materials.
    pub(super) fn material(&self) -> String {
        let bsdf = self.bsdf.unwrap_or("AnyBsdf");
        if self.two_sided { format!("TwoSided<{bsdf}>") } else { bsdf.to_string() }
    }

    /// A shape of that type.
    pub(super) fn shape_of(&self, any: &AnyShape) -> String {
        self.wrapped(self.shape, "AnyShape", shape_name(any), shape(any))
    }

    /// A light of that type.
    pub(super) fn light_of(&self, any: &AnyLight<'_>) -> Result<String, ExportError> {
        Ok(self.wrapped(self.light, "AnyLight", light_name(any), light_expression(any)?))
    }

    /// A material of that type.
    pub(super) fn material_of(&self, any: &AnyMaterial<'_>) -> Result<String, ExportError> {
        let side = |b: &AnyBsdf| self.wrapped(self.bsdf, "AnyBsdf", bsdf_name(b), bsdf_expression(b));
        let TwoSided { front, back } = plain(any)?;
        Ok(match back {
            _ if !self.two_sided => side(&front),
            Some(back) if back == front => format!("TwoSided::both({})", side(&front)),
            Some(back) => format!("TwoSided {{ front: {}, back: Some({}) }}", side(&front), side(&back)),
            None => format!("TwoSided::front_only({})", side(&front)),
        })
    }

    /// An expression as a variant of an enum, unless there is only one kind.
    fn wrapped(&self, only: Option<&str>, any: &str, variant: &str, expression: String) -> String {
        if only.is_some() { expression } else { format!("{any}::{variant}({expression})") }
    }
}

/// A material without textures.
pub(in super::super) fn plain(material: &AnyMaterial<'_>) -> Result<TwoSided<AnyBsdf>, ExportError> {
    match material {
        AnyMaterial::Plain(bsdf) => Ok(*bsdf),
        AnyMaterial::Textured(_) => Err(ExportError::NotBaked {
            what: "a material with textures",
            instead: "give it one colour, or borrow the texels with `Texture` in the program itself",
        }),
    }
}

/// The name of a light's variant, which is that of its type or of its shape's.
fn light_name(light: &AnyLight<'_>) -> &'static str {
    match light {
        AnyLight::Rectangle(_) => "Rectangle",
        AnyLight::Disk(_) => "Disk",
        AnyLight::Sphere(_) => "Sphere",
        AnyLight::Triangle(_) => "Triangle",
        AnyLight::Cylinder(_) => "Cylinder",
        AnyLight::Painted(_) => "Painted",
        AnyLight::Point(_) => "Point",
        AnyLight::Spot(_) => "Spot",
        AnyLight::Directional(_) => "Directional",
        AnyLight::Constant(_) => "Constant",
        AnyLight::DistantDisk(_) => "DistantDisk",
        AnyLight::EnvironmentMap(_) => "EnvironmentMap",
        AnyLight::ConstantPortals(_) => "ConstantPortals",
        AnyLight::EnvironmentPortals(_) => "EnvironmentPortals",
    }
}

/// A light, of its own type.
pub(in super::super) fn light_expression(light: &AnyLight<'_>) -> Result<String, ExportError> {
    let refuse = |what, instead| Err(ExportError::NotBaked { what, instead });
    Ok(match light {
        AnyLight::Rectangle(l) => area(l, AnyShape::Rectangle(*l.shape())),
        AnyLight::Disk(l) => area(l, AnyShape::Disk(*l.shape())),
        AnyLight::Sphere(l) => area(l, AnyShape::Sphere(*l.shape())),
        AnyLight::Triangle(l) => area(l, AnyShape::Triangle(*l.shape())),
        AnyLight::Cylinder(l) => area(l, AnyShape::Cylinder(*l.shape())),
        AnyLight::Point(l) => format!("Point::baked({}, {})", vector(l.position()), rgb(l.intensity())),
        AnyLight::Spot(l) => {
            let ((beam, cutoff), place) = (l.angles(), vector(l.position()));
            let (axis, intensity) = (vector(l.axis()), rgb(l.intensity()));
            format!("Spot::baked({place}, {axis}, {intensity}, {}, {})", number(beam), number(cutoff))
        }
        AnyLight::Directional(l) => {
            format!("Directional::baked({}, {})", vector(l.direction()), rgb(l.irradiance()))
        }
        AnyLight::Constant(l) => format!("Constant::baked({})", rgb(l.radiance_escaping(Vec3::Z))),
        AnyLight::DistantDisk(l) => {
            let (axis, sin2) = (l.axis(), number(l.sin2_radius()));
            format!("DistantDisk::baked({}, {sin2}, {})", vector(axis), rgb(l.radiance_escaping(axis)))
        }
        AnyLight::Painted(_) => {
            return refuse("a light with a texture", "give it one radiance");
        }
        AnyLight::EnvironmentMap(_) | AnyLight::EnvironmentPortals(_) => {
            return refuse(
                "a picture of the surroundings",
                "use a constant light, or borrow the texels with `EnvironmentMap` in the program itself",
            );
        }
        AnyLight::ConstantPortals(_) => {
            return refuse("a sky behind portals", "leave the portals out, or use `Portals` in the program");
        }
    })
}

/// A surface that emits.
fn area<S>(light: &AreaLight<S>, of: AnyShape) -> String
where
    S: crate::light::SampledShape,
{
    let sides = match light.sides() {
        Sides::Front => "Sides::Front",
        Sides::Both => "Sides::Both",
    };
    let radiance: Rgb = *light.surface_radiance();
    format!("AreaLight::baked({}, {}, {sides})", shape(&of), rgb(radiance))
}

fn bsdf_name(bsdf: &AnyBsdf) -> &'static str {
    match bsdf {
        AnyBsdf::Lambert(_) => "Lambert",
        AnyBsdf::Phong(_) => "Phong",
        AnyBsdf::GgxConductor(_) => "GgxConductor",
        AnyBsdf::RoughPlastic(_) => "RoughPlastic",
        AnyBsdf::MetallicRoughness(_) => "MetallicRoughness",
    }
}

/// A model, of its own type.
fn bsdf_expression(bsdf: &AnyBsdf) -> String {
    match bsdf {
        AnyBsdf::Lambert(b) => format!("Lambert::baked({})", rgb(b.reflectance())),
        AnyBsdf::Phong(b) => {
            let (diffuse, specular) = (rgb(b.diffuse()), rgb(b.specular()));
            let numbers = list(&[b.exponent(), b.specular_pmf()]);
            format!("Phong::baked({diffuse}, {specular}, {numbers})")
        }
        AnyBsdf::GgxConductor(b) => {
            let index = b.index().map(|(eta, k)| format!("Some(({}, {}))", rgb(eta), rgb(k)));
            let index = index.unwrap_or_else(|| "None".to_string());
            format!("GgxConductor::baked({}, [{}], {index})", rgb(b.reflectance()), list(&b.alpha()))
        }
        AnyBsdf::RoughPlastic(b) => format!("RoughPlastic::baked([{}])", list(&b.to_numbers())),
        AnyBsdf::MetallicRoughness(b) => {
            let numbers = list(&[b.metallic(), b.roughness()]);
            format!("MetallicRoughness::baked({}, {numbers})", rgb(b.base_color()))
        }
    }
}
