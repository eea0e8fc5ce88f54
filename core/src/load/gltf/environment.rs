//! Light from all around, by `EXT_lights_image_based`.

use super::container::malformed;
use super::cube::CubeMap;
use super::document::{ImageLight, Scene};
use super::source::{Source, entry};
use crate::build::{EnvironmentDescription, Image};
use crate::light::EnvironmentMap;
use crate::load::image::read_rgbd_from;
use crate::load::{MAX_TEXELS, Problem};
use glam::DQuat;
use std::format;
use std::path::PathBuf;
use std::vec::Vec;

/// The light around a scene; `None` where it has none.
pub(super) fn read(
    source: &Source<'_>,
    scene: Option<&Scene>,
) -> Result<Option<EnvironmentDescription>, Problem> {
    let Some(reference) = scene.and_then(|scene| scene.extensions.image_light.as_ref()) else {
        return Ok(None);
    };
    let lights = &source.document.extensions.image_lights.lights;
    surround(source, entry(lights, "lights", reference.light)?).map(Some)
}

/// The light of the largest pictures, that of a mirror. The smaller ones, which are blurred for rough
/// surfaces, and the coefficients of spherical harmonics, which are for matte ones, hold nothing that is
/// not in these; they are checked and left out, because here a surface gathers its light itself.
///
/// Source: Khronos Group, *EXT_lights_image_based*, sections "Defining an Image-Based Light", "Prefiltered
/// Specular Radiance Cubemaps", "RGBD". Differs: it calls the numbers lux, which is no radiance; they are
/// taken for W m⁻² sr⁻¹ as those of emissive materials are. It does not say that the colours follow sRGB,
/// and which way a picture is "flipped about its vertical axis": colours and rows are as in Khronos's
/// sample `EnvironmentTest`, whose edges meet and whose coefficients fit only so.
fn surround(source: &Source<'_>, light: &ImageLight) -> Result<EnvironmentDescription, Problem> {
    check(source, light)?;
    let rotation = DQuat::from_array(light.rotation);
    if !(rotation.length_squared() > 0.0 && rotation.is_finite()) {
        return Err(malformed("its rotation has no length"));
    }
    let cube = cube(source, light)?;
    let mut image = cube.longitude_latitude();
    image.texels.iter_mut().for_each(|texel| *texel *= light.intensity);
    let to_world = glam::DMat3::from_quat(rotation.normalize()).as_mat3();
    let refused = |source| Problem::Map { path: PathBuf::from("specularImages"), source };
    EnvironmentMap::new(&image.texels, image.width, image.height, to_world).map_err(refused)?;
    Ok(EnvironmentDescription::new(image, to_world))
}

/// Refuses what breaks the rules, before a picture is read.
fn check(source: &Source<'_>, light: &ImageLight) -> Result<(), Problem> {
    if !(light.intensity >= 0.0 && light.intensity.is_finite()) {
        return Err(malformed(format!("its intensity is {}; it must be 0 or more", light.intensity)));
    }
    if !light.irradiance_coefficients.as_flattened().iter().all(|c| c.is_finite()) {
        return Err(malformed("its irradianceCoefficients are not finite"));
    }
    for index in light.specular_images.as_flattened() {
        entry(&source.document.images, "images", *index)?;
    }
    let [width, height] = [7.0, 3.5].map(|texels| texels * light.specular_image_size);
    if width * height > MAX_TEXELS as f64 {
        return Err(Problem::TooLarge {
            what: "texels of a cube map in longitude and latitude",
            limit: MAX_TEXELS as usize,
        });
    }
    Ok(())
}

/// The six pictures.
fn cube(source: &Source<'_>, light: &ImageLight) -> Result<CubeMap, Problem> {
    let largest = light.specular_images.first().ok_or_else(|| malformed("it has no specularImages"))?;
    let mut faces = Vec::with_capacity(largest.len());
    let mut size = 0;
    for index in largest {
        let (files, path) = source.picture(*index)?;
        let read = read_rgbd_from(&files, &path);
        let Image { width, height, texels } = read.map_err(|source| Problem::Image { path, source })?;
        if width != height || f64::from(width) != light.specular_image_size {
            let what = format!(
                "images[{index}] has {width}×{height} texels instead of {0}×{0}, its specularImageSize",
                light.specular_image_size
            );
            return Err(malformed(what));
        }
        size = width;
        faces.push(texels);
    }
    Ok(CubeMap { size, faces })
}
