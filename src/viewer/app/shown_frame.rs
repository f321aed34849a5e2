//! The display of a frame: the request to the display pipeline, the reference, and black images.
use std::sync::Arc;

use noisefall_render::render::{Frame, RenderRequest, reference::Reference, view::DisplaySettings, view::View};
use noisefall_scene::scene::Camera;

use super::state::App;
use crate::viewer::background::{display_request::BounceTerm, display_request::DisplayRequest};
use crate::viewer::canvas::drawing::Split;
use crate::viewer::instruments::tabs::InstrumentTab;

impl App {
    /// The request that displays a frame as the controls say.
    pub fn display_request(&mut self, frame: Arc<Frame>) -> DisplayRequest {
        let (comparison, session) = (self.comparison(), &self.session);
        let second = self.results.second_frame.clone().filter(|_| comparison.is_some());
        let term = self.results.second_frame.clone().filter(|_| self.window.tab == Some(InstrumentTab::Bounces));
        let strategy = self.strategy();
        let view = comparison.and_then(|comparison| comparison.view());
        let pinned = if view.is_some() { second.clone() } else { session.pinned.clone() };
        let look = DisplaySettings { view: self.shown_view(), ..session.look };
        // The camera of the last request has been checked; a scene that has just been opened is requested in a moment.
        let is_open = |request: &&RenderRequest| self.is_of_open_scene(request);
        let request = self.background.worker.request().filter(is_open).filter(|_| look.view.shows_features()).cloned();
        let reference = self.reference().filter(|_| frame.generation == self.background.worker.generation());
        let finder = &mut self.background.features;
        let features = request.and_then(|request| finder.of(&request.scene, &request.camera, session.threads));
        let denoised = if look.view.is_denoised() {
            self.background.denoiser.denoised(&frame, session.threads)
        } else {
            self.background.denoiser.stop();
            None
        };
        DisplayRequest {
            reference,
            term: term.map(|of| BounceTerm { of, strategy, k: session.bounces.k, up_to: session.bounces.up_to }),
            frame,
            second,
            shows_second: comparison.is_some_and(|comparison| comparison.layout.split() != Split::None),
            look,
            pinned,
            is_comparison: view.is_some(),
            features,
            denoised,
            materials: session.opened.as_ref().map_or_else(|| Arc::from([]), |opened| opened.materials.clone()),
            on_screen: self.window.view.on_screen(),
            most_side: self.ctx.input(|input| input.max_texture_side),
        }
    }

    /// The view of the image. In a comparison neither side is denoised.
    pub fn shown_view(&self) -> View {
        let own = self.session.look.view;
        match self.comparison() {
            Some(comparison) => comparison.view().unwrap_or(if own.is_denoised() { View::Radiance } else { own }),
            None => own,
        }
    }

    fn is_of_open_scene(&self, request: &RenderRequest) -> bool {
        self.session.opened.as_ref().is_some_and(|opened| Arc::ptr_eq(&request.scene, &opened.scene))
    }

    /// The image that the render must converge to: the one that the user gave, or that of the scene, which is known for
    /// the scene's own camera only.
    pub fn reference(&self) -> Option<Arc<Reference>> {
        let (opened, request) = (self.session.opened.as_ref()?, self.background.worker.request()?);
        if let Some(given) = self.session.given_reference.as_ref().filter(|given| given.is_of(request)) {
            return Some(given.reference.clone());
        }
        let of_scene = Camera { resolution: request.camera.resolution, ..opened.scene.camera };
        let is_of_scene = request.camera == of_scene && Arc::ptr_eq(&request.scene, &opened.scene);
        self.exact_solution().cloned().filter(|_| is_of_scene)
    }

    /// The image that the scene file says the scene converges to. It need not hold after an edit.
    pub fn exact_solution(&self) -> Option<&Arc<Reference>> {
        let is_edited = self.editor.as_ref().is_some_and(|editor| !editor.is_as_opened());
        self.session.opened.as_ref()?.reference.as_ref().filter(|_| !is_edited)
    }

    /// Whether an image with light in this fraction of its pixels shows nothing. Out of a closed object one path in a hundred million
    /// escapes by rounding: inside of one, a few pixels with light are still nothing.
    pub fn shows_nothing(&self, lit: f32) -> bool {
        const STRAY: f32 = 0.01;
        let is_shut_in =
            || self.background.worker.request().is_some_and(|request| request.scene.around(&request.camera).is_some());
        lit == 0.0 || (lit < STRAY && is_shut_in())
    }

    /// Records whether the camera of a new image sees something, or why not. The search for the reason can take as long as a visit to
    /// all triangles, so each image has one search.
    pub fn note_blackness(&mut self, generation: u64) {
        // An image of the scene before can come after another one was opened and before it is requested.
        let is_latest = generation == self.background.worker.generation();
        let request = self.background.worker.request().filter(|request| is_latest && self.is_of_open_scene(request));
        let Some(request) = request else { return };
        let results = &mut self.results;
        if !results.black {
            (results.last_seeing, results.black_reason) = (Some(request.camera), None);
        } else if results.black_reason.as_ref().is_none_or(|(of, _)| *of != generation) {
            results.black_reason = Some((generation, request.scene.why_black(&request.camera, &request.settings)));
        }
    }
}
