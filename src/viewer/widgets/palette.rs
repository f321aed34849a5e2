//! Colours with a meaning, and the themes.
use egui::Color32;

/// Colours with a meaning, legible on the background of the theme.
pub trait Palette {
    fn visuals(&self) -> &egui::Visuals;

    /// For a good state.
    fn good(&self) -> Color32 {
        if self.visuals().dark_mode { Color32::from_rgb(80, 180, 110) } else { Color32::from_rgb(20, 118, 56) }
    }

    /// For a warning.
    fn warning(&self) -> Color32 {
        self.visuals().warn_fg_color
    }

    /// For an error.
    fn bad(&self) -> Color32 {
        self.visuals().error_fg_color
    }

    /// For emphasis and selections.
    fn accent(&self) -> Color32 {
        if self.visuals().dark_mode { Color32::from_rgb(110, 190, 240) } else { Color32::from_rgb(0, 92, 150) }
    }
}

impl Palette for egui::Ui {
    fn visuals(&self) -> &egui::Visuals {
        self.visuals()
    }
}

impl Palette for egui::Visuals {
    fn visuals(&self) -> &egui::Visuals {
        self
    }
}

/// Adds the letters of the monospaced font to the proportional one, which has no arrows.
pub fn set_fonts(ctx: &egui::Context) {
    let mut fonts = egui::FontDefinitions::default();
    let monospace = fonts.families.get(&egui::FontFamily::Monospace).cloned().unwrap_or_default();
    let proportional = fonts.families.entry(egui::FontFamily::Proportional).or_default();
    proportional.extend(monospace.into_iter().filter(|name| name == "Hack"));
    ctx.set_fonts(fonts);
}

/// Sets both themes, with faint colours made legible, and selects one.
pub fn set_themes(ctx: &egui::Context, chosen: Option<&str>) {
    ctx.set_theme(match chosen {
        Some("dark") => egui::ThemePreference::Dark,
        Some("light") => egui::ThemePreference::Light,
        _ => egui::ThemePreference::System,
    });
    ctx.all_styles_mut(|style| {
        // The height of a list is limited by the window only.
        style.spacing.default_area_size.y = 4096.0;
        // A menu of all kinds needs no scrolling.
        style.spacing.combo_height = 480.0;
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
