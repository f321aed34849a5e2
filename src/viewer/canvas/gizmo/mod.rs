//! The gizmo: moves, rotates and scales the selected object by handles or keys.
//!
//! | file | holds |
//! |---|---|
//! | `maths.rs` | rays, axes, planes, angles, snapping |
//! | `operation.rs` | an operation under way: from the pointer or a typed number to a transform |
//! | `handles.rs` | positions of handles, and the one under the pointer |
//! | `keys.rs` | the keys |
//! | `rounding.rs` | rounds what the pointer asks for |
//! | `drawing.rs` | draws handles and figures |
mod drawing;
mod handles;
mod keys;
mod maths;
mod operation;
mod rounding;
#[cfg(test)]
mod tests;

use egui::{Context, Id, PointerButton, Pos2, Rect, Response, Sense, Ui, vec2};
use glam::DVec3;
use noisefall_scene::{scene::Camera, shape::Transform};

pub use self::operation::Mode;
use self::{
    keys::Press,
    operation::{Lock, Operation},
};
use super::{picture_area::PictureArea, projection::pixel_width};

/// Result of a gizmo in one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct GizmoOutput {
    /// The transform of the world about the pivot, from the beginning of the operation until now.
    pub change: Transform,
    /// Metres.
    pub pivot: DVec3,
    pub phase: Phase,
}

/// State of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    Going,
    /// The change stays.
    Done,
    /// The change is discarded.
    Cancelled,
}

/// The gizmo between two frames.
#[derive(Default)]
pub struct Gizmo {
    /// Operation of its handles.
    pub mode: Mode,
    operation: Option<Operation>,
    /// A key began the operation: the pointer moves it without a button.
    is_by_key: bool,
    presses: Vec<Press>,
    /// The handle under the pointer.
    hovered: Option<Lock>,
}

impl Gizmo {
    /// Takes the keys of the gizmo, before the window looks at its own. Call it only while an object is selected.
    pub fn take_keys(&mut self, ctx: &Context) {
        self.presses = keys::take(ctx, self.operation.is_some());
    }

    /// Begins an operation, as its key does.
    pub fn start(&mut self, mode: Mode) {
        self.presses.push(Press::Start(mode));
    }

    /// Whether an operation is under way, or begins in this frame: keys and mouse are the gizmo's.
    pub fn is_active(&self) -> bool {
        self.operation.is_some() || self.presses.iter().any(|press| matches!(press, Press::Start(_)))
    }

    /// Whether the pointer is over a handle.
    pub fn has_pointer(&self) -> bool {
        self.hovered.is_some()
    }

    /// Gives the operation up: the selection is another one.
    pub fn reset(&mut self) {
        *self = Gizmo { mode: self.mode, ..Gizmo::default() };
    }

    /// Shows the gizmo at a pivot over the image of a camera, in a scene of this size. Returns the state of an operation.
    pub fn show(&mut self, ui: &mut Ui, area: &PictureArea, camera: &Camera, pivot: DVec3, size: f64) -> Option<GizmoOutput> {
        let [pointer, pressed] = ui.input(|input| [input.pointer.latest_pos(), input.pointer.press_origin()]);
        let is_over = pointer.is_some_and(|pointer| area.clip.contains(pointer));
        let pointer = pointer.unwrap_or(area.rect.center());
        // During an operation the object has already moved, but its pivot stays.
        let pivot = self.operation.as_ref().map_or(pivot, |operation| operation.pivot);
        let ended = self.follow_keys(pivot, area.place(pointer));
        let handles = handles::handles(self.mode, pivot, camera, area);
        // A drag belongs to the handle that it began on, though the pointer has left it.
        if self.operation.is_none() && !ui.input(|input| input.pointer.any_down()) {
            self.hovered = handles::under(&handles, pointer).filter(|_| is_over).map(|handle| handle.lock);
        }
        let response = self.interact(ui, area, pointer);
        let start = area.place(pressed.unwrap_or(pointer));
        let ended = ended.or(response.and_then(|response| self.follow_mouse(&response, pivot, start)));
        let painter = ui.painter_at(area.clip);
        let Some(operation) = &mut self.operation else {
            drawing::handles(&painter, &handles, self.mode, self.hovered);
            return None;
        };
        operation.point(camera, area.place(pointer));
        let change = operation.change(camera, size, ui.input(|input| input.modifiers.command));
        // Typed numbers are not rounded.
        let is_typed = operation.number().is_some();
        let change = if is_typed { change } else { rounding::rounded(change, pixel_width(camera, pivot)) };
        let moved = match change {
            Transform::Translate(by) => handles::handles(self.mode, pivot + by, camera, area),
            _ => handles,
        };
        drawing::handles(&painter, &moved, self.mode, Some(operation.lock));
        drawing::status(&painter, operation, &change);
        if ended.is_some() {
            (self.operation, self.is_by_key) = (None, false);
        }
        Some(GizmoOutput { change, pivot, phase: ended.unwrap_or(Phase::Going) })
    }

    /// The widget that takes the mouse from the image: over a handle, or everywhere during an operation.
    fn interact(&self, ui: &Ui, area: &PictureArea, pointer: Pos2) -> Option<Response> {
        let near = Rect::from_center_size(pointer, vec2(24.0, 24.0)).intersect(area.clip);
        let rect = match (&self.operation, self.hovered) {
            (Some(_), _) => area.clip,
            (None, Some(_)) => near,
            (None, None) => return None,
        };
        Some(ui.interact(rect, Id::unique("gizmo"), Sense::click_and_drag()))
    }

    /// Begins operations, with the button pressed at `start`, and ends them.
    fn follow_mouse(&mut self, response: &Response, pivot: DVec3, start: [f32; 2]) -> Option<Phase> {
        match (&self.operation, self.hovered) {
            (None, Some(lock)) if response.drag_started_by(PointerButton::Primary) => {
                self.operation = Some(Operation::new(self.mode, lock, pivot, start));
                None
            }
            (Some(_), _) if self.is_by_key && response.secondary_clicked() => Some(Phase::Cancelled),
            (Some(_), _) => {
                let is_released = response.drag_stopped_by(PointerButton::Primary);
                (is_released || (self.is_by_key && response.clicked())).then_some(Phase::Done)
            }
            (None, _) => None,
        }
    }

    /// Follows the keys of this frame.
    fn follow_keys(&mut self, pivot: DVec3, pointer: [f32; 2]) -> Option<Phase> {
        for press in std::mem::take(&mut self.presses) {
            match (press, &mut self.operation) {
                (Press::Start(mode), None) => {
                    (self.mode, self.is_by_key) = (mode, true);
                    self.operation = Some(Operation::new(mode, Lock::Free, pivot, pointer));
                }
                (Press::Toggle(lock), Some(operation)) => operation.toggle(lock),
                (Press::Digit(digit), Some(operation)) => keys::typed(&mut operation.typed, digit),
                (Press::Erase, Some(operation)) => _ = operation.typed.pop(),
                (Press::Confirm, Some(_)) => return Some(Phase::Done),
                (Press::Cancel, Some(_)) => return Some(Phase::Cancelled),
                // Another mode from the same place; what was typed stays.
                (Press::Start(mode), Some(operation)) => (self.mode, operation.mode) = (mode, mode),
                (_, None) => {}
            }
        }
        None
    }
}
