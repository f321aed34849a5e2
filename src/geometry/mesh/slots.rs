//! The order of triangles in the slots of leaves.
use super::{block::SIZE, pieces::Piece};
use crate::geometry::bvh::NONE;

/// Triangles in the order in which leaves first name them.
pub(super) struct Slots {
    /// The vertices of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// The first slot of every leaf.
    first: Vec<u32>,
    /// The triangle in each slot; empty if no triangle is in several, so that both have the same order.
    pub triangle_of: Vec<u32>,
    count: usize,
}

impl Slots {
    /// Fills the leaves: `order` has their items, which are `pieces` of `count` triangles, or whole ones. `triangle` returns the vertices
    /// of a triangle by its number.
    pub fn new(order: &[u32], count: usize, pieces: Option<&[Piece]>, triangle: impl Fn(u32) -> [u32; 3]) -> Slots {
        let (triangles, first) = (Vec::with_capacity(count), Vec::with_capacity(order.len() / SIZE));
        let mut slots = Slots { triangles, first, triangle_of: Vec::new(), count: 0 };
        // The new numbers of triangles that have one.
        let mut numbers = vec![NONE; if pieces.is_some() { count } else { 0 }];
        for leaf in order.chunks_exact(SIZE) {
            slots.first.push(slots.count as u32);
            for item in leaf.iter().copied().filter(|item| *item != NONE) {
                match pieces {
                    None => {
                        slots.triangles.push(triangle(item));
                        slots.count += 1;
                    }
                    Some(pieces) => {
                        let number = pieces[item as usize].triangle;
                        slots.add_piece(&mut numbers[number as usize], || triangle(number));
                    }
                }
            }
        }
        slots
    }

    /// Adds a piece of a triangle with this new number, [`NONE`] before its first piece.
    fn add_piece(&mut self, number: &mut u32, triangle: impl Fn() -> [u32; 3]) {
        if *number == NONE {
            *number = self.triangles.len() as u32;
            self.triangles.push(triangle());
        }
        // A leaf tests a triangle once, however many of its pieces it has.
        let start = self.first.last().map_or(0, |first| *first as usize);
        if !self.triangle_of[start..].contains(number) {
            self.triangle_of.push(*number);
            self.count += 1;
        }
    }

    /// Number of leaves.
    pub fn leaves(&self) -> usize {
        self.first.len()
    }

    /// The first slot of a leaf, and the triangles in its slots.
    pub fn leaf(&self, leaf: usize) -> (u32, impl Iterator<Item = [u32; 3]>) {
        let start = self.first[leaf] as usize;
        let end = self.first.get(leaf + 1).map_or(self.count, |next| *next as usize);
        let triangle = |slot: usize| self.triangle_of.get(slot).map_or(slot, |triangle| *triangle as usize);
        (start as u32, (start..end).map(move |slot| self.triangles[triangle(slot)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bounds::Bounds;

    fn leaf(items: &[u32]) -> [u32; SIZE] {
        std::array::from_fn(|place| items.get(place).copied().unwrap_or(NONE))
    }

    #[test]
    fn triangles_are_numbered_as_leaves_name_them_and_a_leaf_has_each_once() {
        let triangles = [[0, 1, 2], [3, 4, 5], [6, 7, 8]];
        let corner = |slots: &Slots, at: usize| slots.leaf(at).1.map(|triangle| triangle[0]).collect::<Vec<_>>();
        let order = [leaf(&[2, 0]), leaf(&[1])].concat();
        let whole = Slots::new(&order, 3, None, |triangle| triangles[triangle as usize]);
        assert_eq!((corner(&whole, 0), corner(&whole, 1), whole.leaf(1).0), (vec![6, 0], vec![3], 2));
        assert!(whole.triangle_of.is_empty() && whole.leaves() == 2);
        // Pieces of the triangles 0, 1, 0, 1.
        let pieces: Vec<Piece> = (0..4).map(|piece| Piece { triangle: piece % 2, bounds: Bounds::EMPTY }).collect();
        let order = [leaf(&[3, 1, 2]), leaf(&[0])].concat();
        let slots = Slots::new(&order, 2, Some(&pieces), |triangle| triangles[triangle as usize]);
        assert_eq!((corner(&slots, 0), corner(&slots, 1), slots.leaf(1).0), (vec![3, 0], vec![0], 2));
        assert_eq!((slots.triangle_of, slots.triangles.len()), (vec![0, 1, 1], 2));
    }
}
