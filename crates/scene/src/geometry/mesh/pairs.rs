//! Pairs of triangles with a common edge.
//!
//! A pair has four corners in place of six, so that leaves are smaller, and the tree has half as many items. Most meshes are
//! quadrilaterals that were divided, and list both halves one after the other. A triangle that does not fit the next one goes to a free
//! neighbour before it in the list: to the one with which it has the smallest box for the size of both.
use rayon::prelude::*;

use crate::geometry::{bounds::Bounds, bvh::NONE};

/// The least part of all triangles that must be in pairs: one that is not takes the room of a pair.
const LEAST: f64 = 0.95;

/// Triangles in a row among which neighbours are looked for.
const CHUNK: usize = 1 << 16;

type Triangle = [[f32; 3]; 3];

/// One or two triangles; the second one may be [`NONE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair(pub [u32; 2]);

impl Pair {
    /// The corners a, b, c and d of triangles a b c and c d a; d is NaN if there is only one. `corners` returns those of a triangle.
    pub fn corners(self, corners: impl Fn(u32) -> Triangle) -> [[f32; 3]; 4] {
        let Pair([first, second]) = self;
        let one @ [a, b, c] = corners(first);
        let both = if second == NONE { None } else { shared(&one, &corners(second)) };
        both.unwrap_or([a, b, c, [f32::NAN; 3]])
    }
}

/// Divides `count` triangles into pairs; `None` if too many remain alone.
pub(super) fn pairs(count: usize, corners: impl Fn(u32) -> Triangle + Sync) -> Option<Vec<Pair>> {
    let starts: Vec<usize> = (0..count).step_by(CHUNK).collect();
    let chunk = |start: usize| pairs_among(start as u32, count.min(start + CHUNK) as u32, &corners);
    let chunks: Vec<Vec<Pair>> = starts.into_par_iter().map(chunk).collect();
    let all: usize = chunks.iter().map(Vec::len).sum();
    let in_pairs = 2 * (count - all);
    (count > 0 && in_pairs as f64 >= LEAST * count as f64).then(|| chunks.concat())
}

fn pairs_among(start: u32, end: u32, corners: &impl Fn(u32) -> Triangle) -> Vec<Pair> {
    let (mut pairs, mut free) = (Vec::with_capacity((end - start) as usize), Free::new(start, end));
    let mut last: Option<(u32, Triangle)> = None;
    for number in start..end {
        let here = corners(number);
        if let Some((before, _)) = last.filter(|(_, last)| fit(last, &here).is_some()) {
            pairs.push(free.take([before, number]));
            last = None;
        } else if let Some((before, triangle)) = last.replace((number, here)) {
            pairs.extend(free.pair(before, &triangle, corners));
        }
    }
    pairs.extend(last.and_then(|(before, triangle)| free.pair(before, &triangle, corners)));
    pairs.extend((start..end).filter(|number| free.has(*number)).map(|number| Pair([number, NONE])));
    pairs
}

/// Triangles that are in no pair yet.
struct Free {
    start: u32,
    are_free: Vec<bool>,
    /// By the first bits of hashes of edges. If more wait in one place, some are forgotten.
    at_edges: Vec<[u32; 4]>,
}

impl Free {
    fn new(start: u32, end: u32) -> Free {
        let count = (end - start) as usize;
        Free { start, are_free: vec![true; count], at_edges: vec![[NONE; 4]; count.next_power_of_two().max(2)] }
    }

    fn has(&self, triangle: u32) -> bool {
        triangle != NONE && self.are_free[(triangle - self.start) as usize]
    }

    fn take(&mut self, triangles: [u32; 2]) -> Pair {
        triangles.into_iter().for_each(|triangle| self.are_free[(triangle - self.start) as usize] = false);
        Pair(triangles)
    }

    /// Takes a triangle and the neighbour that fits best. If there is none, the triangle waits at its edges.
    fn pair(&mut self, number: u32, triangle: &Triangle, corners: impl Fn(u32) -> Triangle) -> Option<Pair> {
        let buckets = hashes(triangle).map(|edge| (edge >> (64 - self.at_edges.len().ilog2())) as usize);
        let others = buckets.into_iter().flat_map(|bucket| self.at_edges[bucket]).filter(|other| self.has(*other));
        let fits = others.filter_map(|other| fit(&corners(other), triangle).map(|fit| (fit, other)));
        if let Some((_, other)) = fits.min_by(|a, b| a.0.total_cmp(&b.0)) {
            return Some(self.take([other, number]));
        }
        for bucket in buckets {
            let place = self.at_edges[bucket].iter().position(|other| !self.has(*other));
            self.at_edges[bucket][place.unwrap_or(0)] = number;
        }
        None
    }
}

/// Hashes of the edges, which do not depend on the direction.
fn hashes(corners: &Triangle) -> [u64; 3] {
    // Multiplication by 2⁶⁴/φ (Knuth, "The Art of Computer Programming", volume 3, section 6.4). Adding 0 removes the sign of 0.
    let scattered = |x: u64| x.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = |hash: u64, x: &f32| scattered(hash ^ u64::from((x + 0.0).to_bits())).rotate_left(29);
    let [a, b, c] = corners.each_ref().map(|corner| corner.iter().fold(0, mixed));
    [[a, b], [b, c], [c, a]].map(|[a, b]| scattered(a.wrapping_add(b)))
}

/// The area of a box around both triangles, relative to those of their own; `None` if it is larger, or if they have no common edge. Copies
/// have three, and stay alone, so that the tree has only the first.
fn fit(one: &Triangle, two: &Triangle) -> Option<f32> {
    let area = |corners: &[[f32; 3]]| Bounds::of_points(corners.iter().copied()).surface_area();
    let all @ [_, b, _, d] = shared(one, two)?;
    if b == d {
        return None;
    }
    let fit = area(&all) / (area(one) + area(two));
    (fit <= 1.0).then_some(fit)
}

/// The corners a, b, c and d of triangles a b c and c d a, the second of which may run either way around.
fn shared(one: &Triangle, two: &Triangle) -> Option<[[f32; 3]; 4]> {
    let turned = |corners: &Triangle, turn: usize| [corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]];
    // Halves of a quadrilateral a b c d need no turn.
    [0, 1, 2].into_iter().map(|turn| turned(one, turn)).find_map(|[a, b, c]| {
        let rest = [0, 1, 2].into_iter().map(|turn| turned(two, turn)).find(|[x, y, _]| [*x, *y] == [a, c] || [*x, *y] == [c, a]);
        rest.map(|[.., d]| [a, b, c, d])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f32; 3] = [0.0, 0.0, 0.0];
    const B: [f32; 3] = [1.0, 0.0, 0.0];
    const C: [f32; 3] = [1.0, 1.0, 0.5];
    const D: [f32; 3] = [0.0, 1.0, 0.0];

    fn turns([a, b, c]: Triangle) -> [Triangle; 3] {
        [[a, b, c], [b, c, a], [c, a, b]]
    }

    #[test]
    fn halves_of_a_quadrilateral_have_four_corners_however_they_are_listed() {
        for one in turns([A, B, C]) {
            for two in turns([A, C, D]).into_iter().chain(turns([A, D, C])) {
                assert_eq!(shared(&one, &two), Some([A, B, C, D]));
                let corners = |pair: Pair| pair.corners(|triangle| if triangle == 6 { one } else { two });
                assert_eq!(corners(Pair([6, 9])), [A, B, C, D]);
                let single = corners(Pair([6, NONE]));
                assert!(single[..3] == one && single[3][0].is_nan());
                let common = hashes(&one).into_iter().filter(|hash| hashes(&two).contains(hash)).count();
                assert_eq!(common, 1, "one edge is common to both");
            }
        }
        assert_eq!(shared(&[A, B, C], &[A, D, [0.0, 2.0, 0.0]]), None, "a common corner is no edge");
    }

    /// Triangle 2 i and 2 i + 1 are halves of a quadrilateral.
    fn half(triangle: u32) -> Triangle {
        let half = if triangle.is_multiple_of(2) { [A, B, C] } else { [A, C, D] };
        half.map(|[x, y, z]| [x + 2.0 * (triangle / 2) as f32, y, z])
    }

    #[test]
    fn halves_find_each_other_wherever_they_are_in_a_chunk() {
        // All first halves, then all second ones.
        let apart = |triangle: u32| half(2 * triangle % (CHUNK as u32 - 1));
        let found = pairs(CHUNK - 1, apart).expect("all but one are in pairs");
        let mut all: Vec<u32> = found.iter().flat_map(|pair| pair.0).filter(|triangle| *triangle != NONE).collect();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..CHUNK as u32 - 1), "each is there once");
        for pair in found.iter().filter(|pair| pair.0[1] != NONE) {
            assert!(pair.corners(apart)[3][0].is_finite(), "both have an edge in common");
        }
        let on_one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can start");
        assert_eq!(on_one_thread.install(|| pairs(3 * CHUNK, half)), pairs(3 * CHUNK, half));
        // In chunks of their own they do not.
        let count = 2 * CHUNK as u32;
        assert_eq!(pairs(2 * CHUNK, |triangle| half(2 * triangle % (count - 1))), None);
        assert_eq!(pairs(0, half), None);
    }

    #[test]
    fn all_are_left_alone_if_too_many_would_be() {
        let some =
            |every: u32| move |triangle: u32| half(if triangle.is_multiple_of(every) { 1000 + 2 * triangle } else { triangle });
        assert!(pairs(800, some(100)).is_some() && pairs(800, some(20)).is_none());
    }

    #[test]
    fn a_triangle_goes_to_the_next_one_or_to_the_neighbour_with_which_it_has_the_smallest_box() {
        let low = [A, B, [0.5, 0.5, 0.2]];
        let far = half(6);
        let list = [[A, C, D], far, low, far, [A, B, C], far];
        let pairs = |list: &[Triangle]| pairs_among(0, list.len() as u32, &|triangle| list[triangle as usize]);
        assert_eq!(pairs(&list)[0], Pair([0, 4]));
        assert_eq!(pairs(&list[1..])[0], Pair([1, 3]));
        assert_eq!(pairs(&[[A, C, D], low, [A, B, C]]), [Pair([1, 2]), Pair([0, NONE])]);
    }

    #[test]
    fn copies_are_no_pair() {
        assert!(turns([A, B, C]).iter().all(|copy| fit(&[A, B, C], copy).is_none() && fit(&[C, B, A], copy).is_none()));
    }

    #[test]
    fn needles_across_each_other_are_no_pair() {
        let needles = [[A, [9.0, 0.0, 0.0], [0.0, 0.1, 0.0]], [A, [0.0, 0.1, 0.0], [0.0, 0.0, 9.0]]];
        assert!(shared(&needles[0], &needles[1]).is_some() && fit(&needles[0], &needles[1]).is_none());
    }
}
