//! Keys: commands, dialogs, instruments and views.
use egui::{Context, Event, InputState, Key, KeyboardShortcut, Modifiers, Popup, ViewportCommand};

use super::state::App;
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
        // Whatever has the keyboard: only in text this key is the cursor's.
        if presses(ctx, Key::Home) && !ctx.text_edit_focused() {
            self.perform(Command::ResetCamera);
        }
        if ctx.text_edit_focused() || self.dialogs.wait() || self.session.opened.is_none() {
            return;
        }
        let has_dialog = self.dialogs.help || self.dialogs.gallery.open;
        self.command_keys(ctx);
        if presses(ctx, Key::L) {
            self.look_at_selection();
        }
        if !has_dialog {
            self.scene_keys(ctx);
        }
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
            if ctx.input_mut(|input| input.consume_shortcut(&shortcut)) && can && !self.dialogs.wait() {
                self.perform(command);
            }
        }
        // In text they belong to the text.
        if !ctx.text_edit_focused() && !self.dialogs.wait() {
            for (shortcut, command) in STEP_KEYS {
                if ctx.input_mut(|input| input.consume_shortcut(&shortcut)) {
                    self.perform(command);
                }
            }
        }
    }

    /// Keys of dialogs and instruments.
    fn window_keys(&mut self, ctx: &Context) {
        let key = |key| ctx.input(|input| input.key_pressed(key));
        if key(Key::F11) {
            let is_full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
            ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
        }
        if key(Key::Escape) {
            self.escape();
        }
        for (code, shown) in [
            (Key::F1, &mut self.dialogs.help),
            (Key::F6, &mut self.dialogs.gallery.open),
            (Key::F12, &mut self.frame_times.shown),
        ] {
            *shown ^= key(code);
        }
        for (code, tab) in TAB_KEYS {
            if key(code) && self.session.opened.is_some() {
                self.toggle_tab(tab);
            }
        }
    }

    fn command_keys(&mut self, ctx: &Context) {
        // Space presses the button that Tab has reached.
        let has_focus = ctx.egui_wants_keyboard_input();
        for (code, command) in COMMAND_KEYS {
            if presses(ctx, code) && !(code == Key::Space && has_focus) {
                self.perform(command);
            }
        }
    }

    /// Keys that change the scene.
    fn scene_keys(&mut self, ctx: &Context) {
        if ctx.input(|input| self.adds(input)) {
            self.window.opens_add = true;
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

    /// Closes what lies over the picture: of several things all dialogs first, then messages, then the selection, then the region.
    fn escape(&mut self) {
        // A menu, a list or a colour picker closes itself, and nothing else.
        if Popup::is_any_open(&self.ctx) {
            return;
        }
        if refusal::dismiss(&self.ctx) {
            return;
        }
        // The field of a path belongs to its dialog.
        let dialogs = &mut self.dialogs;
        if dialogs.open.take().is_some() || dialogs.save.take().is_some() || dialogs.file.take().is_some() {
            return;
        }
        if dialogs.tev.take().is_some() || dialogs.sequence.take().is_some() || dialogs.existing_frames.take().is_some() {
            return;
        }
        if dialogs.unsaved.take().is_some()
            || dialogs.conflict.take().is_some()
            || dialogs.recovery.take().is_some()
            || dialogs.unfinished.take().is_some()
        {
            return;
        }
        // It lies over the tour, and its cards have the keyboard.
        if std::mem::take(&mut dialogs.gallery.open) {
            return;
        }
        // Escape discards the edit of a field, and does nothing else.
        if self.window.had_focus || self.cancel_loading() {
            return;
        }
        let dialogs = &mut self.dialogs;
        if dialogs.help || dialogs.remarks || dialogs.wait() {
            (dialogs.help, dialogs.remarks, dialogs.scene_error) = (false, false, None);
            return;
        }
        if self.background.adviser.take().is_some() || self.end_tour() || self.discard_copy() {
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

/// Whether Shift+D was pressed. A key that is held, such as that of a flight to the right, is not pressed again.
fn duplicates(input: &InputState) -> bool {
    let is_press = |event: &Event| matches!(event, Event::Key { key: Key::D, pressed: true, repeat: false, modifiers, .. } if modifiers.shift_only());
    input.events.iter().any(is_press)
}
