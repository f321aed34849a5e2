//! The path tracer: batches of paths that run through stages, bounce by bounce.
//!
//! `spawn → ( intersect → surface → shade, one BSDF type at a time → shadow )* → reuse → reuse of outliers`. Each stage is a
//! short loop over full registers that reads a dense queue and appends to the next. The bounce is the same for a whole batch, so all that
//! depends on it (the sampler's dimension, the cap, whether roulette has begun) is decided once per stage and not once per path.
mod batch;
mod bidirectional;
mod collision;
mod coordinates;
mod crossings;
mod fault;
mod features;
mod first_hits;
mod interaction;
mod interrupted;
mod intersect;
mod light_paths;
mod light_sample;
mod media;
mod meet;
mod missed_light;
mod normal_mapping;
mod normal_shadowing;
mod outlier_reuse;
mod outliers;
mod profile;
pub mod queue;
mod queues;
#[cfg(test)]
mod readings;
mod records;
mod replay;
mod reuse;
mod roulette;
mod series;
mod shade;
mod shading;
mod shadow;
mod shared;
mod slots;
mod spawn;
mod surface;
#[cfg(test)]
mod tests;
mod tile_sample;
mod trace;
mod transparent_ray;
mod variation;
mod visible_fraction;
mod weight;
mod work;

#[cfg(test)]
use self::readings::Stream;
pub use self::{
    batch::Batch,
    collision::{clear_fraction, is_blind},
    fault::trace,
    features::{Features, features},
    interrupted::Interrupted,
    light_paths::splat::Splat,
    outlier_reuse::thresholds,
    outliers::{Replays, Thresholds},
    profile::{CountedRays, Profile, StageCost, trace_profiled},
    replay::{
        BidirectionalSample, EmitterHit, End, LightOutcome, PathPoint, Reflection, Replay, SampledLight, SharedLight,
        StrategyTerm, Surface, Vertex, pixel_samples, replay, seen_by_camera,
    },
    series::{SHARES, TERMS, Terms, trace_series},
    slots::{BLOCK, BLOCKS, TILE},
    trace::{PathStage, Segments, trace_counting},
    work::{Blocks, Work},
};
#[cfg(not(test))]
use noisefall_scene::sampling::Stream;
