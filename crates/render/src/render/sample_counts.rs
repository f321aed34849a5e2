//! Sample counts of the pixels of an image, which differ after an interruption and with adaptive sampling.
use std::fmt;

/// Statistics of sample counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleCounts {
    /// Minimum over the pixels.
    pub least: u32,
    /// Maximum over the pixels.
    pub most: u32,
    /// Sum over the pixels.
    pub total: u64,
    /// Number of pixels.
    pub pixels: u64,
}

impl SampleCounts {
    /// Computes the statistics of these sample counts.
    pub fn of(counts: impl Iterator<Item = u32>) -> SampleCounts {
        let start = SampleCounts { least: u32::MAX, ..SampleCounts::default() };
        let all = counts.fold(start, |all, count| SampleCounts {
            least: all.least.min(count),
            most: all.most.max(count),
            total: all.total + u64::from(count),
            pixels: all.pixels + 1,
        });
        if all.pixels == 0 { SampleCounts::default() } else { all }
    }

    /// Samples per pixel on average.
    pub fn mean(&self) -> f64 {
        self.total as f64 / self.pixels.max(1) as f64
    }
}

/// "16 spp", or "3.4 spp on average (3 to 4)".
impl fmt::Display for SampleCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.least, self.most) {
            (least, most) if least == most => write!(f, "{least} spp"),
            (least, most) => write!(f, "{:.1} spp on average ({least} to {most})", self.mean()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sample_counts_are_summarised_correctly() {
        let uneven = SampleCounts::of([3, 4, 3, 3, 4].into_iter());
        assert_eq!(uneven, SampleCounts { least: 3, most: 4, total: 17, pixels: 5 });
        assert_eq!((uneven.mean(), uneven.to_string().as_str()), (3.4, "3.4 spp on average (3 to 4)"));
        assert_eq!(SampleCounts::of([7, 7].into_iter()).to_string(), "7 spp");
        assert_eq!(SampleCounts::of(std::iter::empty()), SampleCounts::default());
    }
}
