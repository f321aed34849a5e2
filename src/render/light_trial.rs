//! Decides whether paths from lights pay in a scene, by a trial of a small image with and without them.
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use super::{
    area::Area,
    estimate::Estimate,
    splats::SplatFilm,
    tile::Tile,
    trial::{relative_difference, relative_variances},
};
use crate::{
    integrator::{Batch, Interrupted, Work, trace},
    math::SimdLevel,
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Reuse, Scene},
};

/// Width and height of the image, at most, and samples per pixel.
const SIZE: u32 = 96;
const SPP: u32 = 16;
/// Time of a ray of paths from both ends, relative to one of `mis`.
const COST: f64 = 1.3;
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
    let known = &scene.light_paths_pay;
    let can_pay = scene.traces_light_paths(&RenderSettings { estimator: Estimator::Bidirectional, ..*settings });
    let pays = match known.get() {
        _ if !can_pay => false,
        Some(pays) => *pays,
        None => {
            // A scene that fails will fail again in the pass, which reports the place.
            let pays = catch_unwind(AssertUnwindSafe(|| pays(scene, interrupted))).unwrap_or(Ok(false))?;
            *known.get_or_init(|| pays)
        }
    };
    Ok(if pays { Estimator::Bidirectional } else { Estimator::Mis })
}

fn pays(scene: &Scene, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<bool, Interrupted> {
    let [width, height] = scene.camera.resolution;
    let longest = width.max(height);
    let resolution = [width, height].map(|side| (SIZE * side).div_ceil(longest).max(1));
    let camera = Camera { resolution, ..scene.camera };
    let with = |estimator| {
        let settings =
            RenderSettings { estimator, sampler: Sampler::Independent, reuse: Reuse::Off, seed: SEED, ..Default::default() };
        small_image(scene, &camera, &settings, interrupted)
    };
    let (of_mis, rays_of_mis) = with(Estimator::Mis)?;
    let (of_both, rays_of_both) = with(Estimator::Bidirectional)?;
    let difference = relative_difference(&of_mis, &of_both);
    let [of_mis, of_both] = relative_variances(&[[of_mis, of_both]]);
    // Light that one of them has not found yet is missing in its variance, but not in the difference.
    let [of_mis, of_both] = [of_mis.max(difference - of_both), of_both.max(difference - of_mis)];
    Ok(of_mis * rays_of_mis as f64 > of_both * rays_of_both as f64 * COST)
}

/// Estimates of a small image, and the number of rays that it took.
fn small_image(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<(Vec<Estimate>, u64), Interrupted> {
    let rays = scene.rays(camera);
    let splats = SplatFilm::new(camera.resolution);
    let areas: Vec<Area> = Area::tiles(camera.resolution).collect();
    let sample = |area: &Area| {
        let (mut batch, mut tile) = (Batch::default(), Tile::new(area.origin, area.size));
        for sample in 0..SPP {
            let work = Work::tile(scene, &rays, settings, area.origin, area.size, sample);
            trace(SimdLevel::best(), &work, &mut batch, interrupted)?;
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
