//! Agreement with images by independent renderers.
use std::{fs, path::Path};

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::validate::{Effort, Section, Statement, Validation, statement::chance_beyond};
use noisefall_base::{file::read_text, math::SimdLevel};
use noisefall_render::render::{
    film::Film,
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{Estimator, RenderSettings, Roulette, Scene, load, parse};

/// Pixels along a block.
const BLOCK: u32 = 16;
/// Some 800 block means a scene: beyond this one in 10⁵ is by chance.
const MOST_SIGMAS: f64 = 4.5;
/// Limit of the root mean square of their z-scores. Two images in 10⁶ exceed it by chance, if three channels count as one number.
const MOST_RMS: f64 = 1.2;
/// Most bytes of the block means of a scene.
const LONGEST: u64 = 64 << 20;
const UNREAD: &str = "its block means cannot be read";

macro_rules! embedded {
    ($name:literal) => {
        [
            $name,
            include_str!(concat!("../../../references/", $name, ".toml")),
            include_str!(concat!("../../../references/", $name, ".txt")),
        ]
    };
}

/// Mean of a block and variance of that mean, for red, green and blue.
type Block = [[f64; 2]; 3];

/// The references in the program: scenes with block means, from `references` beside `src`.
const CARRIED: [[&str; 3]; 6] = [
    embedded!("cornell_box"),
    embedded!("cornell_spheres"),
    embedded!("dof_spheres"),
    embedded!("furnace_enclosure"),
    embedded!("glass_mirror"),
    embedded!("veach_mis"),
];

/// A scene, the block means of its image, and its name in messages.
struct Reference {
    name: String,
    scene: Result<Scene, String>,
    means: Result<String, String>,
}

fn references(validation: &Validation) -> Vec<Reference> {
    let Some(folder) = &validation.references else {
        let of = |[name, scene, means]: [&str; 3]| Reference {
            name: name.to_owned(),
            scene: parse(name, scene.to_owned()).map_err(|error| error.report()),
            means: Ok(means.to_owned()),
        };
        return CARRIED.into_iter().map(of).collect();
    };
    names(folder).into_iter().map(|name| Reference::read(&folder.join(format!("{name}.toml")), name)).collect()
}

impl Reference {
    fn read(path: &Path, name: String) -> Reference {
        let means = read_text(&path.with_extension("txt"), LONGEST).map_err(|error| format!("{UNREAD}: {error}"));
        Reference { name, scene: load(path).map_err(|error| error.report()), means }
    }
}

pub fn section(validation: &Validation) -> Section {
    let mut found = references(validation);
    let all = found.len();
    if validation.effort == Effort::Quick {
        found.truncate(1);
    }
    let statements = found.iter().flat_map(|reference| rows(validation, reference)).collect();
    let some = found.len();
    let remark = if some < all { format!("A quick run: {some} of {all} references.") } else { format!("{all} references.") };
    Section {
        title: "Agreement with references",
        claim: "Renders of the same scenes by an independent renderer, and one exact image, agree block by block.",
        derivation: &[
            "Each reference has means over 256 blocks of 16 × 16 pixels, in three channels, with their standard errors. The difference of two unbiased estimates, divided by the root of the sum of their variances, has a standard normal distribution. If the 768 scores of an image were independent, one would exceed 4.5 in about 200 images. Their root mean square is about 1, or less if the reference has stratified samples, whose error is smaller than their standard errors.",
        ],
        source: "Mitsuba 3 (W. Jakob et al., 2022), except for the furnace enclosure, which is exact.",
        statements,
        figures: Vec::new(),
        remark: Some(remark),
    }
}

/// A file name as words.
fn spoken(name: &str) -> String {
    name.replace('_', " ")
}

/// Names of the scenes in a folder that have block means beside them.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let scenes = entries.map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "toml"));
    let complete = scenes.filter(|path| path.with_extension("txt").is_file());
    let mut names: Vec<String> = complete.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect();
    names.sort();
    names
}

fn rows(validation: &Validation, reference: &Reference) -> Vec<Statement> {
    let settings = |scene: &Scene| RenderSettings {
        max_bounces: scene.settings.max_bounces,
        roulette: Roulette::BY_THROUGHPUT,
        ..validation.settings(Estimator::Mis)
    };
    let what = |text: String| format!("{}: {text}", spoken(&reference.name));
    // With few samples, block means do not have a normal distribution yet.
    match compared(reference, settings, validation.spp(800).max(200)) {
        Ok(BlockZScores { worst, rms, count, sigma }) => {
            let largest = Statement::largest_z(what(format!("largest |z| of {count} block means")), &[worst], MOST_SIGMAS, sigma);
            // The channels of a block share their noise.
            let blocks = count as f64 / 3.0;
            let chance_of_rms = ChiSquared::new(blocks).map_or(f64::NAN, |chi2| chi2.sf(MOST_RMS * MOST_RMS * blocks));
            // The probability for the largest of many.
            let chance = count as f64 * chance_beyond(MOST_SIGMAS);
            let statistic = format!("largest of {count}, must be < {MOST_SIGMAS}");
            vec![
                Statement { chance, statistic, ..largest },
                Statement {
                    chance: chance_of_rms,
                    ..Statement::below(what("root mean square of z".to_owned()), rms, MOST_RMS).of_the_same()
                },
            ]
        }
        Err(reason) => vec![Statement { statistic: String::new(), ..Statement::below(what(reason), f64::NAN, 0.0) }],
    }
}

/// Deviations of block means from a reference, in standard errors.
pub struct BlockZScores {
    /// The largest absolute z-score.
    pub worst: f64,
    /// Root mean square over the blocks.
    pub rms: f64,
    /// Block means compared.
    pub count: usize,
    /// The median of the standard errors, relative to the means.
    pub sigma: f64,
}

/// Renders the scene of a file and compares it with the block means beside it. The sample variance must give the standard error,
/// as it does for independent samples.
pub fn block_z_scores(path: &Path, settings: impl FnOnce(&Scene) -> RenderSettings, spp: u32) -> Result<BlockZScores, String> {
    compared(&Reference::read(path, String::new()), settings, spp)
}

fn compared(reference: &Reference, settings: impl FnOnce(&Scene) -> RenderSettings, spp: u32) -> Result<BlockZScores, String> {
    let scene = reference.scene.as_ref().map_err(String::clone)?;
    let reference = blocks(reference.means.as_ref().map_err(String::clone)?).ok_or(UNREAD)?;
    let ours = rendered(scene, &settings(scene), spp);
    if ours.len() != reference.len() {
        return Err(format!("{} blocks, but the reference has {}", ours.len(), reference.len()));
    }
    let z = |([mean, variance], [exact, error]): (&[f64; 2], &[f64; 2])| {
        // Rounding of the reference to six digits, and of the render.
        let rounding = 2e-6 * exact;
        (mean - exact) / (variance + error + rounding * rounding).sqrt()
    };
    let deviations: Vec<f64> = ours.iter().flatten().zip(reference.iter().flatten()).map(z).collect();
    let count = deviations.len();
    let pairs = ours.iter().flatten().zip(reference.iter().flatten());
    let mut sigmas: Vec<f64> =
        pairs.map(|([_, variance], [exact, error])| (variance + error).sqrt() / exact.max(1e-12)).collect();
    sigmas.sort_by(f64::total_cmp);
    Ok(BlockZScores {
        sigma: sigmas.get(count / 2).copied().unwrap_or(f64::NAN),
        worst: deviations.iter().fold(0.0, |worst, z| z.abs().max(worst)),
        rms: (deviations.iter().map(|z| z * z).sum::<f64>() / count as f64).sqrt(),
        count,
    })
}

/// Parses six numbers per line: means, then standard errors. Lines that start with # are comments.
fn blocks(text: &str) -> Option<Vec<Block>> {
    let block = |line: &str| {
        let numbers: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
        let [r, g, b, er, eg, eb] = numbers[..].try_into().ok()?;
        Some([[r, er * er], [g, eg * eg], [b, eb * eb]])
    };
    text.lines().filter(|line| !line.starts_with('#')).map(block).collect()
}

fn rendered(scene: &Scene, settings: &RenderSettings, spp: u32) -> Vec<Block> {
    let [width, height] = scene.camera.resolution;
    let mut film = Film::new([width, height]);
    let threads = Threads::new(0, SimdLevel::best()).expect("threads can be had");
    let rays = scene.rays(&scene.camera);
    threads.pass(PassJob { scene, rays: &rays, settings }, &mut film, spp, &|| false);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// All pixels of two blocks have radiance 0.5 in every sample.
    const SCENE: &str = "format = 1\ncamera = { eye = [0, 0, 0], look_at = [0, 0, 1], fov = 60, resolution = [32, 16] }\n\
                         [environment]\nradiance = 0.5\n";

    fn write(folder: &Path, name: &str, means: &str) {
        fs::write(folder.join(name).with_extension("toml"), SCENE).expect("it is written");
        fs::write(folder.join(name).with_extension("txt"), means).expect("it is written");
    }

    #[test]
    fn a_quick_run_takes_the_first_reference_and_a_full_one_all() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["b_room", "a_sky", "c_box"] {
            write(folder.path(), name, "0.5 0.5 0.5 0.01 0.01 0.01\n0.5 0.5 0.5 0.01 0.01 0.01\n");
        }
        fs::write(folder.path().join("d_alone.toml"), SCENE).expect("it is written");
        let run = |effort| section(&Validation::new(effort, Some(folder.path().to_owned()), 0));
        let [quick, full] = [Effort::Quick, Effort::Full].map(run);
        assert_eq!(quick.remark.as_deref(), Some("A quick run: 1 of 3 references."));
        assert_eq!(full.remark.as_deref(), Some("3 references."));
        assert!(quick.was_run() && quick.statements.iter().all(|statement| statement.what.starts_with("a sky: ")));
        assert_eq!(full.statements.len(), 3 * quick.statements.len());
        assert!(quick.holds() && full.holds());
    }

    #[test]
    fn blocks_are_held_against_their_own_means_and_errors() {
        let folder = tempfile::tempdir().expect("a folder");
        write(folder.path(), "sky", "# red, green, blue\n0.4 0.5 0.5 0.05 0.1 0.1\n0.5 0.5 0.5 0.1 0.1 0.1\n");
        let found = block_z_scores(&folder.path().join("sky.toml"), |scene| scene.settings, 2).expect("it can be compared");
        assert_eq!(found.count, 6);
        assert!((found.worst - 2.0).abs() < 1e-4 && (found.rms - (4.0f64 / 6.0).sqrt()).abs() < 1e-4);
        assert!((found.sigma - 0.2).abs() < 1e-6, "of 0.125 and five times 0.2 the fourth: {}", found.sigma);
        // Without any noise, the rounding of both is the standard error: 2 · 10⁻⁶ of the mean.
        write(folder.path(), "sky", &"0.500001 0.500001 0.500001 0 0 0\n".repeat(2));
        let exact = block_z_scores(&folder.path().join("sky.toml"), |scene| scene.settings, 2).expect("it can be compared");
        assert!((exact.worst - 1.0).abs() < 1e-3 && (exact.rms - 1.0).abs() < 1e-3, "{} {}", exact.worst, exact.rms);
        write(folder.path(), "sky", "0.5 0.5 0.5 0.1 0.1 0.1\n");
        let short = block_z_scores(&folder.path().join("sky.toml"), |scene| scene.settings, 2).err();
        assert_eq!(short.as_deref(), Some("2 blocks, but the reference has 1"));
    }

    #[test]
    fn a_line_is_three_means_and_three_standard_errors() {
        let found = blocks("# a remark\n1 2 3 0.5 0.25 2\n").expect("a block");
        assert_eq!(found, [[[1.0, 0.25], [2.0, 0.0625], [3.0, 4.0]]]);
        assert!(["1 2 3 4 5", "1 2 3 4 5 6 7", "1 2 3 4 5 x", ""].map(blocks)[..3].iter().all(Option::is_none));
        assert_eq!(blocks("").map(|blocks| blocks.len()), Some(0));
    }
}
