//! The table of all settings of a render. Files, options, lists, figures, legends, the window, studies and Python read it.
//!
//! A new setting is a field of [`RenderSettings`] and a row here.
use super::{
    RenderSettings,
    setting::{Access, Changes, Setting, accepted, access},
};
use crate::scene::{PathReuse, Reuse};
use noisefall_base::declare::{CountRange, Declare, Form, OneOf, Parameter, Parameters, SettingValue, Words};

impl RenderSettings {
    /// How light is estimated.
    pub const ESTIMATOR: Setting = Setting::new(
        Parameter::new("estimator", "How light is estimated. All estimators converge to the same image; they differ in noise.")
            .aliases("integrator method nee"),
        access!(estimator, word),
        |settings| settings.estimator.title().to_owned(),
    )
    .list("estimators")
    .always_told();

    /// Whether vertices are merged.
    pub const MERGING: Setting = Setting::new(
        Parameter::new(
            "merging",
            "Whether the estimator `bidirectional` merges vertices that are near each other (Georgiev et al. 2012). Finds caustics in mirrors. Biased, but consistent.",
        )
        .aliases("vcm merge vertex_merging photons"),
        access!(merging, flag),
        |settings| if settings.merging { PathReuse::Merged.words() } else { "no merging" }.to_owned(),
    )
    .noun("merging");

    /// How directions are sampled.
    pub const DIRECTIONS: Setting = Setting::new(
        Parameter::new("directions", "How the next direction is sampled at diffuse surfaces.")
            .symbol("p(ω)")
            .aliases("sampling importance_sampling distribution"),
        access!(directions, word),
        |settings| format!("{} directions", settings.directions.word().title),
    )
    .always_told();

    /// The sequence of random numbers.
    pub const SAMPLER: Setting = Setting::new(
        Parameter::new("sampler", "Sample pattern of a pixel. It determines how fast the error falls."),
        access!(sampler, word),
        |settings| settings.sampler.title().to_owned(),
    )
    .list("samplers")
    .always_told();

    /// The highest number of bounces.
    pub const MAX_BOUNCES: Setting = Setting::new(
        Parameter::new(
            "max_bounces",
            "Highest number of bounces, reflections and refractions alike. A cap cuts the series L_e + T L_e + …, so the image is too dark. Default: no cap; a path that reaches bounce 4096 is then cut, and the image is labelled biased.",
        )
        .title("Bounce cap")
        .symbol("k")
        .unit("bounces")
        .aliases("depth max_depth bounces max_bounce maxdepth")
        .advice("leave it out for no cap"),
        access!(max_bounces, |parameter: &_, cap: &mut _, p: &mut dyn Parameters| {
            p.optional(parameter, cap, || Self::FIRST_CAP, |p, cap| p.count(parameter, cap, CountRange::ANY));
        }),
        |settings| match settings.max_bounces {
            None => "no cap".to_owned(),
            Some(1) => "cap of 1 bounce".to_owned(),
            Some(cap) => format!("cap of {cap} bounces"),
        },
    )
    .changes(Changes::Limit)
    .counts([Self::FIRST_CAP, Self::HIGHEST_CAP])
    .noun("cap");

    /// Whether crossings count as bounces.
    pub const COUNT_CROSSINGS: Setting = Setting::new(
        Parameter::new("count_crossings", "Whether passing a surface that is not opaque counts as a bounce for `max_bounces`."),
        access!(count_crossings, flag),
        |settings| if settings.count_crossings { "crossings count" } else { "crossings do not count" }.to_owned(),
    )
    .changes(Changes::Limit)
    .noun("count crossings");

    /// How paths end.
    pub const ROULETTE: Setting = Setting::new(
        Parameter::new("roulette", "Ends paths at random and weights the survivors, so that the mean does not change.")
            .aliases("russian_roulette rr"),
        access!(roulette, choice),
        |settings| settings.roulette.words(),
    )
    .noun("roulette")
    .always_told();

    /// Path reuse between neighbouring pixels.
    pub const REUSE: Setting = Setting::new(
        Parameter::new(
            "reuse",
            "Path reuse between neighbouring pixels: suffixes (Bekaert, Sbert and Halton 2002), outliers, or both. Less noise, no bias, but the noise of neighbouring pixels is correlated.",
        )
        .title("Path reuse")
        .aliases("path_reuse share"),
        access!(reuse, word),
        |settings| match settings.reuse {
            Reuse::Auto => "path reuse auto".to_owned(),
            reuse => PathReuse::asked(reuse).words().to_owned(),
        },
    )
    .noun("path reuse");

    /// Whether noisier pixels get more samples.
    pub const ADAPTIVE: Setting = Setting::new(
        Parameter::new("adaptive", "Whether noisy blocks get more samples. Has no effect with path reuse or light paths."),
        access!(adaptive, flag),
        |settings| if settings.adaptive { "adaptive" } else { "not adaptive" }.to_owned(),
    )
    .noun("adaptive");

    /// The seed.
    pub const SEED: Setting = Setting::new(
        Parameter::new("seed", "Seed of the random numbers. Another seed gives different noise with the same mean."),
        access!(seed, count),
        |settings| format!("seed {}", settings.seed),
    )
    .changes(Changes::Seed)
    .list("")
    .noun("seed");

    /// All settings, in the order of files and of the window.
    pub const TABLE: [Setting; 10] = [
        Self::ESTIMATOR,
        Self::MERGING,
        Self::DIRECTIONS,
        Self::SAMPLER,
        Self::MAX_BOUNCES,
        Self::COUNT_CROSSINGS,
        Self::ROULETTE,
        Self::REUSE,
        Self::ADAPTIVE,
        Self::SEED,
    ];

    /// The setting with a key.
    pub fn setting(key: &str) -> Option<Setting> {
        Self::TABLE.into_iter().find(|setting| setting.key() == key)
    }

    /// The settings whose values can be compared: all but the seed.
    pub fn axes() -> impl Iterator<Item = Setting> {
        Self::TABLE.into_iter().filter(|setting| setting.changes != Changes::Seed)
    }

    /// The settings that differ.
    pub fn differing(&self, other: &RenderSettings) -> impl Iterator<Item = Setting> {
        Self::TABLE.into_iter().filter(|setting| setting.differs(self, other))
    }
}

impl Declare for RenderSettings {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        Self::TABLE.iter().for_each(|setting| setting.visit(self, p));
    }
}

fn word<T: Words>(parameter: &Parameter, value: &mut T, p: &mut dyn Parameters) {
    p.word(parameter, value);
}

fn flag(parameter: &Parameter, value: &mut bool, p: &mut dyn Parameters) {
    p.flag(parameter, value);
}

fn count(parameter: &Parameter, value: &mut u32, p: &mut dyn Parameters) {
    p.count(parameter, value, CountRange::ANY);
}

fn choice<T: OneOf>(parameter: &Parameter, value: &mut T, p: &mut dyn Parameters) {
    p.optional_choice(parameter, Form::NameOrTable, value);
}

#[cfg(test)]
mod tests {
    use rand::{SeedableRng, rngs::SmallRng};

    use super::*;
    use noisefall_base::declare::Dice;

    fn random(seed: u64) -> RenderSettings {
        let mut settings = RenderSettings::default();
        settings.parameters(&mut Dice::new(&mut SmallRng::seed_from_u64(seed)));
        settings
    }

    #[test]
    fn every_field_is_in_the_table() {
        for seed in 0..500 {
            let (a, b) = (random(seed), random(seed + 1000));
            let copied = RenderSettings::TABLE.iter().fold(a, |settings, setting| setting.with(&settings, &b));
            assert_eq!(copied, b);
            let differing: Vec<Setting> = a.differing(&b).collect();
            for setting in RenderSettings::TABLE {
                let changed = setting.with(&a, &b);
                assert_eq!(changed != a, differing.contains(&setting), "{setting:?}");
                assert_eq!(setting.value(&changed), setting.value(&b), "{setting:?}");
            }
        }
    }

    #[test]
    fn a_word_gives_the_value_that_it_came_from() {
        for seed in 0..500 {
            let (settings, mut other) = (random(seed), random(seed + 1000));
            for setting in RenderSettings::TABLE {
                let word = setting.value(&settings);
                assert_eq!(setting.read(&mut other, &word), Ok(()), "{setting:?} {word}");
                let nonsense = setting.read(&mut other, "nonsense").expect_err("it is no value");
                let accepted = setting.accepted().alternatives();
                assert!(accepted.iter().all(|word| nonsense.contains(word)), "{nonsense}");
            }
            assert_eq!(settings, other);
        }
    }
}
