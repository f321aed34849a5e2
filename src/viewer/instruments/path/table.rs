//! The terms of a path, one row per vertex, summed as in the equation.
use egui::{Grid, RichText, Ui};
use noisefall::{
    integrator::{Outcome, Replay, Vertex},
    scene::Object,
};

use crate::viewer::widgets::palette::Palette;

const TEXT: f32 = 12.0;
/// More of a path than this nobody reads.
pub const MOST_VERTICES: usize = 64;

/// Columns, and what they say.
const COLUMNS: [(&str, &str); 17] = [
    ("k", "Bounces before this vertex"),
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
    ui.weak(format!("The path {}.", replay.end.name()));
    remark(ui, replay.alone);
    ui.add_space(2.0);
}

/// Notes that pixels share paths. `alone` is the radiance of this path by itself.
fn remark(ui: &mut Ui, alone: Option<[f32; 3]>) {
    if let Some(alone) = alone {
        let text = format!(
            "Pixels share what paths find: this one brought {}, the last Σ. With Share paths on Never both agree.",
            colour(alone)
        );
        ui.label(RichText::new(text).color(ui.warning()));
    }
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
                (false, _) if next.survival < 1.0 => ", ended by roulette",
                (_, false) => ", ends",
                _ => "",
            };
            let lobe = format!("{}, chosen with probability {}", next.lobe.name, short(next.lobe.probability));
            ui.label(RichText::new(format!("{f}, q {:.2}{end}", next.survival)).monospace().size(TEXT)).on_hover_text(lobe);
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

#[cfg(test)]
mod tests {
    use egui_kittest::{Harness, kittest::NodeT};
    use noisefall::{
        integrator::{EmitterHit, Reflection, SampledLight, Surface},
        material::ChosenLobe,
        scene::built_in,
    };

    use super::*;

    /// A vertex all of whose terms are different.
    fn vertex() -> Vertex {
        let grey = |x: f32| [x; 3];
        Vertex {
            bounce: 3,
            origin: grey(0.0),
            direction: grey(0.0),
            throughput: grey(0.101),
            transmittance: grey(0.102),
            distance: Some(1.0),
            object: Some(1),
            normal: None,
            surface: Some(Surface {
                position: [1.5, 2.5, 3.5],
                material: Some("lambertian"),
                front: true,
                wo: grey(0.0),
                shading_normal: None,
            }),
            emission: Some(EmitterHit { radiance: grey(0.103), weight: 0.104, contribution: grey(0.105) }),
            light: Some(SampledLight {
                direction: grey(0.0),
                object: Some(0),
                pdf: 0.107,
                f_cos: grey(0.106),
                weight: 0.108,
                radiance: grey(0.9),
                outcome: Outcome::Hidden,
                distance: None,
                passed: grey(0.109),
                contribution: grey(0.111),
            }),
            reflection: Some(Reflection {
                direction: [0.1, 0.2, 0.3],
                lobe: ChosenLobe { name: "a lobe", probability: 0.5 },
                refracted: false,
                delta: false,
                f: Some(grey(0.112)),
                cos: 0.113,
                pdf: Some(0.114),
                weight: grey(0.9),
                survival: 0.75,
                survives: false,
                goes_on: false,
                throughput: grey(0.9),
            }),
            radiance: grey(0.115),
        }
    }

    /// All that is written, row by row.
    fn written(vertices: Vec<Vertex>) -> Vec<String> {
        let (scene, replay) = (built_in(), Replay { vertices, ..Replay::default() });
        let harness = Harness::builder().with_size(egui::vec2(4000.0, 400.0)).build_ui(|ui| show(ui, &replay, &scene.objects));
        let labels =
            harness.root().children_recursive().filter(|node| node.accesskit_node().role() == egui::accesskit::Role::Label);
        labels.filter_map(|label| label.accesskit_node().value()).collect()
    }

    #[test]
    fn every_term_stands_below_its_heading() {
        let texts = written(vec![vertex()]);
        let (headings, cells) = texts.split_at(COLUMNS.len());
        assert_eq!(headings, COLUMNS.map(|(name, _)| name));
        let scene = built_in();
        assert_eq!(
            cells,
            [
                "3".to_owned(),
                "0.115".to_owned(),
                format!("{} (lambertian)", scene.objects[1].name),
                "1.500 2.500 3.500".to_owned(),
                "0.101".to_owned(),
                "0.102".to_owned(),
                "0.103".to_owned(),
                "0.104".to_owned(),
                "0.105".to_owned(),
                format!("{}, hidden", scene.objects[0].name),
                "0.106".to_owned(),
                "0.107".to_owned(),
                "0.108".to_owned(),
                "0.109".to_owned(),
                "0.111".to_owned(),
                "0.100 0.200 0.300".to_owned(),
                "0.112 · 0.113 / 0.114, q 0.75, ended by roulette".to_owned(),
            ]
        );
    }

    #[test]
    fn what_a_vertex_lacks_leaves_its_columns_empty() {
        let bare = Vertex { surface: None, object: None, emission: None, light: None, reflection: None, ..vertex() };
        let cells = &written(vec![bare])[COLUMNS.len()..];
        assert_eq!(cells.len(), COLUMNS.len());
        assert_eq!(cells[2], "leaves the scene");
        assert!(cells[6..].iter().all(|cell| cell == "–"), "{cells:?}");
    }

    #[test]
    fn a_light_sample_says_what_became_of_it_and_a_mirror_its_weight() {
        let cells = |outcome| {
            let light = vertex().light.map(|light| SampledLight { object: None, outcome, ..light });
            let reflection = vertex().reflection.map(|next| Reflection { delta: true, survives: true, ..next });
            let cells = written(vec![Vertex { light, reflection, ..vertex() }]).split_off(COLUMNS.len());
            [cells[9].clone(), cells[16].clone()]
        };
        let next = "δ, weight 0.900, q 0.75, ends";
        assert_eq!(cells(Outcome::Seen), ["background, seen", next]);
        assert_eq!(cells(Outcome::Void), ["background, not tested", next]);
    }

    #[test]
    fn numbers_are_short_and_colours_one_number_where_they_are_grey() {
        assert_eq!([0.0, 0.5, 12.34, 4321.0, 0.000_12].map(short), ["0", "0.500", "12.3", "4.3e3", "1.2e-4"]);
        assert_eq!((colour([0.5; 3]), colour([0.5, 1.0, 2.0])), ("0.500".to_owned(), "0.500 1.000 2.000".to_owned()));
    }
}
