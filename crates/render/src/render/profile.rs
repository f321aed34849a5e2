//! Measures where the time of a render goes.
use rayon::prelude::*;

use super::{
    area::Area,
    path_reuse::resolved,
    threads::{PassJob, Threads},
    tile::Tile,
};
use noisefall_kernel::integrator::{Batch, Interrupted, Work, thresholds, trace_profiled};
pub use noisefall_kernel::integrator::{CountedRays, PathStage, Profile, StageCost};
use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Scene};

impl Threads {
    /// Renders `spp` samples per pixel of an image, which is discarded, and returns what the stages took. `settings` must not be
    /// adaptive.
    pub fn profile(&self, job: PassJob, spp: u32, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<Profile, Interrupted> {
        let tiles: Vec<Area> = Area::tiles(job.rays.resolution).collect();
        let profile = |batch: &mut Batch, area: &Area| self.profile_tile(job, *area, spp, batch, interrupted);
        self.install(|| {
            let profiles = tiles.par_iter().with_max_len(1).map_init(Batch::default, profile);
            profiles.try_reduce(Profile::default, |a, b| Ok(a.plus(&b)))
        })
    }

    fn profile_tile(
        &self,
        PassJob { scene, rays, settings }: PassJob,
        Area { origin, size }: Area,
        spp: u32,
        batch: &mut Batch,
        interrupted: &dyn Fn() -> bool,
    ) -> Result<Profile, Interrupted> {
        let (mut tile, mut profile) = (Tile::new(origin, size), Profile::default());
        let first = Work::tile(scene, rays, settings, origin, size, 0);
        let thresholds = thresholds(self.level, &first, batch, interrupted)?;
        for sample in 0..spp {
            let work = Work { sample, thresholds: thresholds.as_ref(), ..first };
            trace_profiled(self.level, &work, batch, interrupted, &mut profile)?;
            let start = std::time::Instant::now();
            tile.add(batch.radiance());
            profile.film.time += start.elapsed();
            profile.samples += u64::from(size[0] * size[1]);
        }
        Ok(profile)
    }
}

/// The settings of a scene as a profile takes them: uniform, with what is chosen by trial decided. Also returns the estimator of a render:
/// light paths are not profiled, but `mis` in their place, which has camera paths alone.
pub fn settings_of(scene: &Scene, camera: &Camera) -> (RenderSettings, Estimator) {
    let rays = scene.rays(camera);
    let settings = RenderSettings { adaptive: false, ..scene.settings };
    let decided = resolved(scene, &rays, &settings);
    if decided.estimator.traces_light_paths() {
        let by_mis = RenderSettings { estimator: Estimator::Mis, ..settings };
        (resolved(scene, &rays, &by_mis), decided.estimator)
    } else {
        (decided, decided.estimator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::SimdLevel;
    use noisefall_scene::scene::built_in;

    #[test]
    fn a_profile_covers_all_samples_of_an_image_and_can_be_interrupted() {
        let scene = built_in();
        let camera = Camera { resolution: [70, 40], ..scene.camera };
        let (rays, (settings, _)) = (scene.rays(&camera), settings_of(&scene, &camera));
        let job = PassJob { scene: &scene, rays: &rays, settings: &settings };
        let threads = Threads::new(2, SimdLevel::best()).expect("threads");
        let profile = threads.profile(job, 3, &|| false).expect("nobody interrupts");
        assert_eq!(profile.samples, 3 * 70 * 40);
        assert!(profile.bounces[0][0].rays >= profile.samples && !profile.film.time.is_zero());
        assert!(threads.profile(job, 3, &|| true).is_err());
    }
}
