//! Light sources: surfaces that emit, lamps without surface, and the background.
//!
//! | type | file | description |
//! |---|---|---|
//! | emission | `emission/` | radiance from one or both sides of a surface, constant or textured |
//! | lamps without surface | `lamp/` | point, spot, directional lamp, projector |
//! | background | `background/` | radiance from all directions |
//!
//! `selection/` selects a light for a point, with the light tree of `tree/` if there are many.
pub mod background;
mod bound;
mod choice;
mod coordinates;
pub mod emission;
pub mod lamp;
mod lobe;
pub mod parameters;
mod reference_point;
mod selection;
mod source;
#[cfg(test)]
mod tests;
mod tree;

pub use self::{
    background::{Background, image::ImageBackground},
    choice::{LightRays, LightSample, Lights, RayCoordinates, RaySample},
    coordinates::LightCoordinates,
    emission::{Emission, Emitters, Side},
    lamp::{Lamp, Lamps},
    lobe::Lobe,
    reference_point::ReferencePoint,
};
