//! The layout of a row: label, tooltip, optional mark, control.
use egui::{Align, Id, Label, Layout, Response, RichText, Ui, vec2};
use noisefall_base::declare::Parameter;

/// Width of the labels in points, while the panel is at its narrowest. They get half of what is added.
const LABEL_WIDTH: f32 = 104.0;
/// Width of rows in that panel.
const CONTENT_WIDTH: f32 = 320.0;

/// The mark before a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    None,
    /// A check box: whether the value or table is present.
    Optional(bool),
    /// A button that removes the item from its list.
    Item,
}

/// The label of a row.
#[derive(Clone, Debug)]
pub struct Heading {
    pub title: String,
    pub tooltip: String,
    pub mark: Mark,
}

impl Heading {
    /// The label of a parameter, with its symbol. The tooltip has its description and unit.
    pub fn of(parameter: &Parameter, mark: Mark) -> Heading {
        let symbol = if parameter.symbol.is_empty() { String::new() } else { format!(" {}", parameter.symbol) };
        let unit = if parameter.unit.is_empty() { String::new() } else { format!("\nUnit: {}", parameter.unit) };
        Heading { title: parameter.label() + &symbol, tooltip: format!("{}{unit}", parameter.doc), mark }
    }

    /// Adds the unit to the title, for controls that do not show it.
    pub fn with_unit(parameter: &Parameter, mark: Mark) -> Heading {
        let heading = Heading::of(parameter, mark);
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        Heading { title: heading.title + &unit, ..heading }
    }

    /// Shows the label with its mark in a row, with a control behind it. Returns whether the mark was clicked.
    pub fn row(&self, ui: &mut Ui, control: impl FnOnce(&mut Ui, Id)) -> bool {
        // A row wider than the panel would shift the panel.
        let row = ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let width = LABEL_WIDTH + (0.5 * (ui.available_width() - CONTENT_WIDTH)).max(0.0);
            let size = vec2(width, ui.spacing().interact_size.y);
            let label = ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
                ui.set_min_width(width);
                self.label(ui, RichText::new(&self.title))
            });
            let (label, is_marked) = label.inner;
            // Parts that do not fit beside the label go on below the control, and not below the label.
            ui.vertical(|ui| ui.horizontal_wrapped(|ui| control(ui, label.id)));
            is_marked
        });
        row.inner
    }

    /// Shows the label as the title of a table. Returns whether the mark was clicked.
    pub fn title(&self, ui: &mut Ui) -> bool {
        ui.horizontal(|ui| self.label(ui, RichText::new(&self.title).strong()).1).inner
    }

    /// The whole title, which the row may cut, and the tooltip.
    fn hover_text(&self) -> String {
        format!("{}\n{}", self.title, self.tooltip)
    }

    fn label(&self, ui: &mut Ui, text: RichText) -> (Response, bool) {
        let is_removed =
            self.mark == Mark::Item && ui.small_button("×").on_hover_text("Removes this item from the list.").clicked();
        if let Mark::Optional(mut is_given) = self.mark {
            let checkbox = ui.checkbox(&mut is_given, text).on_hover_text(self.hover_text());
            let is_clicked = checkbox.clicked();
            return (checkbox, is_clicked);
        }
        let label = ui.add(Label::new(text).wrap());
        (label.on_hover_text(self.hover_text()), is_removed)
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::{Harness, kittest::Queryable};

    use super::*;

    #[test]
    fn a_title_that_is_cut_stands_in_the_tooltip() {
        let parameter = Parameter::new("specular_roughness_anisotropy", "How far highlights are stretched.");
        let heading = Heading::of(&parameter, Mark::None);
        let mut harness = Harness::builder().with_size(vec2(400.0, 200.0)).build_ui(|ui| _ = heading.row(ui, |_, _| {}));
        harness.get_by_label("Specular roughness anisotropy").hover();
        harness.run_steps(8);
        assert!(harness.query_by_label("Specular roughness anisotropy\nHow far highlights are stretched.").is_some());
    }
}
