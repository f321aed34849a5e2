//! Many samples of one pixel: their distribution says more about its noise than their mean.
use std::ops::Range;

use super::{radiance_at, work_of};
use crate::integrator::{
    batch::Batch,
    outlier_reuse::thresholds,
    slots::{BLOCK, BLOCKS},
    tile_sample::trace,
    work::{Blocks, Work},
};
use noisefall_base::math::SimdLevel;
use noisefall_scene::scene::{CameraRays, RenderSettings, Scene};

/// The radiance of these samples of a pixel, bit for bit as in the renderer; with light paths, without what other samples bring
/// to the pixel. `None` if interrupted.
///
/// A batch takes one sample in each of its blocks, so that registers are full; where pixels share it takes one sample.
pub fn pixel_samples(
    scene: &Scene,
    rays: &CameraRays,
    settings: &RenderSettings,
    pixel: [u32; 2],
    numbers: Range<u32>,
    interrupted: &dyn Fn() -> bool,
) -> Option<Vec<[f32; 3]>> {
    const SLOTS_OF_BLOCK: usize = (BLOCK * BLOCK) as usize;
    let level = SimdLevel::best();
    let mut batch = Batch::default();
    let mut samples = Vec::with_capacity(numbers.len());
    if scene.path_reuse(rays, settings).correlates() {
        let (first, _) = work_of(scene, rays, settings, pixel, 0);
        let thresholds = thresholds(level, &first, &mut batch, interrupted).ok()?;
        for number in numbers {
            let (work, place) = work_of(scene, rays, settings, pixel, number);
            trace(level, &Work { thresholds: thresholds.as_ref(), ..work }, &mut batch, interrupted).ok()?;
            samples.push(radiance_at(&batch, place));
        }
        return Some(samples);
    }
    for first in numbers.clone().step_by(BLOCKS) {
        let mut blocks = Blocks::default();
        let here = first..numbers.end.min(first.saturating_add(BLOCKS as u32));
        here.clone().for_each(|number| blocks.push(pixel, number));
        let work = Work { blocks: Some(&blocks), ..Work::tile(scene, rays, settings, pixel, [1, 1], first) };
        trace(level, &work, &mut batch, interrupted).ok()?;
        samples.extend(batch.radiance().iter().step_by(SLOTS_OF_BLOCK).take(here.len()).map(|[r, g, b, _]| [*r, *g, *b]));
    }
    Some(samples)
}
