//! The outliner: a list of the parts of the scene, with search, selection and a menu for each.
//!
//! It shows a description and does not change it. It returns the requested actions.
//!
//! | file | holds |
//! |---|---|
//! | `entries.rs` | the parts of a description, in groups |
//! | `menu.rs` | the menu of a part |
mod entries;
mod menu;
#[cfg(test)]
mod tests;

use std::ops::Range;

use egui::{CollapsingHeader, Rect, RichText, ScrollArea, Sense, TextEdit, Ui, UiBuilder, pos2, vec2};
use noisefall_scene::scene::description::SceneDescription;

pub use self::menu::{Action, New, can_rename, part_menu};
use self::{
    entries::{Entry, EntryGroup},
    menu::Menu,
};
use super::subject::Subject;
use crate::viewer::widgets::{committed_text, palette::Palette, style::leave_room_for_bar};

/// The requests of one frame.
#[derive(Debug, Default, PartialEq)]
pub struct OutlinerRequests {
    /// The part that was clicked.
    pub selected: Option<Subject>,
    /// The action on a part.
    pub action: Option<(Subject, Action)>,
}

/// The outliner between two frames.
#[derive(Default)]
pub struct Outliner {
    search: String,
    /// The part that is being renamed.
    renamed: Option<Subject>,
    /// The parts that are listed.
    listed: Option<Listed>,
    /// The selection of the last frame, unless this is the first one: another part is scrolled into sight.
    selected: Option<Option<Subject>>,
}

/// The parts of a revision of the scene that a search finds.
struct Listed {
    revision: u64,
    search: String,
    groups: Vec<EntryGroup>,
    menu: Menu,
}

/// Height of a row in points, with the space below.
const ROW: f32 = 24.0;

/// The space below a row in points.
const GAP: f32 = 2.0;

impl Outliner {
    /// Shows the parts of a description in the remaining room. One of them may be selected. The list is made again when the revision
    /// changes.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        description: &SceneDescription,
        revision: u64,
        selected: Option<&Subject>,
    ) -> OutlinerRequests {
        let mut asked = OutlinerRequests::default();
        ui.horizontal(|ui| {
            let label = ui.label("Search").on_hover_text("Shows only the parts whose name or type contains these letters.");
            let field = TextEdit::singleline(&mut self.search).hint_text("name or type").desired_width(f32::INFINITY);
            ui.add(field).labelled_by(label.id);
        });
        let is_listed = |listed: &Listed| (listed.revision, &listed.search) == (revision, &self.search);
        let listed = self.listed.take().filter(is_listed).unwrap_or_else(|| Listed {
            revision,
            search: self.search.clone(),
            groups: entries::groups(description, &self.search),
            menu: Menu::of(description),
        });
        ScrollArea::vertical().id_salt("parts").auto_shrink(false).show(ui, |ui| {
            leave_room_for_bar(ui);
            for group in &listed.groups {
                self.group(ui, group, &listed.menu, selected, &mut asked);
            }
        });
        self.listed = Some(listed);
        self.selected = Some(selected.cloned());
        asked
    }

    /// Shows the field for the name of a part in place of its row, and scrolls to it.
    pub fn rename(&mut self, subject: Subject) {
        self.search.clear();
        (self.renamed, self.selected) = (Some(subject), Some(None));
    }

    fn group(&mut self, ui: &mut Ui, group: &EntryGroup, menu: &Menu, selected: Option<&Subject>, asked: &mut OutlinerRequests) {
        let title = format!("{} ({})", group.title, group.entries.len());
        let header = CollapsingHeader::new(RichText::new(title).strong()).id_salt(group.title).default_open(true);
        header.show_unindented(ui, |ui| {
            // Only the rows in sight are laid out: a scene can have a hundred thousand objects.
            let size = vec2(ui.available_width(), ROW * group.entries.len() as f32 - GAP);
            let (all, _) = ui.allocate_exact_size(size, Sense::hover());
            let is_newly = |entry: &Entry| {
                selected == Some(&entry.subject) && self.selected.as_ref().is_some_and(|last| last.as_ref() != selected)
            };
            if let Some(place) = group.entries.iter().position(is_newly) {
                let top = all.top() + ROW * place as f32;
                ui.scroll_to_rect(Rect::from_x_y_ranges(all.x_range(), top..=top + ROW), None);
            }
            let seen = in_sight(all, ui.clip_rect(), group.entries.len());
            let top = all.top() + ROW * seen.start as f32;
            let rect = Rect::from_min_max(pos2(all.left(), top), all.max);
            let mut rows = ui.new_child(UiBuilder::new().id_salt(group.title).max_rect(rect));
            rows.spacing_mut().item_spacing.y = GAP;
            for entry in &group.entries[seen] {
                rows.push_id(&entry.subject, |ui| self.row(ui, entry, menu, selected == Some(&entry.subject), asked));
            }
        });
    }

    fn row(&mut self, ui: &mut Ui, entry: &Entry, menu: &Menu, is_selected: bool, asked: &mut OutlinerRequests) {
        let subject = &entry.subject;
        if self.renamed.as_ref() == Some(subject) {
            return self.name_field(ui, entry, asked);
        }
        let is_dragged = matches!(subject, Subject::Material(_) | Subject::Texture(_));
        let advice = if is_dragged { "\nDrag it onto an object, here or in the image, to assign it." } else { "" };
        let text = format!("{}  {}{advice}", entry.name, entry.kind);
        let row = egui::Button::selectable(is_selected, entry.text(ui.visuals()));
        let row = row.sense(Sense::click_and_drag()).truncate().min_size(vec2(ui.available_width(), ROW - GAP));
        let row = ui.add(row).on_hover_text(text);
        if row.clicked() || row.secondary_clicked() {
            asked.selected = Some(subject.clone());
        }
        if row.double_clicked() && can_rename(subject) {
            self.renamed = Some(subject.clone());
        }
        // A material or a texture is assigned by dragging it onto an object, here or in the image.
        if is_dragged {
            row.dnd_set_drag_payload(subject.clone());
        }
        if matches!(subject, Subject::Object(_)) && row.dnd_hover_payload::<Subject>().is_some() {
            ui.painter().rect_stroke(row.rect, 2.0, (1.5, ui.visuals().accent()), egui::StrokeKind::Inside);
            let released = row.dnd_release_payload::<Subject>().and_then(|dragged| Action::assigns(&dragged));
            asked.action = released.map(|action| (subject.clone(), action)).or(asked.action.take());
            asked.selected = asked.action.as_ref().map(|_| subject.clone()).or(asked.selected.take());
        }
        if Menu::is_empty(entry) {
            return;
        }
        row.context_menu(|ui| {
            if let Some(action) = menu.show(ui, entry) {
                match action {
                    Action::Rename(_) => self.renamed = Some(subject.clone()),
                    action => asked.action = Some((subject.clone(), action)),
                }
                ui.close();
            }
        });
    }

    /// The field that stands in the place of a row while the part is renamed.
    fn name_field(&mut self, ui: &mut Ui, entry: &Entry, asked: &mut OutlinerRequests) {
        let id = ui.scope_id();
        let field = ui.horizontal(|ui| {
            let label = ui.label("Name");
            committed_text::show(ui, label.id, &entry.given_name, ui.available_width() - 8.0)
        });
        let field = field.inner;
        let was_shown = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default::<bool>(id), true));
        if !was_shown {
            field.response.request_focus();
        } else if !field.response.has_focus() {
            ui.data_mut(|data| data.remove::<bool>(id));
            self.renamed = None;
        }
        if let Some(name) = field.entered {
            asked.action = Some((entry.subject.clone(), Action::Rename(name)));
        }
    }
}

/// The rows of a list that can be seen. `all` is where all rows lie.
fn in_sight(all: Rect, clip: Rect, count: usize) -> Range<usize> {
    let row = |y: f32| ((y - all.top()) / ROW).max(0.0);
    let first = (row(clip.top()).floor() as usize).min(count);
    first..(row(clip.bottom()).ceil() as usize).clamp(first, count)
}
