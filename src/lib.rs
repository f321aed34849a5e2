//! Noisefall: an interactive progressive path tracer, which solves the light transport equation by Monte Carlo integration.
//!
//! The library is the renderer; the window and the command line are in the binary. The feature `reports` adds `report`, `study` and
//! `validate`.
//!
//! [`scene::load`] reads a scene file, and [`scene::description::SceneDescription::build`] makes a scene in code.
//! [`render::threads::Threads::pass`] renders a number of samples, and [`render::Renderer`] renders progressively on a thread of its own.
//! [`render::image_file::save`] writes a PNG or EXR. The folder `examples/` has a program for each.
//!
//! Folders depend downwards only:
//! `validate`, `study` → `report`, `render`, `measure` → `integrator` → `scene` → `light` → `material`, `geometry` → `texture` → `sampling`, `image`, `model` → `math`.
#![warn(missing_docs)]

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
