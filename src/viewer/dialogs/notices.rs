//! Short messages over the image.
use std::time::Duration;

use egui::{Align2, RichText};

use crate::viewer::widgets::{palette::Palette, quotation::with_quotation_marks, style::over_the_picture};

/// A message. Good news disappear after some seconds; errors stay until they are closed, and can be copied.
pub struct Notice {
    pub text: String,
    pub is_error: bool,
    until: f64,
}

/// The messages that are shown, oldest first.
#[derive(Default)]
pub struct Notices(pub Vec<Notice>);

const NOTICE_SECONDS: f64 = 6.0;
/// Largest width of a text, and the width that the side panel and the buttons need beside it, points.
const MOST_WIDTH: f32 = 620.0;
const AROUND: f32 = 500.0;
/// Width of the buttons of a message, points.
const BUTTONS: f32 = 110.0;
/// The oldest one is dropped for a new one.
const MOST_NOTICES: usize = 4;

impl Notices {
    /// Adds a message, at a time of the window's clock.
    pub fn add(&mut self, text: String, is_error: bool, now: f64) {
        self.0.retain(|notice| notice.text != text);
        if self.0.len() == MOST_NOTICES {
            self.0.remove(0);
        }
        let until = if is_error { f64::INFINITY } else { now + NOTICE_SECONDS };
        self.0.push(Notice { text, is_error, until });
    }

    /// Shows the messages, this much higher than where they usually are.
    pub fn show(&mut self, ctx: &egui::Context, lift: f32) {
        let now = ctx.input(|input| input.time);
        self.0.retain(|notice| notice.until > now);
        if self.0.is_empty() {
            return;
        }
        let mut closed = None;
        egui::Area::new(egui::Id::unique("notices")).anchor(Align2::CENTER_BOTTOM, over_the_picture(64.0 + lift)).show(
            ctx,
            |ui| {
                for (number, notice) in self.0.iter().enumerate() {
                    egui::Frame::popup(ui.style()).show(ui, |ui| {
                        if show_notice(ui, notice) {
                            closed = Some(number);
                        }
                    });
                }
            },
        );
        if let Some(number) = closed {
            self.0.remove(number);
        }
        let next = self.0.iter().map(|notice| notice.until - now).fold(f64::INFINITY, f64::min);
        if next.is_finite() {
            ctx.request_repaint_after(Duration::from_secs_f64(next.max(0.0)));
        }
    }
}

/// Draws a message. Returns whether it was closed.
fn show_notice(ui: &mut egui::Ui, notice: &Notice) -> bool {
    ui.horizontal(|ui| {
        let colour = if notice.is_error { ui.bad() } else { ui.visuals().text_color() };
        let width = (ui.ctx().content_rect().width() - AROUND).clamp(200.0, MOST_WIDTH);
        ui.set_max_width(width);
        ui.scope(|ui| {
            ui.set_max_width(width - BUTTONS);
            ui.add(egui::Label::new(RichText::new(with_quotation_marks(&notice.text)).color(colour)).wrap());
        });
        if notice.is_error && ui.small_button("Copy").on_hover_text("Copies this message.").clicked() {
            ui.ctx().copy_text(notice.text.clone());
        }
        ui.small_button("Close").on_hover_text("Closes this message. (Esc)").clicked()
    })
    .inner
}
