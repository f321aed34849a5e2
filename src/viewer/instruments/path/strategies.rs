//! The table of the strategies of bidirectional paths: what each finds with s vertices from the light and t from the camera.
use egui::{Grid, RichText, Ui};
use noisefall_kernel::integrator::{BidirectionalSample, PathPoint, StrategyTerm};
use noisefall_scene::scene::Object;

use super::cells::{Channel, TEXT, VERTEX_WIDTH, cell, colour, name, short};
use crate::viewer::widgets::style::elided;

/// Columns, and what they say.
const COLUMNS: [(&str, &str); 6] = [
    ("s, t", "Number of vertices from the light and from the camera. The tooltip lists them."),
    ("connected at", "The last vertices of both paths. With s = 0, the camera path hits the light itself."),
    (
        "p",
        "Pdf of the vertices per area, m⁻² each, and per steradian for light from far away. Delta directions and roulette count as 1.",
    ),
    ("C", "Unweighted contribution of this strategy, f/p"),
    ("w", "Weight of multiple importance sampling"),
    ("term", "w C; 0 if something lies between both paths"),
];

/// Shows the strategies that add up to the sample, their sum, and those that bring light to other places of the image.
pub fn show(ui: &mut Ui, both: &BidirectionalSample, radiance: [f32; 3], objects: &[Object], channel: Channel) {
    let channel = channel as usize;
    let mut terms: Vec<&StrategyTerm> = both.strategies.iter().collect();
    terms.sort_by_key(|term| (term.t, term.s));
    let (joined, own): (Vec<_>, Vec<_>) = terms.into_iter().partition(|term| term.t == 1);
    Grid::new("strategies").striped(true).spacing([8.0, 4.0]).show(ui, |ui| {
        for (name, doc) in COLUMNS {
            ui.label(RichText::new(name).weak()).on_hover_text(doc);
        }
        ui.end_row();
        own.iter().for_each(|term| row(ui, both, term, objects, channel));
        ui.label(RichText::new("Sample").strong().size(TEXT))
            .on_hover_text("The sum of the terms above, in the order of the renderer");
        (0..COLUMNS.len() - 2).for_each(|_| drop(ui.label("")));
        cell(ui, short(radiance[channel]), true).on_hover_text(colour(radiance));
        ui.end_row();
        if !joined.is_empty() {
            ui.weak("t = 1")
                .on_hover_text("The light path is connected to the camera. It adds light where the image shows its last vertex.");
            ui.end_row();
        }
        joined.iter().for_each(|term| row(ui, both, term, objects, channel));
    });
}

fn row(ui: &mut Ui, both: &BidirectionalSample, term: &StrategyTerm, objects: &[Object], channel: usize) {
    let vertices = vertices(both, term, objects);
    cell(ui, format!("{}, {}", term.s, term.t), false).on_hover_text(&vertices);
    elided(ui, 2.0 * VERTEX_WIDTH, RichText::new(joint(both, term, objects)).size(TEXT)).on_hover_text(&vertices);
    match term.pdf {
        Some(pdf) => drop(cell(ui, short(pdf as f32), false)),
        None => drop(ui.weak("–")),
    }
    cell(ui, short(term.unweighted[channel]), false).on_hover_text(colour(term.unweighted));
    cell(ui, format!("{:.3}", term.weight), false);
    if term.visible {
        cell(ui, short(term.contribution[channel]), false).on_hover_text(colour(term.contribution));
    } else {
        ui.weak(RichText::new("occluded").size(TEXT));
    }
    ui.end_row();
}

/// The last vertices of both paths, or the place of the image.
fn joint(both: &BidirectionalSample, term: &StrategyTerm, objects: &[Object]) -> String {
    let light = both.light.get((term.s as usize).wrapping_sub(1));
    let camera = both.camera.get((term.t as usize).wrapping_sub(2));
    let (y, z) = (format!("y{}", term.s.wrapping_sub(1)), format!("z{}", term.t - 1));
    match (term.s, term.t) {
        (0, _) => format!("{z} {}", at(camera, objects)),
        (1, _) => format!("light, {z} {}", at(camera, objects)),
        (_, 1) => match term.place {
            Some([x, y_]) => format!("{y} {}, pixel {x:.0} {y_:.0}", at(light, objects)),
            None => format!("{y} {}, camera", at(light, objects)),
        },
        _ => format!("{y} {}, {z} {}", at(light, objects), at(camera, objects)),
    }
}

/// All vertices, from the light to the camera.
fn vertices(both: &BidirectionalSample, term: &StrategyTerm, objects: &[Object]) -> String {
    let mut lines = Vec::new();
    if term.s == 1 {
        lines.push("a light sample".to_owned());
    } else {
        let points = both.light.iter().take(term.s as usize).enumerate();
        lines.extend(points.map(|(index, point)| format!("y{index} {}", at(Some(point), objects))));
    }
    let points = both.camera.iter().take(term.t as usize - 1).enumerate();
    let camera: Vec<String> = points.map(|(index, point)| format!("z{} {}", index + 1, at(Some(point), objects))).collect();
    lines.extend(camera.into_iter().rev());
    lines.push("z0 the camera".to_owned());
    lines.join("\n")
}

/// The object of a vertex.
fn at(point: Option<&PathPoint>, objects: &[Object]) -> String {
    match point {
        Some(PathPoint { object: Some(object), .. }) => name(objects, *object),
        Some(PathPoint { object: None, .. }) => "light or environment".to_owned(),
        None => "environment".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::{Harness, kittest::NodeT};
    use noisefall_scene::scene::built_in;

    use super::*;

    fn term(s: u32, t: u32, contribution: f32) -> StrategyTerm {
        let grey = |x: f32| [x; 3];
        let (unweighted, place) = (grey(2.0 * contribution), (t == 1).then_some([7.2, 8.4]));
        StrategyTerm { s, t, pdf: Some(0.25), unweighted, weight: 0.5, visible: true, place, contribution: grey(contribution) }
    }

    fn both() -> BidirectionalSample {
        let point = |object| PathPoint { position: [0.0; 3], object };
        BidirectionalSample {
            light: vec![point(None), point(Some(0))],
            camera: vec![point(Some(1)), point(Some(0))],
            strategies: vec![
                term(2, 1, 0.125),
                term(2, 2, 0.25),
                StrategyTerm { visible: false, ..term(1, 2, 0.5) },
                term(0, 3, 0.125),
            ],
        }
    }

    #[test]
    fn terms_stand_in_order_above_their_sum_and_joins_with_the_camera_below() {
        let scene = built_in();
        let harness = Harness::builder()
            .with_size(egui::vec2(2000.0, 400.0))
            .build_ui(|ui| show(ui, &both(), [0.375; 3], &scene.objects, Channel::Green));
        let labels =
            harness.root().children_recursive().filter(|node| node.accesskit_node().role() == egui::accesskit::Role::Label);
        let texts: Vec<String> =
            labels.filter_map(|label| label.accesskit_node().value()).filter(|text| !text.is_empty()).collect();
        let [first, second] = [0, 1].map(|object: usize| scene.objects[object].name.clone());
        let rows = [
            ["1, 2".to_owned(), format!("light, z1 {second}"), "0.250".into(), "1.000".into(), "0.500".into(), "occluded".into()],
            [
                "2, 2".to_owned(),
                format!("y1 {first}, z1 {second}"),
                "0.250".into(),
                "0.500".into(),
                "0.500".into(),
                "0.250".into(),
            ],
            ["0, 3".to_owned(), format!("z2 {first}"), "0.250".into(), "0.250".into(), "0.500".into(), "0.125".into()],
        ];
        let end = ["Sample", "0.375", "t = 1", "2, 1"].map(str::to_owned);
        let joined = [format!("y1 {first}, pixel 7 8"), "0.250".into(), "0.250".into(), "0.500".into(), "0.125".into()];
        let headings = COLUMNS.map(|(name, _)| name.to_owned());
        assert_eq!(texts, [&headings[..], &rows.concat(), &end, &joined].concat());
    }

    #[test]
    fn a_tooltip_lists_the_vertices_from_the_light_to_the_camera() {
        let objects = built_in().objects.clone();
        let [first, second] = [0, 1].map(|object: usize| objects[object].name.clone());
        let told = vertices(&both(), &term(2, 3, 1.0), &objects);
        assert_eq!(told, format!("y0 light or environment\ny1 {first}\nz2 {first}\nz1 {second}\nz0 the camera"));
    }
}
