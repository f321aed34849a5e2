//! Hashes of small images of every shipped scene with every sampler and estimator. Refactoring must not change them.
//!
//! A change that is meant to change images says so in its commit and updates the hashes.
use std::{collections::BTreeMap, fmt::Write, fs, path::Path};

use noisefall_base::math::SimdLevel;
use noisefall_render::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, Estimator, RenderSettings, Reuse, Scene, load},
};

const SIZE: u32 = 24;
const SPP: u32 = 3;
/// Set this variable to update the hashes.
const UPDATE: &str = "NOISEFALL_UPDATE_HASHES";

/// FNV-1a over the bits of an image.
fn hash(scene: &Scene, threads: &Threads, sampler: Sampler, estimator: Estimator) -> u64 {
    let [width, height] = scene.camera.resolution;
    let resolution = [SIZE, (SIZE * height).div_ceil(width)];
    let rays = scene.rays(&Camera { resolution, ..scene.camera });
    // Path reuse is on wherever the scene allows it, because the trial depends on the size of the image.
    let settings = RenderSettings { sampler, estimator, reuse: Reuse::Suffixes, ..scene.settings };
    let mut film = Film::new(resolution);
    threads.pass(PassJob { scene, rays: &rays, settings: &settings }, &mut film, SPP, &|| false);
    let frame = Frame::of_film(&film, 0, resolution, resolution);
    let bytes = frame.radiance.iter().flatten().flat_map(|x| x.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[test]
fn the_pictures_of_all_scenes_have_the_bits_that_they_had() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("tests/proof/pictures.txt");
    let files = fs::read_dir(root.join("scenes")).expect("the folder can be read").map(|entry| entry.expect("an entry").path());
    let mut scenes: Vec<_> = files.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect();
    scenes.sort();
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    let mut now = BTreeMap::new();
    for file in &scenes {
        let scene = load(file).expect("a shipped scene compiles");
        let name = file.file_stem().expect("it has a name").to_string_lossy().into_owned();
        for sampler in Sampler::ALL {
            for estimator in Estimator::ALL {
                let what = format!("{name} {} {}", sampler.name(), estimator.name());
                now.insert(what, format!("{:016x}", hash(&scene, &threads, sampler, estimator)));
            }
        }
    }
    if std::env::var_os(UPDATE).is_some() {
        let text = now.iter().fold(String::new(), |mut text, (what, hash)| {
            writeln!(text, "{what} {hash}").expect("text grows");
            text
        });
        fs::write(&path, text).expect("the hashes are written");
    }
    let known = fs::read_to_string(&path).expect("the hashes are there");
    let known: BTreeMap<_, _> =
        known.lines().filter_map(|line| line.rsplit_once(' ')).map(|(what, hash)| (what.to_owned(), hash.to_owned())).collect();
    let changed: Vec<_> = now.iter().filter(|(what, hash)| known.get(*what) != Some(*hash)).map(|(what, _)| what).collect();
    assert!(changed.is_empty() && known.len() == now.len(), "other bits, or new: {changed:?}; if that is meant, set {UPDATE}=1");
}
