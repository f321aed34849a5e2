//! Lists and menus that close when something is chosen. By itself egui closes them for the mouse, and not for keys.
use egui::{IntoAtoms, RectAlign, Response, Tooltip, Ui};

/// An entry that is marked or not.
pub fn entry<'a>(ui: &mut Ui, is_chosen: bool, text: impl IntoAtoms<'a>) -> Response {
    let response = ui.selectable_label(is_chosen, text);
    closing(ui, response.clicked().then_some(()));
    response
}

/// An entry that sets `chosen` to a value.
pub fn value_entry<'a, T: PartialEq>(ui: &mut Ui, chosen: &mut T, value: T, text: impl IntoAtoms<'a>) -> Response {
    let response = entry(ui, *chosen == value, text);
    if response.clicked() {
        *chosen = value;
    }
    response
}

/// Explains an entry beside its list: below it, the text would hide the next entries.
pub fn explained(entry: Response, doc: &str) -> Response {
    const SIDES: [RectAlign; 2] = [RectAlign::RIGHT_START, RectAlign::LEFT_START];
    let mut tooltip = Tooltip::for_enabled(&entry);
    tooltip.popup = tooltip.popup.align(SIDES[0]).align_alternatives(&SIDES[1..]);
    tooltip.show(|ui| ui.label(doc));
    entry
}

/// Returns the choice in the list or menu of `ui`, and closes it if there is one.
pub fn closing<T>(ui: &Ui, chosen: Option<T>) -> Option<T> {
    if chosen.is_some() {
        ui.close();
    }
    chosen
}
