//! A cluster of lights as stored in a node: a bounding sphere, the total power, and a cone around the normals, in two rows of
//! four numbers.
use glam::Vec3;

use super::super::{ReferencePoint, bound::Bound};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// A light as input of the build.
#[derive(Clone, Copy)]
pub(in crate::light) struct Item {
    pub center: Vec3,
    pub radius: f32,
    /// Luminance times largest projected area, divided by π.
    pub power: f32,
    /// Unit normal of the emitting side; 0 if there is none and all sides emit.
    pub axis: Vec3,
    pub two_sided: bool,
    pub light: u32,
}

impl Item {
    pub fn new(bound: &Bound, light: u32) -> Item {
        let center = bound.center.as_vec3();
        // Distance that rounding can move the centre, of both the light and the reference point.
        let moved = 4.0 * f32::EPSILON * center.abs().max_element();
        let axis = bound.normal.map_or(Vec3::ZERO, glam::DVec3::as_vec3);
        Item {
            center,
            radius: (bound.radius as f32 * (1.0 + 1e-6) + moved).max(1e-18),
            power: bound.size as f32 * bound.front.max(bound.back),
            axis: if bound.front > 0.0 { axis } else { -axis },
            two_sided: bound.front > 0.0 && bound.back > 0.0,
            light,
        }
    }
}

/// The rows of a node: centre, radius; power (negative when two-sided), axis x and y, axis z and cosine of the spread in halves of
/// words, and the word.
pub(super) type Rows = [[f32; 4]; 2];

const HALF: f32 = 32767.0;

/// x in [−1, 1] as a 16-bit number, rounded to nearest.
fn half(x: f32) -> u32 {
    (x * HALF + HALF).round() as u32
}

/// The rows of a cluster of lights; `word` refers to its children.
pub(super) fn rows(items: &[Item], word: u32) -> Rows {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for item in items {
        low = low.min(item.center - item.radius);
        high = high.max(item.center + item.radius);
    }
    let center = if items.len() == 1 { items[0].center } else { low + (high - low) * 0.5 };
    let reach = |item: &Item| item.center.distance(center) + item.radius;
    let radius = items.iter().map(reach).fold(0.0, f32::max) * (1.0 + 1e-6);
    let power: f32 = items.iter().map(|item| f64::from(item.power)).sum::<f64>() as f32;
    let two_sided = items.iter().any(|item| item.two_sided);
    let (axis, cos_spread) = cone(items, two_sided);
    let [x, y, z] = axis.map(half);
    let spread = (cos_spread * HALF + HALF).floor().max(0.0) as u32;
    let power = if two_sided { -power } else { power };
    [
        [center.x, center.y, center.z, radius],
        [power, f32::from_bits(x | y << 16), f32::from_bits(z | spread << 16), f32::from_bits(word)],
    ]
}

/// A cone around the normals; a two-sided light counts with either. The cone allows for the rounding of its stored axis.
fn cone(items: &[Item], two_sided: bool) -> ([f32; 3], f32) {
    /// Upper bound of the tilt of the axis by rounding and by its inexact length.
    const TILT: f32 = 0.01;
    let mut sum = Vec3::ZERO;
    for item in items {
        let axis = item.axis * item.power;
        sum += if two_sided && axis.dot(sum) < 0.0 { -axis } else { axis };
    }
    let axis = sum.try_normalize().unwrap_or(Vec3::Z);
    let cos = |item: &Item| match item.axis.dot(axis) {
        _ if item.axis == Vec3::ZERO => -1.0,
        cos if two_sided => cos.abs(),
        cos => cos,
    };
    let angle = items.iter().map(cos).fold(1.0, f32::min).max(-1.0).acos() + TILT;
    (axis.to_array(), angle.min(std::f32::consts::PI).cos())
}

/// Nodes in lanes.
pub(super) struct Cluster<L: Lanes> {
    center: V<L>,
    radius: F<L>,
    power: F<L>,
    axis: U<L>,
    spread: U<L>,
    pub word: U<L>,
}

impl<L: Lanes> Cluster<L> {
    #[inline(always)]
    pub fn new([[x, y, z, radius], [power, axis, spread, word]]: [[F<L>; 4]; 2]) -> Self {
        Cluster { center: V { x, y, z }, radius, power, axis: axis.bits(), spread: spread.bits(), word: word.bits() }
    }

    /// One node in all lanes.
    #[inline(always)]
    pub fn of_all(l: L, rows: &Rows) -> Self {
        let [[x, y, z, radius], [power, axis, spread, word]] = *rows;
        Cluster::new([[l.f(x), l.f(y), l.f(z), l.f(radius)], [l.f(power), l.f(axis), l.f(spread), l.f(word)]])
    }

    /// Estimates the irradiance from these lights, divided by π; 0 only if they cannot contribute. `oriented`: some lights have
    /// normals.
    ///
    /// Let θ be the angle at the reference point between its normal and the direction to the centre, and β half the angle that
    /// the sphere subtends. Then cos(θ − β) bounds all cosines. The estimate mixes a quarter of the bound with three quarters of
    /// the cosine at the centre. The distance counts as at least half the radius. Over 500 and 4000 lights of four kinds the
    /// variance of the choice was 1.3 to 3 times lower than with the bounds alone in seven cases, and 1.1 times higher in one.
    /// Sines and cosines are multiplied by the distance; the sign of the sine of a difference tells which of two angles is
    /// larger.
    #[inline(always)]
    pub fn weight(&self, l: L, at: &ReferencePoint<L>, oriented: bool) -> F<L> {
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let way = self.center - at.p;
        let (distance_squared, radius_squared) = (way.length_squared(), self.radius * self.radius);
        let scale = 1.0 / distance_squared.max(radius_squared);
        let bound_of_sphere = SolidAngleBound {
            cos_beta: (distance_squared - radius_squared).max(zero).sqrt(),
            sin_beta: self.radius,
            far: radius_squared.lt(distance_squared),
            scale,
            root_of_scale: scale.sqrt(),
        };
        let power = self.power.abs() / distance_squared.max(radius_squared * 0.25);
        let cos = way.dot(at.n);
        let sin = (distance_squared - cos * cos).max(zero).sqrt();
        let mut weight = power * at.transmits.pick(one, bound_of_sphere.cosine(cos, sin));
        if oriented {
            let axis = V { x: unhalf(self.axis & 0xffff), y: unhalf(self.axis >> 16), z: unhalf(self.spread & 0xffff) };
            let cos_spread = unhalf(self.spread >> 16);
            let sin_spread = (1.0 - cos_spread * cos_spread).max(zero).sqrt();
            let cos = -way.dot(axis);
            let cos = self.power.below(0.0).pick(cos.abs(), cos);
            let sin = (distance_squared - cos * cos).max(zero).sqrt();
            let (cos, sin) = (cos * cos_spread + sin * sin_spread, sin * cos_spread - cos * sin_spread);
            weight = weight * sin.above(0.0).pick(bound_of_sphere.cosine(cos, sin), one);
        }
        weight
    }
}

/// The solid angle of a cluster's sphere from a reference point.
struct SolidAngleBound<L: Lanes> {
    /// Cosine of half the subtended angle, times the distance.
    cos_beta: F<L>,
    sin_beta: F<L>,
    /// Lanes whose reference point is outside the sphere.
    far: M<L>,
    /// 1/distance², and its root; at most 1/radius².
    scale: F<L>,
    root_of_scale: F<L>,
}

impl<L: Lanes> SolidAngleBound<L> {
    /// Estimates the cosine of an angle at the reference point for the whole sphere. `cos` and `sin` are those at the centre,
    /// times the distance.
    #[inline(always)]
    fn cosine(&self, cos: F<L>, sin: F<L>) -> F<L> {
        // Not quite 0 for a light that only just lies below the horizon: rounding may see it.
        const GRAZING: f32 = 1e-3;
        let (zero, one) = (cos.splat(0.0), cos.splat(1.0));
        let beyond = self.far & (sin * self.cos_beta - cos * self.sin_beta).above(0.0);
        let bound = (cos * self.cos_beta + sin * self.sin_beta) * self.scale + GRAZING;
        let bound = beyond.pick(bound.max(zero).min(one), one);
        bound * 0.25 + (cos * self.root_of_scale).max(zero) * 0.75
    }
}

#[inline(always)]
fn unhalf<L: Lanes>(x: U<L>) -> F<L> {
    x.to_real() * (1.0 / HALF) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::hash::{hash, unit};
    use noisefall_base::math::One;

    /// By rounding, the square of a cosine of −1 is larger than 1 in some of these directions.
    #[test]
    fn lights_straight_behind_a_surface_or_that_face_straight_away_from_it_count_for_nothing() {
        for i in 0..200 {
            let u = |k: u32| f64::from(unit(hash(U::<One>(8 * i + k))).0);
            let (z, turn) = (2.0 * u(0) - 1.0, std::f64::consts::TAU * u(1));
            let (sin, cos) = turn.sin_cos();
            let out = (glam::DVec2::new(cos, sin) * (1.0 - z * z).sqrt()).extend(z).as_vec3();
            let center = out * (1.0 + u(2)) as f32;
            let item = |axis: Vec3| Item { center, radius: 0.1, power: 1.0, axis, two_sided: false, light: 0 };
            let weight = |n: Vec3, axis: Vec3| {
                let n = V::splat(One, n.to_array());
                let at = ReferencePoint { p: V::splat(One, [0.0; 3]), n, transmits: M(false), lobe: None };
                Cluster::of_all(One, &rows(&[item(axis)], 0)).weight(One, &at, axis != Vec3::ZERO).0
            };
            assert_eq!([weight(-out, Vec3::ZERO), weight(out, out)], [0.0; 2], "{i}: {out}");
            assert!(weight(out, -out) > 0.0, "{i}: {out}");
        }
    }

    /// A quarter of the bound cos(θ − β), which is 1 where the sphere reaches over the normal, and three quarters of cos θ.
    #[test]
    fn the_weight_of_a_cluster_falls_off_with_the_angle_at_the_reference_point() {
        for i in 0..200 {
            let u = |k: u32| f64::from(unit(hash(U::<One>(8 * i + k))).0);
            let (radius, distance, theta, power) = (0.1 + u(0), 0.2 + 3.0 * u(1), std::f64::consts::PI * u(2), 1.0 + u(3));
            let item = Item {
                center: Vec3::new(0.0, (distance * theta.cos()) as f32, (distance * theta.sin()) as f32),
                radius: radius as f32,
                power: power as f32,
                axis: Vec3::ZERO,
                two_sided: false,
                light: 0,
            };
            let at =
                ReferencePoint { p: V::splat(One, [0.0; 3]), n: V::splat(One, [0.0, 1.0, 0.0]), transmits: M(false), lobe: None };
            let found = f64::from(Cluster::of_all(One, &rows(&[item], 0)).weight(One, &at, false).0);
            let bound = if radius < distance {
                let beta = (radius / distance).asin();
                if theta > beta { ((theta - beta).cos() + 1e-3).clamp(0.0, 1.0) } else { 1.0 }
            } else {
                1.0
            };
            let centre = (distance * theta.cos() / distance.max(radius)).max(0.0);
            let exact = power / distance.powi(2).max(0.25 * radius.powi(2)) * (0.25 * bound + 0.75 * centre);
            assert!((found - exact).abs() < 1e-4 * power + 1e-3 * exact, "{i}: {found} {exact}, {radius} {distance} {theta}");
        }
    }
}
