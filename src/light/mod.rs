//! Light sources: surfaces that emit, and the background.
//!
//! | kind | file | what it is |
//! |---|---|---|
//! | emission | `emission.rs` | radiance from one or both sides of a surface, constant or by a texture |
//! | background | `background.rs` | constant radiance from all directions that meet no surface |
//! | image background | `image_background.rs` | a picture of all directions, sampled by its light |
//!
//! Which one a point looks at is chosen by `selection.rs`, among many with the light tree of `tree.rs`.
pub mod background;
mod bound;
mod choice;
pub mod emission;
pub mod image_background;
mod lobe;
mod selection;
mod source;
#[cfg(test)]
mod tests;
mod tree;

pub use self::{
    background::Background,
    choice::{LightCoordinates, LightSample, Lights, Receiver},
    emission::{Emission, Emitters, Side},
    image_background::ImageBackground,
    lobe::Lobe,
};
