//! The size of a compiled object, transforms included.
use std::ops::Range;

use egui::{RichText, Ui};
use noisefall_scene::{
    geometry::Shape,
    scene::{Object, Scene},
};

use crate::viewer::widgets::{counted::counted, style::elided};

/// More rows than these nobody reads.
const MOST_ROWS: usize = 3;

/// Shows the sizes of the compiled objects of a part, the first ones of many.
pub fn show(ui: &mut Ui, scene: &Scene, objects: Range<usize>) {
    let objects = &scene.objects[objects];
    for object in objects.iter().take(MOST_ROWS) {
        let doc = "Width, height and depth of the box around the object, with its transforms.";
        elided(ui, ui.available_width(), RichText::new(size(object)).weak()).on_hover_text(doc);
    }
    if objects.len() > MOST_ROWS {
        ui.weak(format!("and {} more", objects.len() - MOST_ROWS));
    }
}

fn size(object: &Object) -> String {
    let [min, max] = object.shape.corners();
    // Three digits, without zeros at the end.
    let edge = |x: f64| format!("{x:.2e}").parse().unwrap_or(x).to_string();
    let box_ = (max - min).to_array().map(edge).join(" × ");
    let triangles = match &object.shape {
        Shape::Mesh { data, .. } => format!(", {}", counted(data.triangles.len(), "triangle")),
        _ => String::new(),
    };
    let moves = if object.motion.0.is_empty() { "" } else { ", moves while the shutter is open" };
    format!("{box_} m{triangles}{moves}")
}

#[cfg(test)]
mod tests {
    use noisefall_scene::scene::parse;

    use super::*;

    fn shape(shape: &str) -> String {
        let camera = "format = 1\n[camera]\neye = [0.0, 0.0, 4.0]\nlook_at = [0.0, 0.0, 0.0]\nfov = 40.0\nresolution = [8, 8]\n";
        let text = format!("{camera}[[objects]]\nshape = {{ {shape} }}");
        size(&parse("scene.toml", text).expect("it is a scene").objects[0])
    }

    #[test]
    fn an_object_has_a_size_and_a_mesh_has_triangles() {
        assert_eq!(shape("sphere = { center = [1.0, 2.0, 3.0], radius = 0.38 }"), "0.76 × 0.76 × 0.76 m");
        let moving = shape("sphere = { center = [1.0, 2.0, 3.0], radius = 0.5 } }\nmotion = [{ translate = [1.0, 0.0, 0.0] }] #");
        assert!(moving.ends_with("m, moves while the shutter is open"), "{moving}");
        assert_eq!(shape("cuboid = { min = [0.0, 0.0, 0.0], max = [1.0, 2.0, 3e-7] }"), "1 × 2 × 0.0000003 m");
        let mesh = "mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]] }";
        assert_eq!(shape(mesh), "1 × 1 × 0 m, 1 triangle");
    }
}
