//! The menu of the image: what can be done to the part under the pointer, and to the image.
use egui::{PointerButton, Popup, Response, SetOpenCommand, Ui};

use super::state::App;
use crate::viewer::canvas::picture_area::PictureArea;
use crate::viewer::panels::{
    outliner::{self, Action, can_rename},
    panel_tabs::PanelTab,
    subject::Subject,
    toolbar::Command,
};
use crate::viewer::widgets::list::closing;

/// The choice of an entry of the menu.
enum Chosen {
    Action(Action),
    Command(Command),
    CopyImage,
}

impl App {
    /// Opens the menu where the right button is clicked, selects what is there, and follows the choice.
    pub fn image_menu(&mut self, ui: &Ui, response: &Response, area: Option<&PictureArea>) {
        // That click ends an operation of the gizmo.
        if self.selection.gizmo.is_active() {
            return;
        }
        // Over a handle of the gizmo too.
        let opens = response.contains_pointer() && ui.input(|input| input.pointer.button_clicked(PointerButton::Secondary));
        if let Some(pixel) = self.window.hovered.filter(|_| opens) {
            let punctual_light = area.and_then(|area| self.punctual_under(ui, area));
            let subject = punctual_light.or_else(|| self.object_at(pixel).map(Subject::Object));
            self.selection.clicked = Some(pixel);
            self.pick(subject.clone());
            self.window.menu_of = subject;
        }
        let mut chosen = None;
        let set = if opens { Some(true) } else { response.clicked().then_some(false) };
        let menu = Popup::context_menu(response).open_memory(set.map(SetOpenCommand::Bool));
        menu.show(|ui| {
            let (of_part, of_image) = (self.part_menu(ui), self.image_commands(ui));
            chosen = closing(ui, of_part.or(of_image));
        });
        match chosen {
            Some(Chosen::Action(Action::Rename(_))) => {
                if let Some(subject) = self.window.menu_of.take() {
                    self.rename(subject);
                }
            }
            Some(Chosen::Action(action)) => {
                let subject = self.window.menu_of.take();
                subject.into_iter().for_each(|subject| self.act_on(subject, action.clone()));
            }
            Some(Chosen::Command(command)) => self.perform(command),
            Some(Chosen::CopyImage) => self.copy_image(),
            None => {}
        }
    }

    fn part_menu(&self, ui: &mut Ui) -> Option<Chosen> {
        let (editor, subject) = (self.editor.as_ref()?, self.window.menu_of.as_ref()?);
        let scene = editor.document.description();
        if !subject.is_in(scene) {
            return None;
        }
        ui.weak(subject.name(scene));
        let action = outliner::part_menu(ui, scene, subject);
        ui.separator();
        action.map(Chosen::Action)
    }

    fn image_commands(&self, ui: &mut Ui) -> Option<Chosen> {
        let mut chosen = None;
        let commands = [("Fit", Command::Fit), ("Actual size", Command::ActualSize), ("Save image…", Command::SavePicture)];
        for (name, command) in commands {
            let is_possible = command != Command::SavePicture || self.can_save();
            if ui.add_enabled(is_possible, egui::Button::new(name)).clicked() {
                chosen = Some(Chosen::Command(command));
            }
        }
        if ui.add_enabled(self.can_save(), egui::Button::new("Copy image")).clicked() {
            chosen = Some(Chosen::CopyImage);
        }
        chosen
    }

    /// Shows the field for the name of the selected part, on the page Edit. Returns whether there is one.
    pub fn rename_selected(&mut self) -> bool {
        let subject = self.selection.subject.clone().filter(|_| self.window.panel == PanelTab::Edit);
        subject.is_some_and(|subject| self.rename(subject))
    }

    fn rename(&mut self, subject: Subject) -> bool {
        let Some(editor) = self.editor.as_mut().filter(|_| can_rename(&subject)) else { return false };
        self.window.panel = PanelTab::Edit;
        editor.outliner.rename(subject);
        true
    }
}
