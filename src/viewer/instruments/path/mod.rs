//! The path inspector: the samples of a pixel, and single paths vertex by vertex or strategy by strategy.
mod cells;
pub mod copying;
pub mod drawing;
mod histogram;
pub mod inspector;
mod strategies;
pub mod tab;
mod table;
mod terms;
