//! Keys: commands, dialogs, instruments and views.
use egui::{Context, Event, InputState, Key, KeyboardShortcut, Modifiers, Popup, ViewportCommand};

use super::{front::FrontDialog, state::App};
use crate::viewer::canvas::interaction::Tool;
use crate::viewer::instruments::tabs::InstrumentTab;
use crate::viewer::panels::{
    outliner::{Action, can_rename},
    panel_tabs::PanelTab,
    toolbar::Command,
    views,
};
use crate::viewer::widgets::refusal;

const FILE_KEYS: [(KeyboardShortcut, Command); 3] = [
    (KeyboardShortcut::new(Modifiers::COMMAND, Key::O), Command::Open),
    (KeyboardShortcut::new(Modifiers::COMMAND, Key::S), Command::SaveScene),
    (KeyboardShortcut::new(Modifiers::COMMAND, Key::E), Command::SavePicture),
];
/// The longer ones first: egui takes a shortcut without Shift for one with it. A key alone must not cost samples.
const STEP_KEYS: [(KeyboardShortcut, Command); 4] = [
    (KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z), Command::Redo),
    (KeyboardShortcut::new(Modifiers::COMMAND, Key::Y), Command::Redo),
    (KeyboardShortcut::new(Modifiers::COMMAND, Key::Z), Command::Undo),
    (KeyboardShortcut::new(Modifiers::COMMAND, Key::R), Command::Restart),
];

const COMMAND_KEYS: [(Key, Command); 8] = [
    (Key::Space, Command::TogglePause),
    (Key::Period, Command::Step),
    (Key::P, Command::ChooseTool(Tool::Picture)),
    (Key::C, Command::ChooseTool(Tool::Camera)),
    (Key::B, Command::ChooseTool(Tool::Region)),
    (Key::I, Command::ChooseTool(Tool::Inspect)),
    (Key::F, Command::Fit),
    (Key::Num1, Command::ActualSize),
];

/// Keys that open an instrument or close it.
const TAB_KEYS: [(Key, InstrumentTab); 4] = [
    (Key::F2, InstrumentTab::Convergence),
    (Key::F3, InstrumentTab::Compare),
    (Key::F4, InstrumentTab::Bounces),
    (Key::F5, InstrumentTab::Path),
];

impl App {
    /// Single keys, unless text is being typed, and those with Ctrl.
    pub fn shortcuts(&mut self, ctx: &Context) {
        self.take_gizmo_keys();
        self.hold_chords(ctx);
        self.file_and_step_keys(ctx);
        self.take_copy_key(ctx);
        self.window_keys(ctx);
        if ctx.text_edit_focused() || self.front().is_some() || self.session.opened.is_none() {
            return;
        }
        // Whatever has the keyboard: only in text this key is the cursor's.
        if presses(ctx, Key::Home) {
            self.perform(Command::ResetCamera);
        }
        self.command_keys(ctx);
        if presses(ctx, Key::L) {
            self.look_at_selection();
        }
        self.scene_keys(ctx);
        self.display_keys(ctx);
    }

    /// Whether a key is held that also moves the camera, and belongs to a chord.
    fn hold_chords(&mut self, ctx: &Context) {
        let can_duplicate = self.selection.subject.as_ref().is_some_and(can_rename);
        let holds = |input: &InputState| {
            let saves = input.key_down(Key::S) && (self.window.holds_chord || input.modifiers.command);
            let adds = input.key_down(Key::A) && (self.window.holds_chord || self.adds(input));
            saves || adds || (input.key_down(Key::D) && (self.window.holds_chord || (can_duplicate && duplicates(input))))
        };
        self.window.holds_chord = ctx.input(holds);
    }

    fn file_and_step_keys(&mut self, ctx: &Context) {
        for (shortcut, command) in FILE_KEYS {
            let can = command != Command::SavePicture || self.can_save();
            if ctx.input_mut(|input| input.consume_shortcut(&shortcut)) && can && self.make_room() {
                self.perform(command);
            }
        }
        // In text they belong to the text.
        if !ctx.text_edit_focused() && self.front().is_none() {
            for (shortcut, command) in STEP_KEYS {
                if ctx.input_mut(|input| input.consume_shortcut(&shortcut)) {
                    self.perform(command);
                }
            }
        }
    }

    /// Keys of dialogs and instruments.
    fn window_keys(&mut self, ctx: &Context) {
        // A key that is held is pressed once.
        let key = |key| ctx.input(|input| begins_press(input, key));
        self.full_screen_key(ctx, key(Key::F11));
        if ctx.input(|input| input.key_pressed(Key::Escape)) {
            self.escape();
        }
        self.frame_times.shown ^= key(Key::F12);
        for (code, dialog) in [(Key::F1, FrontDialog::Help), (Key::F6, FrontDialog::Gallery)] {
            if key(code) {
                self.toggle_dialog(dialog);
            }
        }
        for (code, tab) in TAB_KEYS {
            let is_pressed = key(code) && self.session.opened.is_some() && self.front().is_none();
            if is_pressed && !(code == Key::F2 && self.rename_selected()) {
                self.toggle_tab(tab);
            }
        }
    }

    /// Fills the screen or no longer does, each time the key is pressed, even if the window has not followed the last one yet.
    fn full_screen_key(&mut self, ctx: &Context, is_pressed: bool) {
        let reported = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
        let asked = &mut self.window.full_screen;
        asked.take_if(|[before, _]| *before != reported);
        if is_pressed {
            let is_full = asked.map_or(reported, |[_, asked]| asked);
            *asked = Some([reported, !is_full]);
            ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
        }
    }

    fn command_keys(&mut self, ctx: &Context) {
        // Space presses the button that Tab has reached.
        let has_focus = ctx.egui_wants_keyboard_input();
        for (code, command) in COMMAND_KEYS {
            let is_pressed = if code == Key::Space {
                !has_focus && presses(ctx, code) && ctx.input(|input| begins_press(input, code))
            } else {
                presses(ctx, code)
            };
            if is_pressed {
                self.perform(command);
            }
        }
    }

    /// Keys that change the scene.
    fn scene_keys(&mut self, ctx: &Context) {
        if ctx.input(|input| self.adds(input)) {
            self.open_add();
        }
        let Some(subject) = self.selection.subject.clone().filter(can_rename) else { return };
        if presses(ctx, Key::Delete) || presses(ctx, Key::X) {
            self.act_on(subject, Action::Delete);
        } else if ctx.input(duplicates) {
            if self.window.hovered.is_some() && self.has_gizmo() {
                self.duplicate_and_move(subject);
            } else {
                self.duplicate_beside(&subject);
            }
        }
    }

    /// Keys of views and exposure.
    fn display_keys(&mut self, ctx: &Context) {
        let look = &mut self.session.look;
        let goes_back = ctx.input(|input| is_pressed(input, Key::V, Modifiers::SHIFT));
        for (is_pressed, back) in [(presses(ctx, Key::V), false), (goes_back, true)] {
            if is_pressed {
                look.view = views::next(look.view, back);
            }
        }
        // More than one press can fall into a frame.
        let presses = |key| ctx.input(|input| input.num_presses(key)) as f32;
        let change = 0.5 * (presses(Key::CloseBracket) - presses(Key::OpenBracket));
        if change != 0.0 {
            look.display.exposure = (look.display.exposure + change).clamp(-100.0, 100.0);
        }
    }

    /// Whether Shift+A asks for the menu that adds parts, on the page of the scene.
    fn adds(&self, input: &InputState) -> bool {
        self.window.panel == PanelTab::Edit && is_pressed(input, Key::A, Modifiers::SHIFT)
    }

    /// Closes what lies over the image: the dialog in front first, then the tour, messages, the selection, and the region.
    fn escape(&mut self) {
        // A menu, a list or a colour picker closes itself, and nothing else.
        if Popup::is_any_open(&self.ctx) {
            return;
        }
        if refusal::dismiss(&self.ctx) {
            return;
        }
        // The field of a path belongs to its dialog.
        if let Some(front) = self.front() {
            return self.close(front);
        }
        // Escape discards the edit of a field, and does nothing else.
        if self.window.had_focus || self.cancel_loading() {
            return;
        }
        if self.end_tour() || self.discard_copy() {
            return;
        }
        let dialogs = &mut self.dialogs;
        if dialogs.file_error.is_some() || !dialogs.notices.0.is_empty() {
            dialogs.file_error = None;
            dialogs.notices.0.clear();
        } else if self.selection.subject.is_some() {
            self.selection.select(None);
        } else {
            self.session.budget.region = None;
        }
    }
}

/// Whether a key was pressed without modifiers: those of the press itself, because a quick hand has left them when the frame ends.
fn presses(ctx: &Context, key: Key) -> bool {
    ctx.input(|input| is_pressed(input, key, Modifiers::NONE))
}

/// Whether a key was pressed with exactly these modifiers.
fn is_pressed(input: &InputState, key: Key, with: Modifiers) -> bool {
    let is_press = |event: &Event| matches!(event, Event::Key { key: of, pressed: true, modifiers, .. } if *of == key && modifiers.matches_exact(with));
    input.events.iter().any(is_press)
}

/// Whether a key was pressed, and not only held.
fn begins_press(input: &InputState, key: Key) -> bool {
    let begins = |event: &Event| matches!(event, Event::Key { key: of, pressed: true, repeat: false, .. } if *of == key);
    input.events.iter().any(begins)
}

/// Whether Shift+D was pressed. A key that is held, such as that of a flight to the right, is not pressed again.
fn duplicates(input: &InputState) -> bool {
    let is_press = |event: &Event| matches!(event, Event::Key { key: Key::D, pressed: true, repeat: false, modifiers, .. } if modifiers.shift_only());
    input.events.iter().any(is_press)
}
