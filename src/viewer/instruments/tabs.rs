//! The row of tabs below the image. At most one instrument is open.
use egui::Ui;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstrumentTab {
    Convergence,
    Compare,
    Bounces,
    Path,
}

const TABS: [(InstrumentTab, &str, &str); 4] = [
    (InstrumentTab::Convergence, "Convergence", "Error and bias over samples or time. (F2)"),
    (InstrumentTab::Compare, "Compare", "Two settings at equal render time. (F3)"),
    (InstrumentTab::Bounces, "Bounces", "The image by number of bounces. (F4)"),
    (InstrumentTab::Path, "Pixel", "Samples of a pixel, and their paths term by term. (F5)"),
];

/// Shows the tabs. Returns the one that was clicked.
pub fn show(ui: &mut Ui, open: Option<InstrumentTab>) -> Option<InstrumentTab> {
    let mut clicked = None;
    for (tab, name, doc) in TABS {
        if ui.selectable_label(open == Some(tab), name).on_hover_text(doc).clicked() {
            clicked = Some(tab);
        }
    }
    clicked
}
