//! Bidirectional paths: the estimators `caustics`, `light_tracing` and `bidirectional`.
//!
//! A light path belongs to every sample of a pixel, beside its path from the camera. With y₀ at the light and z₀ at the camera, a
//! strategy (s, t) takes s vertices from the light and t from the camera:
//!
//! | strategy | stage | finds light |
//! |---|---|---|
//! | s = 0 | `arrive.rs` | where the camera path meets a light |
//! | s = 1 | `camera.rs`, `direct.rs` | by light samples |
//! | t = 1 | `light.rs`, `join.rs` | where a vertex of the light path is connected to the camera, in any pixel |
//! | s, t ≥ 2 | `connect.rs` | where two vertices are connected |
//! | merging | `merge.rs` | where a vertex of a light path is near |
//!
//! `bidirectional` weights all of them by the balance heuristic (Veach 1997, section 10.2). The weights are computed from two numbers of
//! each path, which follow it from vertex to vertex (D. van Antwerpen, "Recursive MIS Computation for Streaming BDPT on the GPU", 2011;
//! I. Georgiev, "Implementing Vertex Connection and Merging", 2012): see [`super::light_paths::partial`]. `light_tracing` takes t = 1 alone wherever that can be, that
//! is unless the first surface reflects the light in a single direction. There it works like `mis`, with the balance heuristic. `caustics`
//! takes t = 1 only for paths whose light has come to the first surface by mirrors and clear glass alone.
//!
//! A path contributes the same whichever end it is traced from: both evaluate f(ω_o, ω_i) |cos θ_i| with ω_i towards the light. That
//! contains the factor η² by which refraction scales radiance but not flux (Veach 1997, section 5.2).
//!
//! The stages are compiled once for all types of BSDF, and call what depends on the type (`scatter.rs`).
mod arrive;
mod camera;
mod connect;
mod direct;
mod emit;
mod join;
mod light;
mod merge;
mod observer;
mod radius;
mod scatter;
mod strategy;
mod trace;
mod viewed_normal;

pub(super) use self::{
    observer::{Observer, PathStart, Term},
    scatter::Scattered,
    trace::trace_bidirectional,
};
