//! The instruments below the picture: one at a time, or none.
use egui::{Panel, Ui};

use super::{app::App, link::Companion};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tab {
    Convergence,
    Compare,
    Bounces,
    Path,
}

const TABS: [(Tab, &str, &str); 4] = [
    (Tab::Convergence, "Convergence", "How the error falls, and how it should. (F2)"),
    (Tab::Compare, "Compare", "Two settings of this scene in the same time. (F3)"),
    (Tab::Bounces, "Bounces", "The picture by numbers of bounces. (F4)"),
    (Tab::Path, "Pixel", "A pixel's samples, and single paths vertex by vertex. (F5)"),
];

const HEIGHT: f32 = 250.0;

impl App {
    /// The row of tabs, and what the open one shows.
    pub(super) fn dock(&mut self, ui: &mut Ui) {
        Panel::bottom("tabs").show(ui, |ui| {
            ui.horizontal(|ui| {
                for (tab, name, doc) in TABS {
                    let open = self.dock == Some(tab);
                    if ui.selectable_label(open, name).on_hover_text(doc).clicked() {
                        self.toggle_tab(tab);
                    }
                }
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| self.view_choice(ui));
            });
        });
        let Some(tab) = self.dock else { return };
        let most = (ui.available_height() - 160.0).max(120.0);
        Panel::bottom("instrument").resizable(true).default_size(HEIGHT.min(most)).max_size(most).show(ui, |ui| {
            // What is shown fills the panel, whose height is the user's.
            let room = ui.available_size();
            ui.set_min_size(room);
            match tab {
                Tab::Convergence => self.convergence(ui),
                Tab::Compare => self.compare_tab(ui),
                Tab::Bounces => self.bounces_tab(ui),
                Tab::Path => self.path_tab(ui),
            }
        });
    }

    pub(super) fn toggle_tab(&mut self, tab: Tab) {
        self.dock = (self.dock != Some(tab)).then_some(tab);
    }

    /// What the open instrument has rendered beside the picture: nothing is, where nobody looks.
    pub(super) fn companion(&self) -> Option<Companion> {
        match self.dock {
            Some(Tab::Bounces) => self.has_room_for_series().then_some(Companion::Series),
            _ => self.compare.map(|compare| Companion::Other(compare.other)),
        }
    }
}
