//! Floors below points, and where new objects and lights stand.
use glam::DVec3;

use super::Scene;
use crate::{geometry::MISS, shape::Placement};
use noisefall_base::math::{F, M, One, V};

/// Largest number of surfaces that a ray passes through.
const MOST_PASSED: usize = 64;
/// Distance behind a surface at which a ray continues, as a fraction of the scene's size.
const STEP: f64 = 1e-5;
/// Smallest −y of the unit normal of a ceiling.
const STEEPEST_CEILING: f64 = 0.7;
/// The height of new lights over the floor, in sizes of new objects.
const SIZES_OF_LIGHT_HEIGHT: f64 = 2.0;
/// The largest height of new lights, as a fraction of what is free above the floor.
const PART_OF_ROOM: f64 = 0.6;

impl Scene {
    /// The height of the first surface below a point that belongs to one of these objects, at time 0.
    /// Rays go on `step` metres behind a surface of another one.
    pub fn surface_below(&self, start: DVec3, step: f64, is_one: impl Fn(usize) -> bool) -> Option<f64> {
        let mut p = start;
        for _ in 0..MOST_PASSED {
            let [o, d] = [p, DVec3::NEG_Y].map(|v| V::splat(One, v.as_vec3().to_array()));
            let nearest = self.shapes.closest(One, M(true), o, d, F(0.0));
            if nearest.primitive.0 == MISS {
                return None;
            }
            let distance = f64::from(nearest.t.0);
            if is_one(self.owners[nearest.primitive.0 as usize] as usize) {
                return Some(p.y - distance);
            }
            p.y -= distance + step;
        }
        None
    }
}

impl Placement {
    /// The place on the floor below this one. One on a wall or a ceiling is moved away from it by `clearance`, metres, before; one
    /// without a floor below stays there.
    pub fn on_floor(self, scene: &Scene, clearance: f64) -> Placement {
        if self.is_on_floor() {
            return self;
        }
        let start = self.at + self.normal * clearance;
        let floor = scene.surface_below(start, STEP * scene.size, |_| true);
        Placement { at: DVec3 { y: floor.unwrap_or(start.y), ..start }, normal: DVec3::Y, ..self }
    }

    /// The place over the floor where a light hangs, facing down. On a ceiling it is that of the ceiling.
    pub fn hung(self, scene: &Scene) -> Placement {
        if self.normal.y < -STEEPEST_CEILING {
            return self;
        }
        let floor = self.on_floor(scene, self.size());
        Placement { at: floor.at + DVec3::Y * floor.light_height(scene), normal: DVec3::NEG_Y, ..floor }
    }

    /// The height over this floor at which a light has room, metres.
    pub fn light_height(&self, scene: &Scene) -> f64 {
        let wanted = SIZES_OF_LIGHT_HEIGHT * self.size();
        let [o, d] = [self.at + DVec3::Y * (STEP * scene.size), DVec3::Y].map(|v| V::splat(One, v.as_vec3().to_array()));
        let above = scene.shapes.closest(One, M(true), o, d, F(0.0));
        if above.primitive.0 == MISS { wanted } else { wanted.min(PART_OF_ROOM * f64::from(above.t.0)) }
    }
}
