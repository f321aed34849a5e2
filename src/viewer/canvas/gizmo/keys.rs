//! The keys of a gizmo. It takes them from the window only while an object is selected.
use egui::{Context, Event, Key, Modifiers};

use super::operation::{Lock, Mode};

/// A key that a gizmo understands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Press {
    Start(Mode),
    Toggle(Lock),
    /// A digit, a point or a sign.
    Digit(char),
    Erase,
    Confirm,
    Cancel,
}

/// Takes the keys that start an operation or, during one, all keys of operations. The window does not see these keys.
pub fn take(ctx: &Context, is_under_way: bool) -> Vec<Press> {
    if !is_under_way && ctx.text_edit_focused() {
        return Vec::new();
    }
    let mut presses = Vec::new();
    ctx.input_mut(|input| {
        input.events.retain(|event| {
            let press = press(event, is_under_way);
            presses.extend(press);
            // Text comes after the key that wrote it: both are the same press.
            press.is_none() && !(is_under_way && matches!(event, Event::Text(_)))
        });
    });
    presses
}

fn press(event: &Event, is_under_way: bool) -> Option<Press> {
    let Event::Key { key, pressed: true, modifiers, repeat, .. } = event else { return None };
    if modifiers.command || modifiers.alt {
        return None;
    }
    let start = |mode: Mode| (!repeat && *modifiers == Modifiers::NONE).then_some(Press::Start(mode));
    match key {
        Key::G => return start(Mode::Move),
        Key::R => return start(Mode::Rotate),
        Key::S => return start(Mode::Scale),
        _ if !is_under_way => return None,
        _ => {}
    }
    let axis = [Key::X, Key::Y, Key::Z].iter().position(|axis| axis == key);
    if let Some(axis) = axis {
        return Some(Press::Toggle(if modifiers.shift { Lock::Plane(axis) } else { Lock::Axis(axis) }));
    }
    match key {
        Key::Enter => Some(Press::Confirm),
        Key::Escape => Some(Press::Cancel),
        Key::Backspace => Some(Press::Erase),
        Key::Minus => Some(Press::Digit('-')),
        Key::Period | Key::Comma => Some(Press::Digit('.')),
        _ => digit(*key).map(Press::Digit),
    }
}

fn digit(key: Key) -> Option<char> {
    let mut name = key.symbol_or_name().chars();
    name.next().filter(|c| c.is_ascii_digit() && name.next().is_none())
}

/// Adds a digit, a point or a sign to a number. A sign changes that of the number, and a second point is left out.
pub fn typed(text: &mut String, press: char) {
    match press {
        '-' if text.starts_with('-') => _ = text.remove(0),
        '-' => text.insert(0, '-'),
        '.' if text.contains('.') => {}
        digit => text.push(digit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(key: Key, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
    }

    #[test]
    fn only_the_three_keys_start_an_operation() {
        let start = |event: Key| press(&key(event, Modifiers::NONE), false);
        assert_eq!(start(Key::G), Some(Press::Start(Mode::Move)));
        assert_eq!(start(Key::R), Some(Press::Start(Mode::Rotate)));
        assert_eq!(start(Key::S), Some(Press::Start(Mode::Scale)));
        for other in [Key::X, Key::Num1, Key::Escape, Key::Enter, Key::Period, Key::W, Key::F] {
            assert_eq!(start(other), None, "{other:?} is the window's");
        }
        assert_eq!(press(&key(Key::S, Modifiers::COMMAND), true), None, "Ctrl+S saves");
    }

    #[test]
    fn an_operation_understands_axes_planes_and_numbers() {
        let press = |event: Key, modifiers: Modifiers| press(&key(event, modifiers), true);
        assert_eq!(press(Key::Y, Modifiers::NONE), Some(Press::Toggle(Lock::Axis(1))));
        assert_eq!(press(Key::Z, Modifiers::SHIFT), Some(Press::Toggle(Lock::Plane(2))));
        assert_eq!(press(Key::Num7, Modifiers::NONE), Some(Press::Digit('7')));
        assert_eq!(press(Key::Minus, Modifiers::NONE), Some(Press::Digit('-')));
        assert_eq!(press(Key::Escape, Modifiers::NONE), Some(Press::Cancel));
        assert_eq!(press(Key::F1, Modifiers::NONE), None);
    }

    #[test]
    fn numbers_are_typed_in_any_order_of_sign_and_digits() {
        let mut text = String::new();
        "1.5.2-".chars().for_each(|press| typed(&mut text, press));
        assert_eq!(text, "-1.52");
        typed(&mut text, '-');
        assert_eq!(text, "1.52");
    }
}
