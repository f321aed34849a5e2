//! Options of the settings of a render: one for each row of their table, with one value or a list of values.
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use noisefall_base::declare::Accepted;
use noisefall_scene::scene::{RenderSettings, Setting};

use super::headings;

/// Settings in place of those of the scene.
#[derive(Default)]
pub struct SettingOptions {
    given: Vec<(Setting, String)>,
}

impl SettingOptions {
    /// The settings of a scene with those that were given.
    pub fn settings(&self, of_scene: RenderSettings) -> RenderSettings {
        self.given.iter().fold(of_scene, |settings, (setting, word)| with_word(*setting, settings, word))
    }
}

impl Args for SettingOptions {
    fn augment_args(command: Command) -> Command {
        let option = |setting: &Setting| {
            let option = Arg::new(setting.key()).long(setting.option()).value_name(value_name(setting));
            option.help(help(setting)).help_heading(headings::SAMPLING).value_parser(parser(*setting))
        };
        command.args(RenderSettings::TABLE.iter().map(option))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SettingOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let word = |setting: &Setting| matches.get_one::<String>(setting.key()).cloned();
        let given = RenderSettings::TABLE.into_iter().filter_map(|setting| Some((setting, word(&setting)?)));
        Ok(SettingOptions { given: given.collect() })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// `settings` with the value of a word, which the parser of the option has accepted.
pub fn with_word(setting: Setting, settings: RenderSettings, word: &str) -> RenderSettings {
    let mut changed = settings;
    let is_read = setting.read(&mut changed, word).is_ok();
    debug_assert!(is_read, "{setting:?} {word}");
    changed
}

/// Takes the words that the setting takes.
pub fn parser(setting: Setting) -> impl Fn(&str) -> Result<String, String> + Clone + Send + Sync + 'static {
    move |word| setting.read(&mut RenderSettings::default(), word).map(|()| word.to_owned())
}

/// The sentence of the setting, and the words that it takes.
pub fn help(setting: &Setting) -> String {
    let doc = setting.parameter.doc.trim_end_matches('.');
    match setting.accepted() {
        accepted @ (Accepted::Words(_) | Accepted::Other(_) | Accepted::Flag) => {
            format!("{doc} [{}]", accepted.alternatives().join(", "))
        }
        Accepted::Count | Accepted::OptionalCount => doc.to_owned(),
    }
}

fn value_name(setting: &Setting) -> String {
    match setting.accepted() {
        Accepted::Count => "N".to_owned(),
        Accepted::OptionalCount => "N|none".to_owned(),
        Accepted::Flag => "on|off".to_owned(),
        Accepted::Words(_) | Accepted::Other(_) => setting.key().to_uppercase(),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use noisefall_base::declare::{Declare, Dice};
    use noisefall_scene::scene::Roulette;
    use rand::{SeedableRng, rngs::SmallRng};

    use super::*;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        settings: SettingOptions,
    }

    #[test]
    fn every_setting_has_an_option_that_gives_it_any_value() {
        for seed in 0..200 {
            let mut settings = RenderSettings::default();
            settings.parameters(&mut Dice::new(&mut SmallRng::seed_from_u64(seed)));
            let of_scene = RenderSettings::default();
            let options = noisefall_render::render::settings_text::options(&settings, &of_scene);
            let parsed = Program::try_parse_from(format!("render{options}").split_whitespace()).expect("they are options");
            assert_eq!(parsed.settings.settings(of_scene), settings, "{options}");
        }
    }

    #[test]
    fn numbers_in_range_are_taken_and_others_are_not() {
        let value = |setting: Setting, word: &str| {
            parser(setting)(word).ok().map(|word| with_word(setting, RenderSettings::default(), &word))
        };
        let roulette = |word: &str| value(RenderSettings::ROULETTE, word).map(|settings| settings.roulette);
        for (word, expected) in [
            ("off", Roulette::Off),
            ("0.01", Roulette::fixed(0.01)),
            ("0.5", Roulette::fixed(0.5)),
            ("1", Roulette::fixed(1.0)),
            ("throughput", Roulette::BY_THROUGHPUT),
            ("throughput:0", Roulette::by_throughput_from(0)),
        ] {
            assert_eq!(roulette(word), Some(expected), "{word}");
        }
        for word in ["", "0", "0.0099", "1.0001", "1.5", "nan", "x", "throughput:", "throughput:-1", "throughputs"] {
            assert_eq!(roulette(word), None, "{word}");
        }
        let cap = |word: &str| value(RenderSettings::MAX_BOUNCES, word).map(|settings| settings.max_bounces);
        assert_eq!(["none", "0", "7"].map(cap), [Some(None), Some(Some(0)), Some(Some(7))]);
        assert_eq!(["-1", "1.5", "", "4294967296"].map(cap), [None; 4]);
        let adaptive = |word: &str| value(RenderSettings::ADAPTIVE, word).map(|settings| settings.adaptive);
        assert_eq!(["on", "off", "yes", "true"].map(adaptive), [Some(true), Some(false), None, None]);
        let seed = |word: &str| value(RenderSettings::SEED, word).map(|settings| settings.seed);
        assert_eq!(["4294967295", "-1", "1e3"].map(seed), [Some(u32::MAX), None, None]);
    }
}
