//! The terms of a path, a line a vertex, added up as the equation has it.
use egui::{Grid, RichText, Ui};
use noisefall::{
    integrator::{Outcome, Replay, Vertex},
    scene::Object,
};

use super::remark;
use crate::viewer::look::Inks;

const TEXT: f32 = 12.0;
/// More of a path than this nobody reads.
pub const MOST_VERTICES: usize = 64;

/// Columns, and what they say.
const COLUMNS: [(&str, &str); 17] = [
    ("k", "Reflections before this vertex"),
    ("Σ", "The sum of light so far: in the last row, the sample"),
    ("object", "What is met, and of which material"),
    ("x", "The point met, in metres"),
    ("β", "Throughput: the product of τ f cos θ / (p q) so far"),
    ("τ", "What media on the way here let pass"),
    ("L_e", "Radiance emitted here towards the path"),
    ("w", "MIS weight of the emitted light"),
    ("+ τ β w L_e", "What running into it adds to the sample"),
    (
        "light sample",
        "The lamp that was chosen, and whether it is seen; not tested where it is dark on this side, or nothing of it is reflected",
    ),
    ("f cos θ_l", "Bsdf and cosine towards it"),
    ("p_l", "Density of its direction, per solid angle"),
    ("w_l", "MIS weight of the light sample"),
    ("τ_l", "What media on the way to the lamp let pass, times its texture; 0 where it is not seen"),
    ("+ direct", "What the light sample adds: τ β f cos θ_l L_e τ_l w_l / p_l"),
    ("ω_i", "The next direction, in the world"),
    ("f · cos θ / p, q", "Bsdf, cosine, density per solid angle, and roulette's survival probability of that direction"),
];

/// What the table adds up to, and how.
pub fn heading(ui: &mut Ui, sample: u32, replay: &Replay) {
    let formula = "L = Σ τ β (w L_e + w_l f cos θ_l L_e τ_l / p_l), β growing by τ f cos θ / (p q) a vertex";
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(format!("Sample {sample}: {}", colour(replay.radiance))).color(ui.accent()).strong());
        ui.weak(formula);
    });
    remark(ui, replay.alone);
    ui.add_space(2.0);
}

pub fn show(ui: &mut Ui, replay: &Replay, objects: &[Object]) {
    Grid::new("vertices").striped(true).spacing([14.0, 4.0]).show(ui, |ui| {
        for (name, doc) in COLUMNS {
            ui.label(RichText::new(name).weak()).on_hover_text(doc);
        }
        ui.end_row();
        for vertex in replay.vertices.iter().take(MOST_VERTICES) {
            row(ui, vertex, objects);
        }
    });
    if replay.vertices.len() > MOST_VERTICES {
        ui.weak(format!("and {} vertices more", replay.vertices.len() - MOST_VERTICES));
    }
}

fn row(ui: &mut Ui, vertex: &Vertex, objects: &[Object]) {
    let cell = |ui: &mut Ui, text: String| ui.label(RichText::new(text).monospace().size(TEXT));
    cell(ui, vertex.bounce.to_string());
    cell(ui, colour(vertex.radiance));
    cell(ui, place(vertex, objects));
    cell(ui, vertex.surface.as_ref().map_or_else(String::new, |surface| vector(surface.position)));
    cell(ui, colour(vertex.throughput));
    cell(ui, colour(vertex.transmittance));
    match &vertex.emission {
        Some(met) => {
            cell(ui, colour(met.radiance));
            cell(ui, format!("{:.3}", met.weight));
            cell(ui, colour(met.contribution));
        }
        None => nothing(ui, 3),
    }
    match &vertex.light {
        Some(light) => {
            let lamp = light.object.map_or_else(|| "background".to_owned(), |id| name(objects, id));
            let outcome = match light.outcome {
                Outcome::Seen => "seen",
                Outcome::Hidden => "hidden",
                Outcome::Void => "not tested",
            };
            cell(ui, format!("{lamp}, {outcome}"));
            cell(ui, colour(light.f_cos));
            cell(ui, short(light.pdf));
            cell(ui, format!("{:.3}", light.weight));
            cell(ui, colour(light.passed));
            cell(ui, colour(light.contribution));
        }
        None => nothing(ui, 6),
    }
    match &vertex.reflection {
        Some(next) => {
            cell(ui, vector(next.direction));
            let f = match (next.f, next.pdf) {
                (Some(f), Some(pdf)) if !next.delta => format!("{} · {:.3} / {}", colour(f), next.cos, short(pdf)),
                _ => format!("δ, weight {}", colour(next.weight)),
            };
            let end = match (next.survives, next.goes_on) {
                (false, _) => ", ended by roulette",
                (true, false) => ", ends",
                _ => "",
            };
            cell(ui, format!("{f}, q {:.2}{end}", next.survival));
        }
        None => nothing(ui, 2),
    }
    ui.end_row();
}

fn nothing(ui: &mut Ui, columns: usize) {
    for _ in 0..columns {
        ui.weak("–");
    }
}

/// What a vertex lies on.
fn place(vertex: &Vertex, objects: &[Object]) -> String {
    let Some(object) = vertex.object else { return "leaves the scene".to_owned() };
    let material = vertex.surface.as_ref().and_then(|surface| surface.material).unwrap_or("black");
    format!("{} ({material})", name(objects, object))
}

fn name(objects: &[Object], id: u32) -> String {
    let name = objects.get(id as usize).map_or("", |object| object.name.as_str());
    if name.is_empty() { format!("object {}", id + 1) } else { name.to_owned() }
}

/// A colour in three numbers, or in one where they are the same.
pub fn colour([r, g, b]: [f32; 3]) -> String {
    if r == g && g == b { short(r) } else { format!("{} {} {}", short(r), short(g), short(b)) }
}

fn vector([x, y, z]: [f32; 3]) -> String {
    format!("{x:.3} {y:.3} {z:.3}")
}

/// Four digits that count, as short as they can be.
fn short(x: f32) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        0.001..10.0 => format!("{x:.3}"),
        10.0..1000.0 => format!("{x:.1}"),
        _ => format!("{x:.1e}"),
    }
}
