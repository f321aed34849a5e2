//! The open scene as it is edited: its document and the steps that led to it.
use std::sync::Arc;

use noisefall_base::declare::Problem;
use noisefall_edit::edit::{Document, Edit, Gesture, History, Outside, Version};
use noisefall_scene::scene::description::SceneDescription;

use crate::viewer::panels::{inspector::Inspector, outliner::Outliner};

pub struct SceneEditor {
    pub document: Document,
    /// The document as it is in its file, if it was opened or reloaded without changes.
    opened: Option<Version>,
    history: History,
    /// The drag that is under way; its edits are one step.
    drag: Option<Gesture>,
    /// Counts the changes of the document.
    pub revision: u64,
    pub outliner: Outliner,
    pub inspector: Inspector,
}

impl SceneEditor {
    pub fn new(document: Document) -> SceneEditor {
        SceneEditor {
            opened: (!document.has_changes()).then(|| document.version()),
            document,
            history: History::default(),
            drag: None,
            revision: 0,
            outliner: Outliner::default(),
            inspector: Inspector::default(),
        }
    }

    /// Whether the scene is the one of its file: what the file says of its exact image holds.
    pub fn is_as_opened(&self) -> bool {
        self.opened == Some(self.document.version())
    }

    /// A copy of the scene as it is now.
    pub fn description(&self) -> Arc<SceneDescription> {
        Arc::new(self.document.description().clone())
    }

    /// Makes an edit as a step of its own.
    pub fn apply(&mut self, edit: &Edit) -> Result<(), Problem> {
        self.drag = None;
        self.history.apply(&mut self.document, edit)?;
        self.revision += 1;
        Ok(())
    }

    /// Makes an edit of a drag. Returns whether it begins a step.
    pub fn drag(&mut self, edit: &Edit) -> Result<bool, Problem> {
        let gesture = self.drag.unwrap_or_else(|| self.history.gesture());
        self.history.drag(&mut self.document, edit, gesture)?;
        self.revision += 1;
        Ok(self.drag.replace(gesture).is_none())
    }

    /// Makes an edit in place of those that the drag has made so far. Returns whether it begins a step.
    pub fn drag_from_start(&mut self, edit: impl FnOnce(&Document) -> Option<Edit>) -> Result<bool, Problem> {
        let goes_on = self.drag.is_some() && self.history.undo(&mut self.document);
        let made = edit(&self.document).map(|edit| self.history.apply(&mut self.document, &edit));
        match made {
            Some(Ok(())) => {
                self.revision += 1;
                let gesture = self.drag.unwrap_or_else(|| self.history.gesture());
                Ok(self.drag.replace(gesture).is_none())
            }
            refused => {
                if goes_on {
                    self.history.redo(&mut self.document);
                }
                refused.map_or(Ok(false), |refused| refused.map(|()| false))
            }
        }
    }

    /// Ends the drag: the next edit is a step of its own. Returns whether the drag has made a step.
    pub fn end_drag(&mut self) -> bool {
        self.drag.take().is_some()
    }

    /// Takes back what the drag has made. Returns whether there was anything.
    pub fn cancel_drag(&mut self) -> bool {
        self.drag.take().is_some() && self.undo()
    }

    /// Joins the last two steps into one.
    pub fn join_steps(&mut self) {
        self.history.join();
    }

    /// Reloads the file, as a step of its own.
    pub fn take_outside(&mut self, outside: Outside) {
        (self.drag, self.revision) = (None, self.revision + 1);
        // A text that was read fits.
        let taken = self.document.take_outside(&mut self.history, outside);
        debug_assert!(taken.is_ok(), "{taken:?}");
        if !self.document.has_changes() {
            self.opened = Some(self.document.version());
        }
    }

    /// Takes back the last step. False if there is none.
    pub fn undo(&mut self) -> bool {
        (self.drag, self.revision) = (None, self.revision + 1);
        self.history.undo(&mut self.document)
    }

    /// Makes the last undone step again. False if there is none.
    pub fn redo(&mut self) -> bool {
        (self.drag, self.revision) = (None, self.revision + 1);
        self.history.redo(&mut self.document)
    }
}

#[cfg(test)]
mod tests {
    use noisefall_base::declare::{OwnedValue, Path};
    use noisefall_scene::scene::BUILT_IN;

    use super::*;

    fn editor() -> SceneEditor {
        SceneEditor::new(Document::untitled(BUILT_IN).expect("it is a scene"))
    }

    fn fov(degrees: f64) -> Edit {
        Edit::set(Path::of("camera.fov"), OwnedValue::Number(degrees))
    }

    #[test]
    fn the_edits_of_a_drag_are_one_step() {
        let mut editor = editor();
        let start = editor.description();
        assert_eq!([20.0, 30.0].map(|degrees| editor.drag(&fov(degrees)).ok()), [Some(true), Some(false)]);
        editor.end_drag();
        assert_eq!(editor.drag(&fov(50.0)).ok(), Some(true));
        assert!(editor.undo() && editor.description().camera.fov == Some(30.0));
        assert!(editor.undo() && editor.description() == start && !editor.undo());
    }

    #[test]
    fn a_drag_from_its_start_replaces_its_edit_and_keeps_it_where_a_new_one_is_refused() {
        let mut editor = editor();
        let start = editor.description();
        for (degrees, is_step) in [(20.0, true), (30.0, false)] {
            let made = editor.drag_from_start(|document| {
                assert_eq!(document.description(), &*start);
                Some(fov(degrees))
            });
            assert_eq!(made.ok(), Some(is_step));
        }
        assert!(editor.drag_from_start(|_| Some(fov(500.0))).is_err());
        assert_eq!(editor.drag_from_start(|_| None).ok(), Some(false));
        assert_eq!(editor.description().camera.fov, Some(30.0));
        assert!(editor.cancel_drag() && editor.description() == start && !editor.cancel_drag() && !editor.undo());
    }
}
