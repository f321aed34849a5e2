//! Carries out what the menus of the outliner ask for.
use noisefall_base::declare::{OwnedValue, Path};
use noisefall_edit::edit::Edit;

use super::state::App;
use crate::viewer::panels::{outliner::Action, subject::Subject};

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
            Action::AddEnvironment => _ = self.edit(&Edit::insert(subject.path())),
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
}
