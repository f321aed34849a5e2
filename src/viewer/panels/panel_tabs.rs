//! The two pages of the side panel.
use egui::Ui;

/// A page of the side panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PanelTab {
    /// Settings of the render and the display.
    #[default]
    Render,
    /// Parts of the scene.
    Edit,
}

/// Shows the tabs, and changes the page.
pub fn show(ui: &mut Ui, page: &mut PanelTab) {
    ui.horizontal(|ui| {
        ui.selectable_value(page, PanelTab::Render, "Render").on_hover_text("Settings of the render and of the window.");
        ui.selectable_value(page, PanelTab::Edit, "Edit").on_hover_text("Objects, materials, textures and lights of the scene.");
    });
}
