//! Asks whether to continue the unfinished render of an earlier run.
use egui::Ui;

use super::{
    question::{Choice, ask},
    recovery::in_words,
};
use crate::viewer::background::progress_checkpoints::FoundRender;

/// An answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnfinishedAnswer {
    Continue,
    Discard,
    Later,
}

/// Asks the question.
pub fn show(ctx: &egui::Context, found: &FoundRender) -> Option<UnfinishedAnswer> {
    let explain = |ui: &mut Ui| {
        let FoundRender { scene, rendered, age, .. } = found;
        let (rendered, age) = (in_words(*rendered), in_words(*age));
        ui.label(format!("Continue the render of “{scene}” from {age} ago? It has rendered for {rendered}."));
    };
    let choices = [
        Choice::new("Continue render", "Opens the scene, and continues with these samples.", UnfinishedAnswer::Continue),
        Choice::new("Discard render", "Deletes these samples.", UnfinishedAnswer::Discard),
        Choice::new("Later", "Keeps them and asks again next time. (Esc)", UnfinishedAnswer::Later),
    ];
    ask(ctx, "An unfinished render was found", 420.0, explain, choices, UnfinishedAnswer::Later)
}
