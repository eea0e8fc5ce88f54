//! What a cell's light is in truth, and how well the numbers that describe it determine that.

use super::setup::Setup;
use crate::lights::Specimen;
use crate::oracle::{Amounts, CELLS, Outlook};
use halflight::glam::DVec3;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// How far rounding may turn a receiver's normal (rad).
const TURN: f64 = 2.0 * f32::EPSILON as f64;

/// A truth that rounding of the input changes by more than this share is not held against anyone.
const LOOSEST: f64 = 0.3;

/// What can be said about a light from one receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Nothing is seen of it.
    Dark,
    /// It is seen.
    Seen,
    /// The last bits of the input decide.
    Undecided,
}

/// Truths that have been worked out: they are the same for every density.
static KNOWN: Mutex<BTreeMap<String, Arc<Truth>>> = Mutex::new(BTreeMap::new());

/// The truth about a light from one receiver.
#[derive(Debug, Clone)]
pub(super) struct Truth {
    /// The surface in cells.
    pub(super) outlook: Outlook,
    /// What is in each cell.
    pub(super) cells: [Amounts; CELLS],
    /// What is in all of them.
    pub(super) total: Amounts,
    /// By how much rounding of the input changes each cell.
    pub(super) slack: [Amounts; CELLS],
    /// By how much it changes all of them together.
    pub(super) total_slack: Amounts,
    /// What can be said.
    pub(super) state: State,
}

impl Truth {
    /// The truth of a setup, worked out once.
    pub(super) fn of<S: Specimen>(setup: &Setup<S>) -> Arc<Self> {
        // Debug prints every number to its last digit.
        let key = format!("{:?} {:?}", setup.shape, setup.from);
        let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().get(&key).cloned();
        found.unwrap_or_else(|| {
            let truth = Arc::new(Self::new(setup));
            known().insert(key, Arc::clone(&truth));
            truth
        })
    }

    fn new<S: Specimen>(setup: &Setup<S>) -> Self {
        let outlook = setup.shape.outlook(setup.from.point.as_dvec3());
        let normal = setup.from.normal.as_dvec3().normalize();
        let cells = outlook.seen(DVec3::ZERO, normal);
        let total = sum(&cells);
        let across = normal.any_orthonormal_vector();
        let turns = [across, normal.cross(across), across];
        let (mut slack, mut total_slack) = ([Amounts::default(); CELLS], Amounts::default());
        let mut ever_seen = total.solid_angle > 0.0;
        for (axis, turn) in turns.into_iter().enumerate() {
            let step =
                DVec3::from_array(std::array::from_fn(|i| f64::from(u8::from(i == axis)))) * setup.grid;
            let [a, b] = [1.0, -1.0].map(|k| {
                let normal = (normal + turn * (TURN * k)).normalize();
                outlook.seen(step * k, normal)
            });
            for i in 0..CELLS {
                slack[i] = slack[i].plus(farther(&cells[i], &a[i], &b[i]));
            }
            let (a, b) = (sum(&a), sum(&b));
            total_slack = total_slack.plus(farther(&total, &a, &b));
            ever_seen |= a.solid_angle.max(b.solid_angle) > 0.0;
        }
        let state = if ever_seen { State::Seen } else { State::Dark };
        let mut truth = Self { outlook, cells, total, slack, total_slack, state };
        let firm = truth.rounding() <= LOOSEST * total.irradiance
            && total_slack.solid_angle <= LOOSEST * total.solid_angle;
        if ever_seen && !(firm && total.irradiance > 0.0) {
            truth.state = State::Undecided;
        }
        truth
    }

    /// What single precision may be off in an irradiance, whoever computes it: 1e-5 of it, what
    /// rounded input changes, and a few roundings of the solid angle, of which it is a small part
    /// where the light is low above the horizon.
    pub(super) fn rounding(&self) -> f64 {
        1e-5 * self.total.irradiance + self.total_slack.irradiance + 3e-7 * self.total.solid_angle
    }
}

fn sum(cells: &[Amounts; CELLS]) -> Amounts {
    cells.iter().fold(Amounts::default(), |a, b| a.plus(*b))
}

/// How far two others are from the first, at most.
fn farther(from: &Amounts, a: &Amounts, b: &Amounts) -> Amounts {
    let off = |f: fn(&Amounts) -> f64| (f(a) - f(from)).abs().max((f(b) - f(from)).abs());
    Amounts {
        area: off(|x| x.area),
        solid_angle: off(|x| x.solid_angle),
        irradiance: off(|x| x.irradiance),
        cos_squared: off(|x| x.cos_squared),
        geometry_squared: off(|x| x.geometry_squared),
    }
}
