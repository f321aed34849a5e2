//! However the samples of an image are split, over ranges, threads and instruction sets, the joined image has the same bytes.
use std::path::{Path, PathBuf};

use noisefall::{Camera, Display, PassJob, RenderRequest, RenderSettings, Scene, SimdLevel, Threads};
use noisefall_render::{
    render::{
        checkpoint::{checkpoint_header, keep_scene},
        image_file::{Contents, Format},
        path_reuse::resolved,
        split::{Join, SampleFile, SampleFilm, SampleRanges, SplitPicture, write},
    },
    render_file::{Header, ImageFacts, Kind, Target},
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{PathReuse, Reuse},
};
use rand::{Rng, SeedableRng, rngs::SmallRng, seq::SliceRandom};
use std::sync::Arc;

use super::command_line::scene;

/// Number of random partitions; more are tried with this environment variable.
const TRIALS: &str = "NOISEFALL_PARTITIONS";
const FEW: u32 = 40;

/// An image that is split.
struct Image {
    scene: Arc<Scene>,
    camera: Camera,
    settings: RenderSettings,
}

impl Image {
    fn random(random: &mut SmallRng) -> Image {
        let names = ["cornell_box", "furnace", "bright_sky", "veach_plates", "motion_blur", "glass_and_mirror"];
        let scene = noisefall::load(Path::new(&scene(names[random.random_range(0..names.len())]))).expect("it is shipped");
        let resolution = [random.random_range(1..=70), random.random_range(1..=40)];
        let samplers = [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::BlueNoise];
        let settings = RenderSettings {
            sampler: samplers[random.random_range(0..samplers.len())],
            adaptive: random.random_bool(0.4),
            reuse: [Reuse::Auto, Reuse::Suffixes, Reuse::Outliers, Reuse::Both, Reuse::Off][random.random_range(0..5)],
            seed: random.random_range(0..1000),
            ..scene.settings
        };
        Image { camera: Camera { resolution, ..scene.camera }, scene: Arc::new(scene), settings }
    }

    fn film(&self, random: &mut SmallRng, [start, end]: [u32; 2]) -> SampleFilm {
        let levels = SimdLevel::available();
        let level = levels[random.random_range(0..levels.len())];
        let threads = Threads::new(random.random_range(1..=3), level).expect("threads");
        let rays = self.scene.rays(&self.camera);
        let settings = threads.install(|| resolved(&self.scene, &rays, &self.settings));
        let job = PassJob { scene: &self.scene, rays: &rays, settings: &settings };
        let mut film = SampleFilm::begin(&threads, job, start..end, &|| false).expect("it begins");
        // In steps, as the program goes.
        let mut at = start;
        while at < end {
            at = random.random_range(at + 1..=end);
            film.advance(&threads, job, at, &|| false);
        }
        assert_eq!((film.count().failure.as_ref(), film.samples().list()), (None, &[[start, end]][..]));
        film
    }

    fn path_reuse(&self) -> PathReuse {
        let rays = self.scene.rays(&self.camera);
        self.scene.path_reuse(&rays, &resolved(&self.scene, &rays, &self.settings))
    }

    fn header(&self, samples: [u32; 2]) -> Header {
        let (scene, camera, settings) = (self.scene.clone(), self.camera, self.settings);
        let kept = keep_scene(&scene, Path::new("a.toml"), None);
        let threads = Threads::new(1, SimdLevel::best()).expect("a thread");
        let header = checkpoint_header(&RenderRequest { scene, camera, settings }, kept, None, Target::default(), &threads);
        let image = Some(ImageFacts { shares: self.path_reuse().correlates(), ..ImageFacts::default() });
        Header { kind: Kind::Samples, samples: vec![samples], image, ..header.expect("a header") }
    }

    /// The bytes of an EXR of these sums.
    fn bytes(&self, picture: SplitPicture) -> Vec<u8> {
        let frame = picture.frame();
        let contents = Contents { frame: &frame, channels: &[], settings: "" };
        contents.encode(Display::default(), Format::Exr).expect("it is encoded")
    }

    fn picture(&self, samples: SampleRanges) -> SplitPicture {
        SplitPicture::new(self.camera.resolution, samples, self.path_reuse()).expect("there is memory")
    }
}

/// Cuts the samples up to `end` into random ranges, in random order.
fn partition(random: &mut SmallRng, end: u32) -> Vec<[u32; 2]> {
    let mut ranges = Vec::new();
    let mut start = 0;
    while start < end {
        let next = random.random_range(start + 1..=end.min(start + 1 + end / 2));
        ranges.push([start, next]);
        start = next;
    }
    ranges.shuffle(random);
    ranges
}

fn joined(files: &[PathBuf]) -> Join {
    let open = |path: &PathBuf| SampleFile::open(path).expect("it is whole");
    let mut join = Join::begin(&open(&files[0])).expect("there is memory");
    for path in files {
        join.enter(&open(path)).expect("it belongs to the image");
        join.add(open(path)).expect("it is whole");
    }
    join
}

/// Joins files in random groups until one file is left.
fn join_all(random: &mut SmallRng, folder: &Path, mut files: Vec<PathBuf>) -> Join {
    let mut number = 0;
    while files.len() > 1 && random.random_bool(0.7) {
        files.shuffle(random);
        let group = files.split_off(files.len() - random.random_range(1..=files.len()));
        let join = joined(&group);
        let path = folder.join(format!("group-{number}.nf"));
        number += 1;
        write(&path, join.header(), join.sums()).expect("it is written");
        files.push(path);
    }
    joined(&files)
}

#[test]
fn any_partition_in_any_order_and_grouping_gives_the_bytes_of_one_run() {
    let trials = std::env::var(TRIALS).ok().and_then(|text| text.parse().ok()).unwrap_or(FEW);
    let mut random = SmallRng::seed_from_u64(22);
    for trial in 0..trials {
        let image = Image::random(&mut random);
        let end = random.random_range(4..=20);
        let whole = image.film(&mut random, [0, end]);
        let mut picture = image.picture(whole.samples());
        whole.into_sums().for_each(|sums| picture.add(&sums).expect("every pixel has samples"));
        let expected = image.bytes(picture);

        let folder = tempfile::tempdir().expect("a folder");
        let mut files = Vec::new();
        for range in partition(&mut random, end) {
            let path = folder.path().join(format!("{}.nf", range[0]));
            write(&path, &image.header(range), image.film(&mut random, range).sums()).expect("it is written");
            files.push(path);
        }
        let join = join_all(&mut random, folder.path(), files);
        assert_eq!(join.samples().list(), [[0, end]]);
        let mut picture = image.picture(join.samples().clone());
        join.into_sums().for_each(|sums| picture.add(&sums).expect("every pixel has samples"));
        assert!(image.bytes(picture) == expected, "trial {trial}: {:?} {:?}", image.camera.resolution, image.settings);
    }
}

#[test]
fn exact_sums_have_the_image_of_a_film() {
    let mut random = SmallRng::seed_from_u64(23);
    for _ in 0..6 {
        let image = Image::random(&mut random);
        let samples = random.random_range(4..40);
        let film = image.film(&mut random, [0, samples]);
        let mut picture = image.picture(film.samples());
        film.into_sums().for_each(|sums| picture.add(&sums).expect("every pixel has samples"));
        let exact = picture.frame();

        let threads = Threads::new(1, SimdLevel::best()).expect("a thread");
        let (rays, mut film) = (image.scene.rays(&image.camera), noisefall::Film::new(image.camera.resolution));
        let settings = resolved(&image.scene, &rays, &image.settings);
        threads.pass(PassJob { scene: &image.scene, rays: &rays, settings: &settings }, &mut film, samples, &|| false);
        let plain = noisefall::Frame::of_film(&film, 0, image.camera.resolution, image.camera.resolution);

        let is_near = |a: f64, b: f64| (a - b).abs() <= 1e-5 * a.abs().max(b.abs()) + 1e-12;
        let near = |a: &[[f32; 3]], b: &[[f32; 3]]| {
            a.as_flattened().iter().zip(b.as_flattened()).all(|(a, b)| is_near(f64::from(*a), f64::from(*b)))
        };
        assert!(near(&exact.radiance, &plain.radiance), "{:?}", image.settings);
        assert_eq!((&exact.counts, exact.spp, exact.path_reuse), (&plain.counts, plain.spp, plain.path_reuse));
        let (exact, plain) = (exact.noise.expect("its noise"), plain.noise.expect("its noise"));
        assert!(near(&exact.variance, &plain.variance), "{:?}", image.settings);
        assert!(exact.blocks.iter().zip(&plain.blocks).all(|(a, b)| is_near(*a, *b)), "{:?} {:?}", exact.blocks, plain.blocks);
        assert_eq!(exact.block_degrees, plain.block_degrees);
    }
}
