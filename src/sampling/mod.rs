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

/// A row of the catalogue of samplers.
pub struct SamplerEntry {
    pub sampler: Sampler,
    /// Name in the scene file and on the command line.
    pub name: &'static str,
    /// Name in the window.
    pub title: &'static str,
    /// Explanation in one sentence, for the window.
    pub doc: &'static str,
}

/// The catalogue: a new sampler is one file, one variant of [`Sampler`] with its arms in [`Stream`], and one row here.
pub const SAMPLERS: [SamplerEntry; 4] = [
    SamplerEntry {
        sampler: Sampler::Independent,
        name: "independent",
        title: "Independent",
        doc: "Uniform random numbers: the plain Monte-Carlo method. Error falls as 1/√N.",
    },
    SamplerEntry {
        sampler: Sampler::Stratified,
        name: "stratified",
        title: "Stratified",
        doc: "Every 4^k samples fill a grid of 2^k by 2^k once each: random numbers without clumps.",
    },
    SamplerEntry {
        sampler: Sampler::Sobol,
        name: "sobol",
        title: "Sobol (Owen)",
        doc: "Owen-scrambled Sobol points: evenly spread in every pair of dimensions that belong together. Mostly the least error.",
    },
    SamplerEntry {
        sampler: Sampler::BlueNoise,
        name: "bluenoise",
        title: "Sobol, blue noise",
        doc: "Sobol points ordered over the picture so that the noise of few samples is fine-grained.",
    },
];
