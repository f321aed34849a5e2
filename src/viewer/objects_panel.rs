//! The objects of the scene: what they are made of and what they emit.
use egui::{Grid, RichText, Ui};
use glam::DVec3;
use noisefall::{
    geometry::{Outline, Shape},
    material::{Material, Reflectance},
    scene::{Coating, Object, Roughness, Scene},
};

use super::look::elided;

/// Together, with what is between them, as wide as the panel.
const NAME_WIDTH: f32 = 156.0;
const KIND_WIDTH: f32 = 136.0;
/// More rows than these nobody reads.
const MOST_ROWS: usize = 100;

pub(super) fn objects_panel(ui: &mut Ui, scene: &Scene) {
    Grid::new("objects").num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
        for (i, object) in scene.objects.iter().take(MOST_ROWS).enumerate() {
            let name = if object.name.is_empty() { format!("object {}", i + 1) } else { object.name.clone() };
            elided(ui, NAME_WIDTH, name).on_hover_text(place(object));
            elided(ui, KIND_WIDTH, RichText::new(summary(object)).weak()).on_hover_text(details(object));
            ui.end_row();
        }
    });
    if scene.objects.len() > MOST_ROWS {
        ui.weak(format!("and {} more", scene.objects.len() - MOST_ROWS));
    }
}

/// What shape, how large, and where.
fn place(object: &Object) -> String {
    let (center, radius) = object.shape.bounding_sphere();
    let edges = |edges: &[DVec3]| edges.iter().map(|edge| format!("{:.4}", edge.length())).collect::<Vec<_>>().join(" × ");
    let size = match &object.shape {
        Shape::Ellipsoid { axes, .. } => format!("half axes {} m, ", edges(&[axes.x_axis, axes.y_axis, axes.z_axis])),
        Shape::Flat { outline: Outline::Ellipse, edges: axes, .. } => format!("half axes {} m, ", edges(axes)),
        Shape::Flat { edges: sides, .. } => format!("sides {} m, ", edges(sides)),
        Shape::Cuboid { edges: sides, .. } => format!("sides {} m, ", edges(&[sides.x_axis, sides.y_axis, sides.z_axis])),
        Shape::Cylinder { axes, capped, .. } => {
            let ends = if *capped { "" } else { "open, " };
            format!("{ends}radius {:.4} m, height {:.4} m, ", axes.x_axis.length(), axes.z_axis.length())
        }
        Shape::Mesh { data, .. } => format!("{} triangles, ", data.triangles.len()),
        Shape::Sphere { .. } | Shape::Isosurface { .. } => String::new(),
    };
    let moves = if object.motion.0.is_empty() { "" } else { "\nmoves while the shutter is open" };
    format!("{}: {size}within {radius:.4} m of {center:.4}{moves}", object.shape.name())
}

/// Kind of material, and whether it is a lamp.
fn summary(object: &Object) -> String {
    let material = object.coating.as_ref().map_or("black", |coating| coating.material.name());
    if object.emission.is_some() { format!("{material}, lamp") } else { material.to_owned() }
}

/// All parameters, a line each.
fn details(object: &Object) -> String {
    let mut lines = Vec::new();
    if let Some(coating) = &object.coating {
        lines.push(format!("material `{}`", coating.name));
        lines.extend(parameters(coating));
    }
    if let Some(emission) = &object.emission {
        let [r, g, b] = emission.mean;
        lines.push(format!("emits {r:.3} {g:.3} {b:.3} W/sr/m² on the mean"));
    }
    if lines.is_empty() { "reflects nothing".to_owned() } else { lines.join("\n") }
}

fn parameters(coating: &Coating) -> Vec<String> {
    let colour = |name: &str, [r, g, b]: [f32; 3]| format!("{name} {r:.3} {g:.3} {b:.3}");
    let mut lines = match coating.material {
        Material::Lambertian { albedo } => vec![colour("albedo", albedo)],
        Material::Mirror { reflectance } => vec![colour("reflectance", reflectance)],
        Material::Dielectric { ior, ior_outside, .. } => vec![format!("index {ior} inside, {ior_outside} outside")],
        Material::Conductor { fresnel, .. } => match fresnel {
            Reflectance::Constant(reflectance) => vec![colour("reflectance", reflectance)],
            Reflectance::Schlick(f0) => vec![colour("f0", f0)],
            Reflectance::Index { eta, k } => vec![colour("eta", eta), colour("k", k)],
        },
        Material::Plastic { albedo, ior, .. } => vec![colour("albedo", albedo), format!("index {ior} of the coat")],
    };
    match coating.roughness {
        Roughness::Constant(alpha) if alpha > 0.0 => lines.push(format!("α {alpha:.4}")),
        Roughness::Constant(_) => {}
        Roughness::Texture { .. } => lines.push("α by a texture".to_owned()),
    }
    if coating.transmittance != [1.0; 3] {
        lines.push(colour("transmittance per metre", coating.transmittance));
    }
    if coating.bump.is_some() {
        lines.push("bump map".to_owned());
    }
    if coating.normal_map.is_some() {
        lines.push("normal map".to_owned());
    }
    lines
}
