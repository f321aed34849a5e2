//! Edits of the open scene, undo and redo included: the document changes at once, and its image follows.
use noisefall_base::declare::{Problem, capitalised};
use noisefall_edit::edit::Edit;
use noisefall_scene::scene::description::{ObjectDescription, SceneDescription};

use super::{scene_editor::SceneEditor, state::App};
use crate::viewer::panels::subject::Subject;

impl App {
    /// Makes an edit, as a step of its own. What the reader of scene files would refuse is refused, with its message.
    pub fn edit(&mut self, edit: &Edit) -> bool {
        self.leave_gizmo();
        self.change_scene(&self.title_of(edit), |editor| editor.apply(edit).map(|()| true))
    }

    /// Makes an edit of a drag, which is one step.
    pub fn drag_edit(&mut self, edit: &Edit) {
        self.leave_gizmo();
        self.change_scene(&self.title_of(edit), |editor| editor.drag(edit));
    }

    fn title_of(&self, edit: &Edit) -> String {
        self.editor.as_ref().map_or_else(String::new, |editor| edit.title(editor.document.description()))
    }

    /// Changes the scene by `change`, which returns whether a step of this title begins. Returns whether the change was made.
    pub fn change_scene(&mut self, title: &str, change: impl FnOnce(&mut SceneEditor) -> Result<bool, Problem>) -> bool {
        let Some(editor) = &mut self.editor else { return false };
        let made = change(editor);
        match &made {
            Ok(begins) => {
                if *begins {
                    self.history.push_edit(title);
                }
                self.follow_document();
            }
            Err(problem) => {
                let help = if problem.help.is_empty() { String::new() } else { format!(": {}", problem.help) };
                self.tell(format!("{}{help}", capitalised(&problem.message)), true);
            }
        }
        made.is_ok()
    }

    /// Joins the last two edits into one step.
    pub fn join_edits(&mut self) {
        self.editor.iter_mut().for_each(SceneEditor::join_steps);
        self.history.drop_edit();
    }

    /// Takes back the last edit of the scene, and forgets it.
    pub fn discard_edit(&mut self) {
        self.history.drop_edit();
        self.undo_edit();
    }

    /// Takes back the last edit of the scene.
    pub fn undo_edit(&mut self) {
        self.step_in_scene(SceneEditor::undo, |_| true);
    }

    /// Makes the last undone edit of the scene again.
    pub fn redo_edit(&mut self) {
        self.step_in_scene(SceneEditor::redo, |_| true);
    }

    /// Changes the whole scene by `step`, and renders it if it `is_new`.
    pub fn step_in_scene<T>(&mut self, step: impl FnOnce(&mut SceneEditor) -> T, is_new: impl FnOnce(&SceneDescription) -> bool) {
        let Some(editor) = &mut self.editor else { return };
        let before = editor.description();
        step(editor);
        self.selection.end_operation();
        // Places in the list may be those of other objects now.
        let objects = &editor.document.description().objects;
        if let Some(selected) = self.selection.object().filter(|_| objects.len() != before.objects.len()) {
            let same = before.objects.get(selected).and_then(|object| nearest_equal(objects, object, selected));
            self.selection.select(same.map(Subject::Object));
        }
        if is_new(editor.document.description()) {
            self.follow_document();
        }
    }

    /// Renders the document as it is now.
    pub fn follow_document(&mut self) {
        let Some(editor) = &self.editor else { return };
        let description = editor.description();
        if self.selection.subject.as_ref().is_some_and(|subject| !subject.is_in(&description)) {
            self.selection.select(None);
        }
        self.edit_scene(description);
    }
}

/// The place of the object that equals another one, the nearest of several to a place.
fn nearest_equal(objects: &[ObjectDescription], object: &ObjectDescription, place: usize) -> Option<usize> {
    let equal = objects.iter().enumerate().filter(|(_, other)| *other == object).map(|(at, _)| at);
    equal.min_by_key(|at| at.abs_diff(place))
}
