//! Noisefall: an interactive progressive path tracer, which solves the light transport equation by Monte Carlo integration.
//!
//! The library is the renderer; the window and the command line are in the binary. Folders depend downwards only:
//! `validate`, `study` → `report`, `render` → `measure` → `integrator` → `scene` → `light`, `shape` → `material`, `geometry` →
//! `texture` → `sampling`, `image`, `model` → `declare` → `math`, `file`, `memory`, `quote`.
pub mod declare;
pub mod file;
pub mod geometry;
pub mod image;
pub mod integrator;
pub mod light;
pub mod material;
pub mod math;
pub mod measure;
pub mod memory;
pub mod model;
pub mod quote;
pub mod render;
#[cfg(feature = "reports")]
pub mod report;
pub mod sampling;
pub mod scene;
pub mod shape;
#[cfg(feature = "reports")]
pub mod study;
pub mod texture;
#[cfg(feature = "reports")]
pub mod validate;
