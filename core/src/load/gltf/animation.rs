//! Animations, as far as they move the camera.

use super::accessor::Elements;
use super::camera;
use super::container::malformed;
use super::document::{AnimationSampler, Camera, Node};
use super::log::Log;
use super::scene::transform;
use super::source::{Source, entry};
use crate::build::CameraDescription;
use crate::load::Problem;
use glam::{DMat4, DQuat, DVec4};
use std::format;
use std::vec;
use std::vec::Vec;

/// Most keys of all curves that move a camera: as many as twelve hours have at 24 a second.
const MAX_KEYS: usize = 1 << 20;

/// A camera that moves, and the nodes that it hangs from.
#[derive(Debug, Clone)]
pub(in crate::load) struct Moves {
    camera: Camera,
    /// From the root to the camera.
    links: Vec<Link>,
    end: f64,
}

/// A node, and what moves it.
#[derive(Debug, Clone)]
struct Link {
    node: Node,
    translation: Option<Curve>,
    rotation: Option<Curve>,
    scale: Option<Curve>,
}

/// Values over time.
#[derive(Debug, Clone)]
struct Curve {
    /// Growing (s).
    times: Vec<f32>,
    /// One for each time; for cubic splines three: tangent in, value, tangent out.
    values: Vec<DVec4>,
    how: Interpolation,
    /// Whether they are quaternions.
    turns: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Interpolation {
    Linear,
    Step,
    CubicSpline,
}

/// What moves a camera's node or one that it hangs from; `None` when nothing does.
pub(super) fn read(source: &Source<'_>, log: &mut Log<'_>, node: usize) -> Result<Option<Moves>, Problem> {
    let mut chain = chain(&source.document.nodes, node);
    let mut keys = 0;
    for animation in &source.document.animations {
        for channel in &animation.channels {
            let place = chain.iter_mut().find(|(index, _)| channel.target.node == Some(*index));
            let Some((curve, kind)) = place.and_then(|(_, link)| link.curve(&channel.target.path)) else {
                log.warn(
                    "animations",
                    "only the camera moves, with --frames; all else stays as it was modelled",
                );
                continue;
            };
            if curve.is_some() {
                log.warn("animations", "the camera is moved by several; the first one is followed");
                continue;
            }
            let sampler = entry(&animation.samplers, "samplers", channel.sampler)?;
            let read = Curve::read(source, sampler, kind)?;
            keys += read.times.len();
            *curve = Some(read);
            if keys > MAX_KEYS {
                return Err(Problem::TooLarge { what: "keys of an animation", limit: MAX_KEYS });
            }
        }
    }
    let links: Vec<_> = chain.into_iter().map(|(_, link)| link).collect();
    let end = links.iter().flat_map(Link::curves).filter_map(|curve| curve.times.last().copied());
    let Some(end) = end.reduce(f32::max).map(f64::from) else { return Ok(None) };
    let Some(index) = source.document.nodes[node].camera else { return Ok(None) };
    let camera = entry(&source.document.cameras, "cameras", index)?.clone();
    Ok(Some(Moves { camera, links, end }))
}

/// A node and those that it hangs from, the root first. The tree is known to be one.
fn chain(nodes: &[Node], node: usize) -> Vec<(usize, Link)> {
    let mut parents = vec![None; nodes.len()];
    for (parent, of) in nodes.iter().enumerate() {
        for child in &of.children {
            if let Some(place) = parents.get_mut(*child) {
                *place = Some(parent);
            }
        }
    }
    let mut indices = vec![node];
    while let Some(parent) = indices.last().and_then(|last| parents[*last])
        && indices.len() <= nodes.len()
    {
        indices.push(parent);
    }
    let still =
        |index: usize| Link { node: nodes[index].clone(), translation: None, rotation: None, scale: None };
    indices.into_iter().rev().map(|index| (index, still(index))).collect()
}

impl Moves {
    /// When the last of it ends (s).
    pub(in crate::load) const fn end(&self) -> f64 {
        self.end
    }

    /// The camera at a time (s); `None` when it has no direction then.
    pub(in crate::load) fn at(&self, time: f64) -> Option<CameraDescription> {
        let mut to_world = DMat4::IDENTITY;
        for link in &self.links {
            to_world *= link.at(time)?;
        }
        camera::place(&self.camera, &to_world).ok().map(|(camera, _)| camera)
    }
}

impl Link {
    /// What moves the node in one way, and the type of its values; `None` for what moves no camera.
    fn curve(&mut self, path: &str) -> Option<(&mut Option<Curve>, &'static str)> {
        match path {
            "translation" => Some((&mut self.translation, "VEC3")),
            "rotation" => Some((&mut self.rotation, "VEC4")),
            "scale" => Some((&mut self.scale, "VEC3")),
            _ => None,
        }
    }

    fn curves(&self) -> impl Iterator<Item = &Curve> {
        [&self.translation, &self.rotation, &self.scale].into_iter().flatten()
    }

    /// From the space of the node to that of its parent.
    fn at(&self, time: f64) -> Option<DMat4> {
        let moved = |curve: &Option<Curve>| curve.as_ref().map(|curve| curve.at(time).truncate().to_array());
        let mut node = self.node.clone();
        // A node that is animated has no matrix.
        node.translation = moved(&self.translation).or(node.translation);
        node.scale = moved(&self.scale).or(node.scale);
        node.rotation = self.rotation.as_ref().map(|curve| curve.at(time).to_array()).or(node.rotation);
        transform(&node).ok()
    }
}

impl Curve {
    fn read(source: &Source<'_>, sampler: &AnimationSampler, kind: &str) -> Result<Self, Problem> {
        let how = match sampler.interpolation.as_deref() {
            None | Some("LINEAR") => Interpolation::Linear,
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::CubicSpline,
            Some(other) => {
                return Err(Problem::unknown("interpolation", other, &["LINEAR", "STEP", "CUBICSPLINE"]));
            }
        };
        let times = Elements::new(source, sampler.input, "SCALAR")?;
        let values = Elements::new(source, sampler.output, kind)?;
        if times.len() > MAX_KEYS {
            return Err(Problem::TooLarge { what: "keys of an animation", limit: MAX_KEYS });
        }
        let times: Vec<f32> = (0..times.len()).map(|i| times.get::<1>(i)[0]).collect();
        if times.is_empty() || times.iter().any(|t| !t.is_finite()) || times.windows(2).any(|t| t[0] >= t[1])
        {
            return Err(malformed("the times of its animation do not grow"));
        }
        let for_each = if how == Interpolation::CubicSpline { 3 } else { 1 };
        if values.len() != times.len().saturating_mul(for_each) {
            let (values, times) = (values.len(), times.len());
            return Err(malformed(format!("its animation has {times} times, but {values} values")));
        }
        let value = |i: usize| {
            let numbers: [f32; 4] = if kind == "VEC4" {
                values.get(i)
            } else {
                let [x, y, z] = values.get(i);
                [x, y, z, 0.0]
            };
            DVec4::from_array(numbers.map(f64::from))
        };
        let values: Vec<_> = (0..values.len()).map(value).collect();
        if values.iter().any(|value| !value.is_finite()) {
            return Err(malformed("its animation is not finite"));
        }
        let turns = kind == "VEC4";
        Ok(Self { times, values, how, turns })
    }

    /// The value at a time (s).
    ///
    /// Source: glTF 2.0 Specification, appendix C.
    fn at(&self, time: f64) -> DVec4 {
        let value = |i: usize| {
            if self.how == Interpolation::CubicSpline { self.values[3 * i + 1] } else { self.values[i] }
        };
        let after = self.times.partition_point(|t| f64::from(*t) <= time);
        if after == 0 || after == self.times.len() {
            return value(after.saturating_sub(1));
        }
        let before = after - 1;
        let span = f64::from(self.times[after]) - f64::from(self.times[before]);
        let t = (time - f64::from(self.times[before])) / span;
        match self.how {
            Interpolation::Step => value(before),
            Interpolation::Linear if self.turns => {
                let [a, b] = [before, after].map(|i| DQuat::from_vec4(value(i)).normalize());
                DVec4::from(a.slerp(b, t))
            }
            Interpolation::Linear => value(before).lerp(value(after), t),
            Interpolation::CubicSpline => {
                let (out, into) = (self.values[3 * before + 2] * span, self.values[3 * after] * span);
                let (t2, t3) = (t * t, t * t * t);
                value(before) * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + out * (t3 - 2.0 * t2 + t)
                    + value(after) * (3.0 * t2 - 2.0 * t3)
                    + into * (t3 - t2)
            }
        }
    }
}
