//! Materials and textures that are dragged from the list onto objects of the image.
use egui::{Align2, Color32, DragAndDrop, FontId, Id, LayerId, Order, Ui, vec2};

use super::state::App;
use crate::viewer::panels::{outliner::Action, subject::Subject};

impl App {
    /// The object under the pointer while a material or a texture is dragged.
    pub fn drop_target(&self) -> Option<usize> {
        self.window
            .hovered
            .filter(|_| DragAndDrop::has_payload_of_type::<Subject>(&self.ctx))
            .and_then(|pixel| self.object_at(pixel))
    }

    /// Shows the name of what is dragged at the pointer, and assigns it to the object on which it is dropped.
    pub fn show_dragged(&mut self, ui: &Ui) {
        let Some(dragged) = DragAndDrop::payload::<Subject>(ui.ctx()) else { return };
        if let (Subject::Material(name) | Subject::Texture(name), Some(at)) = (&*dragged, ui.ctx().pointer_latest_pos()) {
            let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::unique("dragged")));
            let text = painter.layout_no_wrap(name.clone(), FontId::proportional(13.0), Color32::WHITE);
            let rect = Align2::LEFT_TOP.anchor_size(at + vec2(16.0, 12.0), text.size());
            painter.rect_filled(rect.expand2(vec2(6.0, 3.0)), 4.0, Color32::from_black_alpha(200));
            painter.galley(rect.min, text, Color32::WHITE);
        }
        let Some(pixel) = self.window.hovered.filter(|_| ui.input(|input| input.pointer.any_released())) else { return };
        DragAndDrop::clear_payload(ui.ctx());
        match (self.object_at(pixel), Action::assigns(&dragged)) {
            (Some(object), Some(action)) => {
                self.act_on(Subject::Object(object), action);
                self.selection.select(Some(Subject::Object(object)));
            }
            _ => self.tell("There is no object here. Drop it on an object.".to_owned(), false),
        }
    }
}
