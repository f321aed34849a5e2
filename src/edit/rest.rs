//! Drops objects onto the surface below them.
use glam::DVec3;

use super::{Document, Edit, Placement};
use crate::{
    geometry::MISS,
    math::{F, M, One, V},
    scene::Scene,
    shape::Transform,
};

/// Places of vertical rays, as fractions of the edges of an object's box. From above they tell where the object is, and from half its
/// height what is below.
const PLACES: [f64; 5] = [0.01, 0.25, 0.5, 0.75, 0.99];
/// Largest number of surfaces that a ray passes through.
const MOST_PASSED: usize = 64;
/// Distance behind a surface at which a ray continues, as a fraction of the object's size.
const STEP: f64 = 1e-5;
/// The accuracy of a drop, as a fraction of the object's size: intersections are found in single precision.
const ACCURACY: f64 = 1e-6;
/// Smallest −y of the unit normal of a ceiling.
const STEEPEST_CEILING: f64 = 0.7;
/// The height of new lamps over the floor, in sizes of new objects.
const SIZES_OF_LAMP_HEIGHT: f64 = 2.0;
/// The largest height of new lamps, as a fraction of what is free above the floor.
const PART_OF_ROOM: f64 = 0.6;

impl Document {
    /// The edit that lets an object rest on the highest surface that is below it and below the middle of its height. An object that has
    /// sunk in is raised; what stands beside it is ignored. `scene` is the compiled scene of this document. `None` if there is nothing
    /// below, or if it rests already.
    pub fn drop_to_floor(&self, scene: &Scene, object: usize) -> Option<Edit> {
        let own = scene.objects_of(object);
        let objects = scene.objects.get(own.clone())?;
        let corners = objects.iter().map(|object| object.shape.corners());
        let [min, max] = corners.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])?;
        let size = (max - min).max_element();
        let (step, is_own) = (STEP * size, |owner: usize| own.contains(&owner));
        let meets_object = |column: &DVec3| surface_below(scene, column.with_y(max.y + step), step, is_own).is_some();
        let columns = PLACES.into_iter().flat_map(|x| PLACES.map(|z| min + (max - min) * DVec3::new(x, 0.5, z)));
        let (meeting, beside): (Vec<_>, Vec<_>) = columns.partition(meets_object);
        // No vertical ray meets an upright sheet.
        let columns = if meeting.is_empty() { beside } else { meeting };
        let floors = columns.into_iter().filter_map(|column| surface_below(scene, column, step, |owner| !is_own(owner)));
        let by = to_accuracy(floors.max_by(f64::total_cmp)? - min.y, ACCURACY * size);
        (by != 0.0).then(|| self.transformed(object, &Transform::Translate(DVec3::Y * by), DVec3::ZERO)).flatten()
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
        let floor = surface_below(scene, start, STEP * scene.size, |_| true);
        Placement { at: DVec3 { y: floor.unwrap_or(start.y), ..start }, normal: DVec3::Y, ..self }
    }

    /// The place over the floor where a lamp hangs, facing down. On a ceiling it is that of the ceiling.
    pub fn hung(self, scene: &Scene) -> Placement {
        if self.normal.y < -STEEPEST_CEILING {
            return self;
        }
        let floor = self.on_floor(scene, self.size());
        Placement { at: floor.at + DVec3::Y * floor.lamp_height(scene), normal: DVec3::NEG_Y, ..floor }
    }

    /// The height over this floor at which a lamp has room, metres.
    pub fn lamp_height(&self, scene: &Scene) -> f64 {
        let wanted = SIZES_OF_LAMP_HEIGHT * self.size();
        let [o, d] = [self.at + DVec3::Y * (STEP * scene.size), DVec3::Y].map(|v| V::splat(One, v.as_vec3().to_array()));
        let above = scene.shapes.closest(One, M(true), o, d, F(0.0));
        if above.primitive.0 == MISS { wanted } else { wanted.min(PART_OF_ROOM * f64::from(above.t.0)) }
    }
}

/// Rounds a number to the decimals that an accuracy warrants.
fn to_accuracy(x: f64, accuracy: f64) -> f64 {
    let decimals = (-accuracy.log10()).ceil().clamp(0.0, 300.0) as usize;
    format!("{x:.decimals$}").parse().unwrap_or(x) + 0.0
}

/// The height of the first surface below a point that belongs to one of these objects, at time 0.
fn surface_below(scene: &Scene, start: DVec3, step: f64, is_one: impl Fn(usize) -> bool) -> Option<f64> {
    let mut p = start;
    for _ in 0..MOST_PASSED {
        let [o, d] = [p, DVec3::NEG_Y].map(|v| V::splat(One, v.as_vec3().to_array()));
        let nearest = scene.shapes.closest(One, M(true), o, d, F(0.0));
        if nearest.primitive.0 == MISS {
            return None;
        }
        let distance = f64::from(nearest.t.0);
        if is_one(scene.owners[nearest.primitive.0 as usize] as usize) {
            return Some(p.y - distance);
        }
        p.y -= distance + step;
    }
    None
}
