//! Joins the gizmo with the selected object or light: its operations are edits of the document.
use egui::Ui;
use glam::DVec3;
use noisefall_scene::shape::Transform;

use super::{scene_editor::SceneEditor, state::App};
use crate::viewer::canvas::{
    framing,
    gizmo::{GizmoOutput, Phase},
    interaction::Tool,
    picture_area::PictureArea,
};
use crate::viewer::panels::subject::Subject;

impl App {
    /// Gives the gizmo its keys, before the window looks at its own: while the pointer is over the image.
    pub fn take_gizmo_keys(&mut self) {
        let is_free = self.front().is_none() && self.has_gizmo();
        let gizmo = &mut self.selection.gizmo;
        if is_free && (self.window.hovered.is_some() || gizmo.has_pointer() || gizmo.is_active()) {
            gizmo.take_keys(&self.ctx);
        }
    }

    /// Whether the selected part has handles over the image.
    pub fn has_gizmo(&self) -> bool {
        let is_moving_tool = matches!(self.window.tool, Tool::Picture | Tool::Camera);
        is_moving_tool && self.selection.movable().is_some() && self.editor.is_some()
    }

    /// Shows the gizmo of the selected part over the image, and makes its edits.
    pub fn show_gizmo(&mut self, ui: &mut Ui, area: &PictureArea) {
        let Some((subject, pivot)) = self.selection.movable().cloned().zip(self.pivot()).filter(|_| self.has_gizmo()) else {
            return self.selection.end_operation();
        };
        let size = self.session.opened.as_ref().map_or(1.0, |opened| opened.scene.size);
        let output = self.selection.gizmo.show(ui, area, &self.session.camera, pivot, size);
        output.into_iter().for_each(|output| self.follow_gizmo(&subject, &output));
    }

    /// The middle of the selected object, or the position of the selected light. A copy is where its original is until it is compiled.
    fn pivot(&self) -> Option<DVec3> {
        let object = match self.selection.copy_of.as_ref().or(self.selection.subject.as_ref())? {
            Subject::PunctualLight(place) => {
                return self.editor.as_ref()?.document.description().punctual_lights.get(*place)?.position();
            }
            Subject::Object(place) => *place,
            _ => return None,
        };
        let scene = &self.session.opened.as_ref()?.scene;
        let objects = &scene.objects[scene.objects_of(object)];
        framing::around(objects.iter().map(|object| object.shape.bounding_sphere())).map(|(center, _)| center)
    }

    fn follow_gizmo(&mut self, subject: &Subject, output: &GizmoOutput) {
        let GizmoOutput { change, pivot, phase } = output;
        if *phase == Phase::Cancelled || (*phase == Phase::Done && is_identity(change)) {
            return self.cancel_operation();
        }
        let is_new = match &self.selection.change {
            Some(before) => before != change,
            None => !is_identity(change),
        };
        if is_new {
            if self.selection.change.is_none() {
                self.editor.as_mut().map(SceneEditor::end_drag);
            }
            self.selection.change = Some(change.clone());
            let name = self.editor.as_ref().map_or_else(String::new, |editor| subject.name(editor.document.description()));
            self.change_scene(&format!("{} of {name}", operation(change)), |editor| {
                editor.drag_from_start(|scene| match subject {
                    Subject::Object(object) => scene.transformed(*object, change, *pivot),
                    Subject::PunctualLight(punctual_light) => scene.transformed_light(*punctual_light, change, *pivot),
                    _ => None,
                })
            });
        }
        if *phase == Phase::Done {
            self.end_step();
            // A copy that could not be moved is in the place of its original.
            self.discard_copy();
        }
    }

    /// Ends the step of an operation. A copy and its move become one step.
    pub fn end_step(&mut self) {
        self.selection.change = None;
        let has_moved = self.editor.as_mut().is_some_and(SceneEditor::end_drag);
        if has_moved && self.selection.copy_of.take().is_some() {
            self.join_edits();
        }
    }

    /// Ends an operation of the gizmo, of which another edit is no part.
    pub fn leave_gizmo(&mut self) {
        if self.selection.gizmo.is_active() {
            self.end_step();
            self.selection.end_operation();
        }
    }

    fn cancel_operation(&mut self) {
        self.selection.change = None;
        if self.editor.as_mut().is_some_and(SceneEditor::cancel_drag) {
            self.history.drop_edit();
            self.follow_document();
        }
        self.discard_copy();
    }
}

/// Names an operation by a noun.
fn operation(change: &Transform) -> &'static str {
    match change {
        Transform::Translate(_) => "move",
        Transform::Rotate(_) => "rotation",
        Transform::Scale(_) => "scaling",
        Transform::Matrix(_) => "transformation",
    }
}

fn is_identity(change: &Transform) -> bool {
    match change {
        Transform::Translate(by) => *by == DVec3::ZERO,
        Transform::Rotate(turn) => turn.degrees == 0.0,
        Transform::Scale(by) => *by == DVec3::ONE,
        Transform::Matrix(_) => false,
    }
}
