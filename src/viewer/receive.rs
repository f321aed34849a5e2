//! Taking in what the threads have finished: scenes, pictures, saved files.
use std::sync::Arc;

use egui::{TextureHandle, TextureOptions};
use noisefall::{
    render::{Budget, Frame, State, truth::Reference, view::Look},
    scene::Camera,
};

use super::{
    app::App,
    canvas::Split,
    catalogue,
    convergence::Moment,
    darkroom::{Order, Print, Term},
    dock::Tab,
    feature_finder::FeatureFinder,
    link::Wish,
    loader::{DroppedTruth, Opened},
    path::Inspector,
};

impl App {
    pub(super) fn receive(&mut self) {
        match self.loader.take() {
            Some(Ok(opened)) => self.open(opened),
            Some(Err(report)) => self.scene_error = Some(report),
            None => {}
        }
        match self.loader.take_reference() {
            Some(Ok(dropped)) => self.take_reference(dropped),
            Some(Err(error)) => self.tell(error, true),
            None => {}
        }
        match self.saver.take() {
            Some(Ok(path)) => {
                self.tell(format!("Saved {}", path.display()), false);
                self.last_saved = Some(path);
            }
            Some(Err(error)) => self.tell(format!("Not saved: {error}"), true),
            None => {}
        }
        let beside = self.link.latest_beside();
        self.status_beside = beside.status;
        let is_there = self.companion().is_some() && beside.frame.generation == self.link.generation_beside();
        self.frame_beside = Some(beside.frame).filter(|frame| is_there && !frame.radiance.is_empty());
        let published = self.link.latest();
        let before = std::mem::replace(&mut self.status, published.status);
        if before.state != self.status.state {
            self.set_title();
        }
        let order = self.what_to_develop(published.frame);
        self.darkroom.order(order);
        if let Some(print) = self.darkroom.take() {
            self.hang(print);
        }
    }

    /// A frame as the controls say it is seen.
    pub(super) fn what_to_develop(&mut self, frame: Arc<Frame>) -> Order {
        let compare = self.comparison();
        let beside = self.frame_beside.clone().filter(|_| compare.is_some());
        let term = self.frame_beside.clone().filter(|_| self.dock == Some(Tab::Bounces));
        let view = compare.and_then(|compare| compare.view());
        let pinned = if view.is_some() { beside.clone() } else { self.pinned.clone() };
        let look = Look { view: view.unwrap_or(self.look.view), ..self.look };
        // What was asked for last, whose camera has been checked; a scene that has just been opened is asked for in a moment.
        let is_open = |wish: &&Wish| self.opened.as_ref().is_some_and(|opened| Arc::ptr_eq(&wish.scene, &opened.scene));
        let wish = self.link.wish().filter(is_open).filter(|_| look.view.shows_features());
        let features = wish.and_then(|wish| self.finder.of(&wish.scene, &wish.camera, self.threads));
        Order {
            truth: self.truth(&frame),
            term: term.map(|of| Term { of, k: self.bounces.k, up_to: self.bounces.up_to }),
            frame,
            beside,
            shows_beside: compare.is_some_and(|compare| compare.layout.split() != Split::None),
            look,
            pinned,
            features,
            materials: self.opened.as_ref().map_or_else(|| Arc::from([]), |opened| opened.materials.clone()),
            most_side: self.ctx.input(|input| input.max_texture_side),
        }
    }

    /// Shows what was developed, and notes its figures.
    fn hang(&mut self, print: Print) {
        set(&self.ctx, &mut self.textures[0], "picture", Some(print.image));
        set(&self.ctx, &mut self.textures[1], "picture beside", print.image_beside);
        (self.against, self.against_beside) = (print.truth, print.truth_beside);
        (self.legend, self.seen, self.scores) = (print.legend, print.seen, print.scores);
        self.black = self.shows_nothing(print.lit);
        self.note_blackness(print.frame.generation);
        if let Some(wish) = self.link.wish() {
            self.history.look_at(&wish.scene, &wish.camera, print.held_against.as_ref());
            let frame = &print.frame;
            if frame.generation == self.link.generation() && !frame.is_coarse() {
                self.history.record(&wish.settings, frame.generation, Moment::of(frame, print.truth));
            }
            let beside =
                print.beside.as_ref().filter(|frame| frame.generation == self.link.generation_beside() && !frame.is_coarse());
            if let (Some(frame), Some(compare)) = (beside, self.compare.filter(|compare| compare.other != wish.settings)) {
                self.history.record(&compare.other, frame.generation, Moment::of(frame, print.truth_beside));
            }
        }
        self.shown = Some(print.frame);
    }

    /// Whether a picture with light in this part of its pixels shows nothing. Out of a closed object one path in a hundred million
    /// gets by rounding: in there, a few pixels with light are still nothing.
    pub(super) fn shows_nothing(&self, lit: f32) -> bool {
        const STRAY: f32 = 0.01;
        let is_shut_in = || self.link.wish().is_some_and(|wish| wish.scene.around(&wish.camera).is_some());
        lit == 0.0 || (lit < STRAY && is_shut_in())
    }

    /// Notes what a picture that has just come says of its camera: that it sees something, or why it sees nothing. To find the
    /// reason can take as long as to look at all triangles, so it is looked for once a picture.
    pub(super) fn note_blackness(&mut self, generation: u64) {
        // A picture of the scene before can come when another one has just been opened, but not been asked for.
        let is_open = |wish: &&Wish| self.opened.as_ref().is_some_and(|opened| Arc::ptr_eq(&wish.scene, &opened.scene));
        let is_latest = generation == self.link.generation();
        let Some(wish) = self.link.wish().filter(|_| is_latest).filter(is_open) else { return };
        if !self.black {
            (self.last_seeing, self.black_reason) = (Some(wish.camera), None);
        } else if self.black_reason.as_ref().is_none_or(|(of, _)| *of != generation) {
            self.black_reason = Some((generation, wish.scene.why_black(&wish.camera, &wish.settings)));
        }
    }

    /// The likeliest reason why what is shown is black, if it is.
    pub(super) fn why_black(&self) -> Option<String> {
        self.black_reason.as_ref().filter(|_| self.black).map(|(_, reason)| reason.clone())
    }

    /// What a frame must converge to.
    fn truth(&self, frame: &Frame) -> Option<Arc<Reference>> {
        self.truth_here().filter(|_| frame.generation == self.link.generation())
    }

    /// What the picture must converge to: what was dropped on the window, or what the scene says, which is known for the scene's own
    /// camera only.
    pub(super) fn truth_here(&self) -> Option<Arc<Reference>> {
        let (opened, wish) = (self.opened.as_ref()?, self.link.wish()?);
        if let Some(dropped) = &self.dropped_truth {
            let of_camera = Camera { resolution: wish.camera.resolution, ..dropped.camera };
            return Some(dropped.reference.clone()).filter(|_| of_camera == wish.camera);
        }
        let of_scene = Camera { resolution: wish.camera.resolution, ..opened.scene.camera };
        let is_of_scene = wish.camera == of_scene && Arc::ptr_eq(&wish.scene, &opened.scene);
        opened.truth.clone().filter(|_| is_of_scene)
    }

    fn take_reference(&mut self, dropped: DroppedTruth) {
        let name = &dropped.name;
        if let Some(mismatch) = dropped.reference.mismatch(dropped.camera.resolution) {
            self.tell(format!("{name}: {mismatch}. Set the resolution to that of the reference."), true);
        } else {
            self.tell(format!("The picture is now held against {name}"), false);
        }
        self.dropped_truth = Some(dropped);
    }

    fn open(&mut self, opened: Opened) {
        let scene = &opened.scene;
        if self.opened.as_ref().is_none_or(|before| before.path != opened.path) {
            // What suited another scene's light says nothing about this one's.
            self.look.display.exposure = 0.0;
        }
        if let Some(path) = &opened.path {
            catalogue::remember(&mut self.catalogue, &opened.name, path);
        }
        (self.camera, self.settings) = (scene.camera, scene.settings);
        self.budget = Budget { max_spp: scene.spp, steps: self.budget.steps, ..Budget::default() };
        (self.compare, self.pinned, self.dropped_truth, self.adviser) = (None, None, None, None);
        self.loader.forget_reference();
        // What was found of the scene before would keep it in memory.
        (self.inspector, self.finder) = (Inspector::new(&self.ctx), FeatureFinder::new(&self.ctx));
        (self.last_seeing, self.black_reason) = (None, None);
        self.scene_error = None;
        self.view.fit();
        self.opened = Some(opened);
        self.set_title();
    }

    /// The window's title says which target is reached: a window that is not looked at is known by its title.
    fn set_title(&self) {
        let Some(opened) = &self.opened else { return };
        let done = if let State::Done(target) = self.status.state { format!(" ({target})") } else { String::new() };
        self.ctx.send_viewport_cmd(egui::ViewportCommand::Title(format!("{}{done} – Noisefall", opened.name)));
    }
}

/// Puts an image into a texture, or takes it away.
fn set(ctx: &egui::Context, texture: &mut Option<TextureHandle>, name: &str, image: Option<egui::ColorImage>) {
    match (texture, image) {
        (Some(texture), Some(image)) => texture.set(image, TextureOptions::NEAREST),
        (texture, image) => *texture = image.map(|image| ctx.load_texture(name, image, TextureOptions::NEAREST)),
    }
}
