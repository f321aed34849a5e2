//! The counts that a pass reports besides its samples.

/// Figures of a pass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassCount {
    /// Rays traced: path segments, shadow rays and visibility rays of path reuse.
    pub rays: u64,
    /// Paths cut because they were too long.
    pub cut_paths: u64,
    /// The first invalid sample.
    pub invalid: Option<SampleId>,
    /// A sample whose computation failed.
    pub failure: Option<Failure>,
}

/// Identifies one sample by its pixel and index, for a replay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleId {
    /// Column and row from the top left.
    pub pixel: [u32; 2],
    /// Index of the sample within the pixel.
    pub sample: u32,
}

/// The renderer panicked.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The sample, or the first one of the tile if none fails alone.
    pub at: SampleId,
    /// Whether the sample fails when it is replayed.
    pub replays: bool,
    /// Resolution of the image, which may have been a coarse one.
    pub resolution: [u32; 2],
    /// The message of the panic.
    pub message: String,
}

impl PassCount {
    /// The figures of both passes together.
    pub fn merge(self, other: PassCount) -> PassCount {
        PassCount {
            rays: self.rays + other.rays,
            cut_paths: self.cut_paths + other.cut_paths,
            invalid: [self.invalid, other.invalid].into_iter().flatten().min(),
            failure: self.failure.or(other.failure),
        }
    }
}

/// The message of a panic.
pub fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned())).unwrap_or_else(|| "unknown panic".to_owned())
}
