//! The state of the window and its layout. Each panel is a file of its own.
use std::{path::PathBuf, sync::Arc};

use egui::{CentralPanel, Panel, ScrollArea, TextureHandle, TextureOptions};
use noisefall::{
    render::{Budget, Display, Frame, State, Status, pass::Threads, truth::Reference},
    scene::{Camera, RenderSettings, built_in},
};

use super::{
    canvas::{self, Tool, View},
    catalogue,
    darkroom::{Darkroom, Order},
    link::{Link, Wish},
    loader::{Loader, Opened},
    look::{dark, section},
    messages::Notice,
    objects_panel::objects_panel,
    path_field::PathField,
    saver::Saver,
};

pub struct App {
    pub(super) ctx: egui::Context,
    pub(super) link: Link,
    darkroom: Darkroom,
    pub(super) loader: Loader,
    pub(super) saver: Saver,

    /// What the user wants.
    pub(super) opened: Option<Opened>,
    pub(super) camera: Camera,
    pub(super) settings: RenderSettings,
    pub(super) budget: Budget,
    pub(super) display: Display,

    /// What there is.
    pub(super) status: Status,
    pub(super) shown: Option<Arc<Frame>>,
    pub(super) true_rel_mse: Option<f64>,
    /// No sample of what is shown has found light.
    pub(super) black: bool,
    texture: Option<TextureHandle>,

    /// The window itself.
    pub(super) tool: Tool,
    pub(super) view: View,
    pub(super) hovered: Option<[u32; 2]>,
    pub(super) help_open: bool,
    pub(super) save_dialog: Option<PathField>,
    pub(super) open_dialog: Option<PathField>,
    pub(super) last_saved: Option<PathBuf>,
    pub(super) catalogue: Vec<catalogue::Entry>,
    /// Why the last scene could not be opened.
    pub(super) scene_error: Option<String>,
    pub(super) notice: Option<Notice>,
}

impl App {
    pub fn new(ctx: &egui::Context, threads: Threads, scene: Option<PathBuf>) -> App {
        dark(ctx);
        // The default is meant for a scene to be replaced within a moment: the loader opens the one asked for.
        let default = built_in();
        let mut loader = Loader::new(ctx);
        loader.open(scene);
        App {
            ctx: ctx.clone(),
            link: Link::new(threads, ctx),
            darkroom: Darkroom::new(ctx),
            loader,
            saver: Saver::new(ctx),
            opened: None,
            camera: default.camera,
            settings: default.settings,
            budget: Budget::default(),
            display: Display::default(),
            status: Status::default(),
            shown: None,
            true_rel_mse: None,
            black: false,
            texture: None,
            tool: Tool::default(),
            view: View::default(),
            hovered: None,
            help_open: false,
            save_dialog: None,
            open_dialog: None,
            last_saved: None,
            catalogue: catalogue::find(),
            scene_error: None,
            notice: None,
        }
    }

    /// One frame of the window.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        let ctx = ui.ctx().clone();
        self.shortcuts(&ctx);
        self.open_dropped_file();
        self.receive();
        Panel::bottom("status").show(ui, |ui| self.status_bar(ui));
        Panel::right("settings").resizable(false).exact_size(336.0).show(ui, |ui| self.panels(ui));
        Panel::top("toolbar").show(ui, |ui| self.toolbar(ui));
        CentralPanel::no_frame().show(ui, |ui| self.canvas(ui));
        self.save_dialog(&ctx);
        self.open_dialog(&ctx);
        self.help(&ctx);
        self.scene_error_window(&ctx);
        self.notice(&ctx);
        self.submit();
    }

    fn panels(&mut self, ui: &mut egui::Ui) {
        // The bar has room of its own: it would lie over what is at the right.
        let scroll = &mut ui.spacing_mut().scroll;
        scroll.floating_allocated_width = scroll.bar_width;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add_space(4.0);
            self.scene_panel(ui);
            ui.add_space(4.0);
            ui.add_enabled_ui(self.opened.is_some(), |ui| {
                section(ui, "Sampling", |ui| self.sampling_panel(ui));
                section(ui, "Camera", |ui| self.camera_panel(ui));
                section(ui, "Display", |ui| self.display_panel(ui));
                if let Some(opened) = &self.opened {
                    section(ui, "Objects", |ui| objects_panel(ui, &opened.scene));
                }
            });
        });
    }

    fn canvas(&mut self, ui: &mut egui::Ui) {
        let texture = self.texture.as_ref().map(TextureHandle::id);
        let size = self.opened.as_ref().map_or(1.0, |opened| opened.scene.size);
        let keys = self.save_dialog.is_none() && self.open_dialog.is_none() && !self.help_open;
        // The picture keeps its own shape until another one is there, which may be never: settings can be impossible.
        let resolution = self.shown.as_ref().map_or(self.camera.resolution, |frame| frame.full_resolution);
        let picture = texture.map(|texture| (texture, resolution));
        let output = canvas::show(ui, picture, self.tool, &mut self.view, &self.camera, size, keys);
        self.hovered = output.hovered;
        if let Some(camera) = output.camera.filter(|camera| camera.check().is_ok()) {
            self.camera = camera;
        }
    }

    /// Takes in what the threads have finished.
    fn receive(&mut self) {
        match self.loader.take() {
            Some(Ok(opened)) => self.open(opened),
            Some(Err(report)) => self.scene_error = Some(report),
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
        let published = self.link.latest();
        self.status = published.status;
        let most_side = self.ctx.input(|input| input.max_texture_side);
        let order = Order { truth: self.truth(&published.frame), frame: published.frame, display: self.display, most_side };
        self.darkroom.order(order);
        if let Some(print) = self.darkroom.take() {
            match &mut self.texture {
                Some(texture) => texture.set(print.image, TextureOptions::NEAREST),
                None => self.texture = Some(self.ctx.load_texture("picture", print.image, TextureOptions::NEAREST)),
            }
            (self.true_rel_mse, self.black) = (print.rel_mse, print.black);
            self.shown = Some(print.frame);
        }
    }

    /// The likeliest reason why what is shown is black, if it is.
    pub(super) fn why_black(&self) -> Option<String> {
        let wish = self.link.wish().filter(|_| self.black)?;
        Some(wish.scene.why_black(&wish.camera, &wish.settings))
    }

    /// What a frame must converge to: known for the scene's own camera only.
    fn truth(&self, frame: &Frame) -> Option<Arc<Reference>> {
        let (opened, wish) = (self.opened.as_ref()?, self.link.wish()?);
        let of_scene = Camera { resolution: wish.camera.resolution, ..opened.scene.camera };
        let is_of_scene = wish.camera == of_scene && Arc::ptr_eq(&wish.scene, &opened.scene);
        opened.truth.clone().filter(|_| is_of_scene && frame.generation == self.link.generation())
    }

    fn open(&mut self, opened: Opened) {
        let scene = &opened.scene;
        if self.opened.as_ref().is_none_or(|before| before.path != opened.path) {
            // What suited another scene's light says nothing about this one's.
            self.display.exposure = 0.0;
        }
        if let Some(path) = &opened.path {
            catalogue::remember(&mut self.catalogue, &opened.name, path);
        }
        self.ctx.send_viewport_cmd(egui::ViewportCommand::Title(format!("{} – Noisefall", opened.name)));
        (self.camera, self.settings) = (scene.camera, scene.settings);
        self.budget = Budget { max_spp: scene.spp, steps: self.budget.steps, ..Budget::default() };
        self.scene_error = None;
        self.view.fit();
        self.opened = Some(opened);
    }

    /// Asks the worker for what the controls say.
    fn submit(&mut self) {
        let Some(opened) = &self.opened else { return };
        if self.camera.check().is_ok() {
            let wish = Wish { scene: opened.scene.clone(), camera: self.camera, settings: self.settings };
            self.link.update(wish, self.budget);
        }
    }

    pub(super) fn toggle_pause(&mut self) {
        self.budget.paused = !self.budget.paused;
    }

    pub(super) fn step(&mut self) {
        if self.status.state != State::Converged {
            self.budget.steps += 1;
            self.budget.paused = true;
        }
    }

    pub(super) fn reset_camera(&mut self) {
        if let Some(opened) = &self.opened {
            self.camera = opened.scene.camera;
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}
