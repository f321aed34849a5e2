//! Renders that are split into ranges of samples, on any number of machines, and joined to the bits of one run.
//!
//! A [`SampleFilm`] takes a range of samples of every pixel into exact sums, which are written to a file and joined with others by
//! [`Join`]. [`SplitPicture`] is the image of such sums: a function of the multiset of samples, however they were split.
mod file;
mod film;
mod join;
mod picture;
mod ranges;
mod section;
mod sums;
#[cfg(test)]
mod tests;

pub use self::{
    file::{SampleFile, SampleFileError, write},
    film::{SampleFilm, SplitError},
    join::{Join, JoinError},
    picture::{NoSamples, SplitPicture},
    ranges::SampleRanges,
};
