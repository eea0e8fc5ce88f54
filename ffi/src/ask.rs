//! What an open scene can be asked.

use crate::{HalflightScene, HalflightStatus, get, put};
use halflight::choose::LightChoice;
use halflight::estimate::{Direct, Irradiance, Job, PixelStats, Probe};
use halflight::film::PixelRect;
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::SurfaceDensity;
use halflight::sequence::Sobol;
use halflight::shape::SurfacePoint;

/// The light at a point, each of red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct HalflightIrradiance {
    /// Irradiance, shadows included (W m⁻²).
    pub mean: [f32; 3],
    /// Its standard error, as if the samples were independent: the true one is smaller (W m⁻²).
    pub standard_error: [f32; 3],
    /// The irradiance if nothing were in the way, in closed form (W m⁻²); 0 where there is none.
    pub unshadowed: [f32; 3],
    /// Whether all lights have a closed form.
    pub has_closed_form: bool,
}

/// What arrives from a direction, each of red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct HalflightRadiance {
    /// Radiance (W m⁻² sr⁻¹).
    pub mean: [f32; 3],
    /// Its standard error, as if the samples were independent: the true one is smaller (W m⁻² sr⁻¹).
    pub standard_error: [f32; 3],
}

impl From<PixelStats> for HalflightRadiance {
    fn from(samples: PixelStats) -> Self {
        let seen = Irradiance { samples, unshadowed: None };
        Self { mean: seen.mean().to_array(), standard_error: seen.standard_error().to_array() }
    }
}

/// Three numbers of the caller.
///
/// # Safety
/// The pointer must be null, misaligned, or point to three numbers.
unsafe fn vector(numbers: *const f32) -> Result<Vec3, HalflightStatus> {
    // SAFETY: as the caller promises; an array has the alignment of its entries.
    let numbers = unsafe { get(numbers.cast::<[f32; 3]>())? };
    let vector = Vec3::from_array(*numbers);
    if vector.is_finite() { Ok(vector) } else { Err(HalflightStatus::Argument) }
}

/// The same with a length of 1.
///
/// # Safety
/// As for [`vector`].
unsafe fn direction(numbers: *const f32) -> Result<Vec3, HalflightStatus> {
    // SAFETY: as the caller promises.
    unsafe { vector(numbers) }?.try_normalize().ok_or(HalflightStatus::Argument)
}

/// How points are asked about.
fn probe(samples: u32) -> Result<Probe<'static>, HalflightStatus> {
    let probe = Probe { samples, surface: SurfaceDensity::Auto, choice: LightChoice::All };
    if samples > 0 { Ok(probe) } else { Err(HalflightStatus::Argument) }
}

/// Irradiance at a point from the side that its normal is on.
///
/// * `scene` – from `halflight_scene_open`
/// * `point` – x, y and z (m), in free space
/// * `normal` – x, y and z, of any length
/// * `samples` – of each light, 1 or more; powers of two serve best
/// * `seed` – which random numbers
/// * `irradiance` – receives the answer
///
/// # Safety
/// `scene` must be null or open, `point` and `normal` null or point to three numbers, `irradiance` must be
/// null or point to a `HalflightIrradiance`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_irradiance(
    scene: *const HalflightScene,
    point: *const f32,
    normal: *const f32,
    samples: u32,
    seed: u32,
    irradiance: *mut HalflightIrradiance,
) -> HalflightStatus {
    let ask = || {
        // SAFETY: as the caller promises.
        let (opened, point, normal) = unsafe { (get(scene)?, vector(point)?, direction(normal)?) };
        let from = SurfacePoint { point, error: Vec3::ZERO, normal };
        let seen = probe(samples)?.irradiance(&opened.scene, &from, &mut Sobol::new(seed));
        Ok(HalflightIrradiance {
            mean: seen.mean().to_array(),
            standard_error: seen.standard_error().to_array(),
            unshadowed: seen.unshadowed.unwrap_or_default().to_array(),
            has_closed_form: seen.unshadowed.is_some(),
        })
    };
    // SAFETY: as the caller promises.
    unsafe { put(irradiance, ask) }
}

/// How much of a light is seen from a point: 0 in the umbra, 1 in full light, between them in the penumbra.
///
/// * `scene` – from `halflight_scene_open`
/// * `point`, `normal`, `samples`, `seed` – as for `halflight_irradiance`
/// * `light` – its index
/// * `visibility` – receives the answer
///
/// # Safety
/// `scene` must be null or open, `point` and `normal` null or point to three numbers, `visibility` must be
/// null or point to a `float`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_visibility(
    scene: *const HalflightScene,
    point: *const f32,
    normal: *const f32,
    light: u32,
    samples: u32,
    seed: u32,
    visibility: *mut f32,
) -> HalflightStatus {
    let ask = || {
        // SAFETY: as the caller promises.
        let (opened, point, normal) = unsafe { (get(scene)?, vector(point)?, direction(normal)?) };
        let from = SurfacePoint { point, error: Vec3::ZERO, normal };
        let (light, mut sequence) = (light as usize, Sobol::new(seed));
        let seen = probe(samples)?.visibility(&opened.scene, &from, light, &mut sequence);
        seen.ok_or(HalflightStatus::NoLight)
    };
    // SAFETY: as the caller promises.
    unsafe { put(visibility, ask) }
}

/// What arrives along a ray: direct light from the surface that it meets.
///
/// * `scene` – from `halflight_scene_open`
/// * `origin` – x, y and z of the eye (m)
/// * `toward` – x, y and z of the direction, of any length
/// * `samples`, `seed` – as for `halflight_irradiance`
/// * `radiance` – receives the answer
///
/// # Safety
/// `scene` must be null or open, `origin` and `toward` null or point to three numbers, `radiance` must be
/// null or point to a `HalflightRadiance`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_ray(
    scene: *const HalflightScene,
    origin: *const f32,
    toward: *const f32,
    samples: u32,
    seed: u32,
    radiance: *mut HalflightRadiance,
) -> HalflightStatus {
    let ask = || {
        // SAFETY: as the caller promises.
        let (opened, origin, toward) = unsafe { (get(scene)?, vector(origin)?, direction(toward)?) };
        let ray = (&Ray::new(origin, toward), f32::INFINITY);
        let seen = probe(samples)?.radiance(&opened.scene, &Direct::default(), ray, &mut Sobol::new(seed));
        Ok(seen.into())
    };
    // SAFETY: as the caller promises.
    unsafe { put(radiance, ask) }
}

/// A pixel of the scene's picture: the bits of `halflight render --technique auto --choose all --sequence
/// sobol` with as many samples and the same seed.
///
/// * `scene` – from `halflight_scene_open`
/// * `column`, `row` – from the left, from the top
/// * `samples`, `seed` – as for `halflight_irradiance`
/// * `radiance` – receives the answer
///
/// # Safety
/// `scene` must be null or open, `radiance` must be null or point to a `HalflightRadiance`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_pixel(
    scene: *const HalflightScene,
    column: u32,
    row: u32,
    samples: u32,
    seed: u32,
    radiance: *mut HalflightRadiance,
) -> HalflightStatus {
    let ask = || {
        // SAFETY: as the caller promises.
        let opened = unsafe { get(scene)? };
        let HalflightScene { scene, camera, film } = *opened;
        if column >= film.width() || row >= film.height() || samples == 0 {
            return Err(HalflightStatus::Argument);
        }
        let (estimator, sequence) = (Direct::default(), Sobol::new(seed));
        let job = Job { scene, camera, film, estimator, sequence };
        let pixel = PixelRect { x0: column, y0: row, x1: column + 1, y1: row + 1 };
        let mut stats = [PixelStats::NEW];
        job.render(pixel, 0..samples, &mut stats);
        Ok(stats[0].into())
    };
    // SAFETY: as the caller promises.
    unsafe { put(radiance, ask) }
}
