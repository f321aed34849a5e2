//! A text field that applies its text on Enter or when it loses the focus. Escape discards the edit.
use egui::{Id, Key, Response, TextEdit, Ui};

/// Outcome of an edit of a text field.
pub struct CommittedText {
    pub response: Response,
    /// The text as it stands in the field.
    pub typed: String,
    /// The text that was entered, if it differs from the current one.
    pub entered: Option<String>,
}

/// Shows the field; `current` is the text while nobody types.
pub fn show(ui: &mut Ui, label: Id, current: &str, width: f32) -> CommittedText {
    let id = ui.scope_id().with((label, "typed"));
    let mut typed = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| current.to_owned());
    let field = TextEdit::singleline(&mut typed).desired_width(width).clip_text(true);
    let response = ui.add(field).labelled_by(label);
    let is_entered = response.lost_focus() && !ui.input(|input| input.key_pressed(Key::Escape));
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, typed.clone()));
    } else {
        ui.data_mut(|data| data.remove::<String>(id));
    }
    let entered = (is_entered && typed != current).then(|| typed.clone());
    CommittedText { response, typed, entered }
}
