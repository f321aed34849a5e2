//! Points of the unit cube and their warps to directions, each with its pdf.
pub mod alias;
mod dimension;
pub mod filter;
pub mod gradient_noise;
pub mod hash;
mod sampler;
#[cfg(test)]
mod tests;
pub mod warp;

pub use self::{
    alias::AliasTable,
    dimension::Dimension,
    filter::Filter,
    sampler::{Sampler, Stream},
    warp::Directions,
};
