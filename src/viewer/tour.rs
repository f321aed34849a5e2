//! A short tour on first run: what noise, bounces and roulette are, shown on the picture itself.
use egui::{Align2, Button, RichText};
use noisefall::scene::Roulette;

use super::{app::App, dock::Tab, look::Inks};

/// What a button of the tour does.
type Act = fn(&mut App);

/// A page of the tour, and what it opens in the window.
struct Page {
    title: &'static str,
    text: &'static str,
    shows: Option<Tab>,
    /// A button that tries it out.
    tries: Option<(&'static str, Act)>,
}

const PAGES: [Page; 4] = [
    Page {
        title: "This picture is an estimate",
        text: "Every pixel is the mean of N random light paths. The samples scatter, and the mean comes nearer to the solution of \
               the light transport equation as 1/√N: four times the samples, half the noise. The curve below shows it, live; the \
               line at the bottom of the window says how far it has come.",
        shows: Some(Tab::Convergence),
        tries: Some(("Start over", |app| app.link.restart())),
    },
    Page {
        title: "Light bounces",
        text: "The solution is a series: light straight from the lamps, light reflected once, twice, and so on. The bars below are \
               what each of these brings. Cut the series short, by a bounce cap, and light is missing for ever: the picture is \
               biased, and the window says so.",
        shows: Some(Tab::Bounces),
        tries: Some(("Show bounce 2 alone", |app| (app.bounces.k, app.bounces.up_to) = (2, false))),
    },
    Page {
        title: "Roulette ends paths, and takes nothing away",
        text: "Instead of a cap, a path ends at random: it survives with probability q, and survivors count 1/q times as much. The \
               mean stays exactly right, at finite cost. Compare it with a cap of 3: what differs is the missing light.",
        shows: Some(Tab::Compare),
        tries: Some(("Compare with a cap of 3", |app| {
            app.settings.roulette = Roulette::BY_THROUGHPUT;
            let capped = noisefall::scene::RenderSettings { max_bounces: Some(3), ..app.settings };
            app.start_comparison(capped);
        })),
    },
    Page {
        title: "Now you",
        text: "Change the sampler or the estimator and watch the curves (F2). Drag with the tool Camera (C) to move through the scene, \
               click with Inspect (I) to see the paths of a pixel, open the gallery (F6) for other scenes. Everything explains \
               itself when the pointer rests on it; F1 lists the keys.",
        shows: None,
        tries: Some(("Open the gallery", |app| app.gallery.open = true)),
    },
];

impl App {
    pub(super) fn start_tour(&mut self) {
        self.go_to_page(0);
    }

    fn go_to_page(&mut self, page: usize) {
        self.tour = Some(page);
        if let Some(tab) = PAGES[page].shows {
            self.dock = Some(tab);
        }
    }

    /// Whether there was one to end.
    pub(super) fn end_tour(&mut self) -> bool {
        self.preferences.change(|preferences| preferences.toured |= self.tour.is_some());
        self.tour.take().is_some()
    }

    pub(super) fn show_tour(&mut self, ctx: &egui::Context) {
        let Some(number) = self.tour.filter(|_| self.shown.is_some()) else { return };
        let page = &PAGES[number];
        let (mut to, mut ends) = (None, false);
        egui::Window::new("Tour")
            .title_bar(false)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::LEFT_TOP, [14.0, 48.0])
            .show(ctx, |ui| {
                ui.set_width(380.0);
                ui.label(RichText::new(page.title).heading().color(ui.accent()));
                ui.add_space(4.0);
                ui.label(page.text);
                ui.add_space(6.0);
                if let Some((name, act)) = page.tries
                    && ui.button(name).clicked()
                {
                    act(self);
                }
                ui.add_space(6.0);
                ui.horizontal(|ui| {
                    ui.weak(format!("{} of {}", number + 1, PAGES.len()));
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                        let last = number + 1 == PAGES.len();
                        if ui.add(Button::new(RichText::new(if last { "Done" } else { "Next" }).strong())).clicked() {
                            (to, ends) = ((!last).then_some(number + 1), last);
                        }
                        if ui.add_enabled(number > 0, Button::new("Back")).clicked() {
                            to = Some(number - 1);
                        }
                        ends |= !last && ui.button("End tour").clicked();
                    });
                });
            });
        if let Some(page) = to {
            self.go_to_page(page);
        }
        if ends {
            self.end_tour();
        }
    }
}
