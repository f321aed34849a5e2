//! Notices on the image: why it is black, and that the exposure of a scene that was opened does not suit it.
use egui::Ui;
use noisefall_base::declare::capitalised;
use noisefall_render::render::{Frame, view::View};
use noisefall_scene::scene::Camera;

use super::state::App;
use crate::viewer::background::exposure_meter::misfit;
use crate::viewer::canvas::{notice::Notice, picture_area::PictureArea};
use crate::viewer::instruments::compare::comparison::CompareLayout;

const BACK: (&str, &str) = ("Back to the last view with light", "Returns to the camera of that view.");
const EXPOSURE: [(&str, &str); 2] = [
    ("Set exposure", "Brings the image into the range of the display. The samples do not change."),
    ("Leave it", "Keeps the exposure as it is."),
];

impl App {
    /// Shows the notice that the image needs, if any.
    pub fn notices(&mut self, ui: &mut Ui, area: &PictureArea) {
        let is_full = self.results.shown.as_ref().is_some_and(|frame| !frame.is_coarse());
        // A notice would hide the other image of a wipe.
        let is_alone = self.comparison().is_none_or(|comparison| comparison.layout == CompareLayout::SideBySide);
        if !is_full || !is_alone || self.session.look.view != View::Radiance {
            return;
        }
        match self.results.why_black().map(|why| format!("{}.", capitalised(why))) {
            Some(why) => self.black_notice(ui, area, why),
            None => self.exposure_notice(ui, area),
        }
    }

    fn black_notice(&mut self, ui: &mut Ui, area: &PictureArea, reason: String) {
        let back = self.results.last_seeing.map(|last| Camera { resolution: self.session.camera.resolution, ..last });
        let back = back.filter(|back| *back != self.session.camera);
        let buttons = if back.is_some() { &[BACK][..] } else { &[] };
        if (Notice { title: "No light found yet", reason, buttons }).show(ui, area).is_some() {
            self.session.camera = back.unwrap_or(self.session.camera);
        }
    }

    fn exposure_notice(&mut self, ui: &mut Ui, area: &PictureArea) {
        let Some(misfit) = self.results.misfit.filter(|misfit| misfit.at == self.session.look.display.exposure) else { return };
        let (title, what) = if misfit.suited < misfit.at { ("Too bright", "bright") } else { ("Too dark", "dark") };
        let stops = (misfit.at - misfit.suited).abs();
        let reason = format!("The image is about {stops:.0} stops too {what} for the display.");
        match (Notice { title, reason, buttons: &EXPOSURE }).show(ui, area) {
            Some(0) => self.session.look.display.exposure = misfit.suited,
            Some(_) => self.results.misfit = None,
            None => {}
        }
    }

    /// Measures the first image of a scene that was opened, once it has light.
    pub fn meter(&mut self, frame: &Frame) {
        let is_due = self.results.awaits_meter && frame.generation == self.background.worker.generation() && !frame.is_coarse();
        if is_due && !self.results.black {
            self.results.awaits_meter = false;
            self.results.misfit = misfit(&frame.radiance, frame.width as usize, self.session.look.display.exposure);
        }
    }
}
