//! 11. Agreement with pictures by independent renderers.
use std::{fs, path::Path};

use crate::{
    math::SimdLevel,
    render::{
        film::Film,
        pass::{PassJob, Threads},
    },
    scene::{Estimator, RenderSettings, Roulette, Scene, load},
    validate::{Effort, Section, Statement, Validation},
};

/// Pixels along a block.
const BLOCK: u32 = 16;
/// Some 800 block means a scene: beyond this one in 10⁵ is by chance.
const MOST_SIGMAS: f64 = 4.5;
/// Mean and variance of the mean of a block's red, green and blue.
type Block = [[f64; 2]; 3];

pub fn section(validation: &Validation) -> Section {
    let mut statements = Vec::new();
    let mut found = names(&validation.references);
    let all = found.len();
    if validation.effort == Effort::Quick {
        found.truncate(1);
    }
    for name in &found {
        statements.extend(agreement(validation, name));
    }
    let place = validation.references.display();
    let remark = match found.len() {
        0 => format!("No references were found in {place}: nothing is claimed here. `--references DIR` says where they are."),
        some if some < all => format!("A quick run: {some} of {all} references in {place}."),
        _ => format!("{all} references in {place}."),
    };
    Section {
        title: "Agreement with references",
        claim: "Pictures of the same scenes by an independent renderer agree block by block.",
        derivation: &[
            "Each reference holds means over 256 blocks of 16 × 16 pixels, three colours each, with their standard errors. The \
             difference of two unbiased estimates, over the root of the sum of their variances, is a standard normal deviate. Were \
             the 768 of a picture independent, one would pass 4.5 in about 200 pictures. Their root mean square is about 1, and less \
             where the reference's samples are stratified and vary less than their standard errors say.",
        ],
        source: "References by Mitsuba 3 (W. Jakob et al., 2022).",
        statements,
        figures: Vec::new(),
        remark: Some(remark),
    }
}

/// A name as it is written in a text.
fn spoken(name: &str) -> String {
    name.replace('_', " ")
}

/// Scenes with block means beside them.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let scenes = entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let complete = scenes.filter(|path| path.with_extension("txt").is_file());
    let mut names: Vec<String> = complete.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect();
    names.sort();
    names
}

fn agreement(validation: &Validation, name: &str) -> Vec<Statement> {
    let failed = |reason: String| {
        vec![Statement {
            what: format!("{}: {reason}", spoken(name)),
            measured: f64::NAN,
            error: 0.0,
            exact: None,
            statistic: String::new(),
            holds: false,
        }]
    };
    let path = validation.references.join(format!("{name}.toml"));
    let scene = match load(&path) {
        Ok(scene) => scene,
        Err(error) => return failed(error.report()),
    };
    let reference = match fs::read_to_string(path.with_extension("txt")).map(|text| blocks(&text)) {
        Ok(Some(reference)) => reference,
        Ok(None) => return failed("its block means cannot be read".to_owned()),
        Err(error) => return failed(format!("its block means cannot be read: {error}")),
    };
    let ours = rendered(validation, &scene);
    if ours.len() != reference.len() {
        return failed(format!("{} blocks, but the reference has {}", ours.len(), reference.len()));
    }
    let (mut worst, mut squares, mut count) = (0f64, 0.0, 0.0);
    for (ours, theirs) in ours.iter().flatten().zip(reference.iter().flatten()) {
        // Rounding of the reference's six digits, and of ours.
        let rounding = 2e-6 * theirs[0];
        let z = (ours[0] - theirs[0]) / (ours[1] + theirs[1] + rounding * rounding).sqrt();
        worst = worst.max(z.abs());
        squares += z * z;
        count += 1.0;
    }
    vec![
        Statement::below(format!("{}: largest |z| of {count} block means", spoken(name)), worst, MOST_SIGMAS),
        Statement::below(format!("{}: root mean square of z", spoken(name)), f64::sqrt(squares / count), 1.1),
    ]
}

/// Six numbers a line: means, then standard errors; lines that start with # are remarks.
fn blocks(text: &str) -> Option<Vec<Block>> {
    let block = |line: &str| {
        let numbers: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
        let [r, g, b, er, eg, eb] = numbers[..].try_into().ok()?;
        Some([[r, er * er], [g, eg * eg], [b, eb * eb]])
    };
    text.lines().filter(|line| !line.starts_with('#')).map(block).collect()
}

fn rendered(validation: &Validation, scene: &Scene) -> Vec<Block> {
    let settings = RenderSettings { max_bounces: scene.settings.max_bounces, ..validation.settings(Estimator::Mis) };
    let settings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..settings };
    let [width, height] = scene.camera.resolution;
    let mut film = Film::new([width, height]);
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let rays = scene.rays(&scene.camera);
    threads.pass(PassJob { scene, rays: &rays, settings: &settings }, &mut film, validation.spp(800), &|| false);
    let columns = width.div_ceil(BLOCK);
    let mut blocks = vec![Block::default(); (columns * height.div_ceil(BLOCK)) as usize];
    let pixels = f64::from(BLOCK * BLOCK);
    for tile in &film.tiles {
        for row in 0..tile.size[1] {
            for (column, estimate) in (0..).zip(tile.estimates(row as usize)) {
                let [x, y] = [tile.origin[0] + column, tile.origin[1] + row];
                let block = &mut blocks[(y / BLOCK * columns + x / BLOCK) as usize];
                let variance = estimate.variance_of_mean.unwrap_or_default();
                for channel in 0..3 {
                    block[channel][0] += estimate.mean[channel] / pixels;
                    block[channel][1] += variance[channel] / (pixels * pixels);
                }
            }
        }
    }
    blocks
}
