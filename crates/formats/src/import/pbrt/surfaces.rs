//! Surfaces: shapes with what covers them, and the objects that they become.
use std::rc::Rc;

use glam::DAffine3;

use super::{import::Import, records::Surface, source::TextSpan, transforms::is_invertible};
use noisefall_scene::{
    scene::{SceneError, description::ObjectDescription},
    shape::Transform,
};

/// Objects that every file may have.
const MOST_OBJECTS: u64 = 200_000;
/// Bytes of the texts for each further object.
const BYTES_PER_OBJECT: u64 = 16;

impl Import {
    /// Adds an object. `by` moves the surface besides, at both times.
    pub fn add_surface(&mut self, surface: &Surface, by: [DAffine3; 2]) -> Result<(), SceneError> {
        let place = &surface.covering.place;
        let most = MOST_OBJECTS + self.files.bytes / BYTES_PER_OBJECT;
        // Surfaces that are left out take time too.
        self.instances += 1;
        if self.instances > most {
            return Err(place.error(format!("the scene has more than {most} objects"), "instances of instances multiply"));
        }
        let maps = [0, 1].map(|time| self.mirror * by[time] * surface.maps[time] * surface.local);
        if !maps.iter().all(is_invertible) {
            let effect = "it would have no extent";
            self.remarks.add(place.to_string(), "a transform that flattens a shape", "nothing", effect);
            return Ok(());
        }
        let motion = self.motion(maps, place);
        self.description.objects.push(ObjectDescription {
            name: surface.name.clone(),
            shape: surface.shape.clone(),
            material: None,
            emission: surface.emission.clone(),
            flip: surface.flip,
            transform: Transform::list_of(&maps[0]),
            motion,
        });
        self.coverings.push(surface.covering.clone());
        Ok(())
    }

    /// The motion from the first to the second map.
    fn motion(&mut self, [start, end]: [DAffine3; 2], place: &TextSpan) -> Vec<Transform> {
        if start == end {
            return Vec::new();
        }
        let way = end * start.inverse();
        self.moves = true;
        const ROUNDING: f64 = 1e-9;
        if start.matrix3.abs_diff_eq(end.matrix3, ROUNDING * start.matrix3.x_axis.abs().max_element().max(1.0)) {
            return vec![Transform::Translate(end.translation - start.translation)];
        }
        // On its way, a linear motion must neither flatten nor mirror.
        let steps = (0..=16).map(|i| f64::from(i) / 16.0);
        let determinants =
            steps.map(|t| (start.matrix3 * (1.0 - t) + end.matrix3 * t).determinant() / start.matrix3.determinant());
        if determinants.fold(f64::INFINITY, f64::min) < 1e-3 {
            self.remarks.add(place.to_string(), "a motion by half a turn or more", "no motion", "it is not blurred");
            return Vec::new();
        }
        self.remarks.add(place.to_string(), "a rotation or scaling in time", "a linear motion", "points move on straight lines");
        Transform::list_of(&way)
    }

    /// `ObjectInstance`.
    pub fn instance(&mut self, name: &str, by: [DAffine3; 2], place: &TextSpan) -> Result<(), SceneError> {
        let unknown = || place.error(format!("`{name}` is not an object"), "define it by ObjectBegin first");
        let surfaces: Rc<_> = self.definitions.get(name).ok_or_else(unknown)?.clone();
        surfaces.iter().try_for_each(|surface| self.add_surface(surface, by))
    }
}
