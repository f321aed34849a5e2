//! The image by strategy of bidirectional paths: the triangle of Veach (1997, figure 10.3).
use egui::{Button, Grid, RichText, Ui, vec2};
use noisefall_scene::scene::Strategy;

use crate::viewer::widgets::palette::Palette;

/// The last row of the triangle.
const MOST_BOUNCES: u32 = 5;

/// The first strategy to show: light samples.
pub const FIRST: Strategy = Strategy { s: 1, t: 2, weighted: true };

/// Shows the triangle, in which a click chooses a strategy. The image of the chosen one has this many samples, if there is one.
pub fn show(ui: &mut Ui, strategy: &mut Strategy, spp: Option<u32>) {
    ui.horizontal_top(|ui| {
        Grid::new("strategies of the image").spacing(vec2(3.0, 2.0)).show(ui, |ui| {
            for bounces in 0..=MOST_BOUNCES {
                ui.weak(format!("k = {bounces}")).on_hover_text("Number of bounces, s + t − 2");
                Strategy::of_bounces(bounces, strategy.weighted).for_each(|each| cell(ui, each, strategy));
                ui.end_row();
            }
        });
        ui.vertical(|ui| {
            ui.checkbox(&mut strategy.weighted, "Weighted").on_hover_text(
                "Shows the light that the strategy contributes to the image, weighted by multiple importance sampling. Without weights, it \
                 shows all light of this number of bounces that the strategy can find.",
            );
            ui.label(RichText::new(meaning(*strategy)).color(ui.accent()));
            ui.weak(match spp {
                Some(spp) => format!("After {spp} samples per pixel. The weighted images of all strategies add up to the image."),
                None => "Available after one sample per pixel.".to_owned(),
            });
        });
    });
}

fn cell(ui: &mut Ui, each: Strategy, chosen: &mut Strategy) {
    let button = Button::selectable(each == *chosen, RichText::new(format!("{}, {}", each.s, each.t)).size(11.0));
    if ui.add(button.min_size(vec2(34.0, 15.0))).on_hover_text(meaning(each)).clicked() {
        *chosen = each;
    }
}

/// Describes a strategy.
pub fn meaning(Strategy { s, t, .. }: Strategy) -> String {
    let how = match (s, t) {
        (0, 2) => "the camera sees a light".to_owned(),
        (0, _) => "the camera path hits a light".to_owned(),
        (1, _) => "the camera path samples a light".to_owned(),
        (_, 1) => "the light path is connected to the camera".to_owned(),
        _ => "vertices of both paths are connected".to_owned(),
    };
    format!("s = {s}, t = {t}: {how}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_strategy_is_told_by_its_ends() {
        let told = |s, t| meaning(Strategy { s, t, weighted: false });
        assert!(told(0, 2).ends_with("sees a light") && told(0, 3).ends_with("hits a light"));
        assert!(told(1, 2).ends_with("samples a light") && told(2, 1).ends_with("connected to the camera"));
        assert_eq!(told(2, 3), "s = 2, t = 3: vertices of both paths are connected");
    }
}
