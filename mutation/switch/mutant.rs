//! Tells which of the mutants is on. Only the copy that `mutation` makes has this file.
use std::{
    env,
    fs::OpenOptions,
    io::Write,
    sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed},
};

const UNKNOWN: u32 = u32::MAX;
/// None is on, and those that are reached are recorded.
const TRACED: u32 = u32::MAX - 1;
static CHOSEN: AtomicU32 = AtomicU32::new(UNKNOWN);
static REACHED: [AtomicU64; 1024] = [const { AtomicU64::new(0) }; 1024];

/// Whether this mutant is on: the one whose number `NOISEFALL_MUTANT` is.
#[inline(always)]
pub fn on(mutant: u32) -> bool {
    let chosen = CHOSEN.load(Relaxed);
    chosen == mutant || (chosen >= TRACED && ask(mutant))
}

#[cold]
#[inline(never)]
fn ask(mutant: u32) -> bool {
    if CHOSEN.load(Relaxed) == UNKNOWN {
        let traced = env::var_os("NOISEFALL_MUTANT_TRACE").is_some();
        let chosen = env::var("NOISEFALL_MUTANT").ok().and_then(|number| number.parse().ok());
        CHOSEN.store(chosen.unwrap_or(if traced { TRACED } else { 0 }), Relaxed);
    }
    if CHOSEN.load(Relaxed) == TRACED {
        record(mutant);
    }
    CHOSEN.load(Relaxed) == mutant
}

/// Appends the number of a mutant to the file that `NOISEFALL_MUTANT_TRACE` names, once per process.
fn record(mutant: u32) {
    let bit = 1 << (mutant % 64);
    if REACHED[mutant as usize / 64].fetch_or(bit, Relaxed) & bit == 0 {
        let path = env::var_os("NOISEFALL_MUTANT_TRACE").expect("it is set");
        let file = OpenOptions::new().append(true).create(true).open(path);
        file.and_then(|mut file| file.write_all(format!("{mutant}\n").as_bytes())).expect("the trace can be written");
    }
}
