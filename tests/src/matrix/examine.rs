//! The checks of one light from one receiver.

use super::Measured;
use super::kind::Kind;
use super::setup::Setup;
use super::tally::Tally;
use super::truth::{State, Truth};
use crate::lights::Specimen;
use crate::random::{Uniforms, corners};
use crate::{Failure, Verdict, ensure};
use halflight::Rgb;
use halflight::light::{
    AreaLight, Density, Emitter, SampledShape, SurfaceDensity, SurfaceSample, SurfaceView,
};
use std::f64::consts::PI;
use std::sync::Arc;

/// Samples of the checks that need no statistics.
const FEW: usize = 512;

/// Samples of the statistical checks, along the axes and turned.
const MANY: [u32; 2] = [1 << 14, 1 << 16];

/// How far a queried density may be from that of the sample, relatively.
const QUERY: f64 = 1e-5;

/// Samples with uniforms this near to an edge of the square do not know them well: there the map
/// may be singular.
const EDGE: f32 = 0.02;

/// Uniforms that the last bits of place and direction know no better than this are not compared.
const UNKNOWN: f64 = 0.1;

/// A point drawn on the light with its density, and the view that it was drawn from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn {
    /// The point as the receiver sees it.
    pub(super) sample: SurfaceSample,
    /// Density of its direction (sr⁻¹).
    pub(super) pdf: f32,
}

impl Drawn {
    /// Cosine at the light; its front emits.
    pub(super) fn cos_light(&self) -> f32 {
        -self.sample.at.normal.dot(self.sample.wi)
    }
}

/// Draws as the light does.
pub(super) fn draw(view: &impl SurfaceView, u: [f32; 2]) -> Option<Drawn> {
    let sample = view.sample(u)?;
    let cos_light = -sample.at.normal.dot(sample.wi);
    if !(cos_light > 0.0) {
        return None;
    }
    let pdf = view.pdf_solid_angle(&sample.at, sample.wi, cos_light)?;
    Some(Drawn { sample, pdf })
}

/// A light with its receiver and its truth.
struct Subject<'a, S: SampledShape> {
    setup: &'a Setup<S>,
    light: AreaLight<S>,
    method: SurfaceDensity,
    view: Option<S::View>,
    truth: Arc<Truth>,
}

/// Runs every check and notes what it finds.
pub(super) fn examine<S: Specimen>(setup: &Setup<S>, method: SurfaceDensity, measured: &mut Measured) {
    let light = AreaLight::new(setup.shape, Rgb::WHITE).expect("a proper radiance");
    let view = light.view(&setup.from, method);
    let subject = Subject { setup, light, method, view, truth: Truth::of(setup) };
    measured.note(setup.what, subject.closed_form());
    match subject.drawn(measured) {
        Err(failure) => measured.note(setup.what, Err(failure)),
        Ok(drawn) => match subject.truth.state {
            State::Dark => measured.note(setup.what, subject.stays_dark(&drawn)),
            State::Undecided => measured.skip("the last bits of the input decide"),
            State::Seen => subject.seen(&drawn, measured),
        },
    }
}

impl<S: Specimen> Subject<'_, S> {
    /// Samples over the whole square and its edges: proper, and of the density that is queried.
    fn drawn(&self, measured: &mut Measured) -> Result<Vec<([f32; 2], Drawn)>, Failure> {
        let mut random = Uniforms::new(31);
        let mut all = Vec::new();
        for u in corners().chain((0..FEW).map(|_| random.two())) {
            let sampled = self.light.sample(&self.setup.from, self.method, u);
            let drawn = self.view.and_then(|view| draw(&view, u));
            let (Some(sampled), Some(drawn)) = (sampled, drawn) else {
                ensure!(sampled.is_none() && drawn.is_none(), "light and view differ at {u:?}");
                continue;
            };
            let Density::SolidAngle(pdf) = sampled.density else {
                return Err(Failure("an area light without a density".into()));
            };
            ensure!(
                pdf == drawn.pdf && sampled.wi == drawn.sample.wi,
                "the light says {pdf}, its view {} at {u:?}",
                drawn.pdf
            );
            self.is_proper(u, &drawn)?;
            let queried =
                self.light.pdf_solid_angle(&self.setup.from, self.method, sampled.wi, &drawn.sample.at);
            let off = (f64::from(queried) / f64::from(pdf) - 1.0).abs();
            measured.density_error = measured.density_error.max(off);
            ensure!(off <= QUERY, "density {queried} when queried, {pdf} when sampled at {u:?}");
            all.push((u, drawn));
        }
        Ok(all)
    }

    /// A unit direction and finite positive numbers, at the place that they say.
    fn is_proper(&self, u: [f32; 2], drawn: &Drawn) -> Verdict {
        let SurfaceSample { at, wi, distance } = drawn.sample;
        ensure!((wi.length() - 1.0).abs() < 1e-6, "direction {wi} at {u:?}");
        ensure!(distance > 0.0 && distance.is_finite(), "distance {distance} at {u:?}");
        ensure!(drawn.pdf > 0.0 && drawn.pdf.is_finite(), "density {} at {u:?}", drawn.pdf);
        let share = self.setup.from.normal.dot(wi).max(0.0) / drawn.pdf;
        ensure!(share.is_finite(), "{share} arrives with density {} at {u:?}", drawn.pdf);
        let from = self.setup.from.point.as_dvec3();
        let end = from + wi.as_dvec3() * f64::from(distance);
        let reach = from.abs().max_element() + self.setup.size;
        let off = end.distance(at.point.as_dvec3());
        ensure!(off <= 2e-6 * reach, "the way ends {off:e} beside {} at {u:?}", at.point);
        Ok(())
    }

    /// The closed form of the irradiance, where there is one.
    fn closed_form(&self) -> Verdict {
        let Some(closed) =
            self.setup.shape.projected_solid_angle(&self.setup.from, halflight::light::Sides::Front)
        else {
            return Ok(());
        };
        let closed = f64::from(closed);
        ensure!((0.0..=1.000_001 * PI).contains(&closed), "projected solid angle {closed}");
        let truth = self.truth.total.irradiance;
        let off = (closed - truth).abs();
        let undecided = self.truth.state == State::Undecided;
        ensure!(
            undecided || off <= self.truth.rounding(),
            "projected solid angle {closed:e} instead of {truth:e}, may be off by {:.1e}",
            self.truth.rounding()
        );
        Ok(())
    }

    fn stays_dark(&self, drawn: &[([f32; 2], Drawn)]) -> Verdict {
        ensure!(drawn.is_empty(), "dark in truth, but {:?}", drawn[0]);
        Ok(())
    }

    fn seen(&self, drawn: &[([f32; 2], Drawn)], measured: &mut Measured) {
        let what = self.setup.what;
        let Some(view) = self.view else {
            return measured.note(what, Err(Failure("seen in truth, but there is no view".into())));
        };
        let (kind, nearest) = Kind::recognise(self.method, &self.truth, &self.setup.from, drawn);
        measured.kinds.insert(kind);
        if kind == Kind::Own && !Kind::may_be_own(self.setup.shape.patch(), self.method) {
            measured.note(what, Err(Failure(format!("no density that the shape should have: {nearest}"))));
        }
        measured.note(what, self.inverts(&view, drawn, kind));
        let mut random = Uniforms::new(32);
        let (from, normal) = (self.setup.from.point.as_dvec3(), self.setup.from.normal);
        let tally = Tally::of(MANY[usize::from(self.setup.aligned)], || {
            let Drawn { sample, pdf } = draw(&view, random.two())?;
            let share = f64::from(normal.dot(sample.wi).max(0.0)) / f64::from(pdf);
            // By the point, unless it is so near that the direction is rounded much less.
            let near = sample.distance < 1e-2 * self.setup.size as f32;
            let by_direction = sample.wi.as_dvec3() * f64::from(sample.distance);
            let place = if near { by_direction } else { sample.at.point.as_dvec3() - from };
            Some((self.truth.outlook.cell(place), share))
        });
        measured.judge(what, &tally, &self.truth, kind);
    }

    /// The inverse returns the uniforms, as far as the last bits of place and direction know them.
    fn inverts(&self, view: &S::View, drawn: &[([f32; 2], Drawn)], kind: Kind) -> Verdict {
        let inner = |x: f32| x > EDGE && x < 1.0 - EDGE;
        for (u, drawn) in drawn.iter().filter(|(u, _)| inner(u[0]) && inner(u[1])) {
            let Some(v) = view.invert(&drawn.sample.at, drawn.sample.wi) else {
                return Err(Failure(format!("no inverse of the sample at {u:?}")));
            };
            ensure!(v.iter().all(|x| (0.0..1.0).contains(x)), "{u:?} became {v:?}");
            // 0 and 1 may be the same place.
            let off = u.iter().zip(v).map(|(a, b)| (a - b).abs().min(1.0 - (a - b).abs()));
            let off = f64::from(off.fold(0.0, f32::max));
            let tolerance = self.inverse_tolerance(drawn, kind);
            ensure!(
                tolerance > UNKNOWN || off <= tolerance,
                "{u:?} became {v:?}, may be off by {tolerance:.1e}"
            );
        }
        Ok(())
    }

    /// How well the uniforms of a place are known. The place is rounded by the grid of the light's
    /// numbers, and by that of the direction; a uniform changes with it by at most the density over
    /// the area times the extent of what is seen across.
    fn inverse_tolerance(&self, drawn: &Drawn, kind: Kind) -> f64 {
        let eps = 16.0 * f64::from(f32::EPSILON);
        let (distance, cos) = (f64::from(drawn.sample.distance), f64::from(drawn.cos_light()));
        let rounding = eps * (self.setup.size + distance / cos);
        let pdf_area = f64::from(drawn.pdf) * cos / (distance * distance);
        // By direction, most of what is seen of a near light is as near as the place.
        let near = if kind == Kind::Area { self.setup.size } else { self.setup.size.min(4.0 * distance) };
        1e-4 + rounding * pdf_area * near
    }
}
