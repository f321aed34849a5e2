//! Rendering: passes over a film on all threads, the worker that runs them, pictures for screen and file.
//!
//! ```text
//!   window or command line                 worker thread                    rayon threads
//!   Job, Budget ──────── channel ───────▶  Session: coarse films, film  ──▶ pass over tiles
//!   Frame, Status ◀── Mutex<Published> ──  one frame when it is due     ◀── sums, counts
//! ```
//! The window says what it wants and never waits; see [`worker`].
mod adaptive;
pub mod display;
mod doubling;
pub mod film;
pub mod frame;
pub mod image_file;
pub mod pass;
mod session;
pub mod settings_text;
pub mod sharing;
pub mod tile;
pub mod tone;
pub mod truth;
pub mod worker;

pub use self::{
    frame::Frame,
    tone::{Display, ToneMap},
    worker::{Budget, Job, Publish, Published, Renderer, State, Status},
};
