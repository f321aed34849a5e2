//! The bidirectional paths of a sample as text, with what each strategy finds.
use super::path_words::{number, place, three};
use noisefall_kernel::integrator::{BidirectionalSample, PathPoint, StrategyTerm};
use noisefall_scene::scene::Scene;

/// The vertices of both paths, and a line for each strategy.
pub fn text(scene: &Scene, BidirectionalSample { light, camera, strategies }: &BidirectionalSample) -> String {
    let mut text = String::from("\n\nfrom the light");
    for (index, point) in light.iter().enumerate() {
        text += &format!("\n  y{index:<14} {}", at(scene, point));
    }
    text += "\nfrom the camera";
    for (index, point) in camera.iter().enumerate() {
        text += &format!("\n  z{:<14} {}", index + 1, at(scene, point));
    }
    text += "\nstrategies: s vertices from the light, t from the camera; those with t ≥ 2 add up to the radiance";
    for term in strategies {
        text += &format!("\n  {:<15} {}", format!("s {}, t {}", term.s, term.t), line(term));
    }
    text
}

fn at(scene: &Scene, PathPoint { position, object }: &PathPoint) -> String {
    let name = object.map_or("light without surface", |object| scene.objects[object as usize].name.as_str());
    format!("{}, {}", if name.is_empty() { "(unnamed)" } else { name }, place(*position))
}

fn line(StrategyTerm { pdf, unweighted, weight, visible, place, contribution, .. }: &StrategyTerm) -> String {
    let pdf = pdf.map_or_else(|| "–".to_owned(), |pdf| format!("{pdf:.4e}"));
    let end = match place {
        _ if !visible => "is occluded".to_owned(),
        Some([x, y]) => format!("adds {} to the image at {x:.1},{y:.1}", three(*contribution)),
        None => format!("adds {}", three(*contribution)),
    };
    format!("p {pdf}, alone {}, weight {}: {end}", three(*unweighted), number(*weight))
}
