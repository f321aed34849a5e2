//! The pose of nodes at a time of the animations.
use std::collections::HashMap;

use glam::{DQuat, DVec4};

use super::{
    accessor::{Column, Picks},
    buffers::Buffers,
    document::{Animation, Channel, Document, Index, element},
    refusal::Found,
};

/// Bytes of a weight while it is interpolated.
const WEIGHT: u64 = 64;

/// Properties of a node that animations set.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub weights: Option<Vec<f64>>,
}

/// Poses by node.
#[derive(Default)]
pub struct Poses {
    pub by_node: HashMap<Index, Pose>,
    /// Names of animations that set what an earlier one sets too, and are left out there.
    pub left_out: Vec<String>,
    /// Targets that are not read.
    pub unknown: Vec<String>,
}

/// Interpolation between two keys.
#[derive(Clone, Copy, PartialEq)]
enum Interpolation {
    Step,
    Linear,
    Cubic,
}

/// Evaluates all animations at a time, seconds. Where two set the same, the first one counts.
pub fn poses(document: &Document, buffers: &Buffers, time: f64) -> Found<Poses> {
    let mut poses = Poses::default();
    for (place, animation) in document.animations.iter().enumerate() {
        let name = if animation.name.is_empty() { format!("animation {place}") } else { animation.name.clone() };
        let mut is_left_out = false;
        for channel in &animation.channels {
            let Some(node) = channel.target.node else { continue };
            let new = evaluated(document, buffers, animation, channel, time).map_err(|error| error.within(&name))?;
            match new {
                None => poses.unknown.push(channel.target.path.clone()),
                Some(new) => is_left_out |= !poses.by_node.entry(node).or_default().add(new),
            }
        }
        if is_left_out {
            poses.left_out.push(name);
        }
    }
    Ok(poses)
}

impl Pose {
    /// Adds what is not set yet, and returns whether that is all.
    fn add(&mut self, other: Pose) -> bool {
        fn fill<T>(slot: &mut Option<T>, value: Option<T>) -> bool {
            let is_free = value.is_none() || slot.is_none();
            if slot.is_none() {
                *slot = value;
            }
            is_free
        }
        let parts = [
            fill(&mut self.translation, other.translation),
            fill(&mut self.rotation, other.rotation),
            fill(&mut self.scale, other.scale),
            fill(&mut self.weights, other.weights),
        ];
        parts == [true; 4]
    }
}

/// Evaluates a channel; `None` if its target is not known.
fn evaluated(document: &Document, buffers: &Buffers, animation: &Animation, channel: &Channel, time: f64) -> Found<Option<Pose>> {
    let sampler = element(&animation.samplers, channel.sampler, "sampler")?;
    let keys = Keys {
        values: Column::open(document, buffers, sampler.output)?,
        interpolation: match sampler.interpolation.as_deref() {
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::Cubic,
            _ => Interpolation::Linear,
        },
        times: Column::open(document, buffers, sampler.input)?,
    };
    if keys.times.count == 0 {
        return Err("a sampler has no times".into());
    }
    let span = keys.span(time)?;
    Ok(Some(match channel.target.path.as_str() {
        "translation" => Pose { translation: Some(keys.at(&span, 1)?[0]), ..Pose::default() },
        "scale" => Pose { scale: Some(keys.at(&span, 1)?[0]), ..Pose::default() },
        "rotation" => Pose { rotation: Some(keys.rotation(&span)?), ..Pose::default() },
        "weights" => {
            let rows = keys.values.count / keys.times.count / keys.rows_of_key();
            // Channels of many nodes can share their values.
            buffers.spend(WEIGHT * rows as u64, "weights of an animation")?;
            Pose { weights: Some(keys.at::<1>(&span, rows)?.into_flattened()), ..Pose::default() }
        }
        _ => return Ok(None),
    }))
}

/// Keys of a sampler.
struct Keys<'a> {
    times: Column<'a>,
    values: Column<'a>,
    interpolation: Interpolation,
}

/// Two keys, the time between them in seconds, and the fraction of it that has passed.
struct Span {
    keys: [usize; 2],
    length: f64,
    fraction: f64,
}

impl Keys<'_> {
    /// Splines have a tangent on both sides of a value.
    fn rows_of_key(&self) -> usize {
        if self.interpolation == Interpolation::Cubic { 3 } else { 1 }
    }

    fn time(&self, key: usize) -> Found<f64> {
        Ok(f64::from(self.times.reals::<1>(&Picks::These(vec![key as u32]))?[0][0]))
    }

    /// The keys around a time. Before the first and after the last one, both are the same. Many channels may share one long list of
    /// times: it is not read as a whole.
    fn span(&self, time: f64) -> Found<Span> {
        let (mut next, mut end) = (0, self.times.count);
        while next < end {
            let middle = (next + end) / 2;
            if self.time(middle)? <= time {
                next = middle + 1;
            } else {
                end = middle;
            }
        }
        let keys = [next.saturating_sub(1), next.min(self.times.count - 1)];
        let start = self.time(keys[0])?;
        let length = self.time(keys[1])? - start;
        let fraction = if length > 0.0 { ((time - start) / length).clamp(0.0, 1.0) } else { 0.0 };
        Ok(Span { keys, length, fraction })
    }

    /// The rows of a key: `part` is 0 for the tangent before a value, 1 for the value and 2 for the tangent after it.
    fn rows<const N: usize>(&self, key: usize, part: usize, rows: usize) -> Found<Vec<[f64; N]>> {
        let start = match self.interpolation {
            Interpolation::Cubic => (3 * key + part) * rows,
            _ => key * rows,
        };
        if start + rows > self.values.count {
            return Err(format!("a sampler has {} values for {} times", self.values.count, self.times.count).into());
        }
        let picks = Picks::These((start..start + rows).map(|row| row as u32).collect());
        let finite = |x: f32| if x.is_finite() { f64::from(x) } else { 0.0 };
        Ok(self.values.reals::<N>(&picks)?.into_iter().map(|row| row.map(finite)).collect())
    }

    /// Interpolated rows. The spline is that of glTF 2.0, appendix C.
    fn at<const N: usize>(&self, span: &Span, rows: usize) -> Found<Vec<[f64; N]>> {
        let [first, second] = span.keys;
        let (a, b) = (self.rows::<N>(first, 1, rows)?, self.rows::<N>(second, 1, rows)?);
        let t = span.fraction;
        let mixed = |weights: [f64; 2]| {
            let row = |(a, b): (&[f64; N], &[f64; N])| std::array::from_fn(|i| a[i] * weights[0] + b[i] * weights[1]);
            a.iter().zip(&b).map(row).collect::<Vec<[f64; N]>>()
        };
        Ok(match self.interpolation {
            Interpolation::Step => a,
            Interpolation::Linear => mixed([1.0 - t, t]),
            Interpolation::Cubic => {
                let (out, into) = (self.rows::<N>(first, 2, rows)?, self.rows::<N>(second, 0, rows)?);
                let (t2, t3) = (t * t, t * t * t);
                let mut values = mixed([2.0 * t3 - 3.0 * t2 + 1.0, 3.0 * t2 - 2.0 * t3]);
                let tangents = [span.length * (t3 - 2.0 * t2 + t), span.length * (t3 - t2)];
                for (value, (out, into)) in values.iter_mut().zip(out.iter().zip(&into)) {
                    for i in 0..N {
                        value[i] += out[i] * tangents[0] + into[i] * tangents[1];
                    }
                }
                values
            }
        })
    }

    /// Rotations turn at constant speed between two keys.
    fn rotation(&self, span: &Span) -> Found<[f64; 4]> {
        if self.interpolation != Interpolation::Linear {
            return Ok(self.at(span, 1)?[0]);
        }
        let [a, b] = span.keys.map(|key| self.rows::<4>(key, 1, 1));
        let [a, b] = [a?[0], b?[0]].map(quaternion);
        // `slerp` takes the shorter way.
        Ok(a.slerp(b, span.fraction).to_array())
    }
}

/// A rotation. Without direction it is none.
pub fn quaternion(numbers: [f64; 4]) -> DQuat {
    DVec4::from(numbers).try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4)
}
