//! How the error falls, live: a curve for every setting that was tried, over each other.
mod export;
pub(super) mod history;
mod plot;

pub use self::history::{History, Moment, name};
