//! A notice in the middle of the image: what is wrong with it, and buttons that help.
use egui::{Align, Button, Color32, FontId, Label, Layout, Rect, Stroke, StrokeKind, TextStyle, Ui, UiBuilder, Vec2, vec2};

use super::picture_area::PictureArea;
use crate::viewer::widgets::quotation::with_quotation_marks;

const MOST_WIDTH: f32 = 420.0;
const MARGIN: f32 = 18.0;
const GAP: f32 = 7.0;
const BUTTON_HEIGHT: f32 = 30.0;

/// The text of a notice, and its buttons with their tooltips.
pub struct Notice<'a> {
    pub title: &'a str,
    pub reason: String,
    pub buttons: &'a [(&'a str, &'a str)],
}

impl Notice<'_> {
    /// Draws the notice in the middle of the image. Returns the place of the button that was clicked.
    pub fn show(&self, ui: &mut Ui, area: &PictureArea) -> Option<usize> {
        let most = MOST_WIDTH.min(area.clip.width() - 4.0 * MARGIN);
        let layout = |text: String, font: FontId, ink: Color32| ui.painter().layout(text, font, ink, most);
        let title = layout(self.title.to_owned(), FontId::proportional(16.0), Color32::WHITE);
        let reason = layout(with_quotation_marks(&self.reason), FontId::proportional(13.5), Color32::from_gray(210));
        let buttons = self.size_of_buttons(ui);
        let width = title.size().x.max(reason.size().x).max(buttons.x);
        let below = if buttons.y > 0.0 { 2.0 * GAP + buttons.y } else { 0.0 };
        let height = title.size().y + GAP + reason.size().y + below;
        let seen = area.rect.intersect(area.clip);
        let rect = Rect::from_center_size(seen.center(), vec2(width, height) + Vec2::splat(2.0 * MARGIN));
        let painter = ui.painter_at(area.clip);
        painter.rect_filled(rect, 8.0, Color32::from_gray(28));
        painter.rect_stroke(rect, 8.0, Stroke::new(1.0, Color32::from_gray(90)), StrokeKind::Inside);
        let inside = UiBuilder::new().max_rect(rect.shrink(MARGIN)).layout(Layout::top_down(Align::Min));
        let mut ui = ui.new_child(inside);
        ui.set_clip_rect(area.clip);
        ui.spacing_mut().item_spacing = Vec2::splat(GAP);
        ui.add(Label::new(title).selectable(false));
        ui.add(Label::new(reason).selectable(false));
        ui.add_space(GAP);
        ui.horizontal(|ui| self.show_buttons(ui)).inner
    }

    fn show_buttons(&self, ui: &mut Ui) -> Option<usize> {
        let mut clicked = None;
        for (place, (name, doc)) in self.buttons.iter().enumerate() {
            let button = ui.add(Button::new(*name).min_size(vec2(0.0, BUTTON_HEIGHT)));
            if button.on_hover_text(*doc).clicked() {
                clicked = Some(place);
            }
        }
        clicked
    }

    fn size_of_buttons(&self, ui: &Ui) -> Vec2 {
        let (font, padding) = (TextStyle::Button.resolve(ui.style()), 2.0 * ui.spacing().button_padding.x);
        let width = |name: &str| ui.painter().layout_no_wrap(name.to_owned(), font.clone(), Color32::WHITE).size().x + padding;
        let widths: f32 = self.buttons.iter().map(|(name, _)| width(name)).sum();
        match self.buttons.len() {
            0 => Vec2::ZERO,
            count => vec2(widths + GAP * (count - 1) as f32, BUTTON_HEIGHT),
        }
    }
}
