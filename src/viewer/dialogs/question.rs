//! A window that asks a question, with a button for each answer.
use egui::{Align2, Button, RichText, Ui};

/// A button and its answer.
pub struct Choice<A> {
    pub name: &'static str,
    pub doc: &'static str,
    pub answer: A,
    /// Why the answer cannot be given now.
    pub refusal: Option<&'static str>,
}

impl<A> Choice<A> {
    pub fn new(name: &'static str, doc: &'static str, answer: A) -> Choice<A> {
        Choice { name, doc, answer, refusal: None }
    }
}

/// Asks a question. `explain` shows its text. The first button is the one to notice. A window that is closed answers `closed`.
pub fn ask<A>(
    ctx: &egui::Context,
    title: &str,
    width: f32,
    explain: impl FnOnce(&mut Ui),
    choices: impl IntoIterator<Item = Choice<A>>,
    closed: A,
) -> Option<A> {
    let (mut open, mut answer) = (true, None);
    egui::Window::new(title).open(&mut open).collapsible(false).resizable(false).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(
        ctx,
        |ui| {
            ui.set_width(width);
            explain(ui);
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                for (place, choice) in choices.into_iter().enumerate() {
                    let name = RichText::new(choice.name);
                    let button = Button::new(if place == 0 { name.strong() } else { name });
                    let response = ui.add_enabled(choice.refusal.is_none(), button).on_hover_text(choice.doc);
                    if response.on_disabled_hover_text(choice.refusal.unwrap_or_default()).clicked() {
                        answer = Some(choice.answer);
                    }
                }
            });
        },
    );
    if open { answer } else { Some(closed) }
}
