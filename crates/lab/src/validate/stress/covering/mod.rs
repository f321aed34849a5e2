//! Scenes in which all pairs, or all triples, of declared kinds appear.
//!
//! Factors are read from the declarations, so a new kind is in these scenes without an edit. Each scene is rendered, compared,
//! edited, saved and replayed.
//!
//! | file | holds |
//! |---|---|
//! | `factors.rs`, `place.rs` | the factors: the visitor that lists what can vary |
//! | `array.rs`, `marks.rs` | covering arrays: few rows with all combinations |
//! | `assign.rs`, `frame.rs` | the scene of a row |
//! | `trial.rs`, `agreement.rs`, `render.rs` | the trial of a scene; whether estimators agree; small films |
//! | `section.rs` | the section of the report |
mod agreement;
mod array;
mod assign;
mod factors;
mod frame;
mod marks;
mod place;
mod render;
mod section;
#[cfg(test)]
mod tests;
mod trial;

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

pub use self::section::section;
use self::{
    agreement::Agreement,
    array::{CoveringArray, Factor, Row, covering_array},
    frame::Frame,
    render::Renderers,
    trial::trial,
};
use super::{dice::Dice, failed_scene::FailedScene};

/// Scenes in a row that are tried on one thread, where each reuses tables of the one before.
const NEIGHBOURS: usize = 16;

/// Scenes between two messages.
const SCENES_OF_MESSAGE: usize = 32 * NEIGHBOURS;

/// How many factors are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strength {
    Pairs = 2,
    Triples = 3,
}

/// The scenes of a covering array, and those that fail.
#[derive(Default)]
pub struct Covering {
    /// Factors and their levels.
    pub factors: usize,
    pub levels: usize,
    /// Combinations that the scenes contain.
    pub combinations: usize,
    pub scenes: usize,
    /// Scenes whose estimates deviate, but have no known error.
    pub unknown: usize,
    pub impossible: Vec<Impossible>,
    pub failed: Vec<FailedScene>,
}

/// Levels that no scene can have together.
pub struct Impossible {
    /// Whether it is a single kind.
    pub is_kind: bool,
    pub words: String,
}

impl Strength {
    pub fn words(self) -> &'static str {
        match self {
            Strength::Pairs => "pairs",
            Strength::Triples => "triples",
        }
    }
}

/// Tries the scenes of a covering array of all factors that are no numbers. Calls `message` now and then.
pub fn cover(strength: Strength, message: &(dyn Fn(&str) + Sync)) -> Covering {
    let frame = match Frame::new() {
        Ok(frame) => frame,
        Err(error) => {
            let plain = FailedScene { name: "plain".to_owned(), text: String::new(), reason: error.to_string() };
            return Covering { failed: vec![plain], ..Covering::default() };
        }
    };
    let chosen: Vec<usize> = (0..frame.factors.len()).filter(|factor| !frame.factors[*factor].is_number).collect();
    let of_chosen = |factor: &usize| {
        let Factor { parent, .. } = frame.factors[*factor].factor;
        // No number is a parent.
        let parent = parent.map(|(parent, level)| (chosen.partition_point(|chosen| *chosen < parent), level));
        Factor { parent, ..frame.factors[*factor].factor.clone() }
    };
    let factors: Vec<Factor> = chosen.iter().map(of_chosen).collect();
    let place = |levels: Vec<(usize, usize)>| {
        levels.into_iter().filter_map(|(factor, level)| Some((chosen.binary_search(&factor).ok()?, level)))
    };
    let mut dice = Dice::new("covering", strength as u32);
    let CoveringArray { rows, covered, impossible } = covering_array(&factors, strength as usize, &mut dice, |row| {
        Some(place(frame.refused(&frame.completed(&chosen, row))?).collect())
    });
    // Neighbours have the same background.
    let mut rows: Vec<Row> = rows.iter().map(|row| frame.completed(&chosen, row)).collect();
    rows.sort_by_cached_key(|row| frame.levels_of_environment(row));
    let (failed, unknown) = tried(&frame, &rows, strength, message);
    let words = |levels: &[(usize, usize)]| {
        frame.words(&levels.iter().map(|(factor, level)| (chosen[*factor], *level)).collect::<Vec<_>>())
    };
    let is_kind = |levels: &[(usize, usize)]| matches!(levels, [(factor, _)] if factors[*factor].is_choice);
    Covering {
        factors: factors.len(),
        levels: factors.iter().map(|factor| factor.levels).sum(),
        combinations: covered,
        scenes: rows.len(),
        impossible: impossible.iter().map(|levels| Impossible { is_kind: is_kind(levels), words: words(levels) }).collect(),
        unknown,
        failed,
    }
}

/// The scenes that fail, and the number of those without a known error. Each thread has render threads of its own: those of a pool would
/// begin another scene while they wait.
fn tried(frame: &Frame, rows: &[Row], strength: Strength, message: &(dyn Fn(&str) + Sync)) -> (Vec<FailedScene>, usize) {
    let (next, unknown) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let failed = Mutex::new(Vec::new());
    let work = || {
        let (renderers, mut before) = (Renderers::new(), frame.known());
        loop {
            let start = NEIGHBOURS * next.fetch_add(1, Ordering::Relaxed);
            if start >= rows.len() {
                return;
            }
            if start > 0 && start.is_multiple_of(SCENES_OF_MESSAGE) {
                message(&format!("{}: {start} of {} scenes", strength.words(), rows.len()));
            }
            for (number, row) in rows.iter().enumerate().skip(start).take(NEIGHBOURS) {
                let row = frame.with_numbers(row, number, start);
                let renderers = renderers.as_ref().map_err(String::clone);
                match renderers.and_then(|renderers| trial(renderers, frame, &row, &before)) {
                    Ok((scene, agreement)) => {
                        before = Arc::new(scene);
                        unknown.fetch_add(usize::from(agreement == Agreement::Unknown), Ordering::Relaxed);
                    }
                    Err(reason) => {
                        let text = format!("# {}\n{}", reason.replace('\n', " "), frame.describe(&row).to_text());
                        let scene = FailedScene { name: format!("{}-{number:05}", strength.words()), text, reason };
                        failed.lock().unwrap_or_else(PoisonError::into_inner).push(scene);
                    }
                }
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..rayon::current_num_threads() {
            scope.spawn(work);
        }
    });
    let mut failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
    failed.sort_by(|a, b| a.name.cmp(&b.name));
    (failed, unknown.into_inner())
}
