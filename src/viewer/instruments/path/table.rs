//! The terms of a path, one row each, summed as in the equation.
use egui::{Grid, RichText, Ui};
use noisefall_kernel::integrator::{LightOutcome, Reflection, Replay, Vertex};
use noisefall_scene::scene::Object;

use super::{
    cells::{Channel, TEXT, VERTEX_WIDTH, cell, colour, name, short},
    terms::{LightId, Row, Term, TermSource, rows, totals},
};
use crate::viewer::widgets::{
    decimals::three,
    palette::Palette,
    style::{choices, elided},
};

/// Width of the source of light, so that the table fits beside the samples in a window of 1280 points.
const TERM_WIDTH: f32 = 100.0;
/// Width of the other columns, and the largest width of the names of vertices, points.
const OTHERS: f32 = 446.0;
const WIDEST_VERTEX: f32 = 260.0;
/// More of a path than this nobody reads.
pub const MOST_VERTICES: usize = 64;

const CHANNELS: [(Channel, &str, &str); 3] = [
    (Channel::Red, "Red", "Shows the red channel. The tooltips show all three."),
    (Channel::Green, "Green", "Shows the green channel. The tooltips show all three."),
    (Channel::Blue, "Blue", "Shows the blue channel. The tooltips show all three."),
];

/// Columns, and what they say.
const COLUMNS: [(&str, &str); 9] = [
    (
        "vertex",
        "Number of bounces before the vertex, and the object that the path hits. The tooltip has the point and the next direction.",
    ),
    ("light", "Emission that the path hits, or the light sample and whether it is visible"),
    ("β", "Throughput: the product of τ f cos θ / (p q) so far, times the transmittance τ of this segment"),
    ("f cos θ", "BSDF and cosine towards the light"),
    ("L_e", "Emitted radiance, W·sr⁻¹·m⁻²"),
    ("τ", "Transmittance of media towards the light, times its texture; 0 if the light is occluded"),
    ("w", "Weight of multiple importance sampling"),
    ("p", "Pdf of the direction to the light, per solid angle; for punctual lights, the selection probability"),
    ("term", "β f cos θ L_e τ w / p. Terms in brackets are shared among neighbouring pixels."),
];

/// Shows what the table adds up to, and how, and lets the user choose a channel.
pub fn heading(ui: &mut Ui, sample: u32, replay: &Replay, channel: &mut Channel) {
    ui.horizontal_wrapped(|ui| {
        ui.label(RichText::new(format!("Sample {sample}: {}", colour(replay.radiance))).color(ui.accent()).strong())
            .on_hover_text("Radiance of the sample: linear red, green and blue.");
        choices(ui, channel, &CHANNELS);
    });
    match &replay.bidirectional {
        Some(_) => ui.weak("L = Σ w C over the strategies with t ≥ 2."),
        // Nothing is shared, and yet the path alone is not the sample.
        None if replay.alone.is_some() && replay.shared.is_none() => ui.weak(
            "Vertices are merged with those of other pixels' paths. The table is that of the camera path, weighted as by MIS.",
        ),
        None => ui.weak(format!("L = Σ β f cos θ L_e τ w / p. The path {}.", replay.end.name())),
    };
    ui.add_space(2.0);
}

/// Shows the table in a width. The names of vertices get what the other columns leave.
pub fn show(ui: &mut Ui, replay: &Replay, objects: &[Object], channel: Channel, room: f32) {
    let (channel, vertex_width) = (channel as usize, (room - OTHERS).clamp(VERTEX_WIDTH, WIDEST_VERTEX));
    Grid::new("vertices").striped(true).spacing([8.0, 4.0]).show(ui, |ui| {
        for (name, doc) in COLUMNS {
            ui.label(RichText::new(name).weak()).on_hover_text(doc);
        }
        ui.end_row();
        for row in rows(replay, MOST_VERTICES) {
            show_row(ui, &row, objects, channel, vertex_width);
        }
        for total in totals(replay, MOST_VERTICES) {
            ui.label(RichText::new(&total.name).strong().size(TEXT)).on_hover_text(total.doc);
            (0..COLUMNS.len() - 2).for_each(|_| drop(ui.label("")));
            cell(ui, short(total.value[channel]), true).on_hover_text(colour(total.value));
            ui.end_row();
        }
    });
}

fn show_row(ui: &mut Ui, row: &Row, objects: &[Object], channel: usize, vertex_width: f32) {
    let vertex = row.vertex;
    let place = format!("{} {}", vertex.bounce, place(vertex, objects));
    elided(ui, vertex_width, RichText::new(&place).size(TEXT)).on_hover_text(format!("{place}\n{}", details(vertex)));
    let Some(term) = &row.term else {
        (0..COLUMNS.len() - 1).for_each(|_| drop(ui.weak("–")));
        ui.end_row();
        return;
    };
    let source = source(term, objects);
    elided(ui, TERM_WIDTH, RichText::new(&source).size(TEXT));
    let factors = [Some(term.throughput), term.f_cos, Some(term.radiance), term.passed];
    factors.into_iter().for_each(|factor| factor_cell(ui, factor, channel));
    cell(ui, format!("{:.3}", term.weight), false);
    match term.pdf {
        Some(pdf) => drop(cell(ui, short(pdf), false)),
        None => drop(ui.weak("–")),
    }
    let value = short(term.value[channel]);
    cell(ui, if term.is_shared { format!("({value})") } else { value }, false).on_hover_text(colour(term.value));
    ui.end_row();
}

fn factor_cell(ui: &mut Ui, factor: Option<[f32; 3]>, channel: usize) {
    match factor {
        Some(factor) => drop(cell(ui, short(factor[channel]), false).on_hover_text(colour(factor))),
        None => drop(ui.weak("–")),
    }
}

/// Source of the light of a term.
fn source(term: &Term, objects: &[Object]) -> String {
    match &term.source {
        TermSource::Hit => "hit".to_owned(),
        TermSource::Light(target, outcome) => {
            let light = match target {
                LightId::Object(id) => name(objects, *id),
                LightId::PunctualLight(name) => name.clone(),
                LightId::Environment => "environment".to_owned(),
            };
            let outcome = match outcome {
                LightOutcome::Seen => "seen",
                LightOutcome::Hidden => "hidden",
                LightOutcome::Void => "not tested",
            };
            format!("{light}, {outcome}")
        }
    }
}

/// Surface of a vertex.
fn place(vertex: &Vertex, objects: &[Object]) -> String {
    let Some(object) = vertex.object else { return "leaves the scene".to_owned() };
    let material = vertex.surface.as_ref().and_then(|surface| surface.material).unwrap_or("black");
    format!("{} ({material})", name(objects, object))
}

/// The point of a vertex, and how the path goes on from there.
fn details(vertex: &Vertex) -> String {
    let mut lines = Vec::new();
    lines.extend(vertex.surface.as_ref().map(|surface| format!("x = {} m", vector(surface.position))));
    lines.push(format!("β = {}, τ = {}", colour(vertex.throughput), colour(vertex.transmittance)));
    lines.extend(vertex.reflection.as_ref().map(continuation));
    lines.join("\n")
}

/// The next direction, its factor of the throughput, and why there is none.
fn continuation(next: &Reflection) -> String {
    let factor = match (next.f, next.pdf) {
        (Some(f), Some(pdf)) if !next.delta => format!("f = {}, cos θ = {:.3}, p = {}", colour(f), next.cos, short(pdf)),
        _ => format!("δ, weight {}", colour(next.weight)),
    };
    let end = match (next.survives, next.goes_on) {
        (false, _) if next.survival < 1.0 => ", ended by roulette",
        (_, false) => ", ends",
        _ => "",
    };
    let lobe = format!("{} with probability {}", next.lobe.name, short(next.lobe.probability));
    format!("ω_i = {}: {lobe}\n{factor}, q = {:.2}{end}", vector(next.direction), next.survival)
}

fn vector(v: [f32; 3]) -> String {
    three(v.map(f64::from), 3)
}

#[cfg(test)]
mod tests {
    use egui_kittest::{Harness, kittest::NodeT};
    use noisefall_kernel::integrator::{EmitterHit, SampledLight, SharedLight, Surface};
    use noisefall_scene::{material::ChosenLobe, scene::built_in};

    use super::*;

    /// A vertex all of whose terms are different.
    fn vertex() -> Vertex {
        let grey = |x: f32| [x; 3];
        Vertex {
            bounce: 3,
            origin: grey(0.0),
            direction: grey(0.0),
            throughput: grey(0.5),
            transmittance: grey(0.102),
            distance: Some(1.0),
            object: Some(1),
            normal: None,
            surface: Some(Surface {
                position: [1.5, 2.5, 3.5],
                material: Some("lambertian"),
                front: true,
                wo: grey(0.0),
                geometric_normal: [0.0, 0.0, 1.0],
                shading_normal: None,
            }),
            emission: Some(EmitterHit { radiance: grey(0.103), weight: 0.104, contribution: grey(0.105), shared: false }),
            light: Some(SampledLight {
                direction: grey(0.0),
                object: Some(0),
                punctual_light: None,
                pdf: 0.107,
                f_cos: grey(0.106),
                weight: 0.108,
                radiance: grey(0.9),
                outcome: LightOutcome::Hidden,
                distance: None,
                passed: grey(0.109),
                contribution: grey(0.111),
                shared: false,
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
    fn written(replay: &Replay) -> Vec<String> {
        let scene = built_in();
        let harness = Harness::builder()
            .with_size(egui::vec2(4000.0, 400.0))
            .build_ui(|ui| show(ui, replay, &scene.objects, Channel::Red, 4000.0));
        let labels =
            harness.root().children_recursive().filter(|node| node.accesskit_node().role() == egui::accesskit::Role::Label);
        labels.filter_map(|label| label.accesskit_node().value()).collect()
    }

    fn of(vertices: Vec<Vertex>) -> Replay {
        Replay { vertices, radiance: [0.216, 0.5, 0.5], ..Replay::default() }
    }

    #[test]
    fn every_term_stands_below_its_heading_and_the_sample_below_them() {
        let texts = written(&of(vec![vertex()]));
        let (headings, cells) = texts.split_at(COLUMNS.len());
        assert_eq!(headings, COLUMNS.map(|(name, _)| name));
        let scene = built_in();
        let place = format!("3 {} (lambertian)", scene.objects[1].name);
        let punctual_light = format!("{}, hidden", scene.objects[0].name);
        let cells: Vec<&str> = cells.iter().map(String::as_str).filter(|cell| !cell.is_empty()).collect();
        assert_eq!(
            cells,
            [
                &[&place, "hit", "0.051", "–", "0.103", "–", "0.104", "–", "0.105"][..],
                &[&place, &punctual_light, "0.051", "0.106", "0.900", "0.109", "0.108", "0.107", "0.111"],
                &["Sample", "0.216"],
            ]
            .concat()
        );
    }

    #[test]
    fn a_vertex_tells_where_it_is_and_how_the_path_goes_on() {
        let told = details(&vertex());
        assert_eq!(
            told,
            "x = 1.500 2.500 3.500 m\nβ = 0.500, τ = 0.102\nω_i = 0.100 0.200 0.300: a lobe with probability 0.500\n\
             f = 0.112, cos θ = 0.113, p = 0.114, q = 0.75, ended by roulette"
        );
        let mirror = vertex().reflection.map(|next| Reflection { delta: true, survives: true, ..next });
        assert!(details(&Vertex { reflection: mirror, ..vertex() }).ends_with("δ, weight 0.900, q = 0.75, ends"));
    }

    #[test]
    fn missing_parts_of_a_vertex_leave_their_columns_empty() {
        let bare = Vertex { surface: None, object: None, emission: None, light: None, reflection: None, ..vertex() };
        let cells = &written(&of(vec![bare]))[COLUMNS.len()..2 * COLUMNS.len()];
        assert_eq!(cells[0], "3 leaves the scene");
        assert!(cells[1..].iter().all(|cell| cell == "–"), "{cells:?}");
    }

    #[test]
    fn a_light_sample_states_its_outcome() {
        let cells = |outcome| {
            let light = vertex().light.map(|light| SampledLight { object: None, outcome, ..light });
            written(&of(vec![Vertex { light, emission: None, ..vertex() }]))[COLUMNS.len() + 1].clone()
        };
        assert_eq!(cells(LightOutcome::Seen), "environment, seen");
        assert_eq!(cells(LightOutcome::Void), "environment, not tested");
        let light = vertex().light.map(|light| SampledLight { object: None, punctual_light: Some("spot".to_owned()), ..light });
        let of_punctual = written(&of(vec![Vertex { light, emission: None, ..vertex() }]));
        assert_eq!(of_punctual[COLUMNS.len() + 1], "spot, hidden");
    }

    #[test]
    fn shared_terms_are_in_brackets_and_light_from_neighbours_has_a_row() {
        let light = vertex().light.map(|light| SampledLight { shared: true, ..light });
        let shared = SharedLight { unshared: [0.105; 3], kept: [0.011; 3], from_neighbours: [0.1; 3] };
        let replay = Replay { shared: Some(shared), ..of(vec![Vertex { light, ..vertex() }]) };
        let texts = written(&replay);
        assert!(texts.contains(&"(0.111)".to_owned()) && texts.contains(&"0.105".to_owned()), "{texts:?}");
        let after = |name: &str| {
            let at = texts.iter().position(|text| text == name).expect("it has a row");
            texts[at + 1..].iter().find(|text| !text.is_empty()).cloned()
        };
        assert_eq!(
            ["Shared, kept", "From neighbours", "Sample"].map(|name| after(name).expect("a number")),
            ["0.011", "0.100", "0.216"]
        );
    }
}
