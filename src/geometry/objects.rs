//! Many objects: a tree over them, down which rays go one at a time.
//!
//! Shapes in a list are tested against all lanes at once, which for one of a few costs less than a step in a tree; of many, a
//! tree finds the few that a ray comes near. Which shapes are for which is decided here.
use fearless_simd::Simd;
use fearless_simd_macros::simd;
use glam::DVec3;

use super::{
    Nearest, Shape,
    bounds::Bounds,
    bvh::{Bvh, Leaves, Slabs, Stack, traverse},
    lists::{Listed, Lists},
    placed::Placed,
};
use crate::math::{F, Lanes, M, MAX_LANES, One, Pick, U, V};

/// What a step down a tree costs, in tests of lanes against a sphere: where the sum of [`Kind::cost`] is less, a tree is slower
/// (measured with 16 lanes on fields of 4 to 128 spheres, cuboids, cylinders and meshes).
const COST_OF_TREE: f32 = 64.0;
/// What would be met by more than one in so many rays is not for the tree.
const SHARE: f32 = 12.0;

/// Something to find, and where it is.
pub(super) struct Object<'a> {
    pub bounds: Bounds,
    pub kind: Kind<'a>,
}

#[derive(Clone, Copy)]
pub(super) enum Kind<'a> {
    /// An analytic shape, whose first piece is primitive `first`.
    Analytic { first: u32, shape: &'a Shape },
    /// By its place among the placed shapes.
    Placed(u32),
}

impl Kind<'_> {
    /// Of a test of all lanes, in those of a sphere.
    fn cost(self) -> f32 {
        match self {
            Kind::Analytic { shape: Shape::Cylinder { capped: true, .. }, .. } => 4.0,
            Kind::Analytic { shape: Shape::Cuboid { .. } | Shape::Cylinder { .. } | Shape::Ellipsoid { .. }, .. } => 2.0,
            // Of a placed shape, the test of whether any lane comes near.
            Kind::Analytic { .. } | Kind::Placed(_) => 1.0,
        }
    }
}

/// A tree over objects.
pub(super) struct Objects {
    bvh: Bvh,
    /// By leaf.
    items: Vec<Item>,
    lists: Lists,
}

#[derive(Clone, Copy)]
enum Item {
    Listed(Listed),
    Placed(u32),
}

/// Sorts objects so that those for a tree come last, and returns how many come before.
pub(super) fn few_and_large(objects: &mut [Object]) -> usize {
    let area = |object: &Object| object.bounds.surface_area();
    objects.sort_by(|a, b| area(b).total_cmp(&area(a)));
    let mut rest = Bounds::EMPTY;
    let mut first = objects.len();
    for (place, object) in objects.iter().enumerate().rev() {
        rest = rest.union(&object.bounds);
        if area(object) * SHARE <= rest.surface_area() {
            first = place;
        }
    }
    let cost: f32 = objects[first..].iter().map(|object| object.kind.cost()).sum();
    if cost < COST_OF_TREE { objects.len() } else { first }
}

impl Objects {
    /// `near` is where the scene happens.
    pub fn new(objects: &[Object], near: DVec3) -> Objects {
        let (bvh, order) = Bvh::build::<1>(objects.iter().map(|object| object.bounds));
        let mut lists = Lists::default();
        // In the order of the leaves, so that what is near in the tree is near in memory.
        let item = |&number: &u32| match objects[number as usize].kind {
            Kind::Analytic { first, shape } => Item::Listed(lists.push(first, shape, near)),
            Kind::Placed(index) => Item::Placed(index),
        };
        let items = order.iter().map(item).collect();
        Objects { bvh, items, lists }
    }

    /// Replaces `nearest` by what is nearer along o + td, d of unit length, in the lanes of `live`.
    #[simd]
    pub fn closest<L: Lanes>(
        &self,
        l: L,
        placed: &[Placed],
        live: M<L>,
        (o, d): (V<L>, V<L>),
        time: F<L>,
        nearest: &mut Nearest<L>,
    ) {
        let slabs = Slabs::new(l, o, d, &self.bvh.bounds());
        let (origins, directions) = (arrays(o), arrays(d));
        let times = time.to_array();
        let mut distances = nearest.t.to_array();
        let mut primitives = nearest.primitive.to_array();
        let mut elements = nearest.element.to_array();
        let (mut stack, mut below) = (Stack::default(), Stack::default());
        let mut rest = live.bits();
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize % MAX_LANES;
            rest &= rest - 1;
            let mut found = Found {
                objects: self,
                placed,
                below: &mut below,
                o: vector(&origins, lane),
                d: vector(&directions, lane),
                time: F(times[lane]),
                primitive: primitives[lane],
                element: elements[lane],
            };
            distances[lane] = traverse(l.token(), &self.bvh, &mut stack, (&slabs, lane), distances[lane], &mut found);
            (primitives[lane], elements[lane]) = (found.primitive, found.element);
        }
        let load = |words: &[u32; MAX_LANES]| l.load(&words.map(f32::from_bits)).bits();
        *nearest = Nearest { t: l.load(&distances), primitive: load(&primitives), element: load(&elements) };
    }
}

/// What one ray has met so far.
struct Found<'a> {
    objects: &'a Objects,
    placed: &'a [Placed],
    below: &'a mut Stack,
    o: V<One>,
    d: V<One>,
    time: F<One>,
    primitive: u32,
    element: u32,
}

impl<S: Simd> Leaves<S> for Found<'_> {
    #[inline(always)]
    fn meet(&mut self, s: S, leaf: u32, t_max: f32) -> f32 {
        let (t, primitive, element) = match self.objects.items[leaf as usize] {
            Item::Listed(which) => {
                let (t, primitive) = self.objects.lists.meet(One, which, self.o, self.d);
                (t, primitive, U(0))
            }
            Item::Placed(index) => {
                let placed = &self.placed[index as usize];
                let found = placed.meet(One, s, self.below, (self.o, self.d), self.time, F(t_max));
                (found.t, found.piece + placed.first, found.element)
            }
        };
        let nearer = t.above(0.0) & t.below(t_max);
        self.primitive = nearer.pick(primitive, U(self.primitive)).0;
        self.element = nearer.pick(element, U(self.element)).0;
        nearer.pick(t, F(t_max)).0
    }

    #[inline(always)]
    fn touch(&self, leaf: u32) -> u32 {
        match self.objects.items[leaf as usize] {
            Item::Listed(_) => 0,
            Item::Placed(index) => index,
        }
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
