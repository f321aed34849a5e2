//! The notice on a black image: the reason, and a button back to a camera that saw something.
use egui::{Align, Button, Color32, FontId, Label, Layout, Rect, Stroke, StrokeKind, Ui, UiBuilder, Vec2, vec2};

use super::picture_area::PictureArea;
use crate::viewer::widgets::quotation::with_quotation_marks;

const MOST_WIDTH: f32 = 420.0;
const MARGIN: f32 = 18.0;
const GAP: f32 = 7.0;
/// Wide enough for its text.
const BUTTON: Vec2 = Vec2 { x: 274.0, y: 30.0 };
const TITLE: &str = "No light found yet";
const BACK: &str = "Back to the last view that showed something";

/// Draws the notice in the middle of the picture. Returns whether its button was clicked.
pub fn show(ui: &mut Ui, area: &PictureArea, why: &str, has_button: bool) -> bool {
    let most = MOST_WIDTH.min(area.clip.width() - 4.0 * MARGIN);
    let layout = |text: String, font: FontId, ink: Color32| ui.painter().layout(text, font, ink, most);
    let title = layout(TITLE.to_owned(), FontId::proportional(16.0), Color32::WHITE);
    let reason = layout(sentence(&with_quotation_marks(why)), FontId::proportional(13.5), Color32::from_gray(210));
    let button = if has_button { BUTTON } else { Vec2::ZERO };
    let width = title.size().x.max(reason.size().x).max(button.x.min(most));
    let height = title.size().y + GAP + reason.size().y + if has_button { 2.0 * GAP + button.y } else { 0.0 };
    let seen = area.rect.intersect(area.clip);
    let rect = Rect::from_center_size(seen.center(), vec2(width, height) + Vec2::splat(2.0 * MARGIN));
    let painter = ui.painter_at(area.clip);
    painter.rect_filled(rect, 8.0, Color32::from_gray(28));
    painter.rect_stroke(rect, 8.0, Stroke::new(1.0, Color32::from_gray(90)), StrokeKind::Inside);
    let inside = UiBuilder::new().max_rect(rect.shrink(MARGIN)).layout(Layout::top_down(Align::Min));
    let mut ui = ui.new_child(inside);
    ui.set_clip_rect(area.clip);
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
