//! Icons of lamps without surface over the image, which select them.
use egui::{Pos2, Ui};

use super::state::App;
use crate::viewer::canvas::{interaction::Tool, lamp_icons, picture_area::PictureArea};
use crate::viewer::panels::{panel_tabs::PanelTab, subject::Subject};

impl App {
    /// Draws the icons on the page of the scene.
    pub fn show_lamp_icons(&self, ui: &Ui, area: &PictureArea) {
        let selected = if let Some(Subject::Lamp(lamp)) = self.selection.subject { Some(lamp) } else { None };
        lamp_icons::draw(ui, area, &self.lamp_places(area), selected);
    }

    /// The lamp whose icon is under the pointer.
    pub fn lamp_under(&self, ui: &Ui, area: &PictureArea) -> Option<Subject> {
        let at = ui.ctx().pointer_latest_pos()?;
        lamp_icons::under(&self.lamp_places(area), at).map(Subject::Lamp)
    }

    fn lamp_places(&self, area: &PictureArea) -> Vec<(usize, Pos2)> {
        let is_shown = self.window.panel == PanelTab::Edit && matches!(self.window.tool, Tool::Picture | Tool::Camera);
        let Some(editor) = self.editor.as_ref().filter(|_| is_shown) else { return Vec::new() };
        lamp_icons::places(editor.document.description(), &self.session.camera, area)
    }
}
