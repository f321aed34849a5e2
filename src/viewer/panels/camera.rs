//! The panel of the camera's numbers.
use egui::{Button, Label, RichText, vec2};
use glam::DVec3;
use noisefall_scene::scene::{Camera, Lens, Scene, description::CameraDescription};

use crate::viewer::widgets::{
    kinds::{kinds, number_rows},
    number,
    quotation::with_quotation_marks,
    refusal,
    slider::{self, Scale},
    style::{controls, row},
};

/// Height of two lines of an error, points.
const ERROR_HEIGHT: f32 = 26.0;
/// The angle of view without a scene, degrees.
const DEFAULT_FOV: f64 = 40.0;

/// Returns whether the camera is to be reset to that of the scene.
pub fn show(ui: &mut egui::Ui, camera: &mut Camera, scene: Option<&Scene>) -> bool {
    let speed = scene.map_or(0.01, |scene| scene.size * 0.002);
    controls(ui, "camera", |ui| {
        row(ui, &CameraDescription::EYE.label(), "Position of the camera: x, y (up), z, in metres.", |ui, label| {
            _ = point(ui, label, &mut camera.eye, speed);
        });
        row(ui, &CameraDescription::LOOK_AT.label(), "Point in the middle of the image, in metres.", |ui, label| {
            _ = point(ui, label, &mut camera.look_at, speed);
        });
        row(ui, &CameraDescription::UP.label(), "Direction that is up in the image.", |ui, label| {
            let before = camera.up;
            let field = point(ui, label, &mut camera.up, 0.01);
            if let Some(field) = field.filter(|_| camera.up == DVec3::ZERO) {
                camera.up = before;
                // Its two other numbers are zero.
                refusal::remember(ui, field, before.element_sum(), "A direction must not be zero.".to_owned());
            }
        });
        projection(ui, camera, scene.map_or(DEFAULT_FOV, |scene| scene.camera.fov));
        lens(ui, camera, speed);
        row(ui, &CameraDescription::FILTER.label(), "Weight of the light around the centre of a pixel.", |ui, _| {
            ui.horizontal(|ui| kinds(ui, &mut camera.filter));
        });
        number_rows(ui, &mut camera.filter);
        row(ui, &CameraDescription::RESOLUTION.label(), "Width and height of the image in pixels.", |ui, label| {
            ui.horizontal(|ui| {
                let [width, height] = &mut camera.resolution;
                let range = 1.0..=f64::from(Camera::MOST_SIDE);
                let side = number::field(ui, width, 0, range.clone());
                ui.add(side).labelled_by(label).on_hover_text("Width");
                ui.label("×");
                let side = number::field(ui, height, 0, range);
                ui.add(side).labelled_by(label).on_hover_text("Height");
            });
        });
    });
    ui.add_space(4.0);
    let moved = scene.is_some_and(|scene| Camera { resolution: camera.resolution, ..scene.camera } != *camera);
    let reset = ui.add_enabled(moved, Button::new("Back to the scene's camera"));
    let resets = reset.on_hover_text("Resets the camera to that of the scene, except for the resolution. (Home)").clicked();
    // Room for an error, whether or not there is one: what is below stays where it is.
    ui.allocate_ui(vec2(ui.available_width(), ERROR_HEIGHT), |ui| {
        ui.set_min_height(ERROR_HEIGHT);
        if let Err(error) = camera.check() {
            let error = RichText::new(with_quotation_marks(&error.to_string())).small();
            ui.add(Label::new(error.color(ui.visuals().error_fg_color)).wrap());
        }
    });
    resets
}

/// A double click gives the angle of view its default.
fn projection(ui: &mut egui::Ui, camera: &mut Camera, default_fov: f64) {
    let before = *camera;
    row(ui, &CameraDescription::PROJECTION.label(), "Rays through one point, or parallel rays.", |ui, _| {
        ui.horizontal(|ui| kinds(ui, &mut camera.projection));
    });
    if camera.projection != before.projection {
        camera.projection = camera.projection.with_width(before.width_at_look_at());
        camera.lens = camera.lens.filter(|_| camera.projection.takes_lens());
    }
    row(ui, &CameraDescription::FOV.label(), "Full horizontal angle of view.", |ui, label| {
        let has_angle = camera.projection.has_angle();
        slider::show(ui, &mut camera.fov, &Scale::linear(1.0..=170.0), default_fov, |ui, fov| {
            let slider = number::slider(ui, fov, 2, 1.0..=170.0).suffix("°");
            ui.add_enabled(has_angle, slider).labelled_by(label)
        });
    });
    number_rows(ui, &mut camera.projection);
}

fn lens(ui: &mut egui::Ui, camera: &mut Camera, speed: f64) {
    let distance = camera.eye.distance(camera.look_at);
    let takes_lens = camera.projection.takes_lens();
    let mut lens = camera.lens.unwrap_or(Lens { radius: 0.0, focus: distance });
    row(
        ui,
        &Lens::RADIUS.label(),
        "Radius in metres. A wide lens blurs what is out of focus; 0 is a pinhole. Orthographic cameras have no lens.",
        |ui, label| {
            let radius = number::field(ui, &mut lens.radius, 4, 0.0..=1e9).speed(0.05 * speed).suffix(" m");
            ui.add_enabled(takes_lens, radius).labelled_by(label);
        },
    );
    row(ui, &Lens::FOCUS.label(), "Distance of the plane in focus, in metres. A pinhole has none.", |ui, label| {
        ui.add_enabled_ui(takes_lens && lens.radius > 0.0, |ui| {
            ui.horizontal(|ui| {
                let focus = number::field(ui, &mut lens.focus, 3, 1e-9..=1e12).speed(speed).suffix(" m");
                ui.add(focus).labelled_by(label);
                if ui.button("Focus on look-at point").on_hover_text("Focuses on the point in the middle of the image.").clicked()
                {
                    lens.focus = distance;
                }
            });
        });
    });
    camera.lens = (lens.radius > 0.0).then_some(lens);
}

/// Returns the field whose number was changed.
fn point(ui: &mut egui::Ui, label: egui::Id, p: &mut DVec3, speed: f64) -> Option<egui::Id> {
    let mut changed = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for coordinate in [&mut p.x, &mut p.y, &mut p.z] {
            let value = number::field(ui, coordinate, 3, -1e12..=1e12).speed(speed);
            let field = ui.add_sized([62.0, 20.0], value).labelled_by(label);
            changed = changed.or(field.changed().then_some(field.id));
        }
    });
    changed
}
