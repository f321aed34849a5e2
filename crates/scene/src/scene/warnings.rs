//! Warnings about valid scenes that are probably not as intended, for the window and the command line.
use glam::DVec3;

use super::{MOST_NESTED, Object, Scene};
use crate::{
    geometry::{MISS, Outline, Shape},
    light::Side,
    texture::NumberSource,
};
use noisefall_base::math::{Lanes, One, V};

/// A surface in front of a light, closer than this fraction of the light's radius, blocks nearly all of its light.
const HAIRS_BREADTH: f64 = 0.01;
/// Largest number of lights that are tested.
const MOST_LIGHTS: usize = 256;
/// Largest number of objects that a warning names.
const MOST_NAMED: usize = 3;
/// Fields of view below this number of degrees are probably in radians.
const RADIANS: f64 = 3.2;
/// Sine of the angle between `up` and the view direction below which the orientation of the image is arbitrary.
const NEARLY_PARALLEL: f64 = 0.02;

impl Scene {
    /// The warnings, one sentence each, without a full stop.
    pub fn warnings(&self) -> &[String] {
        self.warned.get_or_init(|| [self.warnings_of_scene(), self.warnings_of_objects(), self.warnings_of_camera()].concat())
    }

    fn warnings_of_scene(&self) -> Vec<String> {
        let mut warnings = self.former_names.clone();
        if self.lights.is_empty() {
            warnings.push("nothing in this scene emits light: the image will be black".to_owned());
        }
        if self.moves() && self.camera.shutter.is_none() {
            warnings.push("something moves, but without `shutter` in [camera] the image shows it at rest".to_owned());
        }
        if self.shapes.dropped_triangles() > 0 {
            warnings.push(format!(
                "{} triangles without area, or with corners beyond 1e11, were left out",
                self.shapes.dropped_triangles()
            ));
        }
        if self.objects.is_empty() {
            warnings.push("this scene has no objects".to_owned());
        }
        let depth = self.deepest_media;
        if depth > MOST_NESTED {
            warnings.push(format!("{depth} media are nested: only the innermost {MOST_NESTED} are tinted"));
        }
        warnings
    }

    fn warnings_of_objects(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let bare = self.names(|object| object.material.is_none() && object.emission.is_none());
        if let Some((bare, have)) = bare {
            warnings.push(format!("{bare} {have} neither `material` nor `emission`, and will be black"));
        }
        let is_clear =
            |object: &Object| self.material(object).is_some_and(|material| material.opacity == NumberSource::Constant(0.0));
        if let Some((clear, have)) = self.names(|object| object.emission.is_some() && is_clear(object)) {
            warnings.push(format!("{clear} {have} `emission` but a material that lets all light pass, and will be dark"));
        }
        if let Some((flipped, have)) = self.names(|object| object.flip && self.has_inside(object)) {
            warnings.push(format!(
                "{flipped} {have} `flip` on a dielectric: `ior` and `ior_outside` swap sides, and the medium fills the space outside"
            ));
        }
        for (light, wall) in self.covered_light() {
            warnings.push(format!(
                "the light {} faces {} from almost no distance and lights nothing else: turn it by `flip = true`, or move it away",
                self.name_of(light),
                self.name_of(wall)
            ));
        }
        warnings
    }

    fn warnings_of_camera(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let camera = &self.camera;
        if let Some(emitter) = self.around(camera).filter(|object| object.emits_outwards_only()) {
            warnings.push(format!("the camera is inside {}", self.emitter_from_inside(emitter)));
        }
        if camera.projection.has_angle() && camera.fov < RADIANS {
            let (fov, degrees) = (camera.fov, camera.fov.to_degrees());
            warnings
                .push(format!("`fov` is in degrees, and {fov} is a narrow view: taken as radians, it would be {degrees:.1}°"));
        }
        let [_, _, forward] = camera.axes();
        if forward.cross(camera.up.normalize()).length() < NEARLY_PARALLEL {
            warnings.push("`up` is nearly parallel to the direction of view: the image may be rotated by any angle".to_owned());
        }
        warnings
    }

    /// Lights whose emitting side is covered, and the objects that cover them.
    fn covered_light(&self) -> impl Iterator<Item = (&Object, &Object)> {
        let lights = self.objects.iter().enumerate().take_while(|(_, object)| object.emission.is_some());
        lights.take(MOST_LIGHTS).filter_map(|(number, light)| Some((light, self.cover(number, light)?)))
    }

    /// The object that covers a static flat light.
    fn cover(&self, number: usize, light: &Object) -> Option<&Object> {
        let Shape::Flat { outline, origin, edges: [u, v], mirrored } = &light.shape else { return None };
        let side = light.emission.map(|emission| emission.side).filter(|side| *side != Side::Both)?;
        let turns = *mirrored != (side == Side::Back);
        let normal = u.cross(*v).try_normalize()? * if turns { -1.0 } else { 1.0 };
        let above = normal * HAIRS_BREADTH * light.shape.bounding_sphere().1;
        // A ray from above the light towards it first hits another object if that is in between.
        let cover = |(a, b): (f64, f64)| {
            let met = self.first_object(*origin + *u * a + *v * b + above, -normal)?;
            (met != number && light.motion.0.is_empty())
                .then(|| &self.objects[met])
                .filter(|object| !self.has_inside(object) && !self.lets_pass(object))
        };
        let covers: Option<Vec<&Object>> = places(*outline).into_iter().map(cover).collect();
        covers?.first().copied()
    }

    /// The index of the first object along a ray at time 0.
    fn first_object(&self, origin: DVec3, direction: DVec3) -> Option<usize> {
        let l = One;
        let [o, d] = [origin, direction].map(|v| V::splat(l, v.as_vec3().to_array()));
        let nearest = self.shapes.closest(l, l.first(1), o, d, l.f(0.0));
        (nearest.primitive.0 != MISS).then(|| self.owners[nearest.primitive.0 as usize] as usize)
    }

    /// The names of the first objects with a property, and the verb in singular or plural.
    fn names(&self, holds: impl Fn(&&Object) -> bool) -> Option<(String, &'static str)> {
        let count = self.objects.iter().filter(&holds).count();
        let named: Vec<String> = self.objects.iter().filter(&holds).take(MOST_NAMED).map(|object| self.name_of(object)).collect();
        let shown = named.join(", ");
        match count {
            0 => None,
            1 => Some((shown, "has")),
            _ if count > MOST_NAMED => {
                let more = count - MOST_NAMED;
                let objects = if more == 1 { "object" } else { "objects" };
                Some((format!("{shown} and {more} more {objects}"), "have"))
            }
            _ => Some((shown, "have")),
        }
    }

    /// Name of an object in messages.
    pub(super) fn name_of(&self, object: &Object) -> String {
        let number = self.objects.iter().position(|other| std::ptr::eq(other, object)).map_or(0, |at| at + 1);
        if object.name.is_empty() { format!("object {number}") } else { format!("`{}`", object.name) }
    }

    /// Warning about an emitter around the camera that is dark inside, with advice.
    pub(super) fn emitter_from_inside(&self, emitter: &Object) -> String {
        format!("{}, which emits outwards only: `flip = true` turns its front inwards", self.name_of(emitter))
    }
}

impl Object {
    /// Whether an object emits on its outside only.
    pub(super) fn emits_outwards_only(&self) -> bool {
        self.emission.is_some_and(|emission| emission.side == Side::Front)
    }
}

/// Points distributed over a flat shape, in its coordinates.
fn places(outline: Outline) -> [(f64, f64); 5] {
    match outline {
        Outline::Parallelogram => [(0.5, 0.5), (0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)],
        Outline::Triangle => [(0.3, 0.3), (0.1, 0.1), (0.8, 0.1), (0.1, 0.8), (0.45, 0.45)],
        Outline::Ellipse => [(0.0, 0.0), (0.8, 0.0), (-0.8, 0.0), (0.0, 0.8), (0.0, -0.8)],
    }
}
