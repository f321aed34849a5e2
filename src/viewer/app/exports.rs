//! Exports that go on beside the window: the image in tev, and numbered frames.
use egui::Panel;

use super::state::App;
use crate::viewer::background::{
    reference_task::ReferenceTask,
    sequence_task::{ExistingFrames, SequenceEnd, SequenceRequest, SequenceTask},
    tev_link::TevState,
};
use crate::viewer::dialogs::{
    connect_tev::{self, TevDialog},
    save::OtherExport,
    save_target::SaveTarget,
    sequence::{self, SequenceAnswer, SequenceDialog},
};
use crate::viewer::panels::exports::{self, StopCommand};

impl App {
    /// Opens the dialog of an export.
    pub fn open_export(&mut self, export: OtherExport) {
        match export {
            OtherExport::Sequence => {
                self.dialogs.sequence = Some(SequenceDialog::new(self.session.path(), self.session.budget.max_spp));
            }
            OtherExport::Progress => self.open_save_dialog(SaveTarget::Progress),
            OtherExport::Tev => self.dialogs.tev = Some(TevDialog::new(&self.background.tev.address)),
        }
    }

    pub fn show_tev(&mut self, ctx: &egui::Context) {
        let address = connect_tev::show(ctx, &mut self.dialogs.tev);
        address.into_iter().for_each(|address| self.background.tev.connect(address));
    }

    pub fn show_sequence(&mut self, ctx: &egui::Context) {
        let answer = sequence::show(ctx, &mut self.dialogs.sequence);
        answer.into_iter().for_each(|answer| self.render_sequence(answer));
    }

    /// Asks about frames that exist, and follows the answer.
    pub fn show_existing_frames(&mut self, ctx: &egui::Context) {
        let Some((request, [existing, frames])) = &self.dialogs.existing_frames else { return };
        let Some(existing) = sequence::ask_about_existing(ctx, *existing, *frames) else { return };
        let request = SequenceRequest { existing, ..request.clone() };
        self.dialogs.existing_frames = None;
        if existing != ExistingFrames::Ask {
            self.start_sequence(request);
        }
    }

    fn render_sequence(&mut self, answer: SequenceAnswer) {
        let Some(image) = self.session.request() else { return };
        let SequenceAnswer { cameras, spp, files } = answer;
        let (display, threads, existing) = (self.session.look.display, self.session.threads, ExistingFrames::Ask);
        self.start_sequence(SequenceRequest { cameras, spp, files, existing, image, display, threads });
    }

    /// Renders frames. The main render pauses until they are done.
    fn start_sequence(&mut self, request: SequenceRequest) {
        if self.is_rendering_sequence() {
            return self.tell("Other frames are being rendered. Stop them first.".to_owned(), true);
        }
        self.background.sequence = Some(SequenceTask::start(&self.ctx, request));
    }

    /// Whether numbered frames have the machine, and the image waits.
    pub fn is_rendering_sequence(&self) -> bool {
        self.background.sequence.is_some()
    }

    /// Sends the latest frame to tev, and takes up what has ended.
    pub fn receive_exports(&mut self) {
        if let Some(failure) = self.background.tev.receive() {
            self.tell(failure, true);
        }
        if self.background.tev.state() == TevState::Live {
            self.send_to_tev();
        }
        if let Some((request, end)) = SequenceTask::take(&mut self.background.sequence) {
            self.take_sequence(request, end);
        }
    }

    fn send_to_tev(&mut self) {
        let worker = &self.background.worker;
        let (frame, Some(opened)) = (worker.latest().frame, &self.session.opened) else { return };
        if frame.generation == worker.generation() && !frame.is_coarse() && !frame.radiance.is_empty() {
            self.background.tev.show(&opened.name, &frame);
        }
    }

    fn take_sequence(&mut self, request: SequenceRequest, end: Result<SequenceEnd, String>) {
        match end {
            Ok(SequenceEnd::Done { rendered, frames }) => {
                self.tell(format!("Rendered {rendered} of {frames} images: {}", request.files.display()), false);
            }
            Ok(SequenceEnd::Stopped { rendered, frames }) => {
                let text = format!(
                    "Stopped after {rendered} of {frames} images. To continue, render them again and keep the existing ones."
                );
                self.tell(text, false);
            }
            Ok(SequenceEnd::Exist { existing, frames }) => self.dialogs.existing_frames = Some((request, [existing, frames])),
            Err(error) => self.tell(format!("The images were not rendered: {error}"), true),
        }
    }

    /// Shows the line of exports while there are any.
    pub fn exports_panel(&mut self, ui: &mut egui::Ui) {
        let (tev, sequence) = (&self.background.tev, self.background.sequence.as_ref());
        let reference = self.background.reference.as_ref().map(ReferenceTask::progress);
        if tev.state() == TevState::Off && sequence.is_none() && reference.is_none() {
            return;
        }
        let sequence = sequence.map(|task| (task.progress(), task.request.spp));
        match Panel::bottom("exports").show(ui, |ui| exports::show(ui, tev, sequence, reference)).inner {
            Some(StopCommand::Tev) => self.background.tev.stop(),
            Some(StopCommand::Sequence) => self.background.sequence.iter().for_each(SequenceTask::stop),
            Some(StopCommand::Reference) => self.background.reference.iter().for_each(ReferenceTask::stop),
            None => {}
        }
    }
}
