//! The order of triangles in the slots of leaves.
use super::{block::SIZE, pieces::Piece};
use crate::geometry::bvh::NONE;

/// Triangles in the order in which leaves first name them.
pub(super) struct Slots {
    /// The vertices of the triangles, as integers in bits.
    pub triangles: Vec<[f32; 4]>,
    /// The first slot of every leaf.
    first: Vec<u32>,
    /// The triangle in each slot; empty if no triangle is in several, so that both have the same order.
    pub triangle_of: Vec<u32>,
    count: usize,
}

impl Slots {
    /// Fills the leaves: `order` has their items, which are `pieces` of triangles, or whole ones.
    pub fn new(order: &[u32], triangles: &[[u32; 3]], pieces: Option<&[Piece]>) -> Slots {
        let (rows, first) = (Vec::with_capacity(triangles.len()), Vec::with_capacity(order.len() / SIZE));
        let mut slots = Slots { triangles: rows, first, triangle_of: Vec::new(), count: 0 };
        // The new numbers of triangles that have one.
        let mut numbers = vec![NONE; if pieces.is_some() { triangles.len() } else { 0 }];
        for leaf in order.chunks_exact(SIZE) {
            slots.first.push(slots.count as u32);
            for item in leaf.iter().copied().filter(|item| *item != NONE) {
                match pieces {
                    None => {
                        slots.add_triangle(triangles[item as usize]);
                        slots.count += 1;
                    }
                    Some(pieces) => slots.add_piece(triangles, pieces[item as usize].triangle as usize, &mut numbers),
                }
            }
        }
        slots
    }

    fn add_triangle(&mut self, [a, b, c]: [u32; 3]) {
        self.triangles.push([a, b, c, 0].map(f32::from_bits));
    }

    fn add_piece(&mut self, triangles: &[[u32; 3]], triangle: usize, numbers: &mut [u32]) {
        if numbers[triangle] == NONE {
            numbers[triangle] = self.triangles.len() as u32;
            self.add_triangle(triangles[triangle]);
        }
        // A leaf tests a triangle once, however many of its pieces it has.
        let start = self.first.last().map_or(0, |first| *first as usize);
        if !self.triangle_of[start..].contains(&numbers[triangle]) {
            self.triangle_of.push(numbers[triangle]);
            self.count += 1;
        }
    }

    /// Number of leaves.
    pub fn leaves(&self) -> usize {
        self.first.len()
    }

    /// The first slot of a leaf, and the triangles in its slots.
    pub fn leaf(&self, leaf: usize) -> (u32, impl ExactSizeIterator<Item = &[f32; 4]>) {
        let start = self.first[leaf] as usize;
        let end = self.first.get(leaf + 1).map_or(self.count, |next| *next as usize);
        let triangle = |slot: usize| self.triangle_of.get(slot).map_or(slot, |triangle| *triangle as usize);
        (start as u32, (start..end).map(move |slot| &self.triangles[triangle(slot)]))
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
        let corner = |slots: &Slots, at: usize| slots.leaf(at).1.map(|row| row[0].to_bits()).collect::<Vec<_>>();
        let order = [leaf(&[2, 0]), leaf(&[1])].concat();
        let whole = Slots::new(&order, &triangles, None);
        assert_eq!((corner(&whole, 0), corner(&whole, 1), whole.leaf(1).0), (vec![6, 0], vec![3], 2));
        assert!(whole.triangle_of.is_empty() && whole.leaves() == 2);
        // Pieces of the triangles 0, 1, 0, 1.
        let pieces: Vec<Piece> = (0..4).map(|piece| Piece { triangle: piece % 2, bounds: Bounds::EMPTY }).collect();
        let order = [leaf(&[3, 1, 2]), leaf(&[0])].concat();
        let slots = Slots::new(&order, &triangles, Some(&pieces));
        assert_eq!((corner(&slots, 0), corner(&slots, 1), slots.leaf(1).0), (vec![3, 0], vec![0], 2));
        assert_eq!((slots.triangle_of, slots.triangles.len()), (vec![0, 1, 1], 2));
    }
}
