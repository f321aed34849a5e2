//! What all panels look like.
use egui::{CollapsingHeader, Color32, RichText};

/// Of the panel at the right.
pub(super) const PANEL_WIDTH: f32 = 336.0;

/// For what lies in the middle of the picture instead of the window's: how far it is moved, so far above where it would lie.
pub(super) fn over_the_picture(lift: f32) -> [f32; 2] {
    [-0.5 * PANEL_WIDTH, -lift]
}

/// A part of the side panel that can be folded away.
pub(super) fn section(ui: &mut egui::Ui, title: &str, contents: impl FnOnce(&mut egui::Ui)) {
    ui.separator();
    CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
        ui.add_space(4.0);
    });
}

/// A grid of labels and controls; all panels have their controls at the same place.
pub(super) fn controls(ui: &mut egui::Ui, name: &str, rows: impl FnOnce(&mut egui::Ui)) {
    const LABEL_WIDTH: f32 = 96.0;
    ui.spacing_mut().slider_width = 120.0;
    egui::Grid::new(name).num_columns(2).min_col_width(LABEL_WIDTH).spacing([8.0, 8.0]).show(ui, rows);
}

/// One row: a label that explains itself, and a control that screen readers know by it.
pub(super) fn row(ui: &mut egui::Ui, label: &str, doc: &str, control: impl FnOnce(&mut egui::Ui, egui::Id)) {
    let label = ui.label(label).on_hover_text(doc);
    control(ui, label.id);
    ui.end_row();
}

/// Text cut to a width; a tooltip says all of it.
pub(super) fn elided(ui: &mut egui::Ui, width: f32, text: impl Into<egui::WidgetText>) -> egui::Response {
    ui.scope(|ui| {
        ui.set_max_width(width);
        ui.add(egui::Label::new(text).truncate())
    })
    .inner
}

/// A square of a colour, before what it stands for.
pub(super) fn swatch(ui: &mut egui::Ui, colour: Color32) {
    let (rect, _) = ui.allocate_exact_size(egui::vec2(11.0, 11.0), egui::Sense::hover());
    ui.painter().rect_filled(rect, 2.0, colour);
}

/// Inks that mean something, as dark or light as text on the theme's ground must be.
pub(super) trait Inks {
    fn visuals(&self) -> &egui::Visuals;

    /// As it should be.
    fn good(&self) -> Color32 {
        if self.visuals().dark_mode { Color32::from_rgb(80, 180, 110) } else { Color32::from_rgb(20, 118, 56) }
    }

    /// To be minded.
    fn warning(&self) -> Color32 {
        self.visuals().warn_fg_color
    }

    /// Wrong.
    fn bad(&self) -> Color32 {
        self.visuals().error_fg_color
    }

    /// What is chosen, or said with emphasis.
    fn accent(&self) -> Color32 {
        if self.visuals().dark_mode { Color32::from_rgb(110, 190, 240) } else { Color32::from_rgb(0, 92, 150) }
    }
}

impl Inks for egui::Ui {
    fn visuals(&self) -> &egui::Visuals {
        self.visuals()
    }
}

impl Inks for egui::Visuals {
    fn visuals(&self) -> &egui::Visuals {
        self
    }
}

/// Both themes, with what is faint in them made legible, and the one that was chosen.
pub(super) fn themes(ctx: &egui::Context, chosen: Option<&str>) {
    ctx.set_theme(match chosen {
        Some("dark") => egui::ThemePreference::Dark,
        Some("light") => egui::ThemePreference::Light,
        _ => egui::ThemePreference::System,
    });
    ctx.all_styles_mut(|style| {
        // Lists are as tall as they say, within the window.
        style.spacing.default_area_size.y = 4096.0;
    });
    ctx.style_mut_of(egui::Theme::Dark, |style| {
        let visuals = &mut style.visuals;
        visuals.weak_text_color = Some(Color32::from_gray(150));
        (visuals.warn_fg_color, visuals.error_fg_color) = (Color32::from_rgb(222, 160, 60), Color32::from_rgb(228, 96, 88));
        visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(190);
        visuals.widgets.inactive.bg_stroke = egui::Stroke::new(1.0, Color32::from_gray(85));
    });
    ctx.style_mut_of(egui::Theme::Light, |style| {
        let visuals = &mut style.visuals;
        visuals.weak_text_color = Some(Color32::from_gray(95));
        (visuals.warn_fg_color, visuals.error_fg_color) = (Color32::from_rgb(148, 84, 0), Color32::from_rgb(178, 24, 24));
        visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(40);
        visuals.widgets.inactive.bg_stroke = egui::Stroke::new(1.0, Color32::from_gray(165));
    });
}
