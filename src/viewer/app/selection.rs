//! The selected part of the scene.
use crate::viewer::background::outline::OutlineFinder;
use crate::viewer::panels::subject::Subject;

pub struct Selection {
    pub subject: Option<Subject>,
    pub outline: OutlineFinder,
}

impl Selection {
    pub fn new(ctx: &egui::Context) -> Selection {
        Selection { subject: None, outline: OutlineFinder::new(ctx) }
    }

    /// The place in the description of the selected object.
    pub fn object(&self) -> Option<usize> {
        if let Some(Subject::Object(place)) = self.subject { Some(place) } else { None }
    }
}
