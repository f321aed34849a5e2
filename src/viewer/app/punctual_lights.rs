//! Icons of punctual lights over the image, which select them.
use egui::{Pos2, Ui};

use super::state::App;
use crate::viewer::canvas::{interaction::Tool, light_icons, picture_area::PictureArea};
use crate::viewer::panels::{panel_tabs::PanelTab, subject::Subject};

impl App {
    /// Draws the icons on the page of the scene.
    pub fn show_light_icons(&self, ui: &Ui, area: &PictureArea) {
        let selected =
            if let Some(Subject::PunctualLight(punctual_light)) = self.selection.subject { Some(punctual_light) } else { None };
        light_icons::draw(ui, area, &self.punctual_places(area), selected);
    }

    /// The light whose icon is under the pointer.
    pub fn punctual_under(&self, ui: &Ui, area: &PictureArea) -> Option<Subject> {
        let at = ui.ctx().pointer_latest_pos()?;
        light_icons::under(&self.punctual_places(area), at).map(Subject::PunctualLight)
    }

    fn punctual_places(&self, area: &PictureArea) -> Vec<(usize, Pos2)> {
        let is_shown = self.window.panel == PanelTab::Edit && matches!(self.window.tool, Tool::Picture | Tool::Camera);
        let Some(editor) = self.editor.as_ref().filter(|_| is_shown) else { return Vec::new() };
        light_icons::places(editor.document.description(), &self.session.camera, area)
    }
}
