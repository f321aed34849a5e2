//! Joins the outliner and the inspector with the document.
use egui::{RichText, ScrollArea, Ui};
use noisefall_base::declare::{Declare, Family, OneOf, Path};
use noisefall_edit::edit::Edit;
use noisefall_scene::{scene::Camera, texture::TextureKind};

use super::{new_bump::new_bump, scene_editor::SceneEditor, state::App};
use crate::viewer::background::opened_scene::OpenedScene;
use crate::viewer::dialogs::{
    choose_file::{FileDialog, FilePurpose, texture_in_place},
    unsaved::Leaving,
};
use crate::viewer::panels::{
    inspector::{Drag, InspectorRequests, Request, Surroundings},
    modes, objects, scene_commands,
    scene_commands::SceneCommand,
    subject::Subject,
    users,
};
use crate::viewer::widgets::{split, style::leave_room_for_bar};

impl App {
    /// The panel of the scene's parts, with the parameters of the selected one.
    pub fn editor_panel(&mut self, ui: &mut Ui) {
        let Some(editor) = &mut self.editor else { return };
        let description = editor.document.description();
        let (mut asked, mut command) = (Default::default(), None);
        split::show(ui, |ui| {
            ui.label(RichText::new("Parts").strong());
            command = scene_commands::show(ui, std::mem::take(&mut self.window.opens_add));
            asked = editor.outliner.show(ui, description, editor.revision, self.selection.subject.as_ref());
        });
        if let Some(subject) = asked.selected {
            self.pick(Some(subject));
        }
        if let Some((subject, action)) = asked.action {
            self.act_on(subject, action);
        }
        match command {
            Some(SceneCommand::Add(new)) => self.add(new),
            Some(SceneCommand::Begin(template)) => self.ask_to_leave(Leaving::New(template)),
            Some(SceneCommand::UseView) => self.use_view(),
            Some(SceneCommand::SaveAs) => self.ask_where_to_save(),
            None => {}
        }
        ScrollArea::vertical().id_salt("parameters").auto_shrink(false).show(ui, |ui| {
            leave_room_for_bar(ui);
            self.inspector(ui);
        });
    }

    /// Gives the scene the camera and the settings of the window.
    pub fn use_view(&mut self) {
        let edit = |editor: &SceneEditor| editor.document.use_view(&self.session.camera, &self.session.settings);
        match self.editor.as_ref().and_then(edit) {
            Some(edit) => _ = self.edit(&edit),
            None => self.tell("The scene already has this view and these settings.".to_owned(), false),
        }
    }

    /// Gives the scene the camera of the window at its own resolution.
    pub fn keep_view(&mut self) {
        let edit = |editor: &SceneEditor| {
            let scene = editor.document.description();
            let camera = Camera { resolution: scene.camera.resolution, ..self.session.camera };
            editor.document.use_view(&camera, &scene.render.settings)
        };
        if let Some(edit) = self.editor.as_ref().and_then(edit) {
            self.edit(&edit);
        }
    }

    fn inspector(&mut self, ui: &mut Ui) {
        let (Some(editor), Some(opened)) = (&mut self.editor, &self.session.opened) else { return };
        let Some(subject) = &self.selection.subject else {
            ui.weak("Click an object in the image or a part in the list to change it.");
            return;
        };
        let Some(mut part) = subject.of(editor.document.description()) else { return };
        let (path, size, object) = (subject.path(), opened.scene.size, self.selection.object());
        let name = subject.name(editor.document.description());
        let user = ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(name).strong()).on_hover_text(place_in_file(&path));
            if matches!(subject, Subject::Object(_) | Subject::PunctualLight(_)) {
                modes::show(ui, &mut self.selection.gizmo.mode);
            }
            users::show(ui, editor.document.description(), subject)
        });
        if let Some(object) = object {
            objects::show(ui, &opened.scene, opened.scene.objects_of(object));
        }
        let asked = inspected(editor, ui, &mut *part, &path, size);
        self.follow_inspector(asked);
        if user.inner.is_some() {
            self.pick(user.inner);
        }
    }

    /// Makes the edits that the inspector asks for.
    fn follow_inspector(&mut self, asked: InspectorRequests) {
        for request in asked.requests {
            let edit = match request {
                Request::Set { path, value } => Edit::set(path, value),
                Request::Reset { path } => {
                    let default = self.editor.as_ref().and_then(|editor| editor.document.default_of(&path));
                    let Some(value) = default else { continue };
                    Edit::set(path, value)
                }
                Request::Choose { path, choice, name } => {
                    let Some(editor) = &self.editor else { return };
                    let edit = editor.document.change_kind(&path, choice, name);
                    if let Some(file) = editor.document.missing_file(&edit, &path) {
                        self.ask_for_file(FilePurpose::After(edit, file));
                        continue;
                    }
                    edit
                }
                Request::Insert { path } => {
                    let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return };
                    let bump = new_bump(&editor.document, &opened.scene, &path);
                    let edit = bump.unwrap_or_else(|| editor.document.insert(&path));
                    if let Some(file) = editor.document.missing_file(&edit, &path) {
                        self.ask_for_file(FilePurpose::After(edit, file));
                        continue;
                    }
                    edit
                }
                Request::Remove { path } => Edit::remove(path),
                Request::BrowseFile { path } => {
                    self.ask_for_file(FilePurpose::Value(path));
                    continue;
                }
                Request::BrowseTexture { path } => {
                    self.ask_for_file(FilePurpose::Texture(path));
                    continue;
                }
                Request::NewTexture { path, kind } => {
                    let Some(editor) = &mut self.editor else { return };
                    let new = TextureKind::alternatives().into_iter().find(|texture| texture.name() == kind);
                    let Some(texture) = new else { continue };
                    texture_in_place(&mut editor.document, &path, kind, texture)
                }
                Request::Show { family, name } => {
                    let subject = match family {
                        Family::Material => Subject::Material(name),
                        Family::Texture => Subject::Texture(name),
                    };
                    self.pick(Some(subject));
                    continue;
                }
            };
            if asked.drag == Drag::None {
                self.edit(&edit);
            } else {
                self.drag_edit(&edit);
            }
        }
        if asked.drag == Drag::Ended
            && let Some(editor) = &mut self.editor
        {
            editor.end_drag();
        }
    }

    fn ask_for_file(&mut self, purpose: FilePurpose) {
        self.dialogs.file = Some(FileDialog::new(purpose, self.session.path()));
    }

    /// Uses a file that was chosen: as a value, or as a texture in its place.
    pub fn use_file(&mut self, purpose: &FilePurpose, file: &std::path::Path) {
        let path = self.path_in_scene(file);
        let Some(editor) = &mut self.editor else { return };
        let edit = purpose.edit(&mut editor.document, std::path::Path::new(&path));
        self.edit(&edit);
    }

    /// The path of a file as the scene stores it: relative if the file lies in the folder of the scene.
    pub fn path_in_scene(&self, file: &std::path::Path) -> String {
        let folder = self.session.opened.as_ref().map(OpenedScene::folder).unwrap_or_default();
        let folder = std::path::absolute(folder).unwrap_or_default();
        file.strip_prefix(&folder).unwrap_or(file).display().to_string()
    }
}

/// How a scene file names a part.
fn place_in_file(path: &Path) -> String {
    if path.0.is_empty() { "The top of the scene file.".to_owned() } else { format!("In the scene file, this part is {path}.") }
}

/// Shows the inspector of a part at a path.
fn inspected(editor: &mut SceneEditor, ui: &mut Ui, part: &mut dyn Declare, path: &Path, size: f64) -> InspectorRequests {
    let description = editor.document.description();
    let [textures, materials]: [Vec<String>; 2] =
        [description.textures.keys().cloned().collect(), description.materials.keys().cloned().collect()];
    let count_objects = |name: &str| description.objects.iter().filter(|object| object.material.as_deref() == Some(name)).count();
    let surroundings = Surroundings { textures: &textures, materials: &materials, count_objects: &count_objects, size };
    editor.inspector.show(ui, part, path, &surroundings)
}
