//! Decides whether light paths pay in a scene, by a trial of a small image with and without them.
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use super::{
    area::Area,
    estimate::Estimate,
    splats::SplatFilm,
    tile::Tile,
    trial::{relative_excess, relative_variances},
};
use noisefall_base::{math::SimdLevel, parallel::PerThread};
use noisefall_kernel::integrator::{Batch, Interrupted, Work, trace};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Reuse, Scene},
};

/// Width and height of the image, at most, and samples per pixel.
const SIZE: u32 = 96;
const SPP: u32 = 16;
/// Time of a ray of bidirectional paths, relative to one of `mis`.
const COST: f64 = 2.0;
/// A seed that images are unlikely to have.
const SEED: u32 = 0x2c1b_3c6d;

/// The estimator of the settings, with [`Estimator::Auto`] resolved. The decision depends on the scene alone and is made once.
pub(super) fn estimator_unless(
    scene: &Scene,
    settings: &RenderSettings,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<Estimator, Interrupted> {
    if settings.estimator != Estimator::Auto {
        return Ok(settings.estimator);
    }
    if !scene.traces_light_paths(&RenderSettings { estimator: Estimator::Bidirectional, ..*settings }) {
        return Ok(Estimator::Mis);
    }
    let known = &scene.estimator_by_trial;
    if let Some(best) = known.get() {
        return Ok(*best);
    }
    // A scene that fails will fail again in the pass, which reports the place.
    let best = catch_unwind(AssertUnwindSafe(|| best(scene, interrupted))).unwrap_or(Ok(Estimator::Mis))?;
    Ok(*known.get_or_init(|| best))
}

/// The estimator with the least error at equal cost.
fn best(scene: &Scene, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<Estimator, Interrupted> {
    let [width, height] = scene.camera.resolution;
    let longest = width.max(height);
    let resolution = [width, height].map(|side| (SIZE * side).div_ceil(longest).max(1));
    let camera = Camera { resolution, ..scene.camera };
    let with = |estimator| {
        let settings =
            RenderSettings { estimator, sampler: Sampler::Independent, reuse: Reuse::Off, seed: SEED, ..Default::default() };
        small_image(scene, &camera, &settings, interrupted)
    };
    let (of_both, rays_of_both) = with(Estimator::Bidirectional)?;
    let (of_mis, rays_of_mis) = with(Estimator::Mis)?;
    // Light that one of them has not found yet is missing in its variance, but the other one is brighter by it.
    let [missing, missing_in_both] = [relative_excess(&of_both, &of_mis), relative_excess(&of_mis, &of_both)];
    let [variance, variance_of_both] = relative_variances(&[[of_mis, of_both]]);
    let cost = variance.max(missing - variance_of_both) * rays_of_mis as f64;
    let cost_of_both = variance_of_both.max(missing_in_both - variance) * rays_of_both as f64 * COST;
    Ok(if cost_of_both < cost { Estimator::Bidirectional } else { Estimator::Mis })
}

/// Estimates of a small image, and the number of rays that it took.
fn small_image(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<(Vec<Estimate>, u64), Interrupted> {
    let (rays, batches) = (scene.rays(camera), PerThread::<Batch>::new(rayon::current_num_threads()));
    let splats = SplatFilm::new(camera.resolution);
    let areas: Vec<Area> = Area::tiles(camera.resolution).collect();
    let sample = |area: &Area| {
        let batch = &mut *batches.get();
        let mut tile = Tile::new(area.origin, area.size);
        batch.rays = 0;
        for sample in 0..SPP {
            let work = Work::tile(scene, &rays, settings, area.origin, area.size, sample);
            trace(SimdLevel::best(), &work, batch, interrupted)?;
            tile.add(batch.radiance());
            splats.add(rays.filter, &batch.splats);
        }
        Ok((tile, batch.rays))
    };
    let mut tiles = areas.par_iter().map(sample).collect::<Result<Vec<(Tile, u64)>, Interrupted>>()?;
    let paths = u64::from(SPP) * camera.resolution.map(u64::from).iter().product::<u64>();
    for (place, (tile, _)) in tiles.iter_mut().enumerate() {
        tile.splats = splats.estimates(place, paths);
    }
    let estimates = tiles.iter().flat_map(|(tile, _)| (0..tile.size[1] as usize).flat_map(|row| tile.estimates(row))).collect();
    Ok((estimates, tiles.iter().map(|(_, rays)| rays).sum()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::load;

    /// Hardly any path from the camera finds the light through the ball of glass: images without its caustic agree with each other.
    #[test]
    fn bidirectional_paths_are_chosen_for_a_caustic_and_not_for_a_diffuse_room() {
        for (name, best) in [("glass_ball_caustic", Estimator::Bidirectional), ("cornell_spheres", Estimator::Mis)] {
            let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
            let scene = load(path.as_ref()).expect("a shipped scene compiles");
            let settings = RenderSettings { estimator: Estimator::Auto, ..scene.settings };
            assert_eq!(estimator_unless(&scene, &settings, &|| false).ok(), Some(best), "{name}");
        }
    }
}
