//! Building the tree, from the heads down.
use glam::Vec3;

use super::{
    BITS, Tree, WAYS,
    cluster::{Item, Rows, rows},
    split::groups,
    word_of_light,
};

/// Maximum number of levels below a head; the trail of a light has [`BITS`] bits for each.
const MOST_LEVELS: u32 = 32 / BITS;

impl Tree {
    /// Builds the tree. `single` are the lights outside the tree, which are the first candidates; the heads follow.
    pub fn new(items: &mut [Item], single: &[u32], heads: usize) -> Tree {
        let mut tree = Tree {
            heads: Vec::new(),
            nodes: Vec::new(),
            places: vec![[0.0; 4]; single.len() + items.len()],
            oriented: items.iter().any(|item| item.axis != Vec3::ZERO),
        };
        for (candidate, light) in single.iter().enumerate() {
            tree.places[*light as usize][0] = f32::from_bits(candidate as u32);
        }
        let mut rest = items;
        for size in groups(rest, heads) {
            let (head, others) = rest.split_at_mut(size);
            rest = others;
            let candidate = (single.len() + tree.heads.len()) as u32;
            let word = tree.grow(head, BuildPosition { candidate, trail: 0, level: 0 });
            tree.heads.push(rows(head, word));
        }
        tree
    }

    /// Adds the subtree below a node of these lights, and returns the word of the node.
    fn grow(&mut self, items: &mut [Item], place: BuildPosition) -> u32 {
        if let [item] = items {
            self.places[item.light as usize] = [f32::from_bits(place.candidate), f32::from_bits(place.trail), 0.0, 0.0];
            return word_of_light(item.light);
        }
        let mut sizes = groups(items, WAYS);
        let fits = WAYS.saturating_pow(MOST_LEVELS - 1 - place.level);
        if sizes.iter().any(|size| *size > fits) {
            // Too uneven for the levels that are left.
            sizes = (0..WAYS).map(|way| items.len() * (way + 1) / WAYS - items.len() * way / WAYS).collect();
        }
        let first = self.nodes.len() / 2;
        self.nodes.resize(2 * (first + sizes.len()), [0.0; 4]);
        let mut rest = items;
        for (way, size) in sizes.iter().enumerate() {
            let (part, others) = rest.split_at_mut(*size);
            rest = others;
            let trail = place.trail | (way as u32) << (BITS * place.level);
            let word = self.grow(part, BuildPosition { trail, level: place.level + 1, ..place });
            let node: Rows = rows(part, word);
            self.nodes[2 * (first + way)..][..2].copy_from_slice(&node);
        }
        (first as u32) << BITS | (sizes.len() as u32 - 1)
    }
}

/// The current position of the build.
#[derive(Clone, Copy)]
struct BuildPosition {
    candidate: u32,
    trail: u32,
    level: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uneven_lights_fit_the_levels_that_are_left() {
        // All but a few lie in one place, so that groups by cost would be of very different sizes.
        let item = |light: u32| Item {
            center: Vec3::X * if light < 7 { 10f32.powi(light as i32) } else { 0.0 },
            radius: 0.1,
            power: 1.0,
            axis: Vec3::ZERO,
            two_sided: false,
            light,
        };
        let mut items: Vec<_> = (0..WAYS.pow(2) as u32).map(item).collect();
        let mut tree = Tree { places: vec![[0.0; 4]; items.len()], ..Tree::default() };
        tree.grow(&mut items, BuildPosition { candidate: 0, trail: 0, level: MOST_LEVELS - 2 });
        let mut trails: Vec<_> = tree.places.iter().map(|place| place[1].to_bits()).collect();
        trails.sort_unstable();
        let last_levels = |i: u32| i << (BITS * (MOST_LEVELS - 2));
        assert!(trails.into_iter().eq((0..WAYS.pow(2) as u32).map(last_levels)));
    }
}
