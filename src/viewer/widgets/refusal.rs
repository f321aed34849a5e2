//! The reason why a field refused the last number typed. The next key, button or other value ends the message.
use egui::{Context, Event, Id, Label, Response, RichText, Tooltip, Ui};

/// The message of the window: there is at most one.
#[derive(Clone)]
struct Refusal {
    field: Id,
    /// The value that the field has kept.
    value: f64,
    message: String,
    frame: u64,
}

fn place() -> Id {
    Id::unique("refused number")
}

/// Remembers that a field keeps a value, and why.
pub fn remember(ui: &Ui, field: Id, value: f64, message: String) {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.data_mut(|data| data.insert_temp(place(), Refusal { field, value, message, frame }));
}

/// The message of a field with this value, if it has one.
pub fn of(ui: &Ui, field: Id, value: f64) -> Option<String> {
    let last = ui.data(|data| data.get_temp::<Refusal>(place()))?;
    let goes_on = last.frame < ui.ctx().cumulative_frame_nr() && ui.input(|input| input.events.iter().any(is_press));
    if goes_on || (last.field == field && last.value != value) {
        ui.data_mut(|data| data.remove::<Refusal>(place()));
        return None;
    }
    (last.field == field).then_some(last.message)
}

/// Ends the message. Returns whether there was one.
pub fn dismiss(ctx: &Context) -> bool {
    let is_shown = ctx.data(|data| data.get_temp::<Refusal>(place()).is_some());
    ctx.data_mut(|data| data.remove::<Refusal>(place()));
    is_shown
}

fn is_press(event: &Event) -> bool {
    match event {
        Event::PointerButton { pressed, .. } => *pressed,
        // A key that is held for long is pressed once.
        Event::Key { pressed, repeat, .. } => *pressed && !*repeat,
        Event::Text(_) | Event::Paste(_) | Event::Cut => true,
        _ => false,
    }
}

/// Shows a message under a field, over what lies there: no row moves.
pub fn show_below(ui: &Ui, field: &Response, message: &str) {
    let tooltip = Tooltip::always_open(ui.ctx().clone(), ui.layer_id(), field.id.with("refusal"), field.rect);
    tooltip.show(|ui| {
        let message = RichText::new(message).color(ui.visuals().error_fg_color);
        // A text that can be selected would take the clicks of what lies below.
        ui.add(Label::new(message).selectable(false));
    });
}
