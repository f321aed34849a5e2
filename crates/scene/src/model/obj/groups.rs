//! Smoothing groups: lines `s`, as the number of triangles before each one and the number of its group. Faces before the first line are
//! in no group.
use super::super::{ModelFormatError, Smoothing};
use noisefall_base::memory::reserve;

/// The number of a group by the word after `s`: `off` and nothing are 0, which is none.
pub fn number(word: Option<&str>) -> u32 {
    match word {
        None => 0,
        Some(word) if word.eq_ignore_ascii_case("off") => 0,
        Some(word) => word.parse().unwrap_or(1),
    }
}

/// The lines that count for a range of triangles, by the number of triangles since its start; none if the file has none.
pub fn within(groups: &[(u32, u32)], [from, to]: [u32; 2]) -> impl Iterator<Item = (u32, u32)> {
    let next = groups.partition_point(|(at, _)| *at <= from);
    let before = next.checked_sub(1).map_or(0, |last| groups[last].1);
    let start = (!groups.is_empty()).then_some((0, before));
    start.into_iter().chain(groups[next..].iter().take_while(move |(at, _)| *at < to).map(move |(at, group)| (at - from, *group)))
}

/// Returns the smoothing that the lines ask for, of this many triangles.
pub fn smoothing(groups: &[(u32, u32)], triangles: usize) -> Result<Smoothing, ModelFormatError> {
    let runs: Vec<(u32, u32)> = within(groups, [0, triangles as u32]).collect();
    let Some((_, first)) = runs.first() else { return Ok(Smoothing::Unstated) };
    if runs.iter().all(|(_, group)| group == first) {
        return Ok(if *first == 0 { Smoothing::Flat } else { Smoothing::Smooth });
    }
    let _room = reserve("smoothing groups", (triangles * size_of::<u32>()) as u64)?;
    let mut numbers = Vec::with_capacity(triangles);
    let ends = runs[1..].iter().map(|(at, _)| *at as usize).chain([triangles]);
    runs.iter().zip(ends).for_each(|((_, group), end)| numbers.resize(end, *group));
    Ok(Smoothing::Groups(numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_count_until_the_next_one() {
        assert_eq!([None, Some("off"), Some("OFF"), Some("0"), Some("7"), Some("on")].map(number), [0, 0, 0, 0, 7, 1]);
        let groups = [(2, 1), (4, 0), (5, 3)];
        assert_eq!(smoothing(&groups, 6), Ok(Smoothing::Groups(vec![0, 0, 1, 1, 0, 3])));
        assert_eq!(within(&groups, [3, 5]).collect::<Vec<_>>(), [(0, 1), (1, 0)]);
        assert_eq!(smoothing(&[], 6), Ok(Smoothing::Unstated));
        assert_eq!(smoothing(&[(0, 0)], 6), Ok(Smoothing::Flat));
        assert_eq!(smoothing(&[(0, 4), (6, 9)], 6), Ok(Smoothing::Smooth));
    }
}
