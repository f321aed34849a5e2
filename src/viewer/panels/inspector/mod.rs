//! The inspector: a row for every parameter of a part of the scene, made from its declaration.
//!
//! It shows a description and does not change it. It returns the requested changes as [`Request`]s.
//!
//! | file | holds |
//! |---|---|
//! | `rows.rs` | the visitor of declarations: tables, choices and lists, and a row for each value |
//! | `row.rs` | the layout of a row: label, tooltip, optional mark |
//! | `cell.rs` | controls for values, by type |
//! | `numbers.rs` | sliders and fields of numbers |
//! | `references.rs` | menus of names: textures, materials |
//! | `request.rs` | the requested changes |
//! | `surroundings.rs` | the rest of the scene |
mod cell;
mod numbers;
mod references;
mod request;
mod row;
mod rows;
mod surroundings;
#[cfg(test)]
mod tests;

use egui::Ui;
use noisefall_base::declare::{Declare, Path};

use self::rows::Rows;
pub use self::{
    request::{Drag, InspectorRequests, Request},
    surroundings::Surroundings,
};

/// The inspector between two frames.
#[derive(Default)]
pub struct Inspector {
    /// A drag has made requests.
    is_dragging: bool,
}

impl Inspector {
    /// Shows the parameters of the part of a description at a path.
    pub fn show(&mut self, ui: &mut Ui, part: &mut dyn Declare, path: &Path, surroundings: &Surroundings) -> InspectorRequests {
        let requests = ui.push_id(path, |ui| {
            let mut rows = Rows::new(ui, path.clone(), surroundings);
            part.parameters(&mut rows);
            rows.finish()
        });
        let requests = requests.inner;
        let is_down = ui.input(|input| input.pointer.primary_down());
        let drag = match is_down {
            true if self.is_dragging || !requests.is_empty() => Drag::Going,
            false if self.is_dragging => Drag::Ended,
            _ => Drag::None,
        };
        self.is_dragging = drag == Drag::Going;
        InspectorRequests { requests, drag }
    }
}
