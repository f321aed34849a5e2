//! Options that take lists of settings. A study combines the lists.
use noisefall_lab::study::Lists;
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, Reuse, Roulette},
};

use super::options::{self as parse, BounceCap};

#[derive(clap::Args)]
pub struct ListOptions {
    #[arg(long, help = format!("How light is estimated: {}", parse::list_of::<Estimator>()),
          value_name = "LIST", value_delimiter = ',', value_parser = item(parse::word::<Estimator>))]
    estimators: Vec<Estimator>,
    #[arg(long, help = format!("How directions are sampled at diffuse surfaces: {}", parse::list_of::<Directions>()),
          value_name = "LIST", value_delimiter = ',', value_parser = item(parse::word::<Directions>))]
    directions: Vec<Directions>,
    #[arg(long, help = format!("Sampler: {}", parse::list_of::<Sampler>()),
          value_name = "LIST", value_delimiter = ',', value_parser = item(parse::word::<Sampler>))]
    samplers: Vec<Sampler>,
    #[arg(long, help = format!("Russian roulette: {}", Roulette::options().join(", ")),
          value_name = "LIST", value_delimiter = ',', value_parser = item(parse::roulette))]
    roulette: Vec<Roulette>,
    /// Highest numbers of bounces, or none for no cap; a cap makes the estimate biased
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = item(parse::bounce_cap))]
    max_bounces: Vec<BounceCap>,
    #[arg(long, help = format!("What neighbouring pixels share: {}", parse::list_of::<Reuse>()),
          value_name = "LIST", value_delimiter = ',', value_parser = item(parse::word::<Reuse>))]
    reuse: Vec<Reuse>,
    /// Adaptive sampling, with more samples where there is more noise: on, off
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = item(parse::on_or_off))]
    adaptive: Vec<bool>,
}

impl ListOptions {
    /// The lists, with those of `usual` for the ones that were not given.
    pub fn lists(&self, usual: Lists) -> Lists {
        fn given<T: Clone>(list: &[T], usual: Vec<T>) -> Vec<T> {
            if list.is_empty() { usual } else { list.to_vec() }
        }
        Lists {
            estimators: given(&self.estimators, usual.estimators),
            directions: given(&self.directions, usual.directions),
            samplers: given(&self.samplers, usual.samplers),
            roulettes: given(&self.roulette, usual.roulettes),
            caps: given(&self.max_bounces.iter().map(|cap| cap.0).collect::<Vec<_>>(), usual.caps),
            reuses: given(&self.reuse, usual.reuses),
            adaptive: given(&self.adaptive, usual.adaptive),
        }
    }
}

/// Parses an item of a list; spaces and quotes around it are ignored.
pub fn item<T>(parse: fn(&str) -> Result<T, String>) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| parse(text.trim_matches(|c: char| c.is_whitespace() || matches!(c, '"' | '\'')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_of_lists_lose_their_spaces_and_quotes() {
        let sampler = item(parse::word::<Sampler>);
        for text in [" sobol", "sobol\t", "'sobol'", "\"sobol\"", " ' sobol' "] {
            assert_eq!(sampler(text), Ok(Sampler::Sobol), "{text}");
        }
        assert!(sampler("").is_err() && sampler("so bol").is_err());
    }
}
