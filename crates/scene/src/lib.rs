//! Scenes: images, models, textures, materials, shapes and lights as scene files describe them, and as the renderer compiles them.

#[cfg(test)]
mod chi_squared;
pub mod geometry;
pub mod image;
pub mod light;
pub mod material;
pub mod model;
pub mod sampling;
pub mod scene;
pub mod shape;
pub mod texture;
