//! Asks whether to restore unsaved changes of an earlier run.
use std::time::Duration;

use egui::Ui;

use super::question::{Choice, ask};
use crate::viewer::{
    background::{catalogue, recovery_files::FoundRecovery},
    widgets::counted::counted,
};

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecoveryAnswer {
    Restore,
    Discard,
    Later,
}

/// Asks the question.
pub fn show(ctx: &egui::Context, found: &FoundRecovery) -> Option<RecoveryAnswer> {
    let explain = |ui: &mut Ui| {
        let path = found.recovery.file();
        let scene = name(found);
        let label = ui.label(format!("Restore unsaved changes of {scene} from {} ago?", in_words(found.age)));
        path.into_iter().for_each(|path| _ = label.clone().on_hover_text(path.display().to_string()));
        if found.is_older {
            ui.label("The scene file was changed after that.");
        }
    };
    let choices = [
        Choice::new("Restore changes", "Opens the scene with these changes.", RecoveryAnswer::Restore),
        Choice::new("Discard changes", "Deletes these changes.", RecoveryAnswer::Discard),
        Choice::new("Later", "Keeps them and asks again next time. (Esc)", RecoveryAnswer::Later),
    ];
    ask(ctx, "Unsaved changes were found", 420.0, explain, choices, RecoveryAnswer::Later)
}

/// The name of the scene: that of its file, or else its title.
fn name(found: &FoundRecovery) -> String {
    match found.recovery.file() {
        Some(path) => format!("“{}”", catalogue::name("", path)),
        None if found.title.is_empty() => "a scene without a file".to_owned(),
        None => format!("“{}”, a scene without a file,", found.title),
    }
}

/// A time in its largest unit.
pub fn in_words(time: Duration) -> String {
    let minutes = time.as_secs() / 60;
    let (number, unit) = match minutes {
        0 => return "less than a minute".to_owned(),
        1..60 => (minutes, "minute"),
        60..1440 => (minutes / 60, "hour"),
        _ => (minutes / 1440, "day"),
    };
    counted(number, unit)
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
