//! Points of the unit cube and their warps to directions, each with its pdf.
pub mod alias;
mod bits;
mod blue_noise;
mod dimension;
pub mod filter;
pub mod hash;
mod independent;
mod points;
#[cfg(test)]
pub(crate) mod readings;
mod sampler;
mod sobol;
mod stratified;
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
