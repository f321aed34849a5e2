//! Joins the instruments below the image with the state of the window. At most one is open.
use std::sync::Arc;

use egui::{Align, Layout, Panel, ScrollArea, Ui};
use noisefall_render::render::{Frame, RenderRequest, RenderTask};
use noisefall_scene::scene::{RenderSettings, Strategy};

use super::state::App;
use crate::viewer::dialogs::save_target::SaveTarget;
use crate::viewer::instruments::{
    bounces, compare::comparison::CompareLayout, compare::comparison::Comparison, compare::figures::SideStatus,
    compare::tab as compare, convergence::plot, convergence::plot::CurveFile, light_paths, path::tab as path, strategies, tabs,
    tabs::InstrumentTab,
};
use crate::viewer::panels::views;

/// Height of an instrument at first, points: the image has more than half of a low window.
const HEIGHT: f32 = 250.0;
const PART: f32 = 0.45;
/// Width that the tabs and the choice of a view need beside each other, points.
const TABS: f32 = 500.0;

impl App {
    /// Shows the row of tabs and the open instrument.
    pub fn dock(&mut self, ui: &mut Ui) {
        Panel::bottom("tabs").show(ui, |ui| {
            let is_narrow = ui.available_width() < TABS;
            ui.horizontal(|ui| {
                tabs::show(ui, self.window.tab).into_iter().for_each(|tab| self.toggle_tab(tab));
                if !is_narrow {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| views::choice(ui, &mut self.session.look.view));
                }
            });
            if is_narrow {
                ui.horizontal(|ui| {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| views::choice(ui, &mut self.session.look.view));
                });
            }
        });
        let Some(tab) = self.window.tab else { return };
        if self.is_menu(tab) {
            Panel::bottom("menu of an instrument").show(ui, |ui| self.compare_tab(ui));
            return;
        }
        let most = (ui.available_height() - 160.0).max(120.0);
        Panel::bottom("instrument")
            .resizable(true)
            .default_size(HEIGHT.min(PART * ui.available_height()).min(most))
            .max_size(most)
            .show(ui, |ui| {
                // The contents fill the panel, whose height is the user's.
                let room = ui.available_size();
                ui.set_min_size(room);
                self.instrument(ui, tab);
            });
    }

    /// Whether the instrument only asks what to compare with: a line, which leaves the room to the image.
    fn is_menu(&self, tab: InstrumentTab) -> bool {
        tab == InstrumentTab::Compare && self.session.comparison.is_none()
    }

    pub fn instrument(&mut self, ui: &mut Ui, tab: InstrumentTab) {
        let resolution = self.session.camera.resolution;
        match tab {
            InstrumentTab::Convergence => self.convergence_tab(ui),
            InstrumentTab::Compare => _ = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.compare_tab(ui)),
            InstrumentTab::Bounces => {
                let opened = self.session.opened.as_ref();
                let has_light_paths = opened.is_some_and(|opened| light_paths::are_traced(&opened.scene, &self.session.settings));
                let (frame, view) = (self.results.second_frame.as_deref(), self.session.look.view);
                let without_strategies = self.without_strategies();
                let without_strategies = without_strategies.as_deref();
                let subject = bounces::Subject { frame, view, resolution, has_light_paths, without_strategies };
                let show = |ui: &mut Ui| bounces::show(ui, &mut self.session.bounces, subject);
                ScrollArea::vertical().auto_shrink(false).show(ui, show);
            }
            InstrumentTab::Path => {
                let (request, frame) = (self.inspected_request(), self.inspected_frame());
                let side = self.comparison().map(|_| if self.instruments.path.of_second { "B" } else { "A" });
                let subject = path::Subject { request: request.as_ref(), frame: frame.as_deref(), side, resolution };
                if path::show(ui, &mut self.instruments.path, &subject) {
                    self.open_save_dialog(SaveTarget::Path);
                }
            }
        }
    }

    fn convergence_tab(&mut self, ui: &mut Ui) {
        let worker = &self.background.worker;
        let latest = [Some(worker.generation()), self.session.comparison.map(|_| worker.second_generation())];
        let has_reference = self.reference().is_some();
        let file = plot::show(ui, &mut self.instruments.history, latest, has_reference);
        file.into_iter().for_each(|file| match file {
            CurveFile::Csv => self.open_save_dialog(SaveTarget::CurvesCsv),
            CurveFile::Svg => self.open_save_dialog(SaveTarget::CurvesSvg),
        });
    }

    fn compare_tab(&mut self, ui: &mut Ui) {
        let (session, results) = (&mut self.session, &self.results);
        let of_scene = session.opened.as_ref().map_or_else(RenderSettings::default, |opened| opened.scene.settings);
        let sides = [
            SideStatus { status: &results.status, comparison: results.comparison },
            SideStatus { status: &results.second_status, comparison: results.second_comparison },
        ];
        let wipe = &mut self.window.view.wipe;
        let ratio = results.error_ratio;
        let other = compare::show(ui, &mut session.settings, &mut session.comparison, wipe, &of_scene, sides, ratio);
        other.into_iter().for_each(|other| self.start_comparison(other));
    }

    pub fn toggle_tab(&mut self, tab: InstrumentTab) {
        self.window.tab = (self.window.tab != Some(tab)).then_some(tab);
    }

    pub fn start_comparison(&mut self, other: RenderSettings) {
        let layout = self.session.comparison.map_or(CompareLayout::Wipe, |comparison| comparison.layout);
        self.session.comparison = Some(Comparison { other, layout, edits_other: false });
        self.window.tab = Some(InstrumentTab::Compare);
    }

    /// The comparison, while its instrument renders.
    pub fn comparison(&self) -> Option<Comparison> {
        self.session.comparison.filter(|_| self.window.tab != Some(InstrumentTab::Bounces))
    }

    /// The second view of the open instrument: none is rendered unless it is displayed.
    pub fn second_view(&self) -> Option<RenderTask> {
        let request = self.session.request()?;
        match self.window.tab {
            Some(InstrumentTab::Bounces) => {
                let has_room = bounces::has_room_for_series(request.camera.resolution);
                has_room.then(|| match self.strategy() {
                    Some(strategy) => {
                        RenderTask::Picture(RenderRequest { settings: request.settings.of_strategy(strategy), ..request })
                    }
                    None => RenderTask::Series(request),
                })
            }
            tab => match self.session.comparison {
                Some(comparison) => Some(RenderTask::Picture(RenderRequest { settings: comparison.other, ..request })),
                None => (tab == Some(InstrumentTab::Convergence)).then(|| self.series_of_cap(request)).flatten(),
            },
        }
    }

    /// The series that tells the bias of the caps of the curves, while it is not known.
    fn series_of_cap(&self, request: RenderRequest) -> Option<RenderTask> {
        let settings = RenderSettings { max_bounces: None, ..request.settings };
        let is_needed = self.instruments.history.needs_series() && bounces::has_room_for_series(request.camera.resolution);
        is_needed.then_some(RenderTask::Series(RenderRequest { settings, ..request }))
    }

    /// The strategy of bidirectional paths that the image shows, if the scene has any.
    pub fn strategy(&self) -> Option<Strategy> {
        let strategy = self.session.bounces.strategy?;
        self.without_strategies().is_none().then_some(strategy)
    }

    /// Why there are no strategies of bidirectional paths to show, if that is known. A render finds out.
    fn without_strategies(&self) -> Option<String> {
        let opened = self.session.opened.as_ref()?;
        let settings = self.session.settings.of_strategy(strategies::FIRST);
        opened.scene.estimator_in_force(&settings).map(|in_force| in_force.reason)
    }

    /// Traces what the path inspector shows, while it is open.
    pub fn inspect(&mut self) {
        let is_open = self.window.tab == Some(InstrumentTab::Path);
        if self.comparison().is_none() {
            self.instruments.path.of_second = false;
        }
        if let Some(request) = self.inspected_request().filter(|_| is_open) {
            let spp = self.inspected_frame().map_or(1, |frame| frame.spp);
            self.instruments.path.search(&request, spp);
        }
    }

    /// The image that the path inspector looks at: that of the side that was clicked.
    pub fn inspected_request(&self) -> Option<RenderRequest> {
        let request = self.background.worker.request()?.clone();
        let other = self.comparison().filter(|_| self.instruments.path.of_second).map(|comparison| comparison.other);
        Some(RenderRequest { settings: other.unwrap_or(request.settings), ..request })
    }

    fn inspected_frame(&self) -> Option<Arc<Frame>> {
        if self.instruments.path.of_second { self.results.second_frame.clone() } else { self.results.shown.clone() }
    }
}
