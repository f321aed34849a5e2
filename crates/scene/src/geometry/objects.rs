//! The tree over objects, which rays descend two at a time.
//!
//! A list tests a shape against all lanes at once. For a few shapes this costs less than a step in a tree; among many, a tree
//! finds the few near a ray. This module decides which shapes go where.
use fearless_simd::Simd;
use fearless_simd_macros::simd;
use glam::DVec3;

use super::{
    Nearest,
    bounds::Bounds,
    bvh::{Bvh, Leaves, Search, Searches, Slabs, Stacks, traverse},
    instance::Instance,
    lists::{Listed, Lists},
    object::{Object, ObjectKind},
};
use noisefall_base::math::{F, Lanes, M, MAX_LANES, One, U, V};

/// The cost of a tree, in tests of all lanes against a flat shape: if the sum of [`ObjectKind::cost`] is less, a tree is slower
/// (measured with 16 lanes on fields of 4 to 512 spheres, and of 4 to 128 cuboids, cylinders and meshes).
const COST_OF_TREE: f32 = 64.0;
/// Objects that more than one in this number of rays would hit are not in the tree.
const SHARE: f32 = 12.0;

/// A tree over objects.
pub(super) struct Objects {
    bvh: Bvh,
    /// The item of each leaf.
    items: Vec<Item>,
    lists: Lists,
}

#[derive(Clone, Copy)]
enum Item {
    Listed(Listed),
    Instance(u32),
}

/// Splits objects into those for lists and those for a tree. Both keep their order, because of coincident surfaces the first one
/// counts.
pub(super) fn few_and_many(objects: Vec<Object>) -> [Vec<Object>; 2] {
    let mut many = are_small(&objects);
    leave_out_far(&objects, &mut many);
    let cost: f32 = objects.iter().zip(&many).filter(|(_, many)| **many).map(|(object, _)| object.kind.cost()).sum();
    if cost < COST_OF_TREE {
        return [objects, Vec::new()];
    }
    let mut many = many.into_iter();
    let (many, few) = objects.into_iter().partition(|_| many.next() == Some(true));
    [few, many]
}

/// Marks objects that less than one in [`SHARE`] of the rays near the smaller ones would hit.
fn are_small(objects: &[Object]) -> Vec<bool> {
    let area = |object: usize| objects[object].bounds.surface_area();
    let mut by_area: Vec<usize> = (0..objects.len()).collect();
    by_area.sort_by(|&a, &b| area(a).total_cmp(&area(b)));
    let (mut count, mut rest) = (0, Bounds::EMPTY);
    for (place, &object) in by_area.iter().enumerate() {
        rest = rest.union(&objects[object].bounds);
        if area(object) * SHARE <= rest.surface_area() {
            count = place + 1;
        }
    }
    let mut small = vec![false; objects.len()];
    by_area[..count].iter().for_each(|&object| small[object] = true);
    small
}

/// Removes a few objects far outside all others, such as a sun, from the tree, because boxes are widened by the rounding error
/// over the whole tree.
fn leave_out_far(objects: &[Object], many: &mut [bool]) {
    const FAR: f32 = 16.0;
    const MOST: usize = 8;
    let middle =
        |object: usize| [0, 1, 2].map(|axis| 0.5 * objects[object].bounds.min[axis] + 0.5 * objects[object].bounds.max[axis]);
    let members: Vec<usize> = (0..objects.len()).filter(|&object| many[object]).collect();
    if members.is_empty() {
        return;
    }
    let median = [0, 1, 2].map(|axis| {
        let mut places: Vec<f32> = members.iter().map(|&object| middle(object)[axis]).collect();
        let half = places.len() / 2;
        *places.select_nth_unstable_by(half, f32::total_cmp).1
    });
    let distance = |object: usize| middle(object).iter().zip(median).map(|(x, m)| (x - m).abs()).fold(0.0, f32::max);
    let mut distances: Vec<f32> = members.iter().map(|&object| distance(object)).collect();
    let most = distances.len() * 9 / 10;
    let usual = *distances.select_nth_unstable_by(most, f32::total_cmp).1;
    let far: Vec<usize> = members.into_iter().filter(|&object| distance(object) > FAR * usual).collect();
    if far.len() <= MOST {
        far.into_iter().for_each(|object| many[object] = false);
    }
}

impl Objects {
    /// Builds the tree. `near` is a point in the middle of the scene.
    pub fn new(objects: &[Object], near: DVec3) -> Objects {
        let (bvh, order) = Bvh::build::<1>(objects.iter().map(|object| object.bounds));
        let mut lists = Lists::default();
        // In the order of the leaves, so that what is near in the tree is near in memory.
        let item = |&number: &u32| match objects[number as usize].kind {
            ObjectKind::Analytic { first, shape } => Item::Listed(lists.push(first, shape, near)),
            ObjectKind::Instance(index) => Item::Instance(index),
        };
        let items = order.iter().map(item).collect();
        Objects { bvh, items, lists }
    }

    #[cfg(test)]
    pub fn bounds(&self) -> Bounds {
        self.bvh.bounds()
    }

    /// Updates `nearest` with nearer hits along o + td, d of unit length, in the lanes of `live`. A hit before `enough` ends the search.
    /// The stacks are those of this tree and of the trees below.
    #[simd]
    pub fn closest<L: Lanes, const COUNTS: bool>(
        &self,
        l: L,
        instances: &[Instance],
        [stacks, below]: &mut [Stacks<COUNTS>; 2],
        (live, enough): (M<L>, F<L>),
        ((o, d), time): ((V<L>, V<L>), F<L>),
        nearest: &mut Nearest<L>,
    ) {
        let slabs = Slabs::new(l, o, d, &self.bvh.bounds());
        let mut searches = Searches::new(live, Search { limit: nearest.t, enough });
        let mut found = NearestHits {
            objects: self,
            instances,
            below,
            origins: arrays(o),
            directions: arrays(d),
            times: time.to_array(),
            enough: enough.to_array(),
            primitives: nearest.primitive.to_array(),
            elements: nearest.element.to_array(),
        };
        traverse(l.token(), &self.bvh, stacks, (&slabs, &mut searches), &mut found);
        let [primitive, element] = [found.primitives, found.elements].map(|x| l.load(bytemuck::cast_slice(&x)).bits());
        *nearest = Nearest { t: l.load(&searches.t_max), primitive, element };
    }
}

/// The nearest hits so far, by lane.
struct NearestHits<'a, const COUNTS: bool> {
    objects: &'a Objects,
    instances: &'a [Instance],
    below: &'a mut Stacks<COUNTS>,
    origins: [[f32; MAX_LANES]; 3],
    directions: [[f32; MAX_LANES]; 3],
    times: [f32; MAX_LANES],
    enough: [f32; MAX_LANES],
    primitives: [u32; MAX_LANES],
    elements: [u32; MAX_LANES],
}

impl<S: Simd, const COUNTS: bool> Leaves<S> for NearestHits<'_, COUNTS> {
    #[inline(always)]
    fn meet(&mut self, s: S, lane: usize, leaf: u32, t_max: f32) -> f32 {
        let (o, d) = (vector(&self.origins, lane), vector(&self.directions, lane));
        let (t, primitive, element) = match self.objects.items[leaf as usize] {
            Item::Listed(which) => {
                let (t, primitive) = self.objects.lists.meet(One, which, o, d);
                (t, primitive, U(0))
            }
            Item::Instance(index) => {
                let instance = &self.instances[index as usize];
                let search = Search { limit: F(t_max), enough: F(self.enough[lane]) };
                let found = instance.meet(One, s, self.below, (o, d), F(self.times[lane]), search);
                (found.t, found.piece + instance.first, found.element)
            }
        };
        // The first of surfaces that coincide.
        let same = t.0 == t_max && t_max < f32::INFINITY && primitive.0 < self.primitives[lane];
        if t.0 > 0.0 && (t.0 < t_max || same) {
            (self.primitives[lane], self.elements[lane]) = (primitive.0, element.0);
            return t.0;
        }
        t_max
    }
}

#[inline(always)]
fn arrays<L: Lanes>(v: V<L>) -> [[f32; MAX_LANES]; 3] {
    [v.x.to_array(), v.y.to_array(), v.z.to_array()]
}

#[inline(always)]
fn vector(arrays: &[[f32; MAX_LANES]; 3], lane: usize) -> V<One> {
    V { x: F(arrays[0][lane]), y: F(arrays[1][lane]), z: F(arrays[2][lane]) }
}
