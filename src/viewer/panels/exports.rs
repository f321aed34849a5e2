//! The line that shows what is under way beside the image: the connection to tev, numbered frames, and a reference.
use egui::{ProgressBar, Ui};

use crate::viewer::background::{
    reference_task::ReferenceProgress,
    sequence_task::SequenceProgress,
    tev_link::{TevLink, TevState},
};

/// The task that a button of the line stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopCommand {
    Tev,
    Sequence,
    Reference,
}

/// Shows the line. The number beside the progress of a sequence are the samples of a whole frame.
pub fn show(
    ui: &mut Ui,
    tev: &TevLink,
    sequence: Option<(SequenceProgress, u32)>,
    reference: Option<ReferenceProgress>,
) -> Option<StopCommand> {
    let mut command = None;
    ui.horizontal_wrapped(|ui| {
        if let Some((progress, spp)) = sequence {
            let SequenceProgress { frame, frames, spp: done } = progress;
            let text = if frames == 0 { "Preparing frames".to_owned() } else { format!("Rendering frame {frame} of {frames}") };
            ui.label(text).on_hover_text("The main render pauses meanwhile.");
            let part = (frame.saturating_sub(1) as f32 + done as f32 / spp as f32) / frames.max(1) as f32;
            ui.add(ProgressBar::new(part).desired_width(160.0).text(format!("{:.0} %", 100.0 * part)));
            let doc = "Drops the unfinished frame. Finished frames stay.";
            if ui.button("Stop rendering").on_hover_text(doc).clicked() {
                command = Some(StopCommand::Sequence);
            }
        }
        if let Some(progress) = reference {
            if sequence.is_some() {
                ui.separator();
            }
            if show_reference(ui, progress) {
                command = Some(StopCommand::Reference);
            }
        }
        if (sequence.is_some() || reference.is_some()) && tev.state() != TevState::Off {
            ui.separator();
        }
        let text = match tev.state() {
            TevState::Off => return,
            TevState::Connecting => format!("Connecting to tev at {}", tev.address),
            TevState::Live => format!("Sending to tev at {}", tev.address),
        };
        ui.label(text).on_hover_text("tev gets the image at most once a second.");
        if ui.button("Stop sending").on_hover_text("Ends the connection. tev keeps the image.").clicked() {
            command = Some(StopCommand::Tev);
        }
    });
    command
}

/// Shows the progress of a reference. Returns whether it is to stop.
fn show_reference(ui: &mut Ui, progress: ReferenceProgress) -> bool {
    let percent = |x: f64| format!("{:.2} %", 100.0 * x);
    let noise = progress.noise.map_or_else(|| "–".to_owned(), percent);
    let text = format!("Rendering a reference: {} spp, estimated error {noise} of {}", progress.spp, percent(progress.goal));
    ui.label(text).on_hover_text("It takes half of the threads. The image goes on.");
    let part = progress.part();
    ui.add(ProgressBar::new(part).desired_width(120.0).text(format!("{:.0} %", 100.0 * part)));
    ui.button("Stop the reference").on_hover_text("Keeps what is rendered. Render a reference continues it.").clicked()
}
