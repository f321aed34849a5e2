//! A traversal visits every box that a ray hits.
use fearless_simd::Simd;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{Bvh, Leaves, NONE, Search, Searches, Slabs, Stacks, traverse};
use crate::geometry::bounds::Bounds;
use noisefall_base::{
    math::{Lanes, MAX_LANES, SimdLevel, V, in_lanes},
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
    /// By lane.
    shown: Vec<Vec<bool>>,
}

impl<S: Simd> Leaves<S> for Marks<'_> {
    #[inline(always)]
    fn meet(&mut self, _: S, lane: usize, leaf: u32, t_max: f32) -> f32 {
        for &item in self.order[4 * leaf as usize..][..4].iter().filter(|&&item| item != NONE) {
            self.shown[lane][item as usize] = true;
        }
        t_max
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
        for level in SimdLevel::available() {
            in_lanes!(level, l => shows_all(l, &bvh, &order, &boxes, &mut rng));
        }
    }
}

/// Rays in some of the lanes, in groups whose number of rays varies.
fn shows_all<L: Lanes>(l: L, bvh: &Bvh, order: &[u32], boxes: &[Bounds], rng: &mut SmallRng) {
    for k in 0..2000 / L::N {
        let mut corner = || [0; 3].map(|_| rng.random_range(-1.5f32..1.5));
        let mut rays = [([0.0; 3], [0.0; 3]); MAX_LANES].map(|_| (corner(), corner()));
        for (lane, (_, d)) in rays.iter_mut().enumerate() {
            d[(k + lane) % 3] *= [1.0, 0.0, -0.0, 1e-12][(k + lane) % 4];
        }
        let column = |axis: usize| l.load(&rays.map(|(o, d)| [o, d].concat()[axis]));
        let (o, d) = (V { x: column(0), y: column(1), z: column(2) }, V { x: column(3), y: column(4), z: column(5) });
        let is_live: [f32; MAX_LANES] = std::array::from_fn(|_| f32::from(rng.random::<u32>() % 4 > 0));
        let live = l.load(&is_live).above(0.0);
        let mut searches = Searches::new(live, Search::nearest(l, l.f(f32::INFINITY)));
        let mut marks = Marks { order, shown: vec![vec![false; boxes.len()]; MAX_LANES] };
        let slabs = Slabs::new(l, o, d, &bvh.bounds());
        traverse(l.token(), bvh, &mut Stacks::<false>::default(), (&slabs, &mut searches), &mut marks);
        for (lane, ((o, d), shown)) in rays.into_iter().zip(marks.shown).enumerate().take(L::N) {
            if is_live[lane] == 0.0 {
                assert!(!shown.contains(&true), "this lane has no ray");
                continue;
            }
            let lost = boxes.iter().zip(shown).position(|(bounds, shown)| !shown && meets(bounds, o, d));
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
        // Seven for three items each.
        let work = count as u64 * 7 / 3;
        progress.expect(Stage::Trees, work + 1);
        let built = Bvh::build_watched::<4>(count, point, None, (&progress, work));
        assert_eq!(built.map(|(_, order)| order), Ok(Bvh::build::<4>((0..count).map(point)).1), "{count}");
        assert_eq!(progress.fraction(), work as f64 / (work + 1) as f64);
        progress.cancel();
        assert_eq!(Bvh::build_watched::<4>(count, point, None, (&progress, work)).err(), Some(Cancelled), "{count}");
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
    let (bvh, order) =
        Bvh::build_watched::<4>(1000, item, Some(&contents), (&Progress::default(), 1000)).expect("nobody cancels");
    let mut kept: Vec<u32> = order.into_iter().filter(|&item| item != NONE).collect();
    kept.sort_unstable();
    assert_eq!(kept, [(0..9).collect(), vec![999]].concat());
    assert_eq!((bvh.bounds().min, bvh.bounds().max), ([-9.0; 3], [51.0; 3]));
}
