//! Headings under which `render --help` groups its options.

/// Size, exposure and layers of the image.
pub const IMAGE: &str = "Image";
/// The settings of the estimate.
pub const SAMPLING: &str = "Sampling [default: the settings of the scene]";
/// Targets at which a render stops.
pub const STOP: &str = "Stop";
/// Checkpoints, sequences and partial renders.
pub const KEEP: &str = "Keep, continue and split";
/// Files and figures.
pub const OUTPUT: &str = "Output";
/// The replay of single samples.
pub const PATHS: &str = "Paths of a pixel";
