//! What the window has to say: short notices, and why a scene cannot be opened.
use egui::{Align2, RichText, ScrollArea};

use super::app::App;

/// A message that goes away by itself, or when it is clicked.
pub struct Notice {
    pub text: String,
    pub is_error: bool,
    until: f64,
}

const NOTICE_SECONDS: f64 = 6.0;

impl App {
    pub(super) fn tell(&mut self, text: String, is_error: bool) {
        let now = self.ctx.input(|input| input.time);
        self.notice = Some(Notice { text, is_error, until: now + NOTICE_SECONDS });
    }

    pub(super) fn notice(&mut self, ctx: &egui::Context) {
        let Some(notice) = &self.notice else { return };
        let left = notice.until - ctx.input(|input| input.time);
        let mut closed = left <= 0.0;
        egui::Area::new(egui::Id::unique("notice")).anchor(Align2::CENTER_BOTTOM, [-168.0, -44.0]).show(ctx, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                let colour = if notice.is_error { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
                let label = egui::Label::new(RichText::new(&notice.text).color(colour)).sense(egui::Sense::click());
                closed |= ui.add(label).clicked();
            });
        });
        if closed {
            self.notice = None;
        } else {
            ctx.request_repaint_after(std::time::Duration::from_secs_f64(left.max(0.0)));
        }
    }

    pub(super) fn scene_error_window(&mut self, ctx: &egui::Context) {
        let Some(report) = &self.scene_error else { return };
        let (mut open, mut built_in) = (true, false);
        egui::Window::new("This scene cannot be opened")
            .open(&mut open)
            .collapsible(false)
            .default_width(760.0)
            .anchor(Align2::CENTER_CENTER, [-168.0, 0.0])
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
