//! Scene formats: what other programs write and read.

pub mod export;
pub mod import;
