//! Joins the canvas and its overlays with the state of the window.
use egui::{TextureHandle, Ui};
use noisefall_render::render::view::Legend;

use super::state::App;
use crate::viewer::canvas::{
    drawing::Pictures, drawing::Split, interaction, interaction::Tool, overlay, picture_area::PictureArea,
};
use crate::viewer::instruments::{path::drawing, tabs::InstrumentTab};
use crate::viewer::panels::panel_tabs::PanelTab;

impl App {
    pub fn canvas(&mut self, ui: &mut Ui) {
        let has_dialog = self.front().is_some();
        let (pictures, session, window) = (self.pictures(), &mut self.session, &mut self.window);
        let scene = session.opened.as_ref().map(|opened| opened.scene.as_ref());
        // On the page of the scene, letters are for what is selected.
        let is_editing = window.panel == PanelTab::Edit && self.selection.subject.is_some();
        // In an open list, arrows are the list's.
        let keys = !has_dialog
            && !is_editing
            && !egui::Popup::is_any_open(ui.ctx())
            && !self.selection.gizmo.is_active()
            && !window.holds_chord;
        let output = interaction::show(ui, pictures, window.tool, &mut window.view, &session.camera, scene, keys);
        (window.hovered, window.over_second) = (output.hovered, output.over_second);
        if let Some(camera) = output.camera.filter(|camera| camera.check().is_ok()) {
            session.camera = camera;
        }
        window.marking = output.marked.map(|(region, _)| region);
        if let Some((region, true)) = output.marked {
            session.budget.region = Some(region);
            window.marking = None;
        }
        if let Some(pixel) = output.clicked {
            let punctual_light = output.area.and_then(|area| self.punctual_under(ui, &area));
            match punctual_light {
                Some(punctual_light) => self.pick(Some(punctual_light)),
                None => self.click(pixel),
            }
        }
        if let Some(response) = &output.response {
            self.image_menu(ui, response, output.area.as_ref());
        }
        self.show_dragged(ui);
        if let Some(area) = &output.area {
            self.overlays(ui, area, output.second_area.as_ref());
        }
    }

    /// The images that the canvas draws.
    fn pictures(&self) -> Option<Pictures> {
        let [first, second] = self.results.textures.each_ref().map(|texture| texture.as_ref().map(TextureHandle::id));
        // The image keeps its own shape until another one is there, which may be never: settings can be impossible.
        let resolution = self.results.shown.as_ref().map_or(self.session.camera.resolution, |frame| frame.full_resolution);
        let split = self.comparison().map_or(Split::None, |comparison| comparison.layout.split());
        Some(Pictures { first: first?, second: second.filter(|_| split != Split::None), resolution, split })
    }

    /// A click on the image.
    fn click(&mut self, pixel: [u32; 2]) {
        match self.window.tool {
            Tool::Inspect => self.window.tab = Some(InstrumentTab::Path),
            Tool::Picture | Tool::Camera => self.select_at(pixel),
            Tool::Region => {}
        }
        if self.window.tab == Some(InstrumentTab::Path) {
            self.instruments.path.of_second = self.window.over_second;
            self.instruments.path.look_at(pixel);
        }
    }

    /// Draws what lies over the image. `second` is where B lies, if that is elsewhere.
    pub fn overlays(&mut self, ui: &mut Ui, area: &PictureArea, second: Option<&PictureArea>) {
        self.outline_selection(ui, area);
        self.show_light_icons(ui, area);
        self.show_gizmo(ui, area);
        let (session, results) = (&self.session, &self.results);
        let region = self.window.marking.or(session.budget.region);
        let progress = self.background.denoiser.progress().filter(|_| self.shown_view().is_denoised());
        let denoising = progress.map(|part| Legend {
            title: format!("Denoising, {:.0} %. This is the image without it.", 100.0 * part),
            scale: None,
            entries: Vec::new(),
        });
        overlay::show(ui, area, region, results.scores.as_ref(), denoising.as_ref().or(results.legend.as_ref()));
        if self.window.tab == Some(InstrumentTab::Path) {
            let size = session.opened.as_ref().map_or(1.0, |opened| opened.scene.size) as f32;
            let of_path = second.filter(|_| self.instruments.path.of_second).unwrap_or(area);
            drawing::draw(ui, of_path, &self.instruments.path, &session.camera, size);
        }
        self.notices(ui, area);
    }
}
