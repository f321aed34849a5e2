//! A traversal visits every box that a ray hits.
use fearless_simd::{Fallback, Simd};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{Bvh, Leaves, NONE, Slabs, Stack, traverse};
use crate::{
    geometry::bounds::Bounds,
    math::{One, V},
    progress::{Cancelled, Progress, Stage},
};

fn boxes(count: usize, rng: &mut SmallRng) -> Vec<Bounds> {
    let mut corner = |size: f32| [0; 3].map(|_| rng.random_range(-size..size));
    let mut boxes = Vec::new();
    for k in 0..count {
        let min = corner(1.0);
        let size = corner(if k % 4 == 0 { 0.5 } else { 0.02 }).map(f32::abs);
        // Some are flat, some are points.
        let max = std::array::from_fn(|axis| if k % 5 <= axis { min[axis] + size[axis] } else { min[axis] });
        boxes.push(Bounds { min, max });
    }
    boxes
}

/// Marks the items of the visited leaves.
struct Marks<'a> {
    order: &'a [u32],
    shown: Vec<bool>,
}

impl<S: Simd> Leaves<S> for Marks<'_> {
    #[inline(always)]
    fn meet(&mut self, _: S, leaf: u32, t_max: f32) -> f32 {
        for &item in self.order[4 * leaf as usize..][..4].iter().filter(|&&item| item != NONE) {
            self.shown[item as usize] = true;
        }
        t_max
    }

    #[inline(always)]
    fn touch(&self, leaf: u32) -> u32 {
        self.order[4 * leaf as usize]
    }
}

/// Whether the ray hits the box, in f64.
fn meets(bounds: &Bounds, o: [f32; 3], d: [f32; 3]) -> bool {
    let (mut near, mut far) = (0.0f64, f64::INFINITY);
    for axis in 0..3 {
        let distance = |plane: f32| (f64::from(plane) - f64::from(o[axis])) / f64::from(d[axis]);
        if d[axis] == 0.0 {
            far = if (bounds.min[axis]..=bounds.max[axis]).contains(&o[axis]) { far } else { -1.0 };
        } else {
            let (a, b) = (distance(bounds.min[axis]), distance(bounds.max[axis]));
            (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
        }
    }
    near <= far
}

/// Distances that double, so that each split takes one point off: down to the level from which halves alone fit below.
#[test]
fn a_tree_that_grows_too_deep_is_finished_by_halves() {
    let point = |k: i32| Bounds { min: [-(0.5f32.powi(k)), 0.0, 0.0], max: [-(0.5f32.powi(k)), 0.0, 0.0] };
    let (_, order) = Bvh::build::<4>((0..46).map(point));
    let mut sizes: Vec<usize> = order.chunks(4).map(|leaf| leaf.iter().filter(|&&item| item != NONE).count()).collect();
    sizes.sort_unstable();
    // With two levels left a side holds 8, and 12 points are left: they are halved, and halved again.
    assert_eq!(sizes, [vec![1; 34], vec![3; 4]].concat());
}

#[test]
fn every_box_that_is_met_is_shown() {
    let mut rng = SmallRng::seed_from_u64(1);
    for count in [0, 1, 3, 4, 5, 40, 2000] {
        let boxes = boxes(count, &mut rng);
        let (bvh, order) = Bvh::build::<4>(boxes.iter().copied());
        let mut numbers: Vec<u32> = order.iter().copied().filter(|&item| item != NONE).collect();
        numbers.sort_unstable();
        assert!(numbers.iter().copied().eq(0..count as u32), "each in one leaf");
        assert!(boxes.iter().all(|bounds| bvh.bounds().contains(bounds)));
        let mut stack = Stack::<false>::default();
        for k in 0..2000 {
            let mut corner = || [0; 3].map(|_| rng.random_range(-1.5f32..1.5));
            let (o, mut d) = (corner(), corner());
            d[k % 3] *= [1.0, 0.0, -0.0, 1e-12][k % 4];
            let slabs = Slabs::new(One, V::splat(One, o), V::splat(One, d), &bvh.bounds());
            let mut marks = Marks { order: &order, shown: vec![false; count] };
            traverse(Fallback::new(), &bvh, &mut stack, (&slabs, 0), (f32::INFINITY, 0.0), &mut marks);
            let lost = boxes.iter().zip(marks.shown).position(|(bounds, shown)| !shown && meets(bounds, o, d));
            assert_eq!(lost, None, "{o:?} {d:?}");
        }
    }
}

#[test]
fn progress_counts_the_boxes_and_a_cancelled_build_has_no_tree() {
    let point = |i: usize| Bounds::of_points([[i as f32, (i * i % 97) as f32, 0.0]]);
    // Few are counted at the end, and many on the way.
    for count in [0, 5, 40_000] {
        let progress = Progress::default();
        progress.expect(Stage::Trees, count as u64 + 1);
        let built = Bvh::build_watched::<4>(count, point, None, &progress);
        assert_eq!(built.map(|(_, order)| order), Ok(Bvh::build::<4>((0..count).map(point)).1), "{count}");
        assert_eq!(progress.fraction(), count as f64 / (count + 1) as f64);
        progress.cancel();
        assert_eq!(Bvh::build_watched::<4>(count, point, None, &progress).err(), Some(Cancelled), "{count}");
    }
}

#[test]
fn copies_in_one_place_count_once_and_others_there_stay() {
    // Nine contents about one centre, many times each, and one apart.
    let size = |i: usize| 1.0 + (i % 9) as f32;
    let item = |i: usize| match i {
        999 => Bounds { min: [50.0; 3], max: [51.0; 3] },
        i => Bounds { min: [-size(i); 3], max: [size(i); 3] },
    };
    let contents = |a: u32, b: u32| (a % 9).cmp(&(b % 9));
    let (bvh, order) = Bvh::build_watched::<4>(1000, item, Some(&contents), &Progress::default()).expect("nobody cancels");
    let mut kept: Vec<u32> = order.into_iter().filter(|&item| item != NONE).collect();
    kept.sort_unstable();
    assert_eq!(kept, [(0..9).collect(), vec![999]].concat());
    assert_eq!((bvh.bounds().min, bvh.bounds().max), ([-9.0; 3], [51.0; 3]));
}
