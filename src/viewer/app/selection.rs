//! The selected part of the scene.
use noisefall_scene::shape::Transform;

use crate::viewer::background::outline::OutlineFinder;
use crate::viewer::canvas::gizmo::Gizmo;
use crate::viewer::panels::subject::Subject;

pub struct Selection {
    pub subject: Option<Subject>,
    pub outline: OutlineFinder,
    pub gizmo: Gizmo,
    /// The transform that the gizmo has applied to the object or light so far.
    pub change: Option<Transform>,
    /// The part is a copy of this one, which the gizmo moves until it is confirmed or discarded.
    pub copy_of: Option<Subject>,
    /// The pixel of the image that was clicked last, or was under the pointer when Shift+A was pressed: new objects are placed there.
    pub clicked: Option<[u32; 2]>,
}

impl Selection {
    pub fn new(ctx: &egui::Context) -> Selection {
        let outline = OutlineFinder::new(ctx);
        Selection { subject: None, outline, gizmo: Gizmo::default(), change: None, copy_of: None, clicked: None }
    }

    /// Selects a part of the scene, or nothing.
    pub fn select(&mut self, subject: Option<Subject>) {
        if self.subject != subject {
            self.end_operation();
            self.subject = subject;
        }
    }

    /// Ends the operation of the gizmo.
    pub fn end_operation(&mut self) {
        self.gizmo.reset();
        (self.change, self.copy_of) = (None, None);
    }

    /// The selected part that the gizmo may move: an object or a light.
    pub fn movable(&self) -> Option<&Subject> {
        self.subject.as_ref().filter(|subject| matches!(subject, Subject::Object(_) | Subject::PunctualLight(_)))
    }

    /// The place in the description of the selected object.
    pub fn object(&self) -> Option<usize> {
        if let Some(Subject::Object(place)) = self.subject { Some(place) } else { None }
    }
}
