//! A field for a path, which the file dialog of the system can fill in.
use std::{
    path::{PathBuf, is_separator},
    time::{Duration, Instant},
};

use crossbeam_channel::{Receiver, Sender, unbounded};
use egui::{
    Id, Key, RichText, TextEdit, Ui,
    text::{CCursor, CCursorRange},
};

use super::quotation::with_quotation_marks;

/// A dialog that ends sooner was never shown, because nobody can dismiss it so fast.
const TOO_SOON: Duration = Duration::from_millis(300);
const NO_DIALOG: &str = "This system has no file dialog (a desktop portal or zenity). Type the path.";

pub struct PathField {
    pub path: String,
    pub hint: &'static str,
    /// Error message about the path.
    pub refusal: Option<String>,
    /// Result of the file dialog; `None` if there is no dialog.
    picked: (Sender<Option<PathBuf>>, Receiver<Option<PathBuf>>),
    focus: bool,
    keyboard: Keyboard,
    /// Tab is a key of the field, and does not leave it.
    takes_tab: bool,
    /// The text field of the last frame.
    id: Option<Id>,
}

/// How a field takes the keyboard.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Keyboard {
    /// At first, and after an error.
    Once,
    /// At first, and after an error. The whole path is still to be selected.
    SelectsAll,
    /// Whenever nothing else has it. The name of the file is still to be selected.
    SelectsName,
    /// Whenever nothing else has it.
    Always,
}

impl PathField {
    pub fn new(path: String, hint: &'static str) -> PathField {
        PathField {
            path,
            hint,
            refusal: None,
            picked: unbounded(),
            focus: true,
            keyboard: Keyboard::Once,
            takes_tab: false,
            id: None,
        }
    }

    /// A field for a new file. The name of the file is selected, so that typing replaces it. After a click elsewhere the field has the
    /// keyboard again, so that Enter still counts.
    pub fn of_new_file(path: String, hint: &'static str) -> PathField {
        PathField { keyboard: Keyboard::SelectsName, ..PathField::new(path, hint) }
    }

    /// A field whose text Tab completes. The text is selected: a path that is typed or pasted replaces it, and Tab or an arrow goes on
    /// from it.
    pub fn with_completion(self) -> PathField {
        PathField { takes_tab: true, keyboard: Keyboard::SelectsAll, ..self }
    }

    /// Whether keys go to the field.
    pub fn has_keyboard(&self, ui: &Ui) -> bool {
        self.id.is_some_and(|id| ui.memory(|memory| memory.has_focus(id)))
    }

    /// Replaces the text. The cursor goes to its end.
    pub fn set(&mut self, ui: &Ui, path: String) {
        (self.path, self.refusal, self.focus) = (path, None, true);
        let end = CCursor::new(self.path.chars().count());
        self.id.into_iter().for_each(|id| select(ui, id, CCursorRange::one(end)));
    }

    /// The trimmed path; `None` if it is empty.
    pub fn path(&self) -> Option<PathBuf> {
        let path = self.path.trim();
        (!path.is_empty()).then(|| PathBuf::from(path))
    }

    /// Shows the field. Returns whether Enter was pressed in it.
    pub fn show(&mut self, ui: &mut Ui) -> bool {
        match self.picked.1.try_recv() {
            Ok(Some(path)) => (self.path, self.refusal) = (path.display().to_string(), None),
            Ok(None) => self.refusal = Some(NO_DIALOG.to_owned()),
            Err(_) => {}
        }
        let field = ui.add(
            TextEdit::singleline(&mut self.path).hint_text(self.hint).desired_width(f32::INFINITY).lock_focus(self.takes_tab),
        );
        self.id = Some(field.id);
        // Before the field takes the keyboard back.
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let is_idle =
            matches!(self.keyboard, Keyboard::SelectsName | Keyboard::Always) && ui.memory(|memory| memory.focused().is_none());
        if std::mem::take(&mut self.focus) || is_idle {
            field.request_focus();
        }
        match self.keyboard {
            Keyboard::SelectsAll => {
                self.keyboard = Keyboard::Once;
                let end = CCursor::new(self.path.chars().count());
                select(ui, field.id, CCursorRange::two(CCursor::new(0), end));
            }
            Keyboard::SelectsName => {
                self.keyboard = Keyboard::Always;
                self.select_name(ui, field.id);
            }
            Keyboard::Once | Keyboard::Always => {}
        }
        if field.changed() {
            self.refusal = None;
        }
        // After an error the user can continue typing.
        self.focus = entered;
        entered
    }

    /// Selects what follows the folder.
    fn select_name(&self, ui: &Ui, id: Id) {
        let end = self.path.chars().count();
        let start = end - self.path.chars().rev().take_while(|letter| !is_separator(*letter)).count();
        select(ui, id, CCursorRange::two(CCursor::new(start), CCursor::new(end)));
    }

    /// Shows the error message, or else this remark, in a line that keeps its height when it is empty.
    pub fn remark(&self, ui: &mut Ui, remark: &str) {
        match &self.refusal {
            Some(refusal) => ui.colored_label(ui.visuals().error_fg_color, with_quotation_marks(refusal)),
            None => ui.label(RichText::new(if remark.is_empty() { " " } else { remark }).color(ui.visuals().warn_fg_color)),
        };
    }

    /// Shows the button that opens the file dialog of the system, on its own thread.
    pub fn browse(&self, ui: &mut Ui, ask: impl FnOnce(rfd::FileDialog) -> Option<PathBuf> + Send + 'static) {
        if !ui.button("Browse…").on_hover_text("Opens a file dialog.").clicked() {
            return;
        }
        let (sender, ctx) = (self.picked.0.clone(), ui.ctx().clone());
        std::thread::spawn(move || {
            let start = Instant::now();
            let path = ask(rfd::FileDialog::new());
            if path.is_some() || start.elapsed() < TOO_SOON {
                let _ = sender.send(path);
                ctx.request_repaint();
            }
        });
    }
}

fn select(ui: &Ui, id: Id, range: CCursorRange) {
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(range));
    TextEdit::store_state(ui.ctx(), id, state);
}
