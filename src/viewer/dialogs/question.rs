//! A window that asks a question, with a button for each answer.
use egui::{Align2, Button, Response, RichText, Ui};

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

/// Asks a question. `explain` shows its text. The first button is the one to notice. It has the keyboard at first, which no widget
/// behind the question gets. A window that is closed answers `closed`.
pub fn ask<A>(
    ctx: &egui::Context,
    title: &str,
    width: f32,
    explain: impl FnOnce(&mut Ui),
    choices: impl IntoIterator<Item = Choice<A>>,
    closed: A,
) -> Option<A> {
    let (mut open, mut answer) = (true, None);
    let window = egui::Window::new(title).open(&mut open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
        hold_keyboard(ui);
        let mut focused = Vec::new();
        ui.set_width(width);
        explain(ui);
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            for (place, choice) in choices.into_iter().enumerate() {
                let name = RichText::new(choice.name);
                let button = Button::new(if place == 0 { name.strong() } else { name });
                let response = ui.add_enabled(choice.refusal.is_none(), button).on_hover_text(choice.doc);
                focused.extend(response.enabled().then(|| response.clone()));
                if response.on_disabled_hover_text(choice.refusal.unwrap_or_default()).clicked() {
                    answer = Some(choice.answer);
                }
            }
        });
        // Nothing behind it needs the keyboard, and Escape takes it from all.
        if !focused.iter().any(Response::has_focus)
            && let Some(first) = focused.first()
        {
            first.request_focus();
        }
    });
    if open { answer } else { Some(closed) }
}

/// Keeps keys and clicks from all widgets behind this window, as long as it calls this in each frame.
pub fn hold_keyboard(ui: &Ui) {
    ui.memory_mut(|memory| memory.set_modal_layer(ui.layer_id()));
}
