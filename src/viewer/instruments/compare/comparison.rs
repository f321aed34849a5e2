//! A comparison of two settings.
use noisefall_render::render::view::View;
use noisefall_scene::scene::RenderSettings;

use crate::viewer::canvas::drawing::Split;

/// Settings B, rendered beside those of the image, which are A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    pub other: RenderSettings,
    pub layout: CompareLayout,
    /// The sampling panel edits B, and not A.
    pub edits_other: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompareLayout {
    Wipe,
    SideBySide,
    /// A less B.
    Difference,
}

impl CompareLayout {
    /// Layout of the canvas.
    pub fn split(self) -> Split {
        match self {
            CompareLayout::Wipe => Split::Wipe,
            CompareLayout::SideBySide => Split::SideBySide,
            CompareLayout::Difference => Split::None,
        }
    }
}

impl Comparison {
    /// The view that displays both at once, where one does.
    pub fn view(&self) -> Option<View> {
        (self.layout == CompareLayout::Difference).then_some(View::Difference)
    }
}
