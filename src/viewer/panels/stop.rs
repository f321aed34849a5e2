//! The panel of stopping targets and of the region. None of them restarts the render.
use std::time::Duration;

use egui::Ui;
use noisefall_render::render::{Budget, Region};
use noisefall_scene::scene::description::RenderDescription;

use crate::viewer::widgets::{
    number,
    style::{controls, row},
};

const DEFAULT_SPP: u32 = 1024;
const DEFAULT_SECONDS: f64 = 60.0;
const DEFAULT_PERCENT: f64 = 1.0;

pub fn show(ui: &mut Ui, budget: &mut Budget, resolution: [u32; 2]) {
    controls(ui, "stop", |ui| {
        row(
            ui,
            &RenderDescription::SPP.label(),
            "Samples per pixel N at which the render stops. Does not restart it.",
            |ui, label| {
                number::optional(ui, label, &mut budget.max_spp, ("never", "spp"), DEFAULT_SPP, 0, 1.0..=16_777_216.0);
            },
        );
        row(ui, "Stop after", "Render time after which the render stops. Does not restart it.", |ui, label| {
            let before = budget.max_time.map(|time| time.as_secs_f64());
            let mut seconds = before;
            number::optional(ui, label, &mut seconds, ("never", "seconds"), DEFAULT_SECONDS, 1, 0.1..=1e7);
            if seconds != before {
                budget.max_time = seconds.map(Duration::from_secs_f64);
            }
        });
        row(
            ui,
            "Stop below",
            "Estimated relative error at which the render stops, from 64 samples per pixel on. The stop depends on the samples, so it adds a bias far below the target. Does not restart the render.",
            |ui, label| {
                let before = budget.noise.map(|noise| 100.0 * noise);
                let mut percent = before;
                number::optional(ui, label, &mut percent, ("never", "% error"), DEFAULT_PERCENT, 3, 0.001..=100.0);
                // There and back, rounding could make another number of it.
                if percent != before {
                    budget.noise = percent.map(|percent| percent / 100.0);
                }
            },
        );
        row(ui, "Region", "Tiles that are rendered first. Drag a rectangle with the tool Region (B).", |ui, label| {
            region(ui, label, &mut budget.region, resolution);
        });
    });
}

fn region(ui: &mut Ui, label: egui::Id, region: &mut Option<Region>, [width, height]: [u32; 2]) {
    ui.horizontal(|ui| {
        let mut present = region.is_some();
        if ui.checkbox(&mut present, "").labelled_by(label).changed() {
            *region = present.then(|| Region::between([width / 4, height / 4], [width * 3 / 4, height * 3 / 4]));
        }
        let Some(region) = region else {
            ui.weak("none");
            return;
        };
        let before = *region;
        ui.spacing_mut().item_spacing.x = 3.0;
        let most = [f64::from(width), f64::from(height)];
        for (corner, what) in [(&mut region.from, "from"), (&mut region.to, "to")] {
            for (axis, name) in ["x", "y"].into_iter().enumerate() {
                let field = number::field(ui, &mut corner[axis], 0, 0.0..=most[axis]);
                let name = format!("{name} {what}, in pixels");
                let field = ui.add_sized([40.0, 20.0], field).on_hover_text(&name);
                ui.ctx().accesskit_node_builder(field.id, |node| node.set_label(name));
            }
        }
        if (0..2).any(|axis| region.from[axis] >= region.to[axis]) {
            *region = before;
        }
    });
}
