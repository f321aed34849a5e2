//! Advice for options that other renderers have.
use clap::{
    Command, Error,
    error::{ContextKind, ContextValue, ErrorKind},
};

/// Unknown options, and the options that they may mean; the first one that the command has is suggested.
const SYNONYMS: [(&[&str], &[&str]); 11] = [
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
    (&["temperature", "kelvin", "wb"], &["white-balance"]),
];

/// Adds the option that was probably meant to a usage error.
pub fn with_advice(mut error: Error, program: &Command) -> Error {
    if error.kind() == ErrorKind::UnknownArgument
        && let Some(ContextValue::String(typed)) = error.get(ContextKind::InvalidArg)
        && let Some(meant) = meant(typed, program)
    {
        error.insert(ContextKind::SuggestedArg, ContextValue::String(format!("--{meant}")));
    }
    error
}

/// The option of the command that the typed one probably means.
fn meant(typed: &str, program: &Command) -> Option<&'static str> {
    let word = typed.trim_start_matches('-').split('=').next()?;
    let (_, meant) = SYNONYMS.iter().find(|(words, _)| words.contains(&word))?;
    let name = std::env::args_os().nth(1)?;
    let command = program.find_subcommand(&name)?;
    let has = |option: &&&str| command.get_arguments().any(|argument| argument.get_long() == Some(**option));
    meant.iter().find(has).copied()
}
