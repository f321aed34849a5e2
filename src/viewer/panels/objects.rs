//! The size, material and emission of a compiled object.
use std::ops::Range;

use egui::{Grid, RichText, Ui};
use glam::DVec3;
use noisefall::{
    declare::{OneOf, lines_of},
    geometry::{Outline, Shape},
    scene::{Object, Scene},
};

use crate::viewer::widgets::{counted::counted, decimals::fixed, style::elided};

/// Together, with what is between them, as wide as the panel.
const PLACE_WIDTH: f32 = 156.0;
const KIND_WIDTH: f32 = 136.0;
const GAP: f32 = 12.0;
/// More rows than these nobody reads.
const MOST_ROWS: usize = 3;

/// Shows the size and the material of the compiled objects of a part, the first ones of many.
pub fn show(ui: &mut Ui, scene: &Scene, objects: Range<usize>) {
    let objects = &scene.objects[objects];
    let place_width = PLACE_WIDTH.max(ui.available_width() - KIND_WIDTH - GAP);
    Grid::new("objects").num_columns(2).spacing([GAP, 4.0]).show(ui, |ui| {
        for object in objects.iter().take(MOST_ROWS) {
            elided(ui, place_width, RichText::new(place(object)).weak());
            elided(ui, KIND_WIDTH, RichText::new(summary(scene, object)).weak()).on_hover_text(details(scene, object));
            ui.end_row();
        }
    });
    if objects.len() > MOST_ROWS {
        ui.weak(format!("and {} more", objects.len() - MOST_ROWS));
    }
}

/// Shape, size and position of an object.
fn place(object: &Object) -> String {
    let (center, radius) = object.shape.bounding_sphere();
    let edges = |edges: &[DVec3]| edges.iter().map(|edge| format!("{:.4}", edge.length())).collect::<Vec<_>>().join(" × ");
    let size = match &object.shape {
        Shape::Ellipsoid { axes, .. } => format!("semi-axes {} m, ", edges(&[axes.x_axis, axes.y_axis, axes.z_axis])),
        Shape::Flat { outline: Outline::Ellipse, edges: axes, .. } => format!("semi-axes {} m, ", edges(axes)),
        Shape::Flat { edges: sides, .. } => format!("sides {} m, ", edges(sides)),
        Shape::Cuboid { edges: sides, .. } => format!("sides {} m, ", edges(&[sides.x_axis, sides.y_axis, sides.z_axis])),
        Shape::Cylinder { axes, capped, .. } => {
            let ends = if *capped { "" } else { "open, " };
            format!("{ends}radius {:.4} m, height {:.4} m, ", axes.x_axis.length(), axes.z_axis.length())
        }
        Shape::Mesh { data, .. } => format!("{}, ", counted(data.triangles.len(), "triangle")),
        Shape::Sphere { .. } | Shape::Isosurface { .. } => String::new(),
    };
    let center = center.to_array().map(|x| fixed(x, 4)).join(", ");
    let moves = if object.motion.0.is_empty() { "" } else { "\nmoves while the shutter is open" };
    format!("{}: {size}within {radius:.4} m of [{center}]{moves}", object.shape.name())
}

/// Kind of material, and whether it is a lamp.
fn summary(scene: &Scene, object: &Object) -> String {
    let material = scene.material(object).map_or("black", |material| material.material.name());
    if object.emission.is_some() { format!("{material}, lamp") } else { material.to_owned() }
}

/// All parameters, a line each.
fn details(scene: &Scene, object: &Object) -> String {
    let mut lines = Vec::new();
    if let Some(material) = scene.material(object) {
        lines.push(format!("material “{}”", material.name));
        lines.extend(lines_of(|p| material.material.clone().chosen(p)));
        if material.bump.is_some() {
            lines.push("bump map".to_owned());
        }
        if material.normal_map.is_some() {
            lines.push("normal map".to_owned());
        }
    }
    if let Some(emission) = &object.emission {
        let [r, g, b] = emission.mean;
        lines.push(format!("emits {r:.3} {g:.3} {b:.3} W·sr⁻¹·m⁻² on average"));
    }
    if lines.is_empty() { "reflects nothing".to_owned() } else { lines.join("\n") }
}

#[cfg(test)]
mod tests {
    use noisefall::scene::parse;

    use super::*;

    /// The objects of a scene, in the order of the text: none of them emits but the last.
    fn objects(text: &str) -> Vec<Object> {
        scene(text).objects
    }

    fn scene(text: &str) -> Scene {
        let camera = "format = 1\n[camera]\neye = [0.0, 0.0, 4.0]\nlook_at = [0.0, 0.0, 0.0]\nfov = 40.0\nresolution = [8, 8]\n";
        parse("scene.toml", format!("{camera}{text}")).expect("it is a scene")
    }

    fn shape(shape: &str) -> String {
        place(&objects(&format!("[[objects]]\nshape = {{ {shape} }}"))[0])
    }

    #[test]
    fn a_shape_says_its_size_and_its_place() {
        let ball = shape("sphere = { center = [1.0, 2.0, 3.0], radius = 0.5 }");
        assert_eq!(ball, "sphere: within 0.5000 m of [1.0000, 2.0000, 3.0000]");
        let moving = shape("sphere = { center = [1.0, 2.0, 3.0], radius = 0.5 } }\nmotion = [{ translate = [1.0, 0.0, 0.0] }] #");
        assert!(moving.ends_with("\nmoves while the shutter is open"), "{moving}");
        let cuboid = shape("cuboid = { min = [0.0, 0.0, 0.0], max = [1.0, 2.0, 3.0] }");
        assert!(cuboid.contains("sides 1.0000 × 2.0000 × 3.0000 m"), "{cuboid}");
        let cylinder = shape("cylinder = { base = [0.0, 0.0, 0.0], top = [0.0, 3.0, 0.0], radius = 0.25, capped = false }");
        assert!(cylinder.contains("open, radius 0.2500 m, height 3.0000 m"), "{cylinder}");
        let rectangle = shape("rectangle = { origin = [0.0, 0.0, 0.0], edge_u = [2.0, 0.0, 0.0], edge_v = [0.0, 1.0, 0.0] }");
        assert!(rectangle.contains("sides 2.0000 × 1.0000 m"), "{rectangle}");
        let disk = shape("disk = { center = [0.0, 0.0, 0.0], normal = [0.0, 1.0, 0.0], radius = 0.75 }");
        assert!(disk.contains("semi-axes 0.7500 × 0.7500 m"), "{disk}");
    }

    #[test]
    fn a_material_says_its_kind_and_every_parameter() {
        let of = |material: &str, rest: &str| {
            let text = format!(
                "[materials.mine]\n{material}\n[[objects]]\nshape = {{ sphere = {{ center = [0.0, 0.0, 0.0], radius = 1.0 }} }}\n\
                 material = \"mine\"\n{rest}"
            );
            let scene = scene(&text);
            (summary(&scene, &scene.objects[0]), details(&scene, &scene.objects[0]))
        };
        let (kind, more) =
            of("plastic = { albedo = [0.1, 0.2, 0.3], ior = 1.4, alpha = 0.25 }", "emission = { radiance = [1.0, 2.0, 3.0] }");
        assert_eq!(kind, "plastic, lamp");
        assert_eq!(
            more,
            "material “mine”\nalbedo ρ: 0.1 0.2 0.3\nior η: 1.4\nalpha α: 0.25\nemits 1.000 2.000 3.000 W·sr⁻¹·m⁻² on average"
        );
        let (kind, more) = of("dielectric = { ior = 1.5, ior_outside = 1.3, transmittance = [0.1, 0.6, 0.4] }", "");
        assert_eq!(kind, "dielectric");
        assert!(more.contains("ior η: 1.5\nior outside η': 1.3"), "{more}");
        assert!(more.lines().any(|line| line == "transmittance T: 0.1 0.6 0.4"), "a fraction has no unit: {more}");
        let (_, more) = of("conductor = { eta = [0.1, 0.2, 0.3], k = [3.0, 2.0, 1.0] }", "");
        assert!(more.contains("eta η: 0.1 0.2 0.3\nk k: 3 2 1"), "{more}");
        let (_, more) = of(
            "lambertian = { albedo = 0.5 }\nbump = { texture = \"t\", height = 0.1 }",
            "[textures.t]\nchecker = { even = 0.1, odd = 0.5, scale = 4.0 }",
        );
        assert_eq!(more, "material “mine”\nalbedo ρ: 0.5\nbump map");
        let black = scene("[[objects]]\nshape = { sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 } }");
        let object = &black.objects[0];
        assert_eq!((summary(&black, object), details(&black, object)), ("black".to_owned(), "reflects nothing".to_owned()));
    }
}
