//! The question whether to restore changes that were not saved.
use std::time::Duration;

use egui::{Align2, RichText};

use crate::viewer::background::{catalogue, recovery_files::FoundRecovery};

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecoveryAnswer {
    Restore,
    Discard,
    Later,
}

/// Asks the question.
pub fn show(ctx: &egui::Context, found: &FoundRecovery) -> Option<RecoveryAnswer> {
    let (mut open, mut answer) = (true, None);
    egui::Window::new("Unsaved changes were found")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(420.0);
            let path = found.recovery.path.as_deref();
            let scene =
                path.map_or_else(|| "a scene without a file".to_owned(), |path| format!("`{}`", catalogue::name("", path)));
            let label = ui.label(format!("Restore unsaved changes of {scene} from {} ago?", in_words(found.age)));
            path.into_iter().for_each(|path| _ = label.clone().on_hover_text(path.display().to_string()));
            if found.is_older {
                ui.label("The scene file was changed after that.");
            }
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                for (name, doc, means) in [
                    (RichText::new("Restore changes").strong(), "Opens the scene with these changes.", RecoveryAnswer::Restore),
                    (RichText::new("Discard changes"), "Deletes these changes.", RecoveryAnswer::Discard),
                    (RichText::new("Later"), "Asks again when the scene is opened next time. (Esc)", RecoveryAnswer::Later),
                ] {
                    if ui.button(name).on_hover_text(doc).clicked() {
                        answer = Some(means);
                    }
                }
            });
        });
    if open { answer } else { Some(RecoveryAnswer::Later) }
}

/// A time in its largest unit.
fn in_words(time: Duration) -> String {
    let minutes = time.as_secs() / 60;
    let (count, unit) = match minutes {
        0 => return "less than a minute".to_owned(),
        1..60 => (minutes, "minute"),
        60..1440 => (minutes / 60, "hour"),
        _ => (minutes / 1440, "day"),
    };
    format!("{count} {unit}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_has_one_unit() {
        let texts = [0, 59, 60, 3599, 3600, 86_399, 200_000].map(|seconds| in_words(Duration::from_secs(seconds)));
        assert_eq!(texts, ["less than a minute", "less than a minute", "1 minute", "59 minutes", "1 hour", "23 hours", "2 days"]);
    }
}
