//! The scenes as images, to open with a click.
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

use crossbeam_channel::{Receiver, TryRecvError, unbounded};
use egui::{Align2, ColorImage, Response, RichText, ScrollArea, Sense, TextureHandle, TextureOptions, Ui, Vec2, vec2};
use include_dir::{Dir, include_dir};
use noisefall_render::render::{Display, image_file, tone::to_srgb};
use noisefall_scene::scene::ShippedScene;

use super::question::hold_keyboard;
use crate::viewer::background::catalogue::{BUILT_IN_NAME, CatalogueEntry, SceneRequest, open_entry};

/// Of a card: its image, and below it two lines of text.
const PICTURE: Vec2 = Vec2 { x: 164.0, y: 112.0 };
const TEXT: f32 = 36.0;
/// Between two cards of a row.
const GAP: f32 = 12.0;
/// Stands in the place of an image.
const NO_PICTURE: &str = "no image";

/// Images of scenes, read off the UI thread when they are first looked at.
#[derive(Default)]
pub struct Gallery {
    pub open: bool,
    /// The card of the open scene is still to be given the keyboard.
    takes_keyboard: bool,
    /// The last frame in which it was shown.
    last_frame: Option<u64>,
    pictures: HashMap<PathBuf, TextureHandle>,
    arriving: Option<Receiver<(PathBuf, ColorImage)>>,
    /// All images that exist have arrived.
    is_complete: bool,
}

impl Gallery {
    /// How many images have been read.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.pictures.len()
    }

    /// Whether all images that exist have been read.
    #[cfg(test)]
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// Has the images read, once, and takes in those that are there.
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
                drop(sender);
                ctx.request_repaint();
            });
            receiver
        });
        while !self.is_complete {
            match arriving.try_recv() {
                Ok((scene, picture)) => {
                    let texture = ctx.load_texture(scene.display().to_string(), picture, TextureOptions::LINEAR);
                    self.pictures.insert(scene, texture);
                }
                Err(TryRecvError::Disconnected) => self.is_complete = true,
                Err(TryRecvError::Empty) => break,
            }
        }
    }

    /// Shows the gallery. The card of the open scene has the keyboard at first: that of the built-in one if there is no
    /// file.
    pub fn show(&mut self, ctx: &egui::Context, catalogue: &[CatalogueEntry], current: Option<&Path>) -> Option<SceneRequest> {
        let frame = ctx.cumulative_frame_nr();
        self.takes_keyboard |= self.last_frame.replace(frame).is_none_or(|last| last + 1 < frame);
        let current = open_entry(catalogue, current).map(|entry| &*entry.path);
        self.receive(ctx, catalogue.iter().map(|entry| entry.path.clone()));
        let (mut open, mut request) = (true, None);
        let room = ctx.content_rect().size() - vec2(80.0, 120.0);
        let columns = columns(room.x);
        egui::Window::new("Scenes")
            .open(&mut open)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .show(ctx, |ui| {
                hold_keyboard(ui);
                // Nothing takes the keyboard while egui measures the window.
                let focused = (self.takes_keyboard && ui.is_enabled()).then_some(current);
                self.takes_keyboard &= !ui.is_enabled();
                // The bar has room of its own: it would lie over the last cards.
                let scroll = &mut ui.spacing_mut().scroll;
                scroll.floating_allocated_width = scroll.bar_width;
                // As tall at once as it will be: the window is centred by its last size.
                ScrollArea::vertical().max_height(room.y).min_scrolled_height(room.y).show(ui, |ui| {
                    request = self.cards(ui, catalogue, columns, focused).map(SceneRequest::Open);
                });
                ui.add_space(4.0);
                if ui.button("Open a file…").on_hover_text("Opens another scene file.").clicked() {
                    request = Some(SceneRequest::Browse);
                }
            });
        self.open = open && request.is_none();
        request
    }

    /// Returns the scene that was chosen; `Some(None)` is the built-in one, if no card has the same. The card of `focused` is given the keyboard.
    fn cards(
        &self,
        ui: &mut Ui,
        catalogue: &[CatalogueEntry],
        columns: usize,
        focused: Option<Option<&Path>>,
    ) -> Option<Option<PathBuf>> {
        let mut chosen = None;
        let is_listed = open_entry(catalogue, None).is_some();
        if !is_listed && self.card(ui, BUILT_IN_NAME, None, focused == Some(None)).clicked() {
            chosen = Some(None);
        }
        for chapter in catalogue.chunk_by(|a, b| a.chapter == b.chapter) {
            let title = chapter[0].chapter;
            ui.label(RichText::new(title).strong());
            egui::Grid::new(title).spacing([GAP, 8.0]).show(ui, |ui| {
                for (number, entry) in chapter.iter().enumerate() {
                    let takes_keyboard = focused.is_some_and(|focused| focused == Some(&*entry.path));
                    let card = self.card(ui, &entry.name, self.pictures.get(&entry.path), takes_keyboard);
                    if explained(card, &entry.notes).clicked() {
                        chosen = Some(Some(entry.path.clone()));
                    }
                    if (number + 1) % columns == 0 {
                        ui.end_row();
                    }
                }
            });
            ui.add_space(6.0);
        }
        chosen
    }

    /// An image with a name.
    fn card(&self, ui: &mut Ui, name: &str, picture: Option<&TextureHandle>, takes_keyboard: bool) -> Response {
        let (rect, response) = ui.allocate_exact_size(PICTURE + vec2(0.0, TEXT), Sense::click());
        if takes_keyboard {
            response.request_focus();
        }
        // The arrows go on in the same way.
        if takes_keyboard || response.gained_focus() {
            response.scroll_to_me(None);
        }
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
        let frame = egui::Rect::from_min_size(rect.min, PICTURE);
        match picture {
            Some(texture) => drop(ui.painter().image(texture.id(), frame, covering(texture.size_vec2()), egui::Color32::WHITE)),
            None if !self.is_complete => {}
            None => {
                ui.painter().rect_filled(frame, 3.0, ui.visuals().extreme_bg_color);
                let font = egui::FontId::proportional(13.0);
                ui.painter().text(frame.center(), Align2::CENTER_CENTER, NO_PICTURE, font, ui.visuals().weak_text_color());
            }
        }
        ui.painter().rect_stroke(frame, 0.0, ui.visuals().widgets.noninteractive.bg_stroke, egui::StrokeKind::Inside);
        if response.hovered() || response.has_focus() {
            ui.painter().rect_stroke(frame, 3.0, ui.visuals().widgets.hovered.fg_stroke, egui::StrokeKind::Outside);
        }
        let text = egui::Rect::from_min_max(frame.left_bottom() + vec2(0.0, 3.0), rect.max);
        let mut below = ui.new_child(egui::UiBuilder::new().max_rect(text));
        below.add(egui::Label::new(RichText::new(name).size(12.0)).selectable(false).wrap());
        response
    }
}

/// The number of cards beside each other in this width, in points.
fn columns(width: f32) -> usize {
    ((width / (PICTURE.x + GAP)).floor() as usize).clamp(1, 6)
}

/// A card with the notes of its scene as a tooltip.
fn explained(card: Response, notes: &str) -> Response {
    if notes.is_empty() { card } else { card.on_hover_text(notes) }
}

/// The images of the scenes in the program.
static PICTURES: Dir = include_dir!("$CARGO_MANIFEST_DIR/assets/gallery");

/// The image of a shipped scene: `assets/gallery/NAME.png` beside the folder that the scene is in, or in the program.
fn picture(scene: &Path) -> Option<ColorImage> {
    if let Some(shipped) = ShippedScene::of(scene) {
        let png = PICTURES.get_file(format!("{}.png", shipped.name))?.contents();
        let pixels = image::load_from_memory_with_format(png, image::ImageFormat::Png).ok()?.into_rgba8();
        return Some(ColorImage::from_rgba_unmultiplied([pixels.width() as usize, pixels.height() as usize], &pixels));
    }
    let folder = scene.parent()?.parent()?.join("assets").join("gallery");
    let picture = image_file::read(&folder.join(scene.file_stem()?).with_extension("png")).ok()?;
    let mut pixels = Vec::new();
    to_srgb(&picture.radiance, Display::default(), &mut pixels);
    Some(ColorImage::from_rgba_unmultiplied([picture.width as usize, picture.height as usize], pixels.as_flattened()))
}

/// The middle of an image that covers a card: no ground of another brightness shows beside it, whatever the theme.
fn covering(size: Vec2) -> egui::Rect {
    let part = PICTURE / size / (PICTURE / size).max_elem();
    egui::Rect::from_center_size(egui::pos2(0.5, 0.5), part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_images_in_the_program_are_those_of_the_folder() {
        let of_file =
            |name: &str| picture(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name).with_extension("toml"));
        let images = ShippedScene::all().into_iter().filter_map(|scene| Some((scene.name, picture(Path::new(scene.name))?)));
        let images: Vec<_> = images.collect();
        assert!(images.len() > 20);
        for (name, image) in images {
            assert!(of_file(name).is_some_and(|file| file.size == image.size && file.pixels == image.pixels), "{name}");
        }
    }

    #[test]
    fn a_row_has_as_many_cards_as_fit_but_at_least_one_and_at_most_six() {
        assert_eq!([0.0, 100.0, 351.0, 352.0, 900.0, 1056.0, 4000.0].map(columns), [1, 1, 1, 2, 5, 6, 6]);
    }
}
