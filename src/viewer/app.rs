//! The state of the window and its layout. Each panel is a file of its own.
use std::{
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};

use egui::{CentralPanel, Panel, ScrollArea, TextureHandle};
use noisefall::{
    render::{
        Budget, Frame, Region, Status,
        pass::Threads,
        view::{Legend, Look, Scores},
    },
    scene::{Camera, RenderSettings, built_in},
};

use super::{
    advice::Adviser,
    bounces::Bounces,
    canvas::{self, Pictures, Split, Tool},
    catalogue,
    compare::Compare,
    convergence::History,
    darkroom::{Against, Darkroom, Seen},
    dock::Tab,
    feature_finder::FeatureFinder,
    gallery::Gallery,
    link::Link,
    loader::{DroppedTruth, Loader, Opened},
    look::{PANEL_WIDTH, section, themes},
    messages::Notice,
    objects_panel::objects_panel,
    pace::Pace,
    path::Inspector,
    picture_view::View,
    preferences::Preferences,
    save_dialog::SaveDialog,
    saver::Saver,
};

pub struct App {
    pub(super) ctx: egui::Context,
    pub(super) link: Link,
    pub(super) darkroom: Darkroom,
    pub(super) loader: Loader,
    pub(super) saver: Saver,
    pub(super) finder: FeatureFinder,

    /// What the user wants.
    pub(super) opened: Option<Opened>,
    pub(super) camera: Camera,
    pub(super) settings: RenderSettings,
    pub(super) compare: Option<Compare>,
    pub(super) bounces: Bounces,
    pub(super) budget: Budget,
    pub(super) threads: usize,
    pub(super) look: Look,
    pub(super) pinned: Option<Arc<Frame>>,
    pub(super) dropped_truth: Option<DroppedTruth>,

    /// What there is.
    pub(super) status: Status,
    pub(super) status_beside: Status,
    pub(super) shown: Option<Arc<Frame>>,
    /// The latest frame of what is rendered beside the picture.
    pub(super) frame_beside: Option<Arc<Frame>>,
    pub(super) against: Option<Against>,
    pub(super) against_beside: Option<Against>,
    pub(super) legend: Option<Legend>,
    pub(super) seen: Seen,
    pub(super) scores: Option<Scores>,
    pub(super) history: History,
    /// What is shown is black.
    pub(super) black: bool,
    /// Why, and of which generation.
    pub(super) black_reason: Option<(u64, String)>,
    /// The last camera whose picture showed something.
    pub(super) last_seeing: Option<Camera>,
    pub(super) textures: [Option<TextureHandle>; 2],

    /// The window itself.
    pub(super) tool: Tool,
    pub(super) view: View,
    pub(super) dock: Option<Tab>,
    pub(super) hovered: Option<[u32; 2]>,
    /// It is a pixel of the second picture.
    pub(super) over_second: bool,
    /// A field or a list had the keyboard when the last frame ended.
    pub(super) had_focus: bool,
    /// The region that is being drawn.
    pub(super) marking: Option<Region>,
    pub(super) hidden: bool,
    pub(super) help_open: bool,
    pub(super) save_dialog: Option<SaveDialog>,
    pub(super) open_dialog: Option<super::path_field::PathField>,
    pub(super) last_saved: Option<PathBuf>,
    pub(super) catalogue: Vec<catalogue::Entry>,
    /// Why the last scene could not be opened.
    pub(super) scene_error: Option<String>,
    pub(super) notices: Vec<Notice>,
    pub(super) pace: Pace,
    pub(super) gallery: Gallery,
    pub(super) inspector: Inspector,
    /// The page of the tour that is open.
    pub(super) tour: Option<usize>,
    pub(super) preferences: Preferences,
    pub(super) adviser: Option<Adviser>,
}

impl App {
    pub fn new(ctx: &egui::Context, threads: Threads, scene: Option<PathBuf>, preferences: Preferences) -> App {
        themes(ctx, preferences.now.theme.as_deref());
        // The default is meant for a scene to be replaced within a moment: the loader opens the one asked for.
        let default = built_in();
        let mut loader = Loader::new(ctx);
        loader.open(scene);
        App {
            ctx: ctx.clone(),
            threads: threads.count(),
            link: Link::new(threads, ctx),
            darkroom: Darkroom::new(ctx),
            loader,
            saver: Saver::new(ctx),
            finder: FeatureFinder::new(ctx),
            opened: None,
            camera: default.camera,
            settings: default.settings,
            compare: None,
            bounces: Bounces::default(),
            budget: Budget::default(),
            look: Look::default(),
            pinned: None,
            dropped_truth: None,
            status: Status::default(),
            status_beside: Status::default(),
            shown: None,
            frame_beside: None,
            against: None,
            against_beside: None,
            legend: None,
            seen: Seen::default(),
            scores: None,
            history: History::default(),
            black: false,
            black_reason: None,
            last_seeing: None,
            textures: [None, None],
            tool: Tool::default(),
            view: View::default(),
            dock: None,
            hovered: None,
            over_second: false,
            had_focus: false,
            marking: None,
            hidden: false,
            help_open: false,
            save_dialog: None,
            open_dialog: None,
            last_saved: None,
            catalogue: catalogue::find(),
            scene_error: None,
            notices: Vec::new(),
            pace: Pace::default(),
            gallery: Gallery::default(),
            inspector: Inspector::new(ctx),
            tour: None,
            preferences,
            adviser: None,
        }
    }

    /// One frame of the window.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        let start = Instant::now();
        let ctx = ui.ctx().clone();
        self.hidden = false;
        self.shortcuts(&ctx);
        self.take_dropped_file();
        self.receive();
        self.inspect();
        Panel::bottom("status").show(ui, |ui| self.status_bar(ui));
        Panel::right("settings").resizable(false).exact_size(PANEL_WIDTH).show(ui, |ui| self.panels(ui));
        Panel::top("toolbar").show(ui, |ui| self.toolbar(ui));
        self.dock(ui);
        CentralPanel::no_frame().show(ui, |ui| self.canvas(ui));
        self.save_dialog(&ctx);
        self.open_dialog(&ctx);
        self.help(&ctx);
        self.scene_error_window(&ctx);
        self.show_gallery(&ctx);
        self.show_advice(&ctx);
        self.show_tour(&ctx);
        self.show_notices(&ctx);
        self.show_pace(&ctx);
        self.submit();
        self.had_focus = ctx.egui_wants_keyboard_input();
        self.pace.record(start.elapsed(), ctx.input(|input| input.time));
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
                section(ui, "Stop", |ui| self.stop_panel(ui));
                section(ui, "Display", |ui| self.display_panel(ui));
                section(ui, "Camera", |ui| self.camera_panel(ui));
                section(ui, "Window", |ui| self.window_panel(ui));
                if let Some(opened) = &self.opened {
                    section(ui, "Objects", |ui| objects_panel(ui, &opened.scene));
                }
            });
        });
    }

    fn canvas(&mut self, ui: &mut egui::Ui) {
        let scene = self.opened.as_ref().map(|opened| opened.scene.clone());
        // In an open list, arrows are the list's.
        let keys = !self.has_dialog() && !self.help_open && !self.gallery.open && !egui::Popup::is_any_open(ui.ctx());
        let output = canvas::show(ui, self.pictures(), self.tool, &mut self.view, &self.camera, scene.as_deref(), keys);
        (self.hovered, self.over_second) = (output.hovered, output.over_second);
        if let Some(camera) = output.camera.filter(|camera| camera.check().is_ok()) {
            self.camera = camera;
        }
        self.marking = output.marked.map(|(region, _)| region);
        if let Some((region, true)) = output.marked {
            self.budget.region = Some(region);
            self.marking = None;
        }
        if let Some(pixel) = output.clicked {
            self.click(pixel);
        }
        if let Some(place) = &output.place {
            self.overlay(ui, place);
            self.draw_path(ui, place);
            self.black_notice(ui, place);
        }
    }

    /// What the canvas draws.
    fn pictures(&self) -> Option<Pictures> {
        let [first, second] = self.textures.each_ref().map(|texture| texture.as_ref().map(TextureHandle::id));
        // The picture keeps its own shape until another one is there, which may be never: settings can be impossible.
        let resolution = self.shown.as_ref().map_or(self.camera.resolution, |frame| frame.full_resolution);
        let split = self.comparison().map_or(Split::None, |compare| compare.layout.split());
        Some(Pictures { first: first?, second: second.filter(|_| split != Split::None), resolution, split })
    }

    pub(super) fn reset_camera(&mut self) {
        if let Some(opened) = &self.opened {
            self.camera = opened.scene.camera;
        }
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.hide(ctx.input(|input| input.viewport().visible() == Some(false)));
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        frame.info().cpu_usage.into_iter().for_each(|last| self.pace.record_whole(Duration::from_secs_f32(last)));
        self.show(ui);
    }
}
