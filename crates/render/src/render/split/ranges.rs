//! Ranges of sample indices.
use std::fmt;

/// Sorted ranges of sample indices, the second number excluded, that neither touch nor overlap.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SampleRanges(Vec<[u32; 2]>);

impl SampleRanges {
    /// The ranges in a list; `None` if one is empty, or if they overlap.
    pub fn of(list: &[[u32; 2]]) -> Option<SampleRanges> {
        let mut sorted = list.to_vec();
        sorted.sort_unstable();
        let mut ranges: Vec<[u32; 2]> = Vec::new();
        for [start, end] in sorted {
            match ranges.last_mut() {
                _ if start >= end => return None,
                Some([_, last]) if start < *last => return None,
                Some([_, last]) if start == *last => *last = end,
                _ => ranges.push([start, end]),
            }
        }
        Some(SampleRanges(ranges))
    }

    /// All ranges, in order.
    pub fn list(&self) -> &[[u32; 2]] {
        &self.0
    }

    /// Number of samples.
    pub fn total(&self) -> u32 {
        self.0.iter().map(|[start, end]| end - start).sum()
    }

    /// Both together; `None` if they overlap.
    pub fn joined(&self, other: &SampleRanges) -> Option<SampleRanges> {
        SampleRanges::of(&[self.list(), other.list()].concat())
    }

    /// The samples that both have.
    pub fn overlap(&self, other: &SampleRanges) -> SampleRanges {
        let both = |[a, b]: [u32; 2], [c, d]: [u32; 2]| Some([a.max(c), b.min(d)]).filter(|[start, end]| start < end);
        SampleRanges(self.0.iter().flat_map(|a| other.0.iter().filter_map(|b| both(*a, *b))).collect())
    }

    /// The samples from 0 to `end`, or to the last one, that are missing.
    pub fn missing(&self, end: Option<u32>) -> SampleRanges {
        let starts = [0].into_iter().chain(self.0.iter().map(|range| range[1]));
        let last = self.0.last().map_or(0, |range| range[1]);
        let ends = self.0.iter().map(|range| range[0]).chain([end.unwrap_or(last)]);
        SampleRanges(starts.zip(ends).filter(|(start, end)| start < end).map(|(start, end)| [start, end]).collect())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// "0..16, 32..64".
impl fmt::Display for SampleRanges {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranges: Vec<String> = self.0.iter().map(|[start, end]| format!("{start}..{end}")).collect();
        f.write_str(&ranges.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(list: &[[u32; 2]]) -> SampleRanges {
        SampleRanges::of(list).expect("they do not overlap")
    }

    #[test]
    fn ranges_are_joined_in_any_order() {
        let all = of(&[[32, 64], [0, 16], [16, 24]]);
        assert_eq!((all.list(), all.total(), all.to_string().as_str()), (&[[0, 24], [32, 64]][..], 56, "0..24, 32..64"));
        assert_eq!(all.joined(&of(&[[24, 32]])), Some(of(&[[0, 64]])));
        assert_eq!(all.joined(&of(&[[20, 32]])), None);
        assert_eq!(SampleRanges::of(&[[3, 3]]), None);
    }

    #[test]
    fn overlaps_and_gaps_are_named() {
        let all = of(&[[0, 24], [32, 64]]);
        assert_eq!(all.overlap(&of(&[[20, 40], [60, 70]])), of(&[[20, 24], [32, 40], [60, 64]]));
        assert!(all.overlap(&of(&[[24, 32]])).is_empty());
        assert_eq!(all.missing(None), of(&[[24, 32]]));
        assert_eq!(all.missing(Some(100)), of(&[[24, 32], [64, 100]]));
        assert_eq!(of(&[[8, 9]]).missing(None), of(&[[0, 8]]));
        assert_eq!(SampleRanges::default().missing(Some(4)), of(&[[0, 4]]));
    }
}
