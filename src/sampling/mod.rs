//! Points of the unit cube and their warps to directions, each with its pdf.
pub mod alias;
mod bits;
mod blue_noise;
mod filter;
pub mod hash;
mod independent;
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
    filter::Filter,
    sampler::{Dimension, Sampler, Stream},
    warp::Directions,
};
