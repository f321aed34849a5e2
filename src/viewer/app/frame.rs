//! One frame of the window: keys, results, panels, image, dialogs, and the next request.
use std::time::{Duration, Instant};

use egui::{CentralPanel, Panel};

use super::{input_order::split_frame, state::App};
use crate::viewer::widgets::style::PANEL_WIDTH;

impl App {
    /// Lays out one frame.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        let start = Instant::now();
        let ctx = ui.ctx().clone();
        self.window.hidden = false;
        self.guard_changes();
        self.shortcuts(&ctx);
        self.take_dropped_files();
        self.receive();
        self.inspect();
        Panel::bottom("status").show(ui, |ui| self.status_bar(ui));
        self.exports_panel(ui);
        Panel::right("settings")
            .resizable(true)
            .default_size(PANEL_WIDTH)
            .size_range(PANEL_WIDTH..=2.0 * PANEL_WIDTH)
            .show(ui, |ui| self.side_panel(ui));
        Panel::top("toolbar").show(ui, |ui| self.toolbar(ui));
        self.dock(ui);
        CentralPanel::no_frame().show(ui, |ui| self.canvas(ui));
        self.show_dialogs(&ctx);
        self.keep_changes();
        self.keep_progress();
        self.record_step();
        self.keep_scale();
        self.update_title();
        let compiled = self.session.opened.as_ref().map(|opened| &opened.scene.compiled);
        self.frame_times.show(&ctx, self.session.threads, self.background.worker.generation(), compiled);
        self.submit();
        self.window.had_focus = ctx.egui_wants_keyboard_input();
        self.frame_times.record(start.elapsed(), ctx.input(|input| input.time));
    }

    /// Remembers the size of text and controls, which egui changes too.
    fn keep_scale(&mut self) {
        let scale = self.ctx.zoom_factor();
        let scale = (scale != 1.0).then_some(scale);
        if self.preferences.now.scale != scale {
            self.preferences.change(|saved| saved.scale = scale);
        }
    }
}

impl eframe::App for App {
    fn raw_input_hook(&mut self, ctx: &egui::Context, input: &mut egui::RawInput) {
        input.events.splice(0..0, self.window.later_events.drain(..));
        self.window.later_events = split_frame(&mut input.events);
        if !self.window.later_events.is_empty() {
            ctx.request_repaint();
        }
    }

    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.guard_changes();
        self.hide(ctx.input(|input| input.viewport().visible() == Some(false)));
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        frame.info().cpu_usage.into_iter().for_each(|last| self.frame_times.record_whole(Duration::from_secs_f32(last)));
        self.show(ui);
    }
}
