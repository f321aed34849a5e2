//! What sections measure with: scenes from text, settings whose only chance is in the samples, sums over pictures.
use glam::{DVec3, Vec3};

use super::Validation;
use crate::{
    math::{F, One, U, V},
    measure::{Measure, Moments, samples},
    sampling::{
        Directions, Sampler,
        hash::{hash, unit},
    },
    scene::{Estimator, RenderSettings, Reuse, Roulette, Scene, parse},
};

pub const RED: Measure = |radiance| f64::from(radiance[0]);

/// What tables of lost light and their interpolation may lose or add.
pub const TABLES: f64 = 1e-3;

/// The scene of a file that says this after its version.
pub fn scene(text: &str) -> Scene {
    parse("validation", format!("format = 1\n{text}")).unwrap_or_else(|error| panic!("{}\n{text}", error.report()))
}

/// The inside of a unit sphere that emits 1 and reflects ρ.
pub fn furnace(albedo: f64) -> Scene {
    scene(&format!(
        "camera = {{ eye = [0.3, 0.1, -0.2], look_at = [1.0, 0.4, 0.3], fov = 70.0, resolution = [32, 32] }}
        materials.wall.lambertian.albedo = {albedo:?}
        [[objects]]
        shape.sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }}
        material = 'wall'
        emission.radiance = 1.0
        flip = true"
    ))
}

/// The largest of values that are not negative; NaN if one is NaN, which must not pass for small.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, x| if x > largest || x.is_nan() { x } else { largest })
}

/// A direction in numbers of f32, in one lane.
pub fn lanes(v: DVec3) -> V<One> {
    V::splat(One, v.as_vec3().to_array())
}

/// The direction of one lane in f64.
pub fn wide(v: V<One>) -> DVec3 {
    Vec3::from(v.lane(0)).as_dvec3()
}

/// The random numbers of one measurement.
#[derive(Clone, Copy)]
pub struct Random(u32);

impl Random {
    /// A number in (0, 1) for each of eight dimensions of the `i`-th of many.
    pub fn at(self, i: u32, dimension: u32) -> F<One> {
        unit(hash(hash(U(i.wrapping_mul(8).wrapping_add(dimension))) ^ self.0))
    }

    /// The point of the unit square and the number that choose a direction.
    pub fn direction(self, i: u32) -> ((F<One>, F<One>), F<One>) {
        ((self.at(i, 0), self.at(i, 1)), self.at(i, 2))
    }
}

impl Validation {
    /// Independent samples without cap or roulette, and random numbers that no other measurement has.
    pub fn settings(&self, estimator: Estimator) -> RenderSettings {
        RenderSettings {
            estimator,
            sampler: Sampler::Independent,
            directions: Directions::Cosine,
            roulette: Roulette::Off,
            max_bounces: None,
            reuse: Reuse::Off,
            adaptive: false,
            seed: self.next_seed(),
            #[cfg(test)]
            fault: self.fault,
        }
    }

    /// The path estimator with these directions.
    pub fn path(&self, directions: Directions) -> RenderSettings {
        RenderSettings { directions, ..self.settings(Estimator::Path) }
    }

    /// Random numbers with the next seed.
    pub fn random(&self) -> Random {
        Random(self.next_seed())
    }

    /// Moments of the red of `full` samples (fewer in a quick run) of each of 1024 pixels.
    pub fn moments(&self, scene: &Scene, settings: RenderSettings, full: u32) -> Moments {
        Moments::of(samples(scene, settings, self.spp(full)).iter().flatten().copied())
    }
}
