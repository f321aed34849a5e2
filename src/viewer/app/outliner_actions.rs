//! Carries out what the menus of the outliner ask for.
use noisefall::{
    declare::{Declare, OwnedValue, Path},
    edit::{Document, Edit, Placement, Tree},
    material::Material,
    scene::description::MaterialDescription,
    texture::{TextureKind, checker::Checker},
};

use super::state::App;
use crate::viewer::panels::{outliner::Action, outliner::New, subject::Subject};

impl App {
    /// Does something to a part of the scene.
    pub fn act_on(&mut self, subject: Subject, action: Action) {
        let Some(editor) = &mut self.editor else { return };
        let document = &editor.document;
        match action {
            Action::LookAt => {
                self.selection.select(Some(subject));
                self.look_at_selection();
            }
            Action::DropToFloor => self.rest_on_floor(&subject),
            Action::Duplicate => self.duplicate_beside(&subject),
            Action::Delete => {
                if self.edit(&Edit::remove(subject.path())) {
                    self.selection.select(None);
                }
            }
            Action::Rename(name) => {
                let path = subject.path();
                let renamed = subject.renamed(&name);
                let edit = if renamed == subject {
                    Edit::set(path.key("name"), OwnedValue::Text(name))
                } else {
                    Edit::Rename { path, to: name }
                };
                let is_selected = self.selection.subject.as_ref() == Some(&subject);
                if self.edit(&edit) && is_selected {
                    self.selection.select(Some(renamed));
                }
            }
            Action::ChangeKind(kind) => {
                let Some((path, choice)) = subject.choice() else { return };
                let edit = document.change_kind(&path, choice, kind);
                self.edit(&edit);
            }
            Action::AssignMaterial(material) => {
                let Subject::Object(place) = subject else { return };
                let edit = document.assign(&[place], material.as_deref());
                self.edit(&edit);
            }
            Action::AssignTexture(texture) => {
                let Subject::Object(place) = subject else { return };
                self.assign_texture(place, texture);
            }
            Action::AddBackground => _ = self.edit(&Edit::insert(subject.path())),
        }
    }

    /// Adds an object or a lamp where the picture was clicked last, or a material or a texture. An object gets the material of the
    /// surface there, if it is diffuse.
    pub fn add(&mut self, new: New) {
        let (placement, exposure) = (self.placement(), self.session.look.display.exposure.into());
        let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return };
        let (scene, clearance) = (&opened.scene, placement.half());
        let document = &editor.document;
        let added = match new {
            New::Shape(kind) => {
                let material = self.diffuse_material_below();
                document.add_shape(kind, &placement.on_floor(scene, clearance), material.as_deref())
            }
            New::Lamp(kind) => document.add_lamp(kind, &placement.hung(scene), exposure),
            New::LampWithoutSurface(kind) => {
                let floor = placement.on_floor(scene, 2.0 * clearance);
                document.add_lamp_without_surface(kind, &floor, floor.lamp_height(scene), exposure)
            }
            New::Material => Some(added(document, "materials", "material", &mut MaterialDescription::default())),
            New::Texture => Some(added(document, "textures", "texture", &mut TextureKind::from(Checker::default()))),
        };
        if let Some((edit, path)) = added {
            self.edit_and_select(&edit, &path);
        }
    }

    /// Makes an edit, and selects the part at a path. Returns whether the edit was made.
    pub fn edit_and_select(&mut self, edit: &Edit, path: &Path) -> bool {
        let is_made = self.edit(edit);
        if is_made {
            self.selection.select(Subject::at(path));
        }
        is_made
    }

    fn rest_on_floor(&mut self, subject: &Subject) {
        let (Some(opened), Some(editor), Subject::Object(place)) = (&self.session.opened, &self.editor, subject) else { return };
        match editor.document.drop_to_floor(&opened.scene, *place) {
            Some(edit) => _ = self.edit(&edit),
            None => self.tell("The object already rests on a surface, or there is nothing below it.".to_owned(), false),
        }
    }

    /// The material of the surface where new objects are placed, if it is diffuse.
    fn diffuse_material_below(&self) -> Option<String> {
        let middle = self.session.camera.resolution.map(|side| side / 2);
        let object = self.object_at(self.selection.clicked.unwrap_or(middle))?;
        let scene = self.editor.as_ref()?.document.description();
        let name = scene.objects.get(object)?.material.as_ref()?;
        let is_diffuse = matches!(scene.materials.get(name)?.kind, Material::Lambertian(_));
        is_diffuse.then(|| name.clone())
    }

    /// Where the picture was clicked last, or else its middle, or else the point that the camera looks at.
    fn placement(&self) -> Placement {
        let scene_size = self.session.opened.as_ref().map_or(1.0, |opened| opened.scene.size);
        let surface = self.surface_at(None);
        let [at, normal] = surface.unwrap_or([self.session.camera.look_at, glam::DVec3::Y]);
        Placement { at, normal, scene_size }
    }
}

/// The edit that adds a part to a table under a free name, and its path.
fn added(document: &Document, table: &str, wanted: &str, part: &mut dyn Declare) -> (Edit, Path) {
    let path = Path::of(table).key(&document.free_name(table, wanted));
    (Edit::insert_tree(path.clone(), Tree::of(part)), path)
}
