//! One sample of every pixel of a tile, with all that the settings ask for.
use super::{
    batch::Batch, bidirectional::trace_bidirectional, interrupted::Interrupted, outlier_reuse::OutlierReuse, trace::trace_alone,
    work::Work,
};
use noisefall_base::math::{SimdLevel, in_few_lanes};

/// Traces one sample of every pixel of a tile; the result is [`Batch::radiance`]. Calls `interrupted` before every bounce, while paths from
/// both ends are connected, and where pixels share.
pub fn trace(level: SimdLevel, work: &Work, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<(), Interrupted> {
    if let Some(rays) = work.scene.light_rays(work.settings) {
        return in_few_lanes!(level, l => trace_bidirectional(l, work, rays, batch, interrupted, &mut ()));
    }
    match work.thresholds {
        Some(thresholds) => OutlierReuse { work, thresholds }.trace(level, batch, interrupted),
        None => trace_alone(level, work, batch, interrupted),
    }
}
