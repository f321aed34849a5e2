//! Decides whether paths can start at the lights of a scene.
use std::fmt;

use glam::DVec3;

use super::{
    Estimator, Object, RenderSettings, Scene,
    surface::{ONE_SIDED, SELF_LIT, STAGE_MASK, STAGE_SHIFT},
};
use crate::{
    geometry::{Bounds, Shape},
    light::LightRays,
    material::Stage,
    math::{F, One, U},
};

/// Space around the scene, relative to its size.
const MARGIN: f64 = 1e-4;
/// Where more paths survive roulette, they are connected with each other only if they have at most this many bounces.
const MOST_BOUNCES: u32 = 64;
const MOST_SURVIVORS: f32 = 0.98;
const ENDLESS: &str = "with so little roulette and no low bounce cap, there would be too many connections between paths";

/// The rays with which paths start at the lights of a scene.
pub struct LightStarts {
    rays: LightRays,
    has_shading_normals: bool,
}

impl LightStarts {
    /// The rays for an estimator, or what it cannot have in the scene. From some sides a shading normal is another one than from the light,
    /// so paths from lights alone do not find all that a surface reflects.
    fn rays_for(&self, estimator: Estimator) -> Result<&LightRays, &'static str> {
        let is_alone = !estimator.connects() && !estimator.traces_only_caustics();
        if is_alone && self.has_shading_normals {
            return Err("smooth meshes, bump or normal maps");
        }
        Ok(&self.rays)
    }
}

/// The estimator that renders, and why it is not the one of the settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EstimatorInForce {
    pub estimator: Estimator,
    pub reason: String,
}

impl fmt::Display for EstimatorInForce {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.estimator.title(), self.reason)
    }
}

/// Whether paths may have too many vertices to connect all of them in reasonable time.
fn goes_on_for_ever(settings: &RenderSettings) -> bool {
    settings.estimator.connects()
        && settings.roulette.survival() > MOST_SURVIVORS
        && settings.max_bounces.is_none_or(|cap| cap > MOST_BOUNCES)
}

impl Scene {
    /// The rays with which paths from lights start, if the estimator traces any and the scene allows it.
    pub fn light_rays(&self, settings: &RenderSettings) -> Option<&LightRays> {
        let traces = settings.estimator.traces_light_paths() && !goes_on_for_ever(settings);
        if traces { self.rays_or_obstacle(settings.estimator).ok() } else { None }
    }

    /// Whether paths start at lights, too.
    pub fn traces_light_paths(&self, settings: &RenderSettings) -> bool {
        self.light_rays(settings).is_some()
    }

    /// The note that an estimator without its paths from lights works like `mis`; `None` if that is not so.
    pub fn lacks_light_paths(&self, settings: &RenderSettings) -> Option<String> {
        if !settings.estimator.traces_light_paths() {
            return None;
        }
        let name = settings.estimator.name();
        if goes_on_for_ever(settings) {
            return Some(format!("the estimator `{name}` works like `mis`: {ENDLESS}"));
        }
        let reason = self.rays_or_obstacle(settings.estimator).err()?;
        Some(format!("the estimator `{name}` works like `mis` in this scene, which has {reason}"))
    }

    fn rays_or_obstacle(&self, estimator: Estimator) -> Result<&LightRays, &'static str> {
        let made = self.light_paths.get_or_init(|| {
            if let Some(obstacle) = self.obstacle_to_light_paths() {
                return Err(obstacle);
            }
            let (center, radius) = self.bounding_sphere();
            let rays = LightRays::new(&self.lights, center, radius).ok_or("no light from which paths could start")?;
            Ok(LightStarts { rays, has_shading_normals: self.has_shading_normals() })
        });
        made.as_ref().map_err(|reason| *reason)?.rays_for(estimator)
    }

    /// Whether there are shading normals besides those of the surfaces.
    fn has_shading_normals(&self) -> bool {
        let is_smooth = |object: &Object| matches!(&object.shape, Shape::Mesh { data, .. } if !data.normals.is_empty());
        !self.surfaces.relief.is_empty() || self.objects.iter().any(is_smooth)
    }

    /// What is known of the estimator in force, where it is not the one of the settings.
    pub fn estimator_in_force(&self, settings: &RenderSettings) -> Option<EstimatorInForce> {
        let is_auto = settings.estimator == Estimator::Auto;
        // A trial has to try all strategies.
        let wanted = if is_auto { Estimator::Bidirectional } else { settings.estimator };
        if !wanted.traces_light_paths() {
            return None;
        }
        let mis = |reason| Some(EstimatorInForce { estimator: Estimator::Mis, reason });
        if goes_on_for_ever(&RenderSettings { estimator: wanted, ..*settings }) {
            return mis(ENDLESS.to_owned());
        }
        let starts = self.light_paths.get()?.as_ref().map_err(|reason| *reason);
        if let Err(obstacle) = starts.and_then(|starts| starts.rays_for(wanted)) {
            return mis(format!("the scene has {obstacle}"));
        }
        let best = self.estimator_by_trial.get().filter(|_| is_auto)?;
        Some(EstimatorInForce { estimator: *best, reason: "least error in a trial".to_owned() })
    }

    /// What paths from lights do not know yet.
    fn obstacle_to_light_paths(&self) -> Option<&'static str> {
        let surfaces = &self.surfaces;
        let is = |holds: fn(&Object) -> bool| self.objects.iter().any(holds);
        let emits_from_isosurface =
            |object: &Object| object.emission.is_some() && matches!(object.shape, Shape::Isosurface { .. });
        let transmits =
            |word: u32| Stage::ALL.get((word >> STAGE_SHIFT & STAGE_MASK) as usize).is_some_and(|stage| stage.transmits());
        let obstacles = [
            (self.has_lamps_in_media(), "lamps within tinted media"),
            (!surfaces.are_opaque(), "surfaces that are blended or let some light pass"),
            (is(emits_from_isosurface), "isosurfaces that emit light"),
            (surfaces.words().any(|word| word & SELF_LIT != 0) || self.lights.emitters.are_translucent(), "translucent lamps"),
            (surfaces.words().any(|word| word & ONE_SIDED != 0 && transmits(word)), "glass with one side"),
        ];
        obstacles.into_iter().find_map(|(holds, obstacle)| holds.then_some(obstacle))
    }

    /// Whether light may start within a tinted medium, where paths would not know it: the boxes of a lamp and of a tinted object overlap.
    fn has_lamps_in_media(&self) -> bool {
        if self.surfaces.media.is_empty() {
            return false;
        }
        let bounds = |object: &Object| object.shape.bounds(&object.motion);
        let tinted = self.objects.iter().enumerate().filter(|(id, object)| self.has_inside(object) && self.medium(*id) != 0);
        let tinted: Vec<(bool, Bounds)> = tinted.map(|(_, object)| (object.flip, bounds(object))).collect();
        let surfaces = self.objects.iter().filter(|object| object.emission.is_some()).map(bounds);
        let lamps = &self.lights.lamps;
        let rays = (0..lamps.len()).map(|lamp| lamps.emit(One, U(lamp as u32), (F(0.5), F(0.5)))).filter(|ray| !ray.far.0);
        let mut places = surfaces.chain(rays.map(|ray| Bounds::of_points([ray.origin.lane(0)])));
        // A flipped object has its medium outside.
        tinted.iter().any(|(flip, _)| *flip) || places.any(|place| tinted.iter().any(|(_, bounds)| bounds.overlaps(&place)))
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
