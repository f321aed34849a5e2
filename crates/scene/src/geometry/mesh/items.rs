//! Items in the leaves of a tree: triangles, pairs of them, or pieces of long ones.
use super::{
    leaves::{Apart, Filled, PAIRS, Shared, TriangleLeaves},
    pairs::{Pair, pairs},
    pieces::{Pieces, pieces},
    shear::SIZE,
};
use crate::geometry::{
    bounds::Bounds,
    bvh::{Bvh, NONE},
};
use noisefall_base::progress::{Cancelled, Progress};

/// The items of a tree over triangles.
pub(super) enum Items {
    Triangles,
    Pairs(Vec<Pair>),
    Pieces(Pieces),
}

impl Items {
    /// The items for `count` triangles. `corners` returns those of a triangle.
    pub fn of(count: usize, corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync) -> Items {
        match pieces(count, &corners) {
            Some(pieces) => Items::Pieces(pieces),
            None => pairs(count, corners).map_or(Items::Triangles, Items::Pairs),
        }
    }

    /// The tree over them, and their numbers in the order of the leaves. Progress counts triangles.
    pub fn tree(
        &self,
        count: usize,
        corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync,
        progress: &Progress,
    ) -> Result<(Bvh, Vec<u32>), Cancelled> {
        let watch = (progress, count as u64);
        let bits_of = |triangle: u32| bits(corners(triangle));
        match self {
            Items::Triangles => {
                let bounds = |triangle: usize| Bounds::of_points(corners(triangle as u32));
                Bvh::build_watched::<SIZE>(count, bounds, Some(&|a, b| bits_of(a).cmp(&bits_of(b))), watch)
            }
            Items::Pairs(pairs) => {
                let corners = |pair: u32| pairs[pair as usize].corners(&corners);
                let bounds = |pair: usize| Bounds::of_points(corners(pair as u32));
                Bvh::build_watched::<PAIRS>(pairs.len(), bounds, Some(&|a, b| bits(corners(a)).cmp(&bits(corners(b)))), watch)
            }
            Items::Pieces(Pieces { pieces, .. }) => {
                let bits = |piece: u32| bits_of(pieces[piece as usize].triangle);
                Bvh::build_watched::<SIZE>(pieces.len(), |piece| pieces[piece].bounds, Some(&|a, b| bits(a).cmp(&bits(b))), watch)
            }
        }
    }

    /// Which of `count` triangles are in the leaves, whose items are in `order`; `None` if all are. A tree leaves copies out.
    pub fn present(&self, count: usize, order: &[u32]) -> Option<Vec<bool>> {
        let items = match self {
            Items::Triangles => count,
            Items::Pairs(pairs) => pairs.len(),
            Items::Pieces(Pieces { pieces, .. }) => pieces.len(),
        };
        let all = || order.iter().copied().filter(|item| *item != NONE);
        if all().count() == items {
            return None;
        }
        let mut present = vec![false; count];
        for item in all() {
            let triangles = match self {
                Items::Triangles => [item, NONE],
                Items::Pairs(pairs) => pairs[item as usize].0,
                Items::Pieces(Pieces { pieces, .. }) => [pieces[item as usize].triangle, NONE],
            };
            triangles.into_iter().filter(|triangle| *triangle != NONE).for_each(|triangle| present[triangle as usize] = true);
        }
        present.contains(&false).then_some(present)
    }

    /// The leaves of the tree, whose items are in `order`.
    pub fn leaves(&self, order: &[u32], corners: impl Fn(u32) -> [[f32; 3]; 3] + Send + Sync) -> TriangleLeaves {
        let apart =
            |numbers: [u32; SIZE]| (Apart::new(places(&numbers).map(|(place, triangle)| (place, corners(triangle)))), numbers);
        match self {
            Items::Triangles => {
                TriangleLeaves::Apart(Filled::new(order, SIZE, |leaf| apart(std::array::from_fn(|place| leaf[place]))))
            }
            Items::Pieces(pieces) => TriangleLeaves::Apart(Filled::new(order, SIZE, |leaf| apart(pieces.triangles(leaf)))),
            Items::Pairs(pairs) => TriangleLeaves::Shared(Filled::new(order, PAIRS, |leaf| {
                let pair = |item: u32| pairs[item as usize];
                let mut numbers = [NONE; SIZE];
                for (place, item) in places(leaf) {
                    [numbers[place], numbers[PAIRS + place]] = pair(item).0;
                }
                (Shared::new(places(leaf).map(|(place, item)| (place, pair(item).corners(&corners)))), numbers)
            })),
        }
    }
}

/// The items of a leaf, and their places.
fn places(leaf: &[u32]) -> impl Iterator<Item = (usize, u32)> {
    leaf.iter().copied().enumerate().filter(|(_, item)| *item != NONE)
}

fn bits<const N: usize>(corners: [[f32; 3]; N]) -> [[u32; 3]; N] {
    corners.map(|corner| corner.map(f32::to_bits))
}
