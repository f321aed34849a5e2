//! Drops objects onto the surface below them.
use glam::DVec3;

use super::{Document, Edit};
use noisefall_scene::{scene::Scene, shape::Transform};

/// Places of vertical rays, as fractions of the edges of an object's box. From above they tell where the object is, and from half its
/// height what is below.
const PLACES: [f64; 5] = [0.01, 0.25, 0.5, 0.75, 0.99];
/// Distance behind a surface at which a ray continues, as a fraction of the object's size.
const STEP: f64 = 1e-5;
/// The accuracy of a drop, as a fraction of the object's size: intersections are found in single precision.
const ACCURACY: f64 = 1e-6;

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
        let meets_object = |column: &DVec3| scene.surface_below(column.with_y(max.y + step), step, is_own).is_some();
        let columns = PLACES.into_iter().flat_map(|x| PLACES.map(|z| min + (max - min) * DVec3::new(x, 0.5, z)));
        let (meeting, beside): (Vec<_>, Vec<_>) = columns.partition(meets_object);
        // No vertical ray meets an upright sheet.
        let columns = if meeting.is_empty() { beside } else { meeting };
        let floors = columns.into_iter().filter_map(|column| scene.surface_below(column, step, |owner| !is_own(owner)));
        let by = to_accuracy(floors.max_by(f64::total_cmp)? - min.y, ACCURACY * size);
        (by != 0.0).then(|| self.transformed(object, &Transform::Translate(DVec3::Y * by), DVec3::ZERO)).flatten()
    }
}

/// Rounds a number to the decimals that an accuracy warrants.
fn to_accuracy(x: f64, accuracy: f64) -> f64 {
    let decimals = (-accuracy.log10()).ceil().clamp(0.0, 300.0) as usize;
    format!("{x:.decimals$}").parse().unwrap_or(x) + 0.0
}
