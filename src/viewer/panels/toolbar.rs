//! The buttons above the image.
use egui::{Button, Ui};
use noisefall_scene::scene::RenderSettings;

use crate::viewer::{canvas::interaction::Tool, instruments::compare::menu};

/// An action that a button or a key asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    TogglePause,
    Step,
    Restart,
    Undo,
    Redo,
    ChooseTool(Tool),
    ClearRegion,
    ResetCamera,
    Fit,
    ActualSize,
    Compare(RenderSettings),
    EndComparison,
    Open,
    SaveScene,
    SavePicture,
    Help,
}

/// The state that the buttons show.
pub struct Toolbar<'a> {
    pub is_open: bool,
    pub is_paused: bool,
    /// The render has reached its target.
    pub is_done: bool,
    pub has_region: bool,
    pub can_save: bool,
    pub is_comparing: bool,
    /// Names of the steps that undo and redo would revert and repeat.
    pub undo: [Option<String>; 2],
    pub tool: Tool,
    /// Screen pixels per image pixel, if there is an image.
    pub zoom: Option<f32>,
    pub settings: &'a RenderSettings,
}

const TOOLS: [(Tool, &str, &str); 4] = [
    (Tool::Picture, "Image", "Drag pans and the wheel zooms the image. Does not restart the render. (P)"),
    (Tool::Camera, "Camera", "Drag orbits, Shift+drag pans and the wheel dollies the camera. Restarts the render. (C)"),
    (Tool::Region, "Region", "Drag marks a region that is rendered first. Does not restart the render. (B)"),
    (Tool::Inspect, "Inspect", "Click shows the samples of a pixel and their paths. (I)"),
];

impl Toolbar<'_> {
    pub fn show(&self, ui: &mut Ui) -> Option<Command> {
        const WHOLE: f32 = 868.0;
        const OF_REGION: f32 = 56.0;
        const OF_ENDS: f32 = 104.0;
        const OF_IMAGE: f32 = 42.0;
        let needed = WHOLE + if self.has_region { OF_REGION } else { 0.0 };
        let room = ui.available_width() - needed;
        let is_narrow = room < 0.0;
        let (save_name, longer) = if room < OF_IMAGE { ("Save…", 0.0) } else { ("Save image…", OF_IMAGE) };
        let contents = |ui: &mut Ui| {
            let mut command = None;
            let mut asks = |asked: Option<Command>| command = asked.or(command);
            (ui.spacing_mut().button_padding, ui.spacing_mut().item_spacing.x) = (egui::vec2(5.0, 4.0), 6.0);
            asks(self.render_buttons(ui));
            ui.separator();
            asks(self.undo_buttons(ui));
            ui.separator();
            asks(self.tool_buttons(ui));
            ui.separator();
            let home = ui.add_enabled(self.is_open, Button::new("Home"));
            let doc = "Resets the camera to that of the scene, except for the resolution. (Home)";
            asks(home.on_hover_text(doc).clicked().then_some(Command::ResetCamera));
            if let Some(zoom) = self.zoom {
                asks(zoom_buttons(ui, zoom));
            }
            ui.separator();
            if self.is_comparing {
                let end = ui.button("End comparison").on_hover_text("Ends the comparison and continues with A.");
                asks(end.clicked().then_some(Command::EndComparison));
            } else {
                asks(menu::show(ui, self.settings).map(Command::Compare));
            }
            if !is_narrow {
                ui.add_space((ui.available_width() - OF_ENDS - longer).max(0.0));
            }
            let save = ui.add_enabled(self.can_save, Button::new(save_name));
            let doc = "Saves the image as PNG or EXR. (Ctrl+E)";
            asks(save.on_hover_text(doc).clicked().then_some(Command::SavePicture));
            asks(ui.button("Help").on_hover_text("Lists keys and mouse actions. (F1)").clicked().then_some(Command::Help));
            command
        };
        if is_narrow { ui.horizontal_wrapped(contents).inner } else { ui.horizontal(contents).inner }
    }

    fn render_buttons(&self, ui: &mut Ui) -> Option<Command> {
        let label = if self.is_paused { "Resume" } else { "Pause" };
        let step = "Pauses, and takes one more sample per pixel of the image or of the region. (.)";
        let buttons = [
            (
                Button::new(label).min_size(egui::vec2(66.0, 0.0)),
                "Pauses or resumes the render and keeps its samples. (Space)",
                Command::TogglePause,
                self.is_paused || !self.is_done,
            ),
            (Button::new("Step"), step, Command::Step, true),
            (Button::new("Restart"), "Restarts rendering. (Ctrl+R)", Command::Restart, true),
        ];
        let clicked = buttons.map(|(button, doc, command, is_possible)| {
            let button = ui.add_enabled(self.is_open && is_possible, button).on_hover_text(doc);
            let done = "The render has reached its target. To go on, raise the samples under Stop.";
            button.on_disabled_hover_text(if self.is_open { done } else { doc }).clicked().then_some(command)
        });
        clicked.into_iter().flatten().next()
    }

    fn undo_buttons(&self, ui: &mut Ui) -> Option<Command> {
        let mut command = None;
        let buttons = [("↶", "Undo", "Ctrl+Z", Command::Undo), ("↷", "Redo", "Ctrl+Shift+Z", Command::Redo)];
        for ((sign, name, keys, asked), what) in buttons.into_iter().zip(&self.undo) {
            let button = ui.add_enabled(what.is_some(), Button::new(sign));
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, what.is_some(), name));
            let doc = what
                .as_ref()
                .map_or_else(|| format!("Nothing to {}", name.to_lowercase()), |what| format!("{name} {what} ({keys})"));
            if button.on_hover_text(&doc).on_disabled_hover_text(&doc).clicked() {
                command = Some(asked);
            }
        }
        command
    }

    fn tool_buttons(&self, ui: &mut Ui) -> Option<Command> {
        let mut command = None;
        for (tool, name, doc) in TOOLS {
            if ui.selectable_label(self.tool == tool, name).on_hover_text(doc).clicked() {
                command = Some(Command::ChooseTool(tool));
            }
        }
        let doc = "Clears the region and renders the whole image. (Esc)";
        if self.has_region && ui.button("Clear").on_hover_text(doc).clicked() {
            command = Some(Command::ClearRegion);
        }
        command
    }
}

/// Width of the zoom in percent, points.
const ZOOM_WIDTH: f32 = 38.0;

/// A zoom in percent.
fn percent(zoom: f32) -> String {
    format!("{:.0} %", 100.0 * zoom)
}

fn zoom_buttons(ui: &mut Ui, zoom: f32) -> Option<Command> {
    let fits = ui.button("Fit").on_hover_text("Fits the image to the window. (F, double-click)").clicked();
    let is_actual = ui.button("1:1").on_hover_text("Shows one image pixel per screen pixel. (1)").clicked();
    // As wide as any zoom: what follows stays where it is.
    let size = egui::vec2(ZOOM_WIDTH, ui.spacing().interact_size.y);
    let label = egui::Label::new(egui::RichText::new(percent(zoom)).weak()).selectable(false);
    let shown = ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        ui.set_min_width(ZOOM_WIDTH);
        ui.add(label)
    });
    shown.inner.on_hover_text("Zoom: screen pixels per image pixel.");
    fits.then_some(Command::Fit).or(is_actual.then_some(Command::ActualSize))
}
