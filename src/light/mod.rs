//! Light sources: surfaces that emit, and the background.
//!
//! | type | file | description |
//! |---|---|---|
//! | emission | `emission.rs` | radiance from one or both sides of a surface, constant or textured |
//! | background | `background.rs` | constant radiance from all directions |
//! | image background | `image_background.rs` | an image of all directions, sampled by its radiance |
//!
//! `selection.rs` selects a light for a point, with the light tree of `tree.rs` if there are many.
pub mod background;
mod bound;
mod choice;
mod coordinates;
pub mod emission;
pub mod image_background;
mod lobe;
mod reference_point;
mod selection;
mod source;
#[cfg(test)]
mod tests;
mod tree;

pub use self::{
    background::Background,
    choice::{LightSample, Lights},
    coordinates::LightCoordinates,
    emission::{Emission, Emitters, Side},
    image_background::ImageBackground,
    lobe::Lobe,
    reference_point::ReferencePoint,
};
