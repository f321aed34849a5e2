//! The lights of a scene at which paths start.
use glam::DVec3;

use super::{
    BY_SIDE, BlendParts, Estimator, MaterialInstance, Object, Obstacle, Properties, Scene,
    surface::{ONE_SIDED, transmits},
};
use crate::{
    geometry::{Bounds, Shape},
    light::LightRays,
    texture::NumberSource,
};
use noisefall_base::math::{F, One, U};

/// Space around the scene, relative to its size.
const MARGIN: f64 = 1e-4;

/// The media around a light at which paths start, as they carry them, or why none starts there.
type LightStart = Result<u32, Obstacle>;

/// The rays with which paths start at the lights of a scene.
pub struct LightStarts {
    rays: LightRays,
    /// An obstacle that stops only some estimators.
    obstacle: Option<Obstacle>,
}

impl LightStarts {
    /// The rays for an estimator, or what it cannot have in the scene.
    pub fn rays_for(&self, estimator: Estimator) -> Result<&LightRays, Obstacle> {
        self.obstacle.filter(|obstacle| obstacle.stops(estimator)).map_or(Ok(&self.rays), Err)
    }
}

impl Scene {
    /// The lights at which paths start, or why they cannot.
    pub(super) fn light_starts(&self) -> Result<LightStarts, Obstacle> {
        if self.transmits_from_one_side() {
            return Err(Obstacle::OneSided);
        }
        if self.objects.iter().enumerate().any(|(id, object)| self.hides_its_medium(id, object)) {
            return Err(Obstacle::HiddenMedium);
        }
        let starts = self.starts();
        let (center, radius) = self.bounding_sphere();
        let unknown = starts.iter().find_map(|start| start.err());
        let rays = LightRays::new(&self.lights, &starts.iter().map(|start| start.ok()).collect::<Vec<_>>(), center, radius);
        let rays = rays.ok_or(unknown.unwrap_or(Obstacle::NoStart))?;
        if !self.surfaces.media.is_empty() && !self.has_reversible_media(&rays, center + DVec3::X * radius) {
            return Err(Obstacle::OpenMedium);
        }
        // From some sides a shading normal is another one than from the light.
        let relief = self.has_shading_normals().then_some(Obstacle::ShadingNormals);
        Ok(LightStarts { rays, obstacle: unknown.or(relief) })
    }

    /// How paths start at each light.
    fn starts(&self) -> Vec<LightStart> {
        let by_object: Vec<LightStart> = self.objects.iter().map(|object| self.start_at(object)).collect();
        let owner = |primitive: u32| by_object[self.owners[primitive as usize] as usize];
        let punctual_light = |number: usize| {
            let ray = self.lights.punctual_lights.emit(One, U(number as u32), (F(0.5), F(0.5)));
            if ray.far.0 { self.start_far_away() } else { self.media_around_all(&Bounds::of_points([ray.origin.lane(0)])) }
        };
        let surfaces = self.lights.primitives().map(owner);
        let punctual_lights = (0..self.lights.punctual_lights.len()).map(punctual_light);
        surfaces.chain(punctual_lights).chain(self.lights.environment.as_ref().map(|_| self.start_far_away())).collect()
    }

    /// How paths start at an object that emits light.
    fn start_at(&self, object: &Object) -> LightStart {
        if object.emission.is_none() {
            return Ok(0);
        }
        match object.shape {
            Shape::Isosurface { .. } => Err(Obstacle::Isosurface),
            _ if self.lets_pass(object) => Err(Obstacle::ClearLight),
            _ => self.media_around_all(&object.shape.bounds(&object.motion)),
        }
    }

    /// Light from far away starts outside of all objects, except for flipped ones.
    fn start_far_away(&self) -> LightStart {
        let fills_space = |object: &Object| object.flip && self.has_inside(object);
        let is_within = !self.surfaces.media.is_empty() && self.objects.iter().any(fills_space);
        if is_within { Err(Obstacle::FarWithinMedium) } else { Ok(0) }
    }

    /// The media around a box, as paths carry them, if they are the same at all of its points.
    fn media_around_all(&self, bounds: &Bounds) -> LightStart {
        if self.surfaces.media.is_empty() {
            return Ok(0);
        }
        let mut around = Vec::new();
        for (id, object) in self.objects.iter().enumerate().filter(|(_, object)| self.has_inside(object)) {
            let is_apart = !object.shape.bounds(&object.motion).overlaps(bounds);
            let holds = if is_apart { Some(false) } else { object.shape.holds(bounds).filter(|_| object.motion.0.is_empty()) };
            if holds.ok_or(Obstacle::LightAtGlass)? != object.flip {
                around.push((id, object));
            }
        }
        Ok(self.nested_media(around))
    }

    /// Whether there are shading normals besides those of the surfaces.
    fn has_shading_normals(&self) -> bool {
        let is_smooth = |object: &Object| matches!(&object.shape, Shape::Mesh { data, .. } if !data.normals.is_empty());
        !self.surfaces.relief.is_empty() || self.objects.iter().any(is_smooth)
    }

    /// Whether light passes a surface from one side that it does not pass from the other, so that a path is another one in reverse.
    fn transmits_from_one_side(&self) -> bool {
        let differs = |object: &Object| self.material(object).is_some_and(|material| self.passes_by_side(material));
        self.surfaces.words().any(|word| word & ONE_SIDED != 0 && transmits(word)) || self.objects.iter().any(differs)
    }

    /// Whether paths can get into a tinted object, or out of it, without a change of their media. In reverse they would have others.
    fn hides_its_medium(&self, id: usize, object: &Object) -> bool {
        let is_uneven = |material: &MaterialInstance| material.properties.passes || material.blend.is_some();
        self.medium(id) != 0 && self.has_inside(object) && self.material(object).is_some_and(is_uneven)
    }

    /// Whether a material, or a part of it, lets light pass, and is another one from behind.
    fn passes_by_side(&self, material: &MaterialInstance) -> bool {
        let Properties { transmits, passes, .. } = material.properties;
        material.blend.is_some_and(|BlendParts { materials, weight }| {
            let is_by_side = weight == NumberSource::Constant(BY_SIDE) && (transmits || passes);
            is_by_side || materials.iter().any(|part| self.passes_by_side(&self.materials[*part as usize]))
        })
    }

    /// A sphere around all objects in all of their poses.
    fn bounding_sphere(&self) -> (DVec3, f64) {
        let spheres: Vec<_> = self.objects.iter().map(|object| object.shape.swept_sphere(&object.motion)).collect();
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (center, radius) in &spheres {
            (low, high) = (low.min(*center - *radius), high.max(*center + *radius));
        }
        let center = if spheres.is_empty() { DVec3::ZERO } else { (low + high) * 0.5 };
        let radius = spheres.iter().map(|(c, r)| c.distance(center) + r).fold(0.0, f64::max);
        (center, radius * (1.0 + MARGIN) + f64::from(f32::MIN_POSITIVE).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Estimator, RenderSettings, parse};

    /// The notes of `bidirectional` and `light_tracing` about a scene with these materials and a light of one of them.
    fn notes(materials: &str, punctual_light: &str) -> [Option<String>; 2] {
        let text = format!(
            "format = 1
            camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }}
            materials.white.lambertian.albedo = 0.8
            materials.tinted.dielectric = {{ ior = 1.5, transmittance = 0.5 }}
            {materials}
            [[objects]]
            shape.rectangle = {{ origin = [-1, -1, 0], edge_u = [2, 0, 0], edge_v = [0, 2, 0] }}
            material = 'wall'
            [[objects]]
            shape.sphere = {{ center = [0, 0, 2], radius = 0.5 }}
            material = 'tinted'
            [[objects]]
            {punctual_light}
            emission.radiance = 1"
        );
        let scene = parse("lamps.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        [Estimator::Bidirectional, Estimator::LightTracing]
            .map(|estimator| scene.lacks_light_paths(&RenderSettings { estimator, ..RenderSettings::default() }))
    }

    fn assert_note(note: &Option<String>, expected: Option<&str>, of: &str) {
        match expected {
            Some(expected) => assert!(note.as_ref().is_some_and(|note| note.ends_with(expected)), "{of}: {note:?}"),
            None => assert_eq!(*note, None, "{of}"),
        }
    }

    #[test]
    fn paths_start_where_the_media_are_known() {
        let ball = |x: f32, radius: f32| format!("shape.sphere = {{ center = [{x}, 0, 2], radius = {radius} }}");
        let beside = "lights that may touch or cross the surface of a dielectric";
        for (punctual_light, obstacle) in [
            (ball(0.0, 0.2), None),
            (ball(0.4, 0.2), Some(beside)),
            (ball(0.0, 0.6), Some(beside)),
            (ball(2.0, 0.2), None),
            (ball(2.0, 0.2) + "\nmaterial = 'sheer'", Some("lights that let light pass")),
        ] {
            let notes = notes("materials.wall.lambertian.albedo = 0.5\nmaterials.sheer.null = {}", &punctual_light);
            notes.iter().for_each(|note| assert_note(note, obstacle, &punctual_light));
        }
    }

    #[test]
    fn a_path_does_not_get_into_tinted_glass_unseen() {
        let unseen = Some("tinted glass with opacity or in a blend");
        let light = "shape.sphere = { center = [2, 0, 2], radius = 0.2 }";
        let tinted = "materials.glass.dielectric = { ior = 1.5, transmittance = 0.5 }\n";
        for (wall, obstacle) in [
            ("lambertian.albedo = 0.5\nmaterials.tinted.opacity = 0.5", unseen),
            ("blend = { first = 'glass', second = 'white', weight = 0.5 }", unseen),
            ("lambertian.albedo = 0.5\nmaterials.wall.opacity = 0.5", None),
        ] {
            let notes = notes(&format!("{tinted}materials.wall.{wall}"), light);
            notes.iter().for_each(|note| assert_note(note, obstacle, wall));
        }
    }

    #[test]
    fn a_surface_that_transmits_has_to_look_the_same_in_reverse() {
        let sides = "materials that let light pass differently from their two sides";
        let parts = "materials.a.lambertian.albedo = 0.5\nmaterials.b.diffuse_transmission = { reflectance = 0.2, transmittance = 0.5 }\n";
        for (wall, obstacle) in [
            ("blend = { first = 'a', second = 'white', by_side = true }", None),
            ("blend = { first = 'a', second = 'b', weight = 0.5 }", None),
            ("blend = { first = 'a', second = 'b', by_side = true }", Some(sides)),
            ("{ lambertian.albedo = 0.5, opacity = 0.5 }", None),
        ] {
            let wall = if wall.starts_with('{') { format!("materials.wall = {wall}") } else { format!("materials.wall.{wall}") };
            let notes = notes(&(parts.to_owned() + &wall), "shape.sphere = { center = [2, 0, 2], radius = 0.2 }");
            notes.iter().for_each(|note| assert_note(note, obstacle, &wall));
        }
    }
}
