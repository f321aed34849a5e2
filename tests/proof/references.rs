//! Pictures of an independent renderer: means over blocks of 16 × 16 pixels, with their standard errors, in `tests/references`.
//!
//! `NOISEFALL_REFERENCE_SPP=4096 cargo test --release --test proof references` compares with more samples.
use std::{fs, path::Path};

use noisefall::{
    math::SimdLevel,
    render::{
        film::Film,
        pass::{PassJob, Threads},
    },
    sampling::Sampler,
    scene::{RenderSettings, load},
};

const SPP: u32 = 64;
const BLOCK: usize = 16;
const BLOCKS: usize = 16;
/// Some 800 block means a scene: beyond this one in 10⁵ is by chance.
const MOST_SIGMAS: f64 = 4.5;

/// Mean and variance of the mean of a block's red, green and blue.
type Block = [[f64; 2]; 3];

fn reference(name: &str) -> Vec<Block> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/references").join(format!("{name}.txt"));
    let text = fs::read_to_string(path).expect("a reference is kept for every scene");
    let block = |line: &str| {
        let n: Vec<f64> = line.split(' ').map(|number| number.parse().expect("a number")).collect();
        [0, 1, 2].map(|c| [n[c], n[c + 3] * n[c + 3]])
    };
    text.lines().filter(|line| !line.starts_with('#')).map(block).collect()
}

fn rendered(name: &str, spp: u32) -> Vec<Block> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/references").join(format!("{name}.toml"));
    let scene = load(&path).expect("the scene compiles");
    assert_eq!(scene.camera.resolution, [(BLOCK * BLOCKS) as u32; 2]);
    // Independent samples are those whose variance is known from themselves.
    let settings = RenderSettings { sampler: Sampler::Independent, seed: 21, ..scene.settings };
    let mut film = Film::new(scene.camera.resolution);
    let threads = Threads::new(2, SimdLevel::best()).expect("two threads can be had");
    let rays = scene.rays(&scene.camera);
    threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, spp, &|| false);
    assert_eq!(film.invalid_samples(), 0);
    let mut blocks = vec![[[0.0; 2]; 3]; BLOCKS * BLOCKS];
    for tile in &film.tiles {
        for row in 0..tile.size[1] as usize {
            for (column, estimate) in tile.estimates(row).enumerate() {
                let [x, y] = [tile.origin[0] as usize + column, tile.origin[1] as usize + row];
                let block: &mut Block = &mut blocks[y / BLOCK * BLOCKS + x / BLOCK];
                let variance = estimate.variance_of_mean.expect("more than one sample");
                for channel in 0..3 {
                    let pixels = (BLOCK * BLOCK) as f64;
                    block[channel][0] += estimate.mean[channel] / pixels;
                    block[channel][1] += variance[channel] / (pixels * pixels);
                }
            }
        }
    }
    blocks
}

fn agrees(name: &str) {
    let spp = std::env::var("NOISEFALL_REFERENCE_SPP").ok().and_then(|spp| spp.parse().ok()).unwrap_or(SPP);
    let (mut worst, mut squares, mut count) = (0f64, 0.0, 0.0);
    for (ours, theirs) in rendered(name, spp).iter().zip(reference(name)) {
        for ([mean, variance], [exact, error]) in ours.iter().zip(theirs) {
            // Rounding of the reference's six digits, and of ours.
            let rounding = 2e-6 * exact;
            let z = (mean - exact) / (variance + error + rounding * rounding).sqrt();
            worst = worst.max(z.abs());
            squares += z * z;
            count += 1.0;
        }
    }
    println!("{name}, {spp} spp: |z| at most {worst:.2}, rms {:.3}", (squares / count).sqrt());
    assert!(worst < MOST_SIGMAS, "{name}: {worst:.2} σ");
}

#[test]
fn the_five_sphere_cornell_box_agrees_with_an_independent_renderer() {
    agrees("cornell_spheres");
}

#[test]
fn the_furnace_agrees_with_its_exact_solution() {
    agrees("furnace_enclosure");
}

#[test]
fn the_classical_cornell_box_agrees_with_an_independent_renderer() {
    agrees("cornell_box");
}

#[test]
fn glass_mirror_disk_and_cylinder_agree_with_an_independent_renderer() {
    agrees("glass_mirror");
}

#[test]
fn lamps_of_all_sizes_on_plates_of_all_glosses_agree_with_an_independent_renderer() {
    agrees("veach_mis");
}
