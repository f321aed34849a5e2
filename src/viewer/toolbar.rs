//! The buttons above the picture.
use egui::{Button, Key};

use super::{app::App, canvas::Tool, dock::Tab, save_dialog::Target};

const TOOLS: [(Tool, &str, &str); 4] = [
    (Tool::Picture, "Picture", "Drag pans the picture and the wheel magnifies it. Never restarts the render. (P)"),
    (
        Tool::Camera,
        "Camera",
        "Drag orbits, right-drag pans and the wheel dollies the camera. Every move starts a new picture. (C)",
    ),
    (Tool::Region, "Region", "Drag marks a rectangle that is rendered before the rest. Never restarts the render. (G)"),
    (Tool::Inspect, "Inspect", "Click a pixel to see its samples and the paths they came by. (I)"),
];

/// Keys that choose a tool.
const TOOL_KEYS: [(Key, Tool); 4] =
    [(Key::P, Tool::Picture), (Key::C, Tool::Camera), (Key::G, Tool::Region), (Key::I, Tool::Inspect)];

/// Keys that open an instrument or close it.
const TAB_KEYS: [(Key, Tab); 4] =
    [(Key::F2, Tab::Convergence), (Key::F3, Tab::Compare), (Key::F4, Tab::Bounces), (Key::F5, Tab::Path)];

impl App {
    pub(super) fn toolbar(&mut self, ui: &mut egui::Ui) {
        const WHOLE: f32 = 865.0;
        const OF_REGION: f32 = 56.0;
        const OF_ENDS: f32 = 104.0;
        let needed = WHOLE + if self.budget.region.is_some() { OF_REGION } else { 0.0 };
        let is_narrow = ui.available_width() < needed;
        let contents = |ui: &mut egui::Ui| {
            ui.spacing_mut().button_padding = egui::vec2(6.0, 4.0);
            self.render_buttons(ui);
            ui.separator();
            self.tool_buttons(ui);
            ui.separator();
            self.home_button(ui);
            if self.shown.is_some() {
                self.zoom_buttons(ui);
            }
            ui.separator();
            self.compare_menu(ui).into_iter().for_each(|other| self.start_comparison(other));
            if !is_narrow {
                ui.add_space((ui.available_width() - OF_ENDS).max(0.0));
            }
            self.save_and_help(ui);
        };
        if is_narrow {
            ui.horizontal_wrapped(contents);
        } else {
            ui.horizontal(contents);
        }
    }

    fn save_and_help(&mut self, ui: &mut egui::Ui) {
        let save = ui.add_enabled(self.can_save(), Button::new("Save…"));
        if save.on_hover_text("Save the picture as PNG or EXR (Ctrl+S)").clicked() {
            self.open_save_dialog(Target::Picture);
        }
        if ui.button("Help").on_hover_text("Keyboard and mouse (F1)").clicked() {
            self.help_open = !self.help_open;
        }
    }

    fn render_buttons(&mut self, ui: &mut egui::Ui) {
        let open = self.opened.is_some();
        let label = if self.budget.paused { "Resume" } else { "Pause" };
        let pause = ui.add_enabled(open, Button::new(label).min_size(egui::vec2(66.0, 0.0)));
        if pause.on_hover_text("Stop and go on without losing samples (Space)").clicked() {
            self.toggle_pause();
        }
        let step = ui.add_enabled(open, Button::new("Step"));
        if step
            .on_hover_text(
                "Pause, and take one sample per pixel: of every pixel, of the region, or where noise is if Adaptive is on (.)",
            )
            .clicked()
        {
            self.step();
        }
        let restart = ui.add_enabled(open, Button::new("Restart"));
        if restart.on_hover_text("Throw all samples away and start over (R)").clicked() {
            self.link.restart();
        }
    }

    fn tool_buttons(&mut self, ui: &mut egui::Ui) {
        for (tool, name, doc) in TOOLS {
            if ui.selectable_value(&mut self.tool, tool, name).on_hover_text(doc).clicked() && tool == Tool::Inspect {
                self.dock = Some(Tab::Path);
            }
        }
        if self.budget.region.is_some() {
            let clear = ui.button("Clear").on_hover_text("Clear the region and go on with the whole picture (Esc)");
            if clear.clicked() {
                self.budget.region = None;
            }
        }
    }

    fn home_button(&mut self, ui: &mut egui::Ui) {
        let home = ui.add_enabled(self.opened.is_some(), Button::new("Home"));
        if home.on_hover_text("Go back to the camera that the scene opens with (Home)").clicked() {
            self.reset_camera();
        }
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
            self.open_save_dialog(Target::Picture);
        }
        if ctx.input(|input| input.key_pressed(Key::Escape)) {
            self.escape();
        }
        if ctx.input(|input| input.key_pressed(Key::F1)) {
            self.help_open = !self.help_open;
        }
        if ctx.input(|input| input.key_pressed(Key::F6)) {
            self.gallery.open = !self.gallery.open;
        }
        if ctx.input(|input| input.key_pressed(Key::F12)) {
            self.pace.shown = !self.pace.shown;
        }
        for (key, tab) in TAB_KEYS {
            if ctx.input(|input| input.key_pressed(key)) && self.opened.is_some() {
                self.toggle_tab(tab);
            }
        }
        let pressed = |key| ctx.input(|input| input.key_pressed(key) && !input.modifiers.any());
        // Whatever has the keyboard: only in text this key is the cursor's.
        if pressed(Key::Home) && !ctx.text_edit_focused() {
            self.reset_camera();
        }
        if ctx.egui_wants_keyboard_input() || self.has_dialog() || self.opened.is_none() {
            return;
        }
        if pressed(Key::Space) {
            self.toggle_pause();
        }
        if pressed(Key::Period) {
            self.step();
        }
        if pressed(Key::R) {
            self.link.restart();
        }
        for (key, tool) in TOOL_KEYS {
            if pressed(key) {
                self.tool = tool;
                if tool == Tool::Inspect {
                    self.dock = Some(Tab::Path);
                }
            }
        }
        if pressed(Key::V) {
            self.next_view(false);
        }
        if ctx.input(|input| input.key_pressed(Key::V) && input.modifiers.shift_only()) {
            self.next_view(true);
        }
        if pressed(Key::F) {
            self.view.fit();
        }
        if pressed(Key::Num1) {
            self.view.actual_size();
        }
        // More than one press can fall into a frame.
        let presses = |key| ctx.input(|input| input.num_presses(key)) as f32;
        self.look.display.exposure += 0.5 * (presses(Key::CloseBracket) - presses(Key::OpenBracket));
    }

    /// Whether something waits for an answer: keys are its own then.
    pub(super) fn has_dialog(&self) -> bool {
        self.save_dialog.is_some() || self.open_dialog.is_some() || self.scene_error.is_some()
    }

    /// Closes what lies over the picture: of several things all dialogs first, then messages, then the region.
    fn escape(&mut self) {
        // Escape gives the edit of a field up, and nothing else.
        if self.had_focus {
            return;
        }
        if self.adviser.take().is_some() || self.end_tour() {
            return;
        }
        if self.help_open || self.gallery.open || self.has_dialog() {
            (self.help_open, self.gallery.open, self.scene_error) = (false, false, None);
            (self.save_dialog, self.open_dialog) = (None, None);
        } else if !self.notices.is_empty() {
            self.notices.clear();
        } else {
            self.budget.region = None;
        }
    }
}
