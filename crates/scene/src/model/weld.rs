//! Equal corners and equal positions.
use rayon::prelude::*;

/// Returns the distinct corners in the order of their positions, and for each corner its index among them. `place` is the number of a
/// corner's position, less than `places`; corners are ordered by it first.
///
/// Corners are gathered by position, and sorted there: no file can make that as slow as it could make a hash table.
pub fn distinct<C: Copy + Ord + Sync>(corners: &[C], places: usize, place: impl Fn(&C) -> usize + Sync) -> (Vec<C>, Vec<u32>) {
    let mut starts = vec![0u32; places + 2];
    for corner in corners {
        starts[place(corner) + 2] += 1;
    }
    for place in 2..places + 2 {
        starts[place] += starts[place - 1];
    }
    let mut sorted = corners.to_vec();
    for corner in corners {
        let next = &mut starts[place(corner) + 1];
        sorted[*next as usize] = *corner;
        *next += 1;
    }
    let (mut count, mut from) = (0, 0);
    for place in 0..places {
        let to = starts[place + 1] as usize;
        sorted[from..to].sort_unstable();
        let first = count;
        starts[place] = first as u32;
        for at in from..to {
            if count == first || sorted[count - 1] != sorted[at] {
                sorted[count] = sorted[at];
                count += 1;
            }
        }
        from = to;
    }
    starts[places] = count as u32;
    sorted.truncate(count);
    let position = |corner: &C| {
        let [start, end] = [0, 1].map(|next| starts[place(corner) + next]);
        let same_place = &sorted[start as usize..end as usize];
        start + same_place.partition_point(|other| other < corner) as u32
    };
    let positions = corners.par_iter().map(position).collect();
    (sorted, positions)
}

/// Bytes per position while [`positions`] runs.
pub const WELDING: u64 = 28;

/// Returns for each position the index of the first one that equals it. −0 equals 0.
pub fn firsts(all: &[[f32; 3]]) -> Vec<u32> {
    firsts_within(all, |_| ())
}

/// Returns for each position the index of the first one that equals it and has an equal group.
pub fn firsts_within<G: Ord + Send>(all: &[[f32; 3]], group: impl Fn(usize) -> G + Sync) -> Vec<u32> {
    let key = |(index, position): (usize, &[f32; 3])| ((position.map(|x| (x + 0.0).to_bits()), group(index)), index as u32);
    let mut keys: Vec<(([u32; 3], G), u32)> = all.par_iter().enumerate().map(key).collect();
    keys.par_sort_unstable();
    let mut firsts = vec![0; all.len()];
    for same in keys.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|(_, index)| firsts[*index as usize] = same[0].1);
    }
    firsts
}

/// Returns the distinct positions in the order in which they come first, and for each position its index among them. −0 equals 0.
pub fn positions(all: &[[f32; 3]]) -> (Vec<[f32; 3]>, Vec<u32>) {
    // First each position's first equal, and then the number of that.
    let mut numbers = firsts(all);
    let mut kept = Vec::new();
    for index in 0..all.len() {
        let first = numbers[index] as usize;
        if first == index {
            numbers[index] = kept.len() as u32;
            kept.push(all[index]);
        } else {
            numbers[index] = numbers[first];
        }
    }
    (kept, numbers)
}
