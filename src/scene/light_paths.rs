//! Whether paths can start at the lights of a scene.
use glam::DVec3;

use super::{
    Object, RenderSettings, Scene,
    surface::{ONE_SIDED, SELF_LIT, STAGE_MASK, STAGE_SHIFT},
};
use crate::{geometry::Shape, light::LightRays, material::Stage};

/// Space around the scene, relative to its size.
const MARGIN: f64 = 1e-4;

impl Scene {
    /// The rays with which paths from lights start, or the reason why there are none.
    pub fn light_rays(&self) -> Result<&LightRays, &'static str> {
        let made = self.light_paths.get_or_init(|| {
            if let Some(obstacle) = self.obstacle_to_light_paths() {
                return Err(obstacle);
            }
            let (center, radius) = self.bounding_sphere();
            LightRays::new(&self.lights, center, radius).ok_or("no light from which paths could start")
        });
        made.as_ref().map_err(|reason| *reason)
    }

    /// Whether paths start at lights, too.
    pub fn traces_light_paths(&self, settings: &RenderSettings) -> bool {
        settings.estimator.traces_light_paths() && self.light_rays().is_ok()
    }

    /// The note that an estimator without its paths from lights works like `mis` in this scene; `None` if that is not so.
    pub fn lacks_light_paths(&self, settings: &RenderSettings) -> Option<String> {
        let reason = self.light_rays().err().filter(|_| settings.estimator.traces_light_paths())?;
        Some(format!("the estimator `{}` works like `mis` in this scene, which has {reason}", settings.estimator.name()))
    }

    /// What paths from lights do not know yet.
    fn obstacle_to_light_paths(&self) -> Option<&'static str> {
        let surfaces = &self.surfaces;
        let is = |holds: fn(&Object) -> bool| self.objects.iter().any(holds);
        let emits_from_isosurface =
            |object: &Object| object.emission.is_some() && matches!(object.shape, Shape::Isosurface { .. });
        let is_smooth = |object: &Object| matches!(&object.shape, Shape::Mesh { data, .. } if !data.normals.is_empty());
        let words = || surfaces.rows.iter().map(|row| row[3].to_bits());
        let transmits =
            |word: u32| Stage::ALL.get((word >> STAGE_SHIFT & STAGE_MASK) as usize).is_some_and(|stage| stage.transmits());
        let obstacles = [
            (!surfaces.media.is_empty(), "tinted media"),
            (!surfaces.are_opaque(), "surfaces that are blended or let some light pass"),
            (!surfaces.relief.is_empty(), "bump or normal maps"),
            (is(is_smooth), "meshes with normals at their vertices"),
            (is(emits_from_isosurface), "isosurfaces that emit light"),
            (words().any(|word| word & SELF_LIT != 0) || self.lights.emitters.are_translucent(), "translucent lamps"),
            (words().any(|word| word & ONE_SIDED != 0 && transmits(word)), "glass with one side"),
        ];
        obstacles.into_iter().find_map(|(holds, obstacle)| holds.then_some(obstacle))
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
