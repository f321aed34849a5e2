//! Tools of the sections: scenes from text, settings with independent samples, moments of images.
use glam::{DVec3, Vec3};

use super::Validation;
use noisefall_base::math::{F, One, U, V};
use noisefall_kernel::measure::{Measure, Moments, samples};
use noisefall_scene::{
    sampling::{
        Directions, Sampler,
        hash::{hash, unit},
    },
    scene::{Estimator, RenderSettings, Reuse, Roulette, Scene, parse},
};

pub const RED: Measure = |radiance| f64::from(radiance[0]);

/// The estimators that find light where the camera sees a point. No light path arrives in so small a view.
pub fn of_a_point() -> impl Iterator<Item = Estimator> {
    Estimator::ALL.into_iter().filter(|estimator| *estimator != Estimator::LightTracing)
}

/// Relative error of the tables of lost energy and their interpolation.
pub const TABLES: f64 = 1e-3;

/// The scene of a text without its `format` line.
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

/// The largest of non-negative values; NaN if one of them is NaN, so that NaN cannot pass a test.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, x| if x > largest || x.is_nan() { x } else { largest })
}

/// A direction as f32 in one lane.
pub fn lanes(v: DVec3) -> V<One> {
    V::splat(One, v.as_vec3().to_array())
}

/// A direction of one lane as f64.
pub fn wide(v: V<One>) -> DVec3 {
    Vec3::from(v.lane(0)).as_dvec3()
}

/// The random numbers of one measurement.
#[derive(Clone, Copy)]
pub struct Random(u32);

impl Random {
    /// A number in (0, 1) for the `i`-th sample and one of eight dimensions.
    pub fn at(self, i: u32, dimension: u32) -> F<One> {
        unit(hash(hash(U(i.wrapping_mul(8).wrapping_add(dimension))) ^ self.0))
    }

    /// The random numbers that choose a direction: a point of the unit square, and a number for the lobe.
    pub fn direction(self, i: u32) -> ((F<One>, F<One>), F<One>) {
        ((self.at(i, 0), self.at(i, 1)), self.at(i, 2))
    }
}

impl Validation {
    /// Settings with independent samples, without cap and roulette, and with random numbers of their own.
    pub fn settings(&self, estimator: Estimator) -> RenderSettings {
        RenderSettings {
            estimator,
            merging: false,
            sampler: Sampler::Independent,
            directions: Directions::Cosine,
            roulette: Roulette::Off,
            max_bounces: None,
            count_crossings: false,
            reuse: Reuse::Off,
            adaptive: false,
            seed: self.next_seed(),
            strategy: None,
            fault: self.fault,
        }
    }

    /// Settings of the path estimator with these directions.
    pub fn path(&self, directions: Directions) -> RenderSettings {
        RenderSettings { directions, ..self.settings(Estimator::Path) }
    }

    /// Random numbers with the next seed.
    pub fn random(&self) -> Random {
        Random(self.next_seed())
    }

    /// Moments of the red channel of 1024 pixels, each over `full` samples, or fewer in a quick run.
    pub fn moments(&self, scene: &Scene, settings: RenderSettings, full: u32) -> Moments {
        Moments::of(samples(scene, settings, self.spp(full)).iter().flatten().copied())
    }
}
