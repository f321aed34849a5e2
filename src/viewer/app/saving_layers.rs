//! Saves the image as an EXR with layers.
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Features, features};
use noisefall_render::render::{
    Display, Frame, RenderRequest,
    image_file::Contents,
    layers::{Layer, LayerSources, channels, reserve},
    settings_text::settings_text,
    threads::Threads,
};

use super::state::App;
use crate::viewer::instruments::tabs::InstrumentTab;

impl App {
    /// Saves the image on the screen with all layers that are known.
    pub fn save_layers_to(&mut self, path: PathBuf) {
        let of_worker = self.background.worker.request().cloned();
        let (Some(frame), Some(of), true) = (self.results.shown.clone(), of_worker, self.can_save()) else {
            self.tell("Not saved: some pixels have no sample yet. Try again in a moment.".to_owned(), true);
            return;
        };
        let series = self.results.second_frame.clone().filter(|frame| frame.series.is_some());
        if series.is_none() && self.window.tab == Some(InstrumentTab::Bounces) {
            self.tell("The file has no bounces: they have no sample yet. Save it again in a moment.".to_owned(), true);
        }
        let (threads, remarks) = (self.session.threads, self.mixed_remark());
        self.background.saver.save(path, move |path| write(&frame, series.as_ref(), &of, (threads, &remarks), path));
    }
}

fn write(
    frame: &Frame,
    bounces: Option<&Arc<Frame>>,
    of: &RenderRequest,
    (threads, remarks): (usize, &[(&str, String)]),
    path: &Path,
) -> Result<(), String> {
    let RenderRequest { scene, camera, settings } = of;
    let _layers = reserve(&Layer::ALL, camera.resolution).map_err(|error| error.to_string())?;
    let _features = Features::reserve(camera.resolution).map_err(|error| error.to_string())?;
    // A pool of its own, with as many threads as the renderer has.
    let pool = Threads::new(threads, SimdLevel::best()).map_err(|error| error.to_string())?;
    let seen = pool.install(|| features(SimdLevel::best(), scene, camera, &|| false));
    let series = bounces.and_then(|frame| frame.series.as_ref());
    let (channels, _) = channels(&Layer::ALL, frame, &LayerSources { features: seen.as_ref(), series });
    let text = settings_text(scene, camera, settings, Display::default(), frame, remarks);
    let contents = Contents { frame, channels: &channels, settings: &text };
    contents.save(Display::default(), path).map_err(|error| error.to_string())
}
