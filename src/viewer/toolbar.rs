//! The buttons above the picture.
use egui::{Button, Key};

use super::{app::App, canvas::Tool};

impl App {
    pub(super) fn toolbar(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            ui.spacing_mut().button_padding = egui::vec2(8.0, 4.0);
            self.render_buttons(ui);
            ui.separator();
            self.tool_buttons(ui);
            if self.shown.is_some() {
                ui.separator();
                self.zoom_buttons(ui);
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Help").on_hover_text("Keyboard and mouse (F1)").clicked() {
                    self.help_open = !self.help_open;
                }
                let save = ui.add_enabled(self.can_save(), Button::new("Save…"));
                if save.on_hover_text("Save the picture as PNG or EXR (Ctrl+S)").clicked() {
                    self.open_save_dialog();
                }
            });
        });
    }

    fn render_buttons(&mut self, ui: &mut egui::Ui) {
        let open = self.opened.is_some();
        let label = if self.budget.paused { "Resume" } else { "Pause" };
        let pause = ui.add_enabled(open, Button::new(label).min_size(egui::vec2(70.0, 0.0)));
        if pause.on_hover_text("Stop and go on without losing samples (Space)").clicked() {
            self.toggle_pause();
        }
        let step = ui.add_enabled(open, Button::new("Step"));
        if step.on_hover_text("Pause, and add one sample to every pixel (.)").clicked() {
            self.step();
        }
        let restart = ui.add_enabled(open, Button::new("Restart"));
        if restart.on_hover_text("Throw all samples away and start over (R)").clicked() {
            self.link.restart();
        }
    }

    fn tool_buttons(&mut self, ui: &mut egui::Ui) {
        ui.label("Drag moves");
        ui.selectable_value(&mut self.tool, Tool::Picture, "Picture")
            .on_hover_text("Drag pans the picture and the wheel magnifies it. Never restarts the render. (P)");
        ui.selectable_value(&mut self.tool, Tool::Camera, "Camera")
            .on_hover_text("Drag orbits, right-drag pans and the wheel dollies the camera. Every move starts a new picture. (C)");
    }

    fn zoom_buttons(&mut self, ui: &mut egui::Ui) {
        if ui.button("Fit").on_hover_text("The whole picture (F, or double-click)").clicked() {
            self.view.fit();
        }
        if ui.button("1:1").on_hover_text("One picture pixel to one screen pixel (1)").clicked() {
            self.view.actual_size();
        }
        ui.weak(format!("{:.0} %", 100.0 * self.view.drawn_zoom));
    }

    /// Single keys, unless text is being typed; and Ctrl+S.
    pub(super) fn shortcuts(&mut self, ctx: &egui::Context) {
        let save = egui::KeyboardShortcut::new(egui::Modifiers::COMMAND, Key::S);
        if ctx.input_mut(|input| input.consume_shortcut(&save)) && self.can_save() {
            self.open_save_dialog();
        }
        if ctx.input(|input| input.key_pressed(Key::Escape)) {
            (self.help_open, self.save_dialog, self.open_dialog) = (false, None, None);
        }
        if ctx.input(|input| input.key_pressed(Key::F1)) {
            self.help_open = !self.help_open;
        }
        if ctx.egui_wants_keyboard_input() || self.opened.is_none() {
            return;
        }
        let pressed = |key| ctx.input(|input| input.key_pressed(key) && !input.modifiers.any());
        if pressed(Key::Space) {
            self.toggle_pause();
        }
        if pressed(Key::Period) {
            self.step();
        }
        if pressed(Key::R) {
            self.link.restart();
        }
        if pressed(Key::P) {
            self.tool = Tool::Picture;
        }
        if pressed(Key::C) {
            self.tool = Tool::Camera;
        }
        if pressed(Key::F) {
            self.view.fit();
        }
        if pressed(Key::Num1) {
            self.view.actual_size();
        }
        // More than one press can fall into a frame.
        let presses = |key| ctx.input(|input| input.num_presses(key)) as f32;
        self.display.exposure += 0.5 * (presses(Key::CloseBracket) - presses(Key::OpenBracket));
        if pressed(Key::Home) {
            self.reset_camera();
        }
    }
}
