//! Features of the first hits, without noise: normals, colours, distances, objects, and the cost of finding them.
//!
//! Where light passes through surfaces, a first hit is a surface that is more than half opaque there, and the heavier part of a blend.
//!
//! It runs the first stages of the renderer, `spawn → intersect → surface`, on blocks of pixels with rays through pixel centres.
use std::time::{Duration, Instant};

use fearless_simd_macros::simd;
use rayon::prelude::*;

use super::{
    batch::Batch,
    interaction::SurfaceInteraction,
    intersect::intersect,
    queue::Register,
    records::Path,
    slots::BLOCK,
    spawn::spawn,
    transparent_ray::Decisions,
    variation::{IncidentPaths, vary},
    work::Work,
};
use noisefall_base::{
    math::{F, Lanes, M, Pick, SimdLevel, U, V, in_lanes},
    memory::{self, Reservation, TooMuch},
};
use noisefall_scene::{
    geometry::{MISS, Nearest, PrimitiveRef},
    sampling::Filter,
    scene::{Camera, Legend, RenderSettings, Scene, Shutter},
};

/// A tent without width: all samples of a pixel lie at its centre.
const MIDDLE: Filter = Filter::tent(0.0);

/// Number of times that the rays of a block are traced. The shortest time counts, because other load on the machine only adds
/// time.
const REPETITIONS: u32 = 4;

/// Features at the pixel centres, row by row from the top left.
pub struct Features {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Unit shading normals in world space, on the viewer's side; zero if the ray leaves the scene.
    pub normal: Vec<[f32; 3]>,
    /// Scale of the BSDF including textures: white for types without a colour, zero if nothing is reflected or hit.
    pub albedo: Vec<[f32; 3]>,
    /// Metres along the ray; infinite if it leaves the scene.
    pub depth: Vec<f32>,
    /// Positions in world space, metres; zero if the ray leaves the scene.
    pub position: Vec<[f32; 3]>,
    /// Indices into [`Scene::objects`], or [`MISS`].
    pub object: Vec<u32>,
    /// Indices into [`Legend::names`], or [`MISS`].
    pub material: Vec<u32>,
    /// Nanoseconds that a thread takes to find the first hit of a ray, averaged over blocks of 8 × 8 pixels. This is a
    /// measurement, and not reproducible.
    pub cost: Vec<f32>,
}

/// Computes the features for the camera with a pinhole and an instantaneous shutter; `None` if it was interrupted. Runs on the
/// threads of the calling pool. All levels give the same result except for the cost.
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
    /// Reserves memory for the features of an image of this size.
    pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Bytes per pixel: of the result, and of its block before that.
        const PIXEL: u64 = 52 + 52;
        memory::reserve(format_args!("features of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// Features of a camera that sees nothing.
    fn empty([width, height]: [u32; 2]) -> Features {
        let pixels = width as usize * height as usize;
        Features {
            width,
            height,
            normal: vec![[0.0; 3]; pixels],
            albedo: vec![[0.0; 3]; pixels],
            depth: vec![f32::INFINITY; pixels],
            position: vec![[0.0; 3]; pixels],
            object: vec![MISS; pixels],
            material: vec![MISS; pixels],
            cost: vec![0.0; pixels],
        }
    }

    /// Copies the block with its upper left corner at a pixel to its position.
    fn put(&mut self, [x, y]: [u32; 2], block: &Block, legend: &Legend) {
        let wide = BLOCK.min(self.width - x) as usize;
        for (slot, seen) in block.seen.iter().enumerate() {
            let pixel = (y as usize + slot / wide) * self.width as usize + x as usize + slot % wide;
            self.cost[pixel] = block.cost;
            let Some(seen) = seen else { continue };
            self.normal[pixel] = seen.normal;
            self.albedo[pixel] = seen.albedo;
            self.depth[pixel] = seen.depth;
            self.position[pixel] = seen.position;
            self.object[pixel] = seen.object;
            self.material[pixel] = legend.of_object[seen.object as usize];
        }
    }
}

/// Hits of a block of pixels, row by row, and the cost per ray.
struct Block {
    seen: Vec<Option<PixelFeatures>>,
    cost: f32,
}

/// One pixel of [`Features`] with a hit.
#[derive(Clone, Copy)]
struct PixelFeatures {
    normal: [f32; 3],
    albedo: [f32; 3],
    depth: f32,
    position: [f32; 3],
    object: u32,
}

#[simd]
fn look<L: Lanes>(l: L, work: &Work, batch: &mut Batch) -> Block {
    spawn(l, work, batch);
    let mut shortest = Duration::MAX;
    for _ in 0..REPETITIONS {
        let start = Instant::now();
        intersect(l, work, batch, Decisions::Middle);
        shortest = shortest.min(start.elapsed());
    }
    // A coarse clock may say that it took no time.
    let nanoseconds = shortest.as_nanos().max(1) as f32;
    let mut seen = Vec::with_capacity(batch.current().len());
    describe(l, work, batch, &mut seen);
    Block { cost: nanoseconds / seen.len() as f32, seen }
}

/// Describes the hits of the paths of a batch, in order.
#[simd]
fn describe<L: Lanes>(l: L, work: &Work, batch: &Batch, seen: &mut Vec<Option<PixelFeatures>>) {
    let (scene, paths) = (work.scene, batch.current());
    for Register { start, live } in paths.registers(l) {
        let path = Path::read(l, &paths.paths, start);
        let Nearest { t, primitive, element } = batch.first_hits.get(l, start, scene.shapes.have_elements());
        let hit = live & !primitive.is(MISS);
        let count = L::N.min(paths.len() - start);
        if !hit.any() {
            seen.resize(seen.len() + count, None);
            continue;
        }
        // Lanes without a surface look at primitive 0.
        let primitive = hit.pick(primitive, l.u(0));
        let mut place = PrimitiveRef { time: work.rays.moment(l), ..PrimitiveRef::of(l, primitive) };
        if scene.shapes.have_elements() {
            place.element = hit.pick(element, l.u(0));
        }
        let reached = hit.pick(t, l.f(0.0));
        let row = if work.has_blends() { hit.pick(batch.first_hits.rows(l, start), l.u(0)) } else { primitive };
        let (normal, albedo) = shading(l, scene, hit, &path, (place, row), reached);
        let position = path.o + path.d * reached;
        let (t, primitive, hits) = (t.to_array(), primitive.to_array(), hit.bits());
        let [normal, albedo, position] = [normal, albedo, position].map(|v| [v.x, v.y, v.z].map(F::to_array));
        for lane in 0..count {
            seen.push((hits >> lane & 1 == 1).then(|| PixelFeatures {
                normal: normal.map(|axis| axis[lane]),
                albedo: albedo.map(|channel| channel[lane]),
                depth: t[lane],
                position: position.map(|axis| axis[lane]),
                object: scene.owners[primitive[lane] as usize],
            }));
        }
    }
}

/// Shading normal on the viewer's side and colour of the surfaces that the paths in `hit` reach after `t` metres.
#[inline(always)]
fn shading<L: Lanes>(
    l: L,
    scene: &Scene,
    hit: M<L>,
    path: &Path<L>,
    (place, row): (PrimitiveRef<L>, U<L>),
    t: F<L>,
) -> (V<L>, V<L>) {
    let point = scene.shapes.surface_point(l, &place, path.o + path.d * t);
    let cos = -point.n_geometric.dot(path.d);
    let [x, y, z, word] = l.rows(&scene.surfaces.rows, row);
    let n = point.n_geometric * l.f(1.0).copysign(cos);
    let incident = IncidentPaths {
        d: path.d,
        interaction: SurfaceInteraction { place, row, point, cos },
        media: l.u(0),
        word: word.bits(),
        keeps_hidden_normals: false,
    };
    let (_, reflects) = incident.sides();
    let (colour, detail, _) = vary(l, scene, &incident, hit & reflects, V { x, y, z }, n);
    (detail.n, reflects.pick(colour, V::splat(l, [0.0; 3])))
}
