//! Keeps typed text and changes of focus in their order.
//!
//! egui moves the focus before widgets read the text of a frame. Letters would be lost if Tab or a click elsewhere came in the same
//! frame, so such a frame is split. A frame in which a button is pressed and the pointer moves on is split too, so that the drag
//! begins where the button was pressed.
use egui::{Event, Key};

/// Leaves the events of one frame, and returns those of later frames.
pub fn split_frame(events: &mut Vec<Event>) -> Vec<Event> {
    let is_typed = |event: &Event| {
        matches!(event, Event::Text(_) | Event::Paste(_) | Event::Cut | Event::Ime(_))
            || matches!(event, Event::Key { pressed: true, .. })
    };
    let is_later = |(place, event): &(usize, &Event)| {
        let before = &events[..*place];
        let leaves = moves_keyboard(event);
        let is_drag = matches!(event, Event::PointerMoved(_)) && before.iter().any(is_button_press);
        is_drag || (leaves && before.iter().any(is_typed)) || (is_typed(event) && before.iter().any(moves_keyboard))
    };
    let end = events.iter().enumerate().find(is_later);
    let end = end.map_or(events.len(), |(place, _)| place);
    events.split_off(end)
}

fn is_button_press(event: &Event) -> bool {
    matches!(event, Event::PointerButton { pressed: true, .. })
}

/// Whether an event moves the keyboard to another widget, or lets a field complete its text.
fn moves_keyboard(event: &Event) -> bool {
    is_button_press(event) || matches!(event, Event::Key { key: Key::Tab, pressed: true, .. })
}

#[cfg(test)]
mod tests {
    use egui::{Modifiers, PointerButton, Pos2};

    use super::*;

    fn key(key: Key) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
    }

    fn text(text: &str) -> Event {
        Event::Text(text.to_owned())
    }

    /// The frames of these events.
    fn frames(mut events: Vec<Event>) -> Vec<Vec<Event>> {
        let mut frames = Vec::new();
        while !events.is_empty() {
            let later = split_frame(&mut events);
            frames.push(std::mem::replace(&mut events, later));
        }
        frames
    }

    #[test]
    fn typed_text_reaches_its_field_before_tab_or_a_press_leaves_it() {
        let press =
            Event::PointerButton { pos: Pos2::ZERO, button: PointerButton::Primary, pressed: true, modifiers: Modifiers::NONE };
        for leaves in [key(Key::Tab), press] {
            let events = vec![key(Key::Num4), text("4"), key(Key::Num0), text("0"), leaves.clone(), text("7")];
            let [before, after, later] = &frames(events.clone())[..] else { panic!("{:?}", frames(events)) };
            assert_eq!((&before[..], &after[..], &later[..]), (&events[..4], &events[4..5], &events[5..]));
        }
    }

    #[test]
    fn a_drag_begins_where_the_button_was_pressed() {
        let moved = |x: f32| Event::PointerMoved(Pos2::new(x, 0.0));
        let button = |pressed| {
            let (pos, modifiers) = (Pos2::new(1.0, 0.0), Modifiers::NONE);
            Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
        };
        let events = vec![moved(1.0), button(true), moved(2.0), moved(9.0), button(false)];
        let [pressed, dragged] = &frames(events.clone())[..] else { panic!("{:?}", frames(events)) };
        assert_eq!((&pressed[..], &dragged[..]), (&events[..2], &events[2..]));
    }

    #[test]
    fn two_tabs_are_two_steps() {
        assert_eq!(frames(vec![key(Key::Tab), key(Key::Tab)]).len(), 2);
    }

    #[test]
    fn other_frames_stay_whole() {
        let moved = Event::PointerMoved(Pos2::ZERO);
        for events in [vec![moved.clone(), text("a"), key(Key::Enter)], vec![key(Key::Tab), moved], Vec::new()] {
            let mut whole = events.clone();
            assert!(split_frame(&mut whole).is_empty() && whole == events);
        }
    }
}
