//! What was meant by options of other renderers.
use clap::{
    Command, Error,
    error::{ContextKind, ContextValue, ErrorKind},
};

/// Words that are no options here, and those that they may mean; of several the first that the command has.
const SYNONYMS: [(&[&str], &[&str]); 10] = [
    (&["samples", "samples-per-pixel", "sample-count", "num-samples"], &["spp"]),
    (&["depth", "max-depth", "bounces", "cap"], &["max-bounces"]),
    (&["resolution", "width", "height", "res"], &["size"]),
    (&["integrator", "method"], &["estimator", "estimators"]),
    (&["russian-roulette", "rr"], &["roulette"]),
    (&["share", "sharing"], &["reuse"]),
    (&["timeout", "seconds", "budget"], &["time", "seconds"]),
    (&["out", "file"], &["output"]),
    (&["tonemap", "tone-map"], &["tone"]),
    (&["ev", "stops"], &["exposure"]),
];

/// An error of usage that names the option that was meant, where that is known.
pub fn with_advice(mut error: Error, program: &Command) -> Error {
    if error.kind() == ErrorKind::UnknownArgument
        && let Some(ContextValue::String(typed)) = error.get(ContextKind::InvalidArg)
        && let Some(meant) = meant(typed, program)
    {
        error.insert(ContextKind::SuggestedArg, ContextValue::String(format!("--{meant}")));
    }
    error
}

/// The option of the command that is being run.
fn meant(typed: &str, program: &Command) -> Option<&'static str> {
    let word = typed.trim_start_matches('-').split('=').next()?;
    let (_, meant) = SYNONYMS.iter().find(|(words, _)| words.contains(&word))?;
    let name = std::env::args_os().nth(1)?;
    let command = program.find_subcommand(&name)?;
    let has = |option: &&&str| command.get_arguments().any(|argument| argument.get_long() == Some(**option));
    meant.iter().find(has).copied()
}
