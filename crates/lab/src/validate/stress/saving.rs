//! Random scenes are saved into the files of others.
use rayon::prelude::*;

use super::Dice;
use crate::validate::{Section, Statement};
use noisefall_edit::edit::write_and_read;

/// Pairs of scenes that a full run draws.
pub const PAIRS: u32 = 10_000;

/// Saves the given number of pairs of scenes into each other.
pub fn section(pairs: u32) -> Section {
    let wrong = |number: &u32| write_and_read(&mut Dice::new("saving", *number)).is_err();
    let wrong: Vec<u32> = (0..pairs).into_par_iter().filter(wrong).collect();
    let first = wrong.first().map_or_else(String::new, |number| format!(" (saving-{number})"));
    let what = format!("{pairs} scenes written into files of other scenes: those that read as anything else{first}");
    Section {
        title: "What is saved",
        claim: "Saving changes only what has changed, and what is saved reads as the scene, bit for bit.",
        derivation: &[
            "Two scenes are drawn from the declarations. The first one is a file, written with a table for everything or as a person \
             writes it. Read and written without changes, the text is the same. Then the second scene takes the place of the first: some of \
             its objects, materials and textures are matched with random ones of the file, under other names and in another order, and the others are new. \
             What is written into the file must read as the second scene.",
        ],
        source: "The same operations save a scene that is edited in the window.",
        statements: vec![Statement::none(what, wrong.len() as u32)],
        figures: Vec::new(),
        remark: None,
    }
}
