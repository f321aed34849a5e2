//! The tab of the path inspector: a pixel, its samples, and the vertices of one path.
use egui::{RichText, ScrollArea, Ui, scroll_area::ScrollBarVisibility};
use noisefall_base::math::colour::luminance;
use noisefall_kernel::integrator::Replay;
use noisefall_render::render::{Frame, RenderRequest};
use noisefall_scene::scene::Object;

use super::{cells::Channel, copying, histogram, inspector::PathInspector, strategies, table};
use crate::viewer::{
    instruments::light_paths,
    widgets::{number, palette::Palette},
};

/// Width of the column of samples, points.
const SAMPLES: f32 = 352.0;
/// Below this width the path stands under the samples, and not beside them.
const NARROW: f32 = 640.0;

/// The image that is inspected.
pub struct Subject<'a> {
    /// Its request to the renderer.
    pub request: Option<&'a RenderRequest>,
    /// The frame on the screen.
    pub frame: Option<&'a Frame>,
    /// The letter of its side of a comparison.
    pub side: Option<&'static str>,
    pub resolution: [u32; 2],
}

/// Shows what the inspector has traced. Returns whether to save the path or its samples.
pub fn show(ui: &mut Ui, inspector: &mut PathInspector, subject: &Subject) -> bool {
    let Subject { request, resolution, .. } = *subject;
    let Some(pixel) = inspector.pixel else {
        ui.label("Click a pixel of the image to see its samples and their paths.");
        if ui.button("Use the middle pixel").clicked() {
            inspector.look_at(resolution.map(|side| side / 2));
        }
        return false;
    };
    if ui.available_width() < NARROW {
        let scroll = ScrollArea::both().auto_shrink(false);
        return scroll
            .show(ui, |ui| {
                ui.set_max_width(SAMPLES);
                let saves = samples(ui, inspector, pixel, subject);
                ui.separator();
                path(ui, inspector, request, |ui, replay, objects, channel| terms(ui, replay, objects, channel, SAMPLES));
                saves
            })
            .inner;
    }
    let left = egui::Panel::left("pixel").resizable(false).exact_size(SAMPLES);
    let column = |ui: &mut Ui| ScrollArea::vertical().show(ui, |ui| samples(ui, inspector, pixel, subject)).inner;
    let saves = left.show(ui, column).inner;
    egui::Frame::new().inner_margin(egui::Margin { left: 8, ..egui::Margin::ZERO }).show(ui, |ui| {
        path(ui, inspector, request, |ui, replay, objects, channel| {
            // The bar has room of its own: it would lie over the last column.
            let style = &mut ui.spacing_mut().scroll;
            style.floating_allocated_width = style.bar_width;
            let room = ui.available_width() - ui.spacing().scroll.allocated_width();
            let scroll = ScrollArea::both().auto_shrink(false).scroll_bar_visibility(ScrollBarVisibility::AlwaysVisible);
            _ = scroll.show(ui, |ui| terms(ui, replay, objects, channel, room));
        });
    });
    saves
}

/// Shows the pixel and its samples. Returns whether to save them or the path.
fn samples(ui: &mut Ui, inspector: &mut PathInspector, pixel: [u32; 2], subject: &Subject) -> bool {
    pixel_choice(ui, inspector, pixel, subject.side, subject.resolution);
    if let Some(frame) = subject.frame {
        estimate(ui, frame, pixel);
    }
    sample_column(ui, inspector, subject.request)
}

/// Shows the path of the chosen sample, with its table.
fn path(
    ui: &mut Ui,
    inspector: &mut PathInspector,
    request: Option<&RenderRequest>,
    show_table: impl FnOnce(&mut Ui, &Replay, &[Object], Channel),
) {
    if let Some(failure) = inspector.failure() {
        let text = format!("{failure}. Please report it with the command in the status line.");
        ui.label(RichText::new(text).color(ui.bad()));
        return;
    }
    let mut channel = inspector.channel;
    let Some((sample, replay)) = inspector.replay() else {
        ui.weak("Tracing the samples of this pixel …");
        return;
    };
    let objects = request.map_or(&[][..], |request| &request.scene.objects);
    table::heading(ui, sample, replay, &mut channel);
    show_table(ui, replay, objects, channel);
    inspector.channel = channel;
}

/// Shows the terms of a sample in a width: of its strategies if there are light paths, or else of its vertices.
fn terms(ui: &mut Ui, replay: &Replay, objects: &[Object], channel: Channel, room: f32) {
    match &replay.bidirectional {
        Some(both) => strategies::show(ui, both, replay.radiance, objects, channel),
        None => table::show(ui, replay, objects, channel, room),
    }
}

fn pixel_choice(ui: &mut Ui, inspector: &mut PathInspector, pixel: [u32; 2], side: Option<&str>, [width, height]: [u32; 2]) {
    let mut at = pixel;
    ui.horizontal(|ui| {
        let name = side.map_or_else(|| "Pixel".to_owned(), |side| format!("Pixel of {side}"));
        ui.label(name).on_hover_text("Column and row from the top left. Click the image to choose another pixel.");
        for (axis, name, most) in [(0, "x", width), (1, "y", height)] {
            let label = ui.weak(name);
            let field = number::field(ui, &mut at[axis], 0, 0.0..=f64::from(most.saturating_sub(1)));
            ui.add(field).labelled_by(label.id);
        }
    });
    if at != pixel {
        inspector.look_at(at);
    }
}

/// Shows the estimate of the pixel.
fn estimate(ui: &mut Ui, frame: &Frame, pixel: [u32; 2]) {
    if let Some(index) = frame.index_at(pixel) {
        let y = luminance(frame.radiance[index]);
        let error = Some(frame.standard_error[index]).filter(|error| error.is_finite());
        let error = error.map_or_else(String::new, |error| format!(" ± {error:.4}"));
        ui.label(format!("L = {y:.4}{error}, N = {}", frame.spp_at(index)))
            .on_hover_text("Luminance of the displayed image, its standard error, and the number of samples.");
    }
}

/// Shows the samples of the pixel. Returns whether to save them or the path.
fn sample_column(ui: &mut Ui, inspector: &mut PathInspector, request: Option<&RenderRequest>) -> bool {
    sample_choice(ui, inspector);
    let Some(histogram) = inspector.histogram() else { return false };
    if let Some(sample) = histogram::show(ui, histogram, inspector.sample) {
        inspector.sample = sample;
    }
    let saves = request.is_some_and(|request| copying::show(ui, inspector, request));
    let traces_light_paths = request.is_some_and(|request| light_paths::are_traced(&request.scene, &request.settings));
    if traces_light_paths {
        ui.weak("Samples lack the light that light paths bring to this pixel from others (t = 1).");
    }
    ui.weak("Overlay: the path in yellow, with rings at vertices that the camera does not see; light samples in blue, faint if occluded.");
    if traces_light_paths {
        ui.weak("The light path is orange. Dashes connect both paths where nothing lies between.");
    }
    saves
}

/// Chooses the sample whose path is shown.
fn sample_choice(ui: &mut Ui, inspector: &mut PathInspector) {
    let brightest = inspector.histogram().map(|histogram| histogram.brightest);
    let sample = &mut inspector.sample;
    ui.horizontal(|ui| {
        let label = ui.label("Sample").on_hover_text("Sample index. The pixel and this index determine the path completely.");
        if ui.add_enabled(*sample > 0, egui::Button::new("Previous")).on_hover_text("Goes to the previous sample.").clicked() {
            *sample -= 1;
        }
        let field = number::field(ui, sample, 0, 0.0..=f64::from(u32::MAX));
        ui.add(field).labelled_by(label.id);
        if ui.button("Next").on_hover_text("Goes to the next sample.").clicked() {
            *sample = sample.saturating_add(1);
        }
        if let Some(brightest) = brightest
            && ui
                .button("Brightest")
                .on_hover_text("Goes to the sample with the highest luminance, which causes the most noise.")
                .clicked()
        {
            *sample = brightest;
        }
    });
}
