//! The tour on first run: noise, bounces, roulette and bidirectional paths, shown on the image itself.
use egui::{Button, RichText, ScrollArea, TextStyle, TextWrapMode, Ui, WidgetText, Window};

use crate::viewer::{instruments::tabs::InstrumentTab, widgets::palette::Palette};

/// An action that a page asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TourRequest {
    GoTo(usize),
    End,
    Restart,
    ShowSecondBounce,
    /// Compares roulette with a cap of 3 bounces.
    CompareWithCap,
    /// Compares MIS with bidirectional paths.
    CompareBidirectional,
    /// Opens a scene with a glass ball.
    OpenGlass,
    OpenGallery,
}

/// A page of the tour, and what it opens in the window.
struct Page {
    title: &'static str,
    text: &'static str,
    shows: Option<InstrumentTab>,
    /// A button that tries it out.
    tries: (&'static str, TourRequest),
    /// Its text for a scene without glass, and another button.
    without_glass: Option<(&'static str, (&'static str, TourRequest))>,
}

const PAGES: [Page; 5] = [
    Page {
        title: "This image is an estimate",
        text: "Every pixel is the mean of N random light paths. The samples scatter. Their mean approaches the solution of the light \
               transport equation as 1/√N, or faster with Sobol points: four times the samples halve the noise, or better. The curve below shows the error live. The status \
               line shows the samples and the noise so far.",
        shows: Some(InstrumentTab::Convergence),
        tries: ("Restart", TourRequest::Restart),
        without_glass: None,
    },
    Page {
        title: "Light bounces",
        text: "The solution is a series: emitted light, light reflected once, twice, and so on. The bars below show the share of each \
               term. A bounce cap cuts the series. The missing light makes the image biased, and the window says so.",
        shows: Some(InstrumentTab::Bounces),
        tries: ("Show bounce 2 alone", TourRequest::ShowSecondBounce),
        without_glass: None,
    },
    Page {
        title: "Roulette ends paths without bias",
        text: "A path can end at random instead of at a cap. It survives with probability q, and survivors count 1/q times as much. The \
               mean stays exact at finite cost. Compare it with a cap of 3: the difference is the missing light.",
        shows: Some(InstrumentTab::Compare),
        tries: ("Compare with a cap of 3", TourRequest::CompareWithCap),
        without_glass: None,
    },
    Page {
        title: "Bidirectional path tracing",
        text: "The glass focuses light to a caustic. Light paths reach it easily; camera paths rarely hit a small light through \
               glass. A strategy (s, t) takes s vertices from the light and t from the camera. Bidirectional path \
               tracing combines all strategies, each weighted by its pdf over the sum of all pdfs. The image stays the same. \
               Caustics have less noise, but simple scenes take more time.",
        shows: Some(InstrumentTab::Compare),
        tries: ("Compare MIS with bidirectional", TourRequest::CompareBidirectional),
        without_glass: Some((
            "Paths can also start at the lights. A strategy (s, t) takes s vertices from a light and t from the camera. Bidirectional \
             path tracing combines all strategies. This pays off for caustics, the light that glass focuses, and this scene has no \
             glass. Open one that has, and compare there.",
            ("Open a scene with glass", TourRequest::OpenGlass),
        )),
    },
    Page {
        title: "Your turn",
        text: "Change the sampler or the estimator and watch the curves (F2). Drag with the tool Camera (C) to move through the scene. \
               Click with Inspect (I) to see the paths of a pixel. Open the gallery (F6) for other scenes. Every control has a \
               tooltip; F1 lists the keys.",
        shows: None,
        tries: ("Open the gallery", TourRequest::OpenGallery),
        without_glass: None,
    },
];

/// Width of a page, and its distance from the edges and from the top of the window, in points.
const WIDTH: f32 = 380.0;
const MARGIN: f32 = 14.0;
const TOP: f32 = 48.0;
/// Between title and text.
const GAP: f32 = 4.0;
/// Height of the bar above the text and of the buttons below it, with the frame of the window.
const AROUND: f32 = 130.0;

/// The number of pages.
#[cfg(test)]
pub const COUNT: usize = PAGES.len();

/// The instrument that a page shows.
pub fn tab_of(page: usize) -> Option<InstrumentTab> {
    PAGES[page].shows
}

fn heading(ui: &Ui, page: &Page) -> RichText {
    RichText::new(page.title).heading().color(ui.accent())
}

impl Page {
    /// The text and the buttons for a scene.
    fn contents(&self, has_glass: bool) -> (&'static str, Vec<(&'static str, TourRequest)>) {
        match self.without_glass.filter(|_| !has_glass) {
            Some((text, opens)) => (text, vec![opens, self.tries]),
            None => (self.text, vec![self.tries]),
        }
    }
}

/// The height of the longest text of a page of this width.
fn height(ui: &Ui, page: &Page, width: f32) -> f32 {
    let layout = |text: WidgetText| text.into_galley(ui, Some(TextWrapMode::Wrap), width, TextStyle::Body).size().y;
    let texts = [true, false].map(|has_glass| layout(page.contents(has_glass).0.into()));
    let lines = layout(heading(ui, page).into()) + texts[0].max(texts[1]);
    (lines + GAP + ui.spacing().item_spacing.y).ceil()
}

/// Shows a page. The bar above it moves it.
pub fn show(ctx: &egui::Context, number: usize, has_glass: bool) -> Option<TourRequest> {
    let page = &PAGES[number];
    let (text, buttons) = page.contents(has_glass);
    let (mut open, mut request) = (true, None);
    // A small screen shows the buttons and scrolls the text.
    let screen = ctx.content_rect().size();
    let [width, most_height] = [WIDTH.min(screen.x - 3.0 * MARGIN), (screen.y - TOP - AROUND - MARGIN).max(60.0)];
    let window = Window::new("Tour").open(&mut open).collapsible(false).resizable(false).default_pos([MARGIN, TOP]);
    window.show(ctx, |ui| {
        ui.set_width(width);
        // The buttons stay where they are from page to page: a second click on Next must not hit the image.
        let height = PAGES.iter().map(|page| height(ui, page, width)).fold(0.0, f32::max).min(most_height);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink([true, false]).show(ui, |ui| {
            ui.label(heading(ui, page));
            ui.add_space(GAP);
            ui.label(text);
        });
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            for (name, asked) in buttons {
                if ui.button(name).clicked() {
                    request = Some(asked);
                }
            }
        });
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            ui.weak(format!("{} of {}", number + 1, PAGES.len()));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let last = number + 1 == PAGES.len();
                if ui.add(Button::new(RichText::new(if last { "Done" } else { "Next" }).strong())).clicked() {
                    request = Some(if last { TourRequest::End } else { TourRequest::GoTo(number + 1) });
                }
                if ui.add_enabled(number > 0, Button::new("Back")).clicked() {
                    request = Some(TourRequest::GoTo(number - 1));
                }
                if !last && ui.button("End tour").clicked() {
                    request = Some(TourRequest::End);
                }
            });
        });
    });
    if open { request } else { Some(TourRequest::End) }
}
