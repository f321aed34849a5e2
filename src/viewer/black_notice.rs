//! The notice on a black picture: why it is black, and the way back to a view that showed something.
use egui::{Align, Button, Color32, FontId, Label, Layout, Rect, Stroke, StrokeKind, Ui, UiBuilder, Vec2, vec2};
use noisefall::{render::view::View, scene::Camera};

use super::{app::App, canvas::Place, compare::Layout as Sides};

const MOST_WIDTH: f32 = 420.0;
const MARGIN: f32 = 18.0;
const GAP: f32 = 7.0;
/// As wide as its text needs.
const BUTTON: Vec2 = Vec2 { x: 274.0, y: 30.0 };
const TITLE: &str = "No light found yet";
const BACK: &str = "Back to the last view that showed something";

impl App {
    /// Shows the notice in the middle of the picture, if all that is seen of it is black.
    pub(super) fn black_notice(&mut self, ui: &mut Ui, place: &Place) {
        let is_full = self.shown.as_ref().is_some_and(|frame| !frame.is_coarse());
        let is_radiance = self.look.view == View::Radiance;
        // A notice would hide the other picture of a wipe.
        let is_alone = self.comparison().is_none_or(|compare| compare.layout == Sides::SideBySide);
        let Some(why) = self.why_black().filter(|_| is_full && is_radiance && is_alone) else { return };
        let back = self.last_seeing.map(|last| Camera { resolution: self.camera.resolution, ..last });
        if let Some(camera) = back.filter(|back| *back != self.camera) {
            if card(ui, place, &why, true) {
                self.camera = camera;
            }
        } else {
            card(ui, place, &why, false);
        }
    }
}

/// Draws the notice. Whether its button was clicked.
fn card(ui: &mut Ui, place: &Place, why: &str, has_button: bool) -> bool {
    let most = MOST_WIDTH.min(place.clip.width() - 4.0 * MARGIN);
    let layout = |text: String, font: FontId, ink: Color32| ui.painter().layout(text, font, ink, most);
    let title = layout(TITLE.to_owned(), FontId::proportional(16.0), Color32::WHITE);
    let reason = layout(sentence(why), FontId::proportional(13.5), Color32::from_gray(210));
    let button = if has_button { BUTTON } else { Vec2::ZERO };
    let width = title.size().x.max(reason.size().x).max(button.x.min(most));
    let height = title.size().y + GAP + reason.size().y + if has_button { 2.0 * GAP + button.y } else { 0.0 };
    let seen = place.rect.intersect(place.clip);
    let rect = Rect::from_center_size(seen.center(), vec2(width, height) + Vec2::splat(2.0 * MARGIN));
    let painter = ui.painter_at(place.clip);
    painter.rect_filled(rect, 8.0, Color32::from_gray(28));
    painter.rect_stroke(rect, 8.0, Stroke::new(1.0, Color32::from_gray(90)), StrokeKind::Inside);
    let inside = UiBuilder::new().max_rect(rect.shrink(MARGIN)).layout(Layout::top_down(Align::Min));
    let mut ui = ui.new_child(inside);
    ui.set_clip_rect(place.clip);
    ui.spacing_mut().item_spacing.y = GAP;
    ui.add(Label::new(title).selectable(false));
    ui.add(Label::new(reason).selectable(false));
    ui.add_space(GAP);
    has_button && ui.add(Button::new(BACK).min_size(BUTTON)).clicked()
}

/// A clause as a sentence.
fn sentence(clause: &str) -> String {
    let mut letters = clause.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).chain(['.']).collect()
}
