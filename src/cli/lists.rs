//! Options that take lists of settings. A study combines the lists.
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use noisefall_lab::study::Lists;
use noisefall_scene::scene::{RenderSettings, Setting};

use super::settings::{help, parser, with_word};

/// Lists of settings.
pub struct ListOptions {
    given: Lists,
}

impl ListOptions {
    /// The lists, with those of `usual` for the ones that were not given.
    pub fn lists(&self, usual: Lists) -> Lists {
        usual.replaced_by(self.given.clone())
    }

    /// The options without dashes.
    pub fn names() -> impl Iterator<Item = &'static str> {
        RenderSettings::axes().map(|setting| setting.list)
    }
}

impl Args for ListOptions {
    fn augment_args(command: Command) -> Command {
        let option = |setting: Setting| {
            let option = Arg::new(setting.list).long(setting.list.replace('_', "-")).value_name("LIST").help(help(&setting));
            option.action(ArgAction::Append).value_delimiter(',').value_parser(item(parser(setting)))
        };
        command.args(RenderSettings::axes().map(option))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for ListOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let given = RenderSettings::axes().fold(Lists::default(), |lists, setting| {
            let Some(words) = matches.get_many::<String>(setting.list) else { return lists };
            lists.with(setting, words.map(|word| with_word(setting, RenderSettings::default(), word)))
        });
        Ok(ListOptions { given })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Parses an item of a list; spaces and quotes around it are ignored.
pub fn item<T>(parse: impl Fn(&str) -> Result<T, String> + Clone) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| parse(text.trim_matches(|c: char| c.is_whitespace() || matches!(c, '"' | '\'')))
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        lists: ListOptions,
    }

    #[test]
    fn items_of_lists_lose_their_spaces_and_quotes() {
        let sampler = item(parser(RenderSettings::SAMPLER));
        for text in [" sobol", "sobol\t", "'sobol'", "\"sobol\"", " ' sobol' "] {
            assert_eq!(sampler(text), Ok("sobol".to_owned()), "{text}");
        }
        assert!(sampler("").is_err() && sampler("so bol").is_err());
    }

    #[test]
    fn every_setting_but_the_seed_has_a_list() {
        for setting in RenderSettings::axes() {
            let word = setting.value(&RenderSettings::default());
            let list = format!("--{}={word},{word}", setting.list.replace('_', "-"));
            let lists = Program::try_parse_from(["sheet", &list]).expect("it is an option").lists.lists(Lists::default());
            let other = RenderSettings::default();
            assert_eq!(lists.combinations(other), [other], "{setting:?}");
        }
        assert_eq!(ListOptions::names().count() + 1, RenderSettings::TABLE.len());
    }
}
