//! Images of an independent renderer: means over blocks of 16 × 16 pixels with their standard errors, in `crates/lab/references`.
//!
//! `NOISEFALL_REFERENCE_SPP=4096 cargo test --release --test proof references` compares with more samples.
use std::path::Path;

use noisefall_lab::validate::{BlockZScores, block_z_scores};
use noisefall_scene::{sampling::Sampler, scene::RenderSettings};

const SPP: u32 = 256;
/// Limit for about 800 block means per scene; by chance one in 10⁵ exceeds it.
const MOST_SIGMAS: f64 = 4.5;

fn agrees(name: &str) {
    let spp = std::env::var("NOISEFALL_REFERENCE_SPP").ok().and_then(|spp| spp.parse().ok()).unwrap_or(SPP);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/lab/references").join(format!("{name}.toml"));
    let found = block_z_scores(&path, |scene| RenderSettings { sampler: Sampler::Independent, seed: 21, ..scene.settings }, spp);
    let BlockZScores { worst, rms, count, .. } = found.unwrap_or_else(|reason| panic!("{name}: {reason}"));
    println!("{name}, {spp} spp: |z| at most {worst:.2} of {count}, rms {rms:.3}");
    assert_eq!(count, 16 * 16 * 3, "{name}");
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
fn lights_of_all_sizes_on_plates_of_all_glosses_agree_with_an_independent_renderer() {
    agrees("veach_mis");
}

#[test]
fn a_field_of_spheres_under_a_lens_agrees_with_an_independent_renderer() {
    agrees("dof_spheres");
}
