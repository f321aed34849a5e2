//! What the window has to say: short notices, and why a scene cannot be opened.
use std::time::Duration;

use egui::{Align2, RichText, ScrollArea};

use super::{
    app::App,
    look::{Inks, over_the_picture},
};

/// A message. Good news go away by themselves; errors stay until they are closed, and can be copied.
pub struct Notice {
    pub text: String,
    pub is_error: bool,
    until: f64,
}

const NOTICE_SECONDS: f64 = 6.0;
/// Older ones make place.
const MOST_NOTICES: usize = 4;

impl App {
    pub(super) fn tell(&mut self, text: String, is_error: bool) {
        let now = self.ctx.input(|input| input.time);
        self.notices.retain(|notice| notice.text != text);
        if self.notices.len() == MOST_NOTICES {
            self.notices.remove(0);
        }
        let until = if is_error { f64::INFINITY } else { now + NOTICE_SECONDS };
        self.notices.push(Notice { text, is_error, until });
    }

    pub(super) fn show_notices(&mut self, ctx: &egui::Context) {
        let now = ctx.input(|input| input.time);
        self.notices.retain(|notice| notice.until > now);
        if self.notices.is_empty() {
            return;
        }
        let mut closed = None;
        egui::Area::new(egui::Id::unique("notices")).anchor(Align2::CENTER_BOTTOM, over_the_picture(64.0)).show(ctx, |ui| {
            for (number, notice) in self.notices.iter().enumerate() {
                egui::Frame::popup(ui.style()).show(ui, |ui| {
                    if show_notice(ui, notice) {
                        closed = Some(number);
                    }
                });
            }
        });
        if let Some(number) = closed {
            self.notices.remove(number);
        }
        let next = self.notices.iter().map(|notice| notice.until - now).fold(f64::INFINITY, f64::min);
        if next.is_finite() {
            ctx.request_repaint_after(Duration::from_secs_f64(next.max(0.0)));
        }
    }

    pub(super) fn scene_error_window(&mut self, ctx: &egui::Context) {
        let Some(report) = &self.scene_error else { return };
        let (mut open, mut built_in) = (true, false);
        egui::Window::new("This scene cannot be opened")
            .open(&mut open)
            .collapsible(false)
            .default_width((ctx.content_rect().width() - 376.0).clamp(300.0, 760.0))
            .anchor(Align2::CENTER_CENTER, over_the_picture(0.0))
            .show(ctx, |ui| {
                ScrollArea::both().max_height(360.0).show(ui, |ui| {
                    ui.add(egui::Label::new(RichText::new(report).monospace()).extend());
                });
                ui.horizontal(|ui| {
                    if ui.button("Copy").on_hover_text("Copy this message").clicked() {
                        ui.ctx().copy_text(report.clone());
                    }
                    built_in = self.opened.is_none() && ui.button("Open the built-in scene").clicked();
                });
            });
        if built_in {
            self.loader.open(None);
        }
        if !open || built_in {
            self.scene_error = None;
        }
    }
}

/// Draws a message. Whether it was closed.
fn show_notice(ui: &mut egui::Ui, notice: &Notice) -> bool {
    ui.horizontal(|ui| {
        let colour = if notice.is_error { ui.bad() } else { ui.visuals().text_color() };
        ui.set_max_width(620.0);
        ui.add(egui::Label::new(RichText::new(&notice.text).color(colour)).wrap());
        if notice.is_error && ui.small_button("Copy").on_hover_text("Copy this message").clicked() {
            ui.ctx().copy_text(notice.text.clone());
        }
        ui.small_button("Close").on_hover_text("Close this message (Esc)").clicked()
    })
    .inner
}
