//! Undo and redo.
use std::collections::VecDeque;

use super::{Document, Edit, Version};
use noisefall_base::declare::Problem;

/// Largest number of steps; the oldest are forgotten first.
const MOST: usize = 20_000;

/// A gesture such as a drag of the mouse: its edits form one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Gesture(u64);

/// The steps that led to the present document, and those that were undone.
#[derive(Debug, Default)]
pub struct History {
    done: VecDeque<HistoryStep>,
    undone: Vec<HistoryStep>,
    gestures: u64,
}

/// From one version of a document to another.
#[derive(Debug)]
struct HistoryStep {
    /// The edit that leads there.
    edit: Edit,
    version: Version,
    title: String,
    gesture: Option<Gesture>,
}

impl History {
    /// The oldest steps beyond this number are forgotten.
    pub const MOST: usize = MOST;

    /// A new gesture.
    pub fn gesture(&mut self) -> Gesture {
        self.gestures += 1;
        Gesture(self.gestures)
    }

    /// Applies an edit as a step of its own. Undone steps cannot be redone afterwards.
    pub fn apply(&mut self, document: &mut Document, edit: &Edit) -> Result<(), Problem> {
        self.step(document, edit, None)
    }

    /// Applies an edit that is undone together with the others of its gesture.
    pub fn drag(&mut self, document: &mut Document, edit: &Edit, gesture: Gesture) -> Result<(), Problem> {
        self.step(document, edit, Some(gesture))
    }

    fn step(&mut self, document: &mut Document, edit: &Edit, gesture: Option<Gesture>) -> Result<(), Problem> {
        let (version, title) = (document.version(), edit.title(document.description()));
        let inverse = document.apply(edit)?;
        self.undone.clear();
        match self.done.back_mut() {
            Some(last) if gesture.is_some() && last.gesture == gesture => last.merge(inverse),
            _ => self.done.push_back(HistoryStep { edit: inverse, version, title, gesture }),
        }
        if self.done.len() > MOST {
            self.done.pop_front();
        }
        Ok(())
    }

    /// Joins the last two steps into one, which has the name of the first.
    pub fn join(&mut self) {
        let Some(last) = self.done.pop_back() else { return };
        match self.done.back_mut() {
            Some(first) => first.merge(last.edit),
            None => self.done.push_back(last),
        }
    }

    /// Undoes the last step. Returns false if there is none.
    pub fn undo(&mut self, document: &mut Document) -> bool {
        let Some(step) = self.done.pop_back() else { return false };
        self.undone.extend(step.follow(document));
        true
    }

    /// Redoes the step that was undone last. Returns false if there is none.
    pub fn redo(&mut self, document: &mut Document) -> bool {
        let Some(step) = self.undone.pop() else { return false };
        self.done.extend(step.follow(document));
        true
    }

    /// Name of the step that undo would take back, for a menu.
    pub fn to_undo(&self) -> Option<&str> {
        self.done.back().map(|step| step.title.as_str())
    }

    /// Name of the step that redo would repeat, for a menu.
    pub fn to_redo(&self) -> Option<&str> {
        self.undone.last().map(|step| step.title.as_str())
    }

    /// The edit that [`History::undo`] applies next; its paths are those that change.
    pub fn next_undo(&self) -> Option<&Edit> {
        self.done.back().map(|step| &step.edit)
    }

    /// The edit that [`History::redo`] applies next.
    pub fn next_redo(&self) -> Option<&Edit> {
        self.undone.last().map(|step| &step.edit)
    }

    /// Number of steps that can be undone.
    pub fn len(&self) -> usize {
        self.done.len()
    }

    /// Whether nothing can be undone.
    pub fn is_empty(&self) -> bool {
        self.done.is_empty()
    }
}

impl HistoryStep {
    /// Applies the step and returns its inverse.
    fn follow(self, document: &mut Document) -> Option<HistoryStep> {
        let from = document.version();
        let inverse = document.return_to(self.version, &self.edit);
        debug_assert!(inverse.is_ok(), "{:?} was possible before: {inverse:?}", self.edit);
        // Nothing is merged with a step that has been undone.
        Some(HistoryStep { edit: inverse.ok()?, version: from, gesture: None, ..self })
    }

    /// Extends the step, which undoes edits, by the inverse of one more edit.
    fn merge(&mut self, inverse: Edit) {
        if absorbs(&self.edit, &inverse) {
            return;
        }
        match &mut self.edit {
            Edit::All(edits) => edits.insert(0, inverse),
            edit => {
                let older = std::mem::replace(edit, Edit::All(Vec::new()));
                *edit = Edit::All(vec![inverse, older]);
            }
        }
    }
}

/// Whether doing `older` has the same effect as doing `newer` and then `older`.
fn absorbs(older: &Edit, newer: &Edit) -> bool {
    match (older, newer) {
        (Edit::Set { path, .. }, Edit::Set { path: again, .. }) => path == again,
        (
            Edit::Remove { path } | Edit::Replace { path, .. },
            Edit::Set { path: inner, .. } | Edit::Replace { path: inner, .. },
        ) => path.holds(inner),
        (Edit::All(older), Edit::All(newer)) => {
            older.len() == newer.len() && older.iter().zip(newer).all(|(older, newer)| absorbs(older, newer))
        }
        _ => false,
    }
}
