//! Keeps the mouse from what lies behind a dialog that waits for an answer.
use egui::{Area, Context, Id, Order, Sense};

/// Covers the panels and the image, below all windows.
pub fn show(ctx: &Context) {
    let rect = ctx.content_rect();
    let area = Area::new(Id::unique("shield")).order(Order::Background).fixed_pos(rect.min);
    area.show(ctx, |ui| ui.allocate_response(rect.size(), Sense::click_and_drag()));
}
