//! Saves the image, the curves or a path to a file.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use noisefall_base::file::replace;
use noisefall_render::render::{Frame, image_file::Contents, settings_text::settings_text, view::View};
use noisefall_scene::scene::Strategy;

use super::state::App;
use crate::viewer::background::{
    display_image::DisplayImage, display_image::render, display_request::BounceTerm, display_request::DisplayRequest,
};
use crate::viewer::dialogs::{
    save::SaveDialog,
    save_target::{SaveTarget, SceneNames},
};
use crate::viewer::instruments::path::copying::{PathForm, written};

impl App {
    /// Whether the screen shows the full image that the controls describe.
    pub fn can_save(&self) -> bool {
        let worker = &self.background.worker;
        let is_found = || worker.request().is_some_and(|request| self.background.features.has(&request.scene, &request.camera));
        let has_features = !self.session.look.view.shows_features() || is_found();
        let Some(frame) = self.results.shown.as_ref().filter(|_| has_features) else { return false };
        let is_denoised = !self.shown_view().is_denoised() || self.background.denoiser.of(frame).is_some();
        is_denoised && !frame.is_coarse() && frame.generation == worker.generation()
    }

    pub fn open_save_dialog(&mut self, target: SaveTarget) {
        if self.dialogs.save.is_none() {
            let scene = SceneNames {
                path: self.session.path(),
                title: self.session.opened.as_ref().map_or("", |opened| opened.name.as_str()),
                last_saved: self.window.last_saved.as_deref(),
                folder: self.window.last_folder.as_deref(),
            };
            let dialog = SaveDialog::new(target, &scene);
            let has_other_view = target == SaveTarget::Scene && self.session.view_differs();
            self.dialogs.save = Some(if has_other_view { dialog.with_view() } else { dialog });
        }
    }

    pub fn save_target(&mut self, target: SaveTarget, path: PathBuf) {
        let bytes = match target {
            SaveTarget::Scene => return self.save_scene_to(&path),
            SaveTarget::Picture => return self.save_to(path),
            SaveTarget::Layers => return self.save_layers_to(path),
            SaveTarget::Progress => return self.save_checkpoint_to(path),
            SaveTarget::CurvesCsv => self.instruments.history.csv(),
            SaveTarget::CurvesSvg => Ok(self.instruments.history.svg().into_bytes()),
            SaveTarget::Path => {
                let extension = path.extension().unwrap_or_default().to_string_lossy();
                let form = PathForm::of_extension(&extension).zip(self.inspected_request());
                let text = form.and_then(|(form, request)| written(&self.instruments.path, &request, form));
                text.map(String::into_bytes).ok_or_else(|| "The path is not traced yet. Try again in a moment.".to_owned())
            }
        };
        self.background.saver.save(path, move |path| replace(path, &bytes?).map_err(|error| error.to_string()));
    }

    /// The request for all pixels of a frame, as the controls say.
    pub fn full_display_request(&mut self, frame: Arc<Frame>) -> DisplayRequest {
        DisplayRequest { on_screen: None, most_side: usize::MAX, ..self.display_request(frame) }
    }

    /// Saves the image on the screen.
    pub fn save_to(&mut self, path: PathBuf) {
        if !self.can_save() {
            self.tell("Not saved: some pixels have no sample yet. Try again in a moment.".to_owned(), true);
            return;
        }
        let of_worker = self.background.worker.request().cloned();
        let (Some(shown), Some(of)) = (self.results.shown.clone(), of_worker) else { return };
        // A denoised image may be that of an earlier frame.
        let denoised = self.background.denoiser.of(&shown).filter(|_| self.shown_view().is_denoised());
        let frame = denoised.unwrap_or(shown);
        let request = self.full_display_request(frame.clone());
        let remarks = [remarks(&request, &path), self.mixed_remark()].concat();
        let display = self.session.look.display;
        let settings = settings_text(&of.scene, &of.camera, &of.settings, display, &frame, &remarks);
        self.background.saver.save(path, move |path| {
            let DisplayImage { frame, pixels, .. } = render(request);
            Contents { frame: &frame, channels: &[], settings: &settings }
                .save_shown(&pixels, path)
                .map_err(|error| error.to_string())
        });
    }
}

/// Settings that say which part of the image a PNG shows. An EXR has all of it.
fn remarks(request: &DisplayRequest, path: &Path) -> Vec<(&'static str, String)> {
    let view = request.look.view;
    let mut remarks = Vec::new();
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr")) {
        return remarks;
    }
    if view != View::Radiance {
        remarks.push(("view", view.title().to_owned()));
    }
    if let Some(term) = request.term.as_ref().filter(|_| view.shows_light()) {
        remarks.push(("light", format!("{}, {} spp", part(term), term.of.spp)));
    }
    remarks
}

/// The part of the light in words.
fn part(term: &BounceTerm) -> String {
    if let Some(Strategy { s, t, weighted }) = term.strategy {
        return format!("strategy s = {s}, t = {t}, {}", if weighted { "weighted" } else { "not weighted" });
    }
    let relation = if term.up_to { "at most" } else { "exactly" };
    let bounces = if term.k == 1 { "bounce" } else { "bounces" };
    format!("{relation} {} {bounces}", term.k)
}

#[cfg(test)]
mod tests {
    use noisefall_render::render::view::DisplaySettings;

    use super::*;
    use crate::viewer::background::display_request::tests::request;

    #[test]
    fn a_png_names_the_shown_part_of_the_image_and_an_exr_shows_all() {
        let said = |view, (k, up_to), path: &str| {
            let frame = Arc::new(Frame { spp: 9, ..Frame::default() });
            let term = Some(BounceTerm { of: frame.clone(), strategy: None, k, up_to });
            let request = DisplayRequest { term, look: DisplaySettings { view, ..DisplaySettings::default() }, ..request(frame) };
            remarks(&request, Path::new(path)).into_iter().map(|(_, text)| text).collect::<Vec<_>>()
        };
        assert_eq!(said(View::Radiance, (3, true), "a.png"), ["at most 3 bounces, 9 spp"]);
        assert_eq!(said(View::Radiance, (1, false), "a.png"), ["exactly 1 bounce, 9 spp"]);
        assert_eq!(said(View::Depth, (1, false), "a.png"), [View::Depth.title()], "no term is seen");
        assert!(said(View::Radiance, (3, true), "a.EXR").is_empty());
        let strategy = Some(Strategy { s: 2, t: 3, weighted: true });
        let term = BounceTerm { of: Arc::new(Frame::default()), strategy, k: 1, up_to: false };
        assert_eq!(part(&term), "strategy s = 2, t = 3, weighted");
    }
}
