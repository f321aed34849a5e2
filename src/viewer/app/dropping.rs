//! Files that were dropped on the window: scenes, meshes, textures, skies and references.
use std::path::Path as FilePath;

use glam::DVec3;
use noisefall_base::declare::{OwnedValue, Path, Textured};
use noisefall_edit::edit::Edit;

use super::state::App;
use crate::viewer::background::dropped::DroppedFile;
use crate::viewer::dialogs::{choose_file::FilePurpose, unsaved::Leaving};
use crate::viewer::panels::subject::Subject;

impl App {
    /// Reads what was dropped on the window, and uses what has been read.
    pub fn take_dropped_files(&mut self) {
        let dropped = self.ctx.input(|input| input.raw.dropped_files.clone());
        // The question is about the scene that is open.
        if !dropped.is_empty() && self.awaits_answer() && self.dialogs.open.is_none() {
            return self.tell("Not opened: close the dialog first, then drop the file again.".to_owned(), true);
        }
        for file in dropped {
            self.background.drops.read(file.path().to_owned(), self.session.camera.resolution, self.window.hovered);
        }
        while let Some((file, pixel)) = self.background.drops.take() {
            // Some systems do not move the pointer while a file is dragged.
            let pixel = pixel.or(self.window.hovered);
            match file {
                Ok(file) => self.use_dropped(file, pixel),
                Err(why) => self.tell(why, true),
            }
        }
    }

    fn use_dropped(&mut self, file: DroppedFile, pixel: Option<[u32; 2]>) {
        match file {
            DroppedFile::Scene(path) => self.ask_to_leave(Leaving::Open(Some(path))),
            DroppedFile::Reference(path) => self.background.loader.read_reference(path, self.session.camera),
            DroppedFile::Mesh(path, _) if self.asks_for_scene() => self.ask_to_leave(Leaving::Open(Some(path))),
            _ if self.editor.is_none() => self.tell("Open a scene first.".to_owned(), true),
            DroppedFile::Mesh(path, bounds) => self.add_mesh(&path, bounds, pixel),
            DroppedFile::Texture(path) => self.use_as_texture(&path, pixel),
            DroppedFile::Sky(path) => self.use_as_sky(&path),
        }
    }

    /// Whether a mesh is to be the scene: there is no object that it could stand beside, or the window asks for a scene to open.
    fn asks_for_scene(&mut self) -> bool {
        let is_empty = self.editor.as_ref().is_none_or(|editor| editor.document.description().objects.is_empty());
        self.dialogs.open.take().is_some() || is_empty
    }

    /// Adds a mesh where it was dropped, or else where the image was clicked last.
    fn add_mesh(&mut self, file: &FilePath, bounds: [DVec3; 2], pixel: Option<[u32; 2]>) {
        let path = self.path_in_scene(file);
        // Without a surface, it stands on the floor below the point that the camera looks at.
        let placement = self.placement(pixel, DVec3::ZERO);
        let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return };
        let (edit, object) = editor.document.add_mesh(&path, bounds, placement, &opened.scene);
        self.edit_and_select(&edit, &object);
    }

    /// Makes an image the colour of the object that it was dropped on, or else of the selected one.
    fn use_as_texture(&mut self, file: &FilePath, pixel: Option<[u32; 2]>) {
        let under = pixel.and_then(|pixel| self.object_at(pixel));
        let Some(object) = under.or(self.selection.object()) else {
            return self.tell("Drop the texture on an object, or select the object first.".to_owned(), true);
        };
        if let Some(color) = self.color_of_object(object) {
            self.use_file(&FilePurpose::Texture(color), file);
            self.selection.select(Some(Subject::Object(object)));
        }
    }

    /// Makes a texture of the scene the colour of the material of an object.
    pub fn assign_texture(&mut self, object: usize, texture: String) {
        if let Some(color) = self.color_of_object(object) {
            self.edit(&Edit::set(color, OwnedValue::Textured(Textured::Texture(texture))));
        }
    }

    /// Where the material of an object has its colour; says so if it has none.
    fn color_of_object(&mut self, object: usize) -> Option<Path> {
        let document = &self.editor.as_ref()?.document;
        let Some(material) = &document.description().objects.get(object)?.material else {
            self.tell("This object has no material. Assign one first.".to_owned(), true);
            return None;
        };
        let color = document.colour_of_material(material);
        if color.is_none() {
            self.tell(format!("The material {material} has no colour that a texture could replace."), true);
        }
        color
    }

    fn use_as_sky(&mut self, file: &FilePath) {
        let path = self.path_in_scene(file);
        let Some(editor) = &self.editor else { return };
        let edit = editor.document.set_sky(&path);
        self.edit(&edit);
    }
}
