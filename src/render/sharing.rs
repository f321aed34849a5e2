//! Decides whether path reuse pays in a scene, by a trial of a few tiles with and without it.
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use super::{estimate::Estimate, light_trial::estimator_unless, tile::Tile, trial::relative_variances};
use crate::{
    integrator::{Batch, Interrupted, TILE, Work, trace},
    math::SimdLevel,
    sampling::Sampler,
    scene::{CameraRays, RenderSettings, Reuse, Scene},
};

/// Positions of the tiles in the image.
const PLACES: [[f64; 2]; 5] = [[0.25, 0.25], [0.75, 0.25], [0.5, 0.5], [0.25, 0.75], [0.75, 0.75]];
/// Samples per pixel, with and without sharing.
const SPP: u32 = 4;
/// Cost of a sample with sharing relative to one without: in scenes of lists, and in scenes with trees. Measured costs are 1.7 to
/// 2.2 and 1.1 to 1.5.
const COST: f64 = 2.1;
const COST_WITH_TREES: f64 = 1.4;
/// A seed that images are unlikely to have.
const SEED: u32 = 0x7f4a_7c15;

/// The same settings, with [`Estimator::Auto`](crate::scene::Estimator::Auto) and [`Reuse::Auto`] resolved. Where sharing is possible, the decision depends on the scene alone and is made
/// once, with the scene's own estimator: a change of sampler, estimator or cap never turns sharing on or off.
pub fn resolved(scene: &Scene, rays: &CameraRays, settings: &RenderSettings) -> RenderSettings {
    resolved_unless(scene, rays, settings, &|| false).unwrap_or(*settings)
}

/// The same, unless the trial is interrupted. Then nothing is decided.
pub(super) fn resolved_unless(
    scene: &Scene,
    rays: &CameraRays,
    settings: &RenderSettings,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<RenderSettings, Interrupted> {
    let pays = || {
        let known = &scene.sharing_pays;
        if let Some(pays) = known.get() {
            return Ok(*pays);
        }
        // A scene that fails will fail again in the pass, which reports the place.
        let pays = catch_unwind(AssertUnwindSafe(|| pays(scene, interrupted))).unwrap_or(Ok(false))?;
        Ok(*known.get_or_init(|| pays))
    };
    let settings = &RenderSettings { estimator: estimator_unless(scene, settings, interrupted)?, ..*settings };
    let reuse = match settings.reuse {
        Reuse::Auto if scene.can_share(rays, settings) && pays()? => Reuse::On,
        Reuse::Auto => Reuse::Off,
        said => said,
    };
    Ok(RenderSettings { reuse, ..*settings })
}

/// Name of path sharing in legends and tables.
pub fn sharing_name(shares: bool) -> &'static str {
    if shares { "shared paths" } else { "no sharing" }
}

fn pays(scene: &Scene, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<bool, Interrupted> {
    let settings =
        RenderSettings { estimator: scene.settings.estimator, sampler: Sampler::Independent, seed: SEED, ..Default::default() };
    let rays = scene.rays(&scene.camera);
    let [width, height] = scene.camera.resolution;
    let tile = |[x, y]: &[f64; 2]| {
        let origin = [(width, x), (height, y)].map(|(side, part)| (f64::from(side) * part) as u32 / TILE * TILE);
        let size = [TILE.min(width - origin[0]), TILE.min(height - origin[1])];
        let with = |reuse| estimates(scene, &rays, RenderSettings { reuse, ..settings }, Tile::new(origin, size), interrupted);
        Ok([with(Reuse::Off)?, with(Reuse::On)?])
    };
    let tiles = PLACES.par_iter().map(tile).collect::<Result<Vec<[Vec<Estimate>; 2]>, Interrupted>>()?;
    let [without, with] = relative_variances(&tiles);
    let cost = if scene.shapes.are_listed() { COST } else { COST_WITH_TREES };
    Ok(without > cost * with)
}

/// Estimates from a few samples of a tile.
fn estimates(
    scene: &Scene,
    rays: &CameraRays,
    settings: RenderSettings,
    mut tile: Tile,
    interrupted: &dyn Fn() -> bool,
) -> Result<Vec<Estimate>, Interrupted> {
    let mut batch = Batch::default();
    for sample in 0..SPP {
        let work = Work::tile(scene, rays, &settings, tile.origin, tile.size, sample);
        trace(SimdLevel::best(), &work, &mut batch, interrupted)?;
        tile.add(batch.radiance());
    }
    Ok((0..tile.size[1] as usize).flat_map(|row| tile.estimates(row)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trial_that_is_interrupted_decides_nothing() {
        let scene = crate::scene::built_in();
        let rays = scene.rays(&scene.camera);
        let settings = RenderSettings { reuse: Reuse::Auto, ..scene.settings };
        assert!(resolved_unless(&scene, &rays, &settings, &|| true).is_err());
        let fresh = crate::scene::built_in();
        assert_eq!(resolved(&scene, &rays, &settings), resolved(&fresh, &fresh.rays(&fresh.camera), &settings));
    }
}
