//! A light in selection: estimates an upper bound of its irradiance.
use std::f32::consts::FRAC_1_PI;

use glam::DVec3;

use super::{
    ReferencePoint,
    bound::Bound,
    punctual_light::{Beam, PunctualLight, PunctualRows},
};
use crate::geometry::{Shape, Sphere};
use noisefall_base::math::{F, Lanes, Pick, V};

/// An emitting primitive, or a punctual light.
pub(super) struct Source {
    extent: Extent,
    /// Luminance of the front and of the back.
    front: f32,
    back: f32,
}

enum Extent {
    Sphere(Sphere),
    /// Any other shape within the sphere around `center`. `size` is its largest projected area over π; flat ones have a normal.
    Within {
        center: [f32; 3],
        radius_squared: f32,
        size: f32,
        normal: Option<[f32; 3]>,
    },
    /// A punctual light. Its irradiance is known exactly, but for the image that it may cast.
    PunctualLight(PunctualRows),
}

impl Source {
    /// Builds a source from a piece of a [`Shape`] and its bounds. `near` is a point near the middle of the scene.
    pub fn new(piece: &Shape, bound: &Bound, near: DVec3) -> Source {
        let extent = match piece {
            Shape::Sphere { center, radius, .. } if !bound.moves => Extent::Sphere(Sphere::new(*center, *radius, near)),
            _ => Extent::Within {
                center: bound.center.as_vec3().to_array(),
                radius_squared: (bound.radius * bound.radius) as f32,
                size: bound.size as f32,
                normal: bound.normal.map(|n| n.as_vec3().to_array()),
            },
        };
        Source { extent, front: bound.front, back: bound.back }
    }

    /// Builds a source from a light.
    pub fn of_punctual(punctual_light: &PunctualLight) -> Source {
        Source { extent: Extent::PunctualLight(punctual_light.rows(0)), front: punctual_light.light() * FRAC_1_PI, back: 0.0 }
    }

    /// Estimates an upper bound of the irradiance from this light, divided by π: E ≈ L A cos θ_i cos θ_e/d², which is a bound if
    /// the light is far away. For lobes, estimates the light that they reflect.
    #[inline(always)]
    pub fn weight<L: Lanes>(&self, l: L, at: &ReferencePoint<L>) -> F<L> {
        match &self.extent {
            Extent::Sphere(sphere) => {
                let cone = sphere.seen_from(l, at.p);
                let light = cone.outside.pick(l.f(self.front), l.f(self.back));
                let facing = facing(l, at, cone.axis, cone.sin_squared.sqrt());
                light * cone.sin_squared * cone.outside.pick(reflected(at, cone.axis, cone.sin_squared, facing), l.f(1.0))
            }
            Extent::Within { center, radius_squared, size, normal } => {
                let way = -(at.p - *center);
                let distance_squared = way.length_squared();
                let near = !distance_squared.above(*radius_squared);
                let axis = way * (1.0 / distance_squared.sqrt());
                let sin = (l.f(*radius_squared) / distance_squared).sqrt();
                let mut light = near.pick(l.f(1.0), reflected(at, axis, sin * sin, facing(l, at, axis, sin)));
                match normal {
                    Some(normal) => {
                        let cos = -axis.dot_with(*normal);
                        let leaving = near.pick(l.f(1.0), (cos.abs() + sin).min(l.f(1.0)));
                        light = light * leaving * cos.above(0.0).pick(l.f(self.front), l.f(self.back));
                    }
                    None => light = light * self.front.max(self.back),
                }
                light * *size / distance_squared.max(l.f(*radius_squared))
            }
            Extent::PunctualLight(rows) => {
                let beam = Beam::of_all(l, rows);
                let way = beam.way_from(l, at.p);
                let zero = l.f(0.0);
                let reflected = reflected(at, way.wi, zero, facing(l, at, way.wi, zero));
                reflected * beam.strength(l, -way.wi) * way.spread * self.front
            }
        }
    }
}

/// The reflected light, relative to that of a diffuse surface with the light overhead.
#[inline(always)]
fn reflected<L: Lanes>(at: &ReferencePoint<L>, axis: V<L>, sin_squared: F<L>, facing: F<L>) -> F<L> {
    // Not `map_or`, whose closure would be compiled without the instructions of `L`.
    match &at.lobe {
        Some(lobe) => lobe.reflected(at.n, axis, sin_squared, facing),
        None => facing,
    }
}

/// An upper bound of the cosine at the reference point for all directions within the angle of sine `sin` around `axis`.
#[inline(always)]
fn facing<L: Lanes>(l: L, at: &ReferencePoint<L>, axis: V<L>, sin: F<L>) -> F<L> {
    // Not quite 0 for a light that only just lies below the horizon: rounding may see it.
    const GRAZING: f32 = 1e-3;
    let cos = (axis.dot(at.n) + sin + GRAZING).max(l.f(0.0)).min(l.f(1.0));
    at.transmits.pick(l.f(1.0), cos)
}
