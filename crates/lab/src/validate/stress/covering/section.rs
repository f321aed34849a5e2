//! The section of the report.
use std::time::Instant;

use super::{Covering, Strength, agreement::LIMITS, cover};
use crate::validate::{FailedScene, Section, Statement};

/// Tries all combinations of a strength. Returns the scenes that fail.
pub fn section(strength: Strength, message: &(dyn Fn(&str) + Sync)) -> (Section, Vec<FailedScene>) {
    let start = Instant::now();
    let covering = cover(strength, message);
    let Covering { scenes, combinations, unknown, .. } = covering;
    let remark = format!(
        "{scenes} scenes with {combinations} {} in {:.0} s; {unknown} have no known error.",
        strength.words(),
        start.elapsed().as_secs_f64()
    );
    let statements = statements_of(strength, &covering);
    let section = Section {
        title: match strength {
            Strength::Pairs => "Pairs of types",
            Strength::Triples => "Triples of types",
        },
        claim: match strength {
            Strength::Pairs => "Every two types work together.",
            Strength::Triples => "Every three types work together.",
        },
        derivation: &[
            "What can vary in a scene is read from the declarations: the types of materials, textures, shapes, transforms, lights, \
             emission, environments and cameras, every parameter that may be a texture, every option of the render. A covering array has \
             few scenes in which all pairs, or all triples, of their levels appear. Numbers are changed by chance. What cannot be combined, \
             such as a lens and parallel rays, is found by compiling the scene, and listed.",
            "Each scene has the same image at every SIMD level. Its samples are those of their replays, and add up to the pixel. Edits are \
             undone, and the scene, its text and its image are as before. Its text reads as the scene, with the same image.",
            "Two estimators agree on the mean of the image. A deviation is looked at again with four times as many images, up to twice; \
             the last look alone fails a scene, beyond 5.5 standard errors: by chance once in 10⁷ scenes. Light that is reflected once is compared where \
             only light paths find more: punctual lights or a sky, seen through mirrors or clear glass. If one image has more than a tenth \
             of the variance at the last look, the error of the mean is not known, and the scene does not fail.",
        ],
        source: "D. Cohen, S. Dalal, M. Fredman, G. Patton, “The AETG System: An Approach to Testing Based on Combinatorial Design”, IEEE \
                 Transactions on Software Engineering 23(7), 1997.",
        statements,
        figures: Vec::new(),
        remark: Some(remark),
    };
    (section, covering.failed)
}

fn statements_of(strength: Strength, covering: &Covering) -> Vec<Statement> {
    let Covering { factors, levels, combinations, scenes, impossible, failed, .. } = covering;
    let first = failed.first().map_or_else(String::new, |scene| format!(" ({}: {})", scene.name, scene.reason));
    let all = strength.words();
    let what = format!(
        "{scenes} scenes with {combinations} {all} of the {levels} levels of {factors} factors, images agree within {} standard errors: \
         those that fail{first}",
        LIMITS[2]
    );
    let kinds = impossible.iter().filter(|levels| levels.is_kind).count();
    let refused: Vec<&str> = impossible.iter().map(|levels| levels.words.as_str()).collect();
    vec![
        Statement::none(what, failed.len() as u32),
        Statement::none(
            format!("— types that every scene refuses; these levels are refused: {}", refused.join("; ")),
            kinds as u32,
        ),
    ]
}
