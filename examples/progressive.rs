//! Shows an image in an egui window while it is rendered. Drag to turn the camera around the scene.
//!
//!     cargo run --release --example progressive -- scenes/glass_and_mirror.toml
use std::{env::args_os, error::Error, path::Path, sync::Arc};

use eframe::egui;
use glam::DQuat;
use noisefall::{Display, Publish, RenderRequest, Renderer, SimdLevel, Threads, built_in, load, to_srgb};

struct Window {
    renderer: Renderer,
    generation: u64,
    request: RenderRequest,
    texture: Option<egui::TextureHandle>,
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        // Never waits. The first frames of a new generation are coarse.
        let published = self.renderer.latest();
        let frame = &published.frame;
        let mut pixels = Vec::new();
        to_srgb(&frame.radiance, Display::default(), &mut pixels);
        let image =
            egui::ColorImage::from_rgba_unmultiplied([frame.width as usize, frame.height as usize], pixels.as_flattened());
        let texture = ui.ctx().load_texture("frame", image, egui::TextureOptions::NEAREST);
        let size = egui::Vec2::from(self.request.camera.resolution.map(|side| side as f32));
        // Leaves room for the line of text below.
        let room = ui.available_size() - egui::vec2(0.0, 24.0);
        let size = size * (room / size).min_elem();
        let dragged = ui.add(egui::Image::new((texture.id(), size)).sense(egui::Sense::drag())).drag_delta();
        self.texture = Some(texture);
        ui.label(format!("{} samples per pixel", published.status.spp));
        if dragged.x != 0.0 {
            let camera = &mut self.request.camera;
            let turn = DQuat::from_axis_angle(camera.up.normalize(), f64::from(-0.01 * dragged.x));
            camera.eye = camera.look_at + turn * (camera.eye - camera.look_at);
            // The new generation cancels the one that is being rendered.
            self.generation += 1;
            self.renderer.submit(self.generation, self.request.clone());
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Arc::new(args_os().nth(1).map_or_else(|| Ok(built_in()), |path| load(Path::new(&path)))?);
    let threads = Threads::new(0, SimdLevel::best())?;
    let create = |context: &eframe::CreationContext| -> Result<Box<dyn eframe::App>, _> {
        let ctx = context.egui_ctx.clone();
        let renderer = Renderer::new(threads, Publish::Live, move || ctx.request_repaint());
        let (camera, settings) = (scene.camera, scene.settings);
        let request = RenderRequest { scene, camera, settings };
        renderer.submit(1, request.clone());
        Ok(Box::new(Window { renderer, generation: 1, request, texture: None }))
    };
    Ok(eframe::run_native("Progressive", eframe::NativeOptions::default(), Box::new(create))?)
}
