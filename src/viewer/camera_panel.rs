//! The camera, by numbers.
use egui::{Button, DragValue, RichText, Slider, SliderClamping};
use glam::DVec3;

use super::{
    app::App,
    look::{controls, row},
};

impl App {
    pub(super) fn camera_panel(&mut self, ui: &mut egui::Ui) {
        let speed = self.opened.as_ref().map_or(0.01, |opened| opened.scene.size * 0.002);
        let camera = &mut self.camera;
        controls(ui, "camera", |ui| {
            row(ui, "Eye", "Where the camera stands, in metres: x, y (up), z.", |ui, label| {
                point(ui, label, &mut camera.eye, speed);
            });
            row(ui, "Look at", "The point in the middle of the picture.", |ui, label| {
                point(ui, label, &mut camera.look_at, speed);
            });
            row(ui, "Up", "The direction that is up in the picture.", |ui, label| point(ui, label, &mut camera.up, 0.01));
            row(ui, "Field of view", "The full angle across the picture's width.", |ui, label| {
                ui.add(Slider::new(&mut camera.fov, 1.0..=170.0).clamping(SliderClamping::Edits).suffix("°").max_decimals(2))
                    .labelled_by(label);
            });
            row(ui, "Resolution", "Width and height in pixels.", |ui, label| {
                ui.horizontal(|ui| {
                    let [width, height] = &mut camera.resolution;
                    let side =
                        |value| DragValue::new(value).range(1..=noisefall::scene::Camera::MOST_SIDE).update_while_editing(false);
                    ui.add(side(width)).labelled_by(label).on_hover_text("Width");
                    ui.label("×");
                    ui.add(side(height)).labelled_by(label).on_hover_text("Height");
                });
            });
        });
        if let Err(error) = self.camera.check() {
            ui.label(RichText::new(error.to_string()).color(ui.visuals().error_fg_color));
        }
        let moved = self.opened.as_ref().is_some_and(|opened| opened.scene.camera != self.camera);
        let reset = ui.add_enabled(moved, Button::new("Back to the scene's camera"));
        if reset.on_hover_text("The camera the scene opened with (Home)").clicked() {
            self.reset_camera();
        }
    }
}

fn point(ui: &mut egui::Ui, label: egui::Id, p: &mut DVec3, speed: f64) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for coordinate in [&mut p.x, &mut p.y, &mut p.z] {
            let value = DragValue::new(coordinate).speed(speed).max_decimals(3).range(-1e12..=1e12);
            ui.add_sized([62.0, 20.0], value).labelled_by(label);
        }
    });
}
