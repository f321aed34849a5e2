//! What a camera sees first, without noise: normals, colours, distances, objects, and how long it takes to find them.
//!
//! The first stages of the renderer, `spawn → intersect → surface`, on blocks of pixels whose rays go through their middles.
use std::time::{Duration, Instant};

use fearless_simd_macros::simd;
use rayon::prelude::*;

use super::{
    batch::{Batch, Hit, Path},
    intersect::intersect,
    spawn::spawn,
    surface::{Arrival, Met, vary},
    work::{BLOCK, Work},
};
use crate::{
    geometry::{MISS, Place},
    in_lanes,
    math::{F, Lanes, M, Pick, SimdLevel, V},
    memory::{self, Reservation, TooMuch},
    sampling::Filter,
    scene::{Camera, Legend, RenderSettings, Scene, Shutter},
};

/// A tent without width: all of a pixel's samples lie in its middle.
const MIDDLE: Filter = Filter::Tent { radius: 0.0 };

/// The rays of a block are traced so often, and the shortest time counts: what else the machine does only adds to the others.
const REPETITIONS: u32 = 4;

/// What is seen through the middles of the pixels, row by row from the top left.
pub struct Features {
    pub width: u32,
    pub height: u32,
    /// Unit normals that surfaces are shaded with, in the world, on the viewer's side; zero where the ray leaves the scene.
    pub normal: Vec<[f32; 3]>,
    /// What the bsdf is scaled by, textures included: white for kinds without a colour, zero where nothing is reflected or met.
    pub albedo: Vec<[f32; 3]>,
    /// Metres along the ray; infinite where it leaves the scene.
    pub depth: Vec<f32>,
    /// Places in [`Scene::objects`], or [`MISS`].
    pub object: Vec<u32>,
    /// Places in [`Legend::names`], or [`MISS`].
    pub material: Vec<u32>,
    /// Nanoseconds that it takes a thread to find what a ray meets first, on average over blocks of 8 × 8 pixels. This is measured and
    /// never twice the same.
    pub cost: Vec<f32>,
}

/// What a camera would see if it had a pinhole and its shutter closed at once; `None` if it was interrupted. Runs on the threads of
/// the pool that it is called in. All levels give the same but for the cost.
pub fn features(level: SimdLevel, scene: &Scene, camera: &Camera, interrupted: &(dyn Fn() -> bool + Sync)) -> Option<Features> {
    let rays = scene.rays(&Camera { lens: None, shutter: camera.shutter.map(Shutter::at_opening), filter: MIDDLE, ..*camera });
    let settings = RenderSettings::default();
    let [width, height] = camera.resolution;
    let corners = |side: u32| (0..side).step_by(BLOCK as usize);
    let corners: Vec<[u32; 2]> = corners(height).flat_map(|y| corners(width).map(move |x| [x, y])).collect();
    let block = |batch: &mut Batch, &[x, y]: &[u32; 2]| {
        let size = [BLOCK.min(width - x), BLOCK.min(height - y)];
        let work = Work::tile(scene, &rays, &settings, [x, y], size, 0);
        (!interrupted()).then(|| in_lanes!(level, l => look(l, &work, batch)))
    };
    let blocks: Option<Vec<Block>> = corners.par_iter().map_init(Batch::default, block).collect();
    let mut features = Features::empty(camera.resolution);
    let legend = scene.legend();
    corners.iter().zip(blocks?).for_each(|(corner, block)| features.put(*corner, &block, &legend));
    Some(features)
}

impl Features {
    /// Room for those of a picture of this size.
    pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Of a pixel: what is kept, and before that what its block has seen.
        const PIXEL: u64 = 40 + 40;
        memory::reserve(format_args!("features of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// Of a camera that looks past everything.
    fn empty([width, height]: [u32; 2]) -> Features {
        let pixels = width as usize * height as usize;
        Features {
            width,
            height,
            normal: vec![[0.0; 3]; pixels],
            albedo: vec![[0.0; 3]; pixels],
            depth: vec![f32::INFINITY; pixels],
            object: vec![MISS; pixels],
            material: vec![MISS; pixels],
            cost: vec![0.0; pixels],
        }
    }

    /// Puts the block with its upper left corner at a pixel in its place.
    fn put(&mut self, [x, y]: [u32; 2], block: &Block, legend: &Legend) {
        let wide = BLOCK.min(self.width - x) as usize;
        for (slot, seen) in block.seen.iter().enumerate() {
            let pixel = (y as usize + slot / wide) * self.width as usize + x as usize + slot % wide;
            self.cost[pixel] = block.cost;
            let Some(seen) = seen else { continue };
            self.normal[pixel] = seen.normal;
            self.albedo[pixel] = seen.albedo;
            self.depth[pixel] = seen.depth;
            self.object[pixel] = seen.object;
            self.material[pixel] = legend.of_object[seen.object as usize];
        }
    }
}

/// What the rays of a block of pixels meet, row by row, and what finding it costs each.
struct Block {
    seen: Vec<Option<Seen>>,
    cost: f32,
}

/// One pixel of [`Features`] where a surface is met.
#[derive(Clone, Copy)]
struct Seen {
    normal: [f32; 3],
    albedo: [f32; 3],
    depth: f32,
    object: u32,
}

#[simd]
fn look<L: Lanes>(l: L, work: &Work, batch: &mut Batch) -> Block {
    spawn(l, work, batch);
    let mut shortest = Duration::MAX;
    for _ in 0..REPETITIONS {
        let start = Instant::now();
        intersect(l, work, batch);
        shortest = shortest.min(start.elapsed());
    }
    // A coarse clock may say that it took no time.
    let nanoseconds = shortest.as_nanos().max(1) as f32;
    let mut seen = Vec::with_capacity(batch.current().len());
    describe(l, work, batch, &mut seen);
    Block { cost: nanoseconds / seen.len() as f32, seen }
}

/// What the paths of a batch have met, in their order.
#[simd]
fn describe<L: Lanes>(l: L, work: &Work, batch: &Batch, seen: &mut Vec<Option<Seen>>) {
    let (scene, paths) = (work.scene, batch.current());
    for start in (0..paths.len()).step_by(L::N) {
        let path = Path::read(l, paths, start);
        let primitive = l.load(&batch.primitive[start..]).bits();
        let t = l.load(&batch.t[start..]);
        let hit = l.first(paths.len() - start) & !primitive.is(MISS);
        let count = L::N.min(paths.len() - start);
        if !hit.any() {
            seen.resize(seen.len() + count, None);
            continue;
        }
        // Lanes without a surface look at primitive 0.
        let primitive = hit.pick(primitive, l.u(0));
        let mut place = Place { time: work.rays.moment(l), ..Place::of(l, primitive) };
        if scene.shapes.have_elements() {
            place.element = hit.pick(l.load(&batch.element[start..]).bits(), l.u(0));
        }
        let (normal, albedo) = shading(l, scene, hit, &path, place, hit.pick(t, l.f(0.0)));
        let (t, primitive, hits) = (t.to_array(), primitive.to_array(), hit.bits());
        let (normal, albedo) = ([normal.x, normal.y, normal.z].map(F::to_array), [albedo.x, albedo.y, albedo.z].map(F::to_array));
        for lane in 0..count {
            seen.push((hits >> lane & 1 == 1).then(|| Seen {
                normal: normal.map(|axis| axis[lane]),
                albedo: albedo.map(|channel| channel[lane]),
                depth: t[lane],
                object: scene.owners[primitive[lane] as usize],
            }));
        }
    }
}

/// Normal on the viewer's side and colour of the surfaces that the paths of `hit` meet after `t` metres.
#[inline(always)]
fn shading<L: Lanes>(l: L, scene: &Scene, hit: M<L>, path: &Path<L>, place: Place<L>, t: F<L>) -> (V<L>, V<L>) {
    let point = scene.shapes.surface_point(l, &place, path.o + path.d * t);
    let cos = -point.n_geometric.dot(path.d);
    let [x, y, z, word] = l.rows(&scene.surfaces.rows, place.primitive);
    let n = point.n_geometric * l.f(1.0).copysign(cos);
    let mut record = Hit { p: point.p, n, colour: V { x, y, z }, throughput: path.throughput, slot: path.slot };
    let arrival = Arrival { d: path.d, met: Met { place, point, cos }, media: l.u(0), word: word.bits(), plain: record };
    let (_, reflects) = arrival.sides();
    let detail = vary(l, scene, &arrival, hit & reflects, &mut record);
    (detail.n, reflects.pick(record.colour, V::splat(l, [0.0; 3])))
}
