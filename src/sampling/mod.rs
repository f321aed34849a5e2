//! Points of the unit cube and their warps to directions, each with its pdf.
pub mod alias;
mod dimension;
pub mod filter;
pub mod gradient_noise;
pub mod hash;
#[cfg(test)]
pub(crate) mod readings;
mod sampler;
#[cfg(test)]
mod tests;
pub mod warp;

#[cfg(test)]
pub use self::readings::Stream;
#[cfg(not(test))]
pub use self::sampler::Stream;
pub use self::{alias::AliasTable, dimension::Dimension, filter::Filter, sampler::Sampler, warp::Directions};
