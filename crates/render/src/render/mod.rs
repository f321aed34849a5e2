//! Rendering: passes over a film on all threads, the worker that runs them, images for screen and file.
//!
//! ```text
//!   window or command line                 worker thread                    rayon threads
//!   RenderRequest, Budget ── channel ─────▶  Session: coarse films, film  ──▶ pass over tiles
//!   SceneEdit ────────────── channel ─────▶  compiles what changed, starts a Session
//!   Frame, Status ◀── Mutex<Published> ──  one frame when it is due     ◀── sums, counts
//! ```
//! The window states what it wants and never waits; see [`worker`].
mod adaptive;
pub mod area;
mod block;
pub mod checkpoint;
mod coarse;
pub mod colour_map;
pub mod denoise;
pub mod display;
mod error_estimator;
pub mod estimate;
mod exact_sum;
pub mod film;
pub mod frame;
pub mod halves;
mod heavy_tail;
pub mod image_file;
pub mod layers;
mod light_trial;
mod noise_layer;
mod non_local_means;
pub mod pass;
mod pass_count;
pub mod path_formula;
pub mod path_reuse;
pub mod path_samples;
mod path_strategies;
pub mod path_text;
mod path_words;
pub mod profile;
mod protocol;
pub mod reference;
pub mod region;
pub mod replay_command;
mod sample_counts;
mod sampled_tile;
mod scatter;
mod scene_edit;
pub mod series;
mod session;
pub mod settings_text;
mod splats;
pub mod split;
pub mod still;
mod target;
#[cfg(test)]
mod tests;
pub mod tev;
pub mod threads;
pub mod tile;
mod tile_estimates;
mod tile_series;
pub mod tone;
mod trial;
pub mod view;
mod white_balance;
pub mod worker;

pub use self::{
    error_estimator::MODEL_ERROR,
    frame::Frame,
    protocol::{Budget, Publish, Published, RenderRequest, RenderTask, State, Status},
    region::Region,
    sample_counts::SampleCounts,
    scene_edit::{EditResult, SceneEdit},
    series::Series,
    target::Target,
    tone::{Display, ToneMap},
    white_balance::WhiteBalance,
    worker::{KeepHandle, Renderer},
};
