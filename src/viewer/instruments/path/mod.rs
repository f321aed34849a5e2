//! The path inspector: the samples of a pixel, and single paths vertex by vertex.
pub mod copying;
pub mod drawing;
mod histogram;
pub mod inspector;
pub mod tab;
mod table;
mod terms;
