//! The scenes as pictures, to open with a click.
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

use crossbeam_channel::{Receiver, unbounded};
use egui::{Align2, ColorImage, RichText, ScrollArea, Sense, TextureHandle, TextureOptions, Ui, Vec2, vec2};
use noisefall::render::{Display, image_file, tone::to_srgb};

use crate::viewer::background::{
    catalogue::{CatalogueEntry, SceneRequest},
    loader::BUILT_IN_NAME,
};

/// Of a card: its picture, and below it two lines of text.
const PICTURE: Vec2 = Vec2 { x: 164.0, y: 112.0 };
const TEXT: f32 = 36.0;

/// Pictures of scenes, read off the UI thread when they are first looked at.
#[derive(Default)]
pub struct Gallery {
    pub open: bool,
    pictures: HashMap<PathBuf, TextureHandle>,
    arriving: Option<Receiver<(PathBuf, ColorImage)>>,
}

impl Gallery {
    /// How many pictures have been read.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.pictures.len()
    }

    /// Has the pictures read, once, and takes in those that are there.
    fn receive(&mut self, ctx: &egui::Context, scenes: impl Iterator<Item = PathBuf>) {
        let arriving = self.arriving.get_or_insert_with(|| {
            let (sender, receiver) = unbounded();
            let (scenes, ctx): (Vec<PathBuf>, _) = (scenes.collect(), ctx.clone());
            std::thread::spawn(move || {
                for scene in scenes {
                    if let Some(picture) = picture(&scene) {
                        let _ = sender.send((scene, picture));
                        ctx.request_repaint();
                    }
                }
            });
            receiver
        });
        for (scene, picture) in arriving.try_iter() {
            let texture = ctx.load_texture(scene.display().to_string(), picture, TextureOptions::LINEAR);
            self.pictures.insert(scene, texture);
        }
    }

    /// Shows the gallery while it is open.
    pub fn show(&mut self, ctx: &egui::Context, catalogue: &[CatalogueEntry]) -> Option<SceneRequest> {
        if !self.open {
            return None;
        }
        self.receive(ctx, catalogue.iter().map(|entry| entry.path.clone()));
        let (mut open, mut request) = (true, None);
        let room = ctx.content_rect().size() - vec2(80.0, 120.0);
        let columns = ((room.x / (PICTURE.x + 12.0)).floor() as usize).clamp(1, 6);
        egui::Window::new("Scenes")
            .open(&mut open)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .show(ctx, |ui| {
                ScrollArea::vertical().max_height(room.y).show(ui, |ui| {
                    request = self.cards(ui, catalogue, columns).map(SceneRequest::Open);
                });
                ui.add_space(4.0);
                if ui.button("Open a file…").on_hover_text("A scene that is not shown here").clicked() {
                    request = Some(SceneRequest::Browse);
                }
            });
        self.open = open && request.is_none();
        request
    }

    /// Returns the scene that was chosen; `Some(None)` is the built-in one.
    fn cards(&self, ui: &mut Ui, catalogue: &[CatalogueEntry], columns: usize) -> Option<Option<PathBuf>> {
        let mut chosen = None;
        let built_in = catalogue.iter().find(|entry| entry.path.ends_with("cornell_spheres.toml"));
        let picture_of = |path: &PathBuf| self.pictures.get(path);
        let first = (BUILT_IN_NAME, None, built_in.and_then(|entry| picture_of(&entry.path)));
        let others = catalogue.iter().map(|entry| (entry.name.as_str(), Some(entry.path.clone()), picture_of(&entry.path)));
        egui::Grid::new("gallery").spacing([12.0, 12.0]).show(ui, |ui| {
            for (number, (name, path, picture)) in std::iter::once(first).chain(others).enumerate() {
                if card(ui, name, picture) {
                    chosen = Some(path);
                }
                if (number + 1) % columns == 0 {
                    ui.end_row();
                }
            }
        });
        chosen
    }
}

/// The picture of a shipped scene: `assets/gallery/NAME.png` beside the folder that the scene is in.
fn picture(scene: &Path) -> Option<ColorImage> {
    let folder = scene.parent()?.parent()?.join("assets").join("gallery");
    let picture = image_file::read(&folder.join(scene.file_stem()?).with_extension("png")).ok()?;
    let mut pixels = Vec::new();
    to_srgb(&picture.radiance, Display::default(), &mut pixels);
    Some(ColorImage::from_rgba_unmultiplied([picture.width as usize, picture.height as usize], pixels.as_flattened()))
}

/// A picture with a name. Returns whether it was clicked.
fn card(ui: &mut Ui, name: &str, picture: Option<&TextureHandle>) -> bool {
    let (rect, response) = ui.allocate_exact_size(PICTURE + vec2(0.0, TEXT), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    let frame = egui::Rect::from_min_size(rect.min, PICTURE);
    ui.painter().rect_filled(frame, 3.0, ui.visuals().extreme_bg_color);
    if let Some(texture) = picture {
        let size = texture.size_vec2();
        let fitted = egui::Rect::from_center_size(frame.center(), size * (PICTURE / size).min_elem());
        ui.painter().image(
            texture.id(),
            fitted,
            egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0)),
            egui::Color32::WHITE,
        );
    }
    if response.hovered() || response.has_focus() {
        ui.painter().rect_stroke(frame, 3.0, ui.visuals().widgets.hovered.fg_stroke, egui::StrokeKind::Outside);
    }
    let text = egui::Rect::from_min_max(frame.left_bottom() + vec2(0.0, 3.0), rect.max);
    let mut below = ui.new_child(egui::UiBuilder::new().max_rect(text));
    below.add(egui::Label::new(RichText::new(name).size(12.0)).selectable(false).wrap());
    response.on_hover_text(name).clicked()
}
