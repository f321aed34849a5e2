//! Instruments below the image: convergence, comparison, bounces, paths of a pixel.
pub mod bounces;
pub mod compare;
pub mod convergence;
pub mod light_paths;
pub mod path;
pub mod strategies;
pub mod tabs;
