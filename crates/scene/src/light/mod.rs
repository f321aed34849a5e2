//! Light sources: surfaces that emit, punctual lights, and the environment.
//!
//! | type | file | description |
//! |---|---|---|
//! | emission | `emission/` | radiance from one or both sides of a surface, constant or textured |
//! | punctual lights | `punctual_light/` | point, spot, directional light, projector |
//! | background | `environment/` | radiance from all directions |
//!
//! `selection/` selects a light for a point, with the light tree of `tree/` if there are many.
mod bound;
mod choice;
mod coordinates;
pub mod emission;
pub mod environment;
mod lobe;
pub mod parameters;
pub mod punctual_light;
mod reference_point;
mod selection;
mod source;
#[cfg(test)]
mod tests;
mod tree;

pub use self::{
    choice::{LightRays, LightSample, Lights, RayCoordinates, RaySample},
    coordinates::LightCoordinates,
    emission::{Emission, Emitters, Side},
    environment::{Environment, image::EnvironmentImage},
    lobe::Lobe,
    punctual_light::{PunctualLight, PunctualLights},
    reference_point::ReferencePoint,
};
