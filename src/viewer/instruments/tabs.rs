//! The row of tabs below the picture. At most one instrument is open.
use egui::Ui;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstrumentTab {
    Convergence,
    Compare,
    Bounces,
    Path,
}

const TABS: [(InstrumentTab, &str, &str); 4] = [
    (InstrumentTab::Convergence, "Convergence", "How the error falls, and how it should. (F2)"),
    (InstrumentTab::Compare, "Compare", "Two settings of this scene in the same time. (F3)"),
    (InstrumentTab::Bounces, "Bounces", "The picture by numbers of bounces. (F4)"),
    (InstrumentTab::Path, "Pixel", "A pixel's samples, and single paths vertex by vertex. (F5)"),
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
