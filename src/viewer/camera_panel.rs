//! The camera, by numbers.
use egui::{Button, DragValue, RichText, Slider};
use glam::DVec3;

use super::app::{App, row};

impl App {
    pub(super) fn camera_panel(&mut self, ui: &mut egui::Ui) {
        let speed = self.opened.as_ref().map_or(0.01, |opened| opened.scene.size * 0.002);
        egui::Grid::new("camera").num_columns(2).spacing([12.0, 8.0]).show(ui, |ui| {
            let camera = &mut self.camera;
            row(ui, "Eye", "Where the camera stands, in metres: x, y (up), z.", |ui| point(ui, &mut camera.eye, speed));
            row(ui, "Look at", "The point in the middle of the picture.", |ui| point(ui, &mut camera.look_at, speed));
            row(ui, "Up", "The direction that is up in the picture.", |ui| point(ui, &mut camera.up, 0.01));
            row(ui, "Field of view", "The full angle across the picture's width.", |ui| {
                ui.add(Slider::new(&mut camera.fov, 1.0..=170.0).suffix("°").fixed_decimals(1));
            });
            row(ui, "Resolution", "Width and height in pixels.", |ui| {
                ui.horizontal(|ui| {
                    let [width, height] = &mut camera.resolution;
                    let side =
                        |value| DragValue::new(value).range(1..=noisefall::scene::Camera::MOST_SIDE).update_while_editing(false);
                    ui.add(side(width)).on_hover_text("Width");
                    ui.label("×");
                    ui.add(side(height)).on_hover_text("Height");
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

fn point(ui: &mut egui::Ui, p: &mut DVec3, speed: f64) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for coordinate in [&mut p.x, &mut p.y, &mut p.z] {
            ui.add_sized([58.0, 20.0], DragValue::new(coordinate).speed(speed).max_decimals(3).range(-1e12..=1e12));
        }
    });
}
