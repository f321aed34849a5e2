//! The pilot that estimates the typical brightness of the pixels of a tile. It has a seed of its own, so thresholds depend on no
//! sample of the image.
use crate::integrator::{batch::Batch, interrupted::Interrupted, outliers::Thresholds, trace::trace_alone, work::Work};
use noisefall_base::math::SimdLevel;
use noisefall_scene::{
    sampling::Sampler,
    scene::{RenderSettings, Reuse},
};

/// Changes the seed of the pilot, whose samples are thrown away.
const SEED: u32 = 0x5be0_cd19;

/// The thresholds of the tile of `work`; `None` if its pixels do not reuse outliers. Rays of the pilot are not counted.
pub fn thresholds(
    level: SimdLevel,
    work: &Work,
    batch: &mut Batch,
    interrupted: &dyn Fn() -> bool,
) -> Result<Option<Thresholds>, Interrupted> {
    if !work.scene.path_reuse(work.rays, work.settings).has_outliers() {
        return Ok(None);
    }
    let settings =
        RenderSettings { sampler: Sampler::Independent, seed: work.settings.seed ^ SEED, reuse: Reuse::Off, ..*work.settings };
    let pilot = Work { settings: &settings, sample: 0, thresholds: None, ..*work };
    let counts = (batch.rays, batch.cut_paths);
    let traced = trace_alone(level, &pilot, batch, interrupted);
    (batch.rays, batch.cut_paths) = counts;
    traced.map(|()| Some(Thresholds::of_pilot(work.size, batch.radiance())))
}
