//! Parsers of option values.
use std::{ops::Range, time::Duration};

use noisefall_base::{declare::Words, quote::either};
use noisefall_kernel::measure::Floor;
use noisefall_render::render::{Display, ToneMap, WhiteBalance, image_file::Format};

use super::{headings, replay::Which};

/// Display transform of a PNG.
#[derive(clap::Args)]
pub struct DisplayOptions {
    /// Exposure of a PNG in stops; each stop doubles the brightness [default: that of the scene]
    #[arg(help_heading = headings::IMAGE, long, value_name = "STOPS", value_parser = exposure, allow_negative_numbers = true)]
    exposure: Option<f32>,
    /// White balance of a PNG: the colour temperature of the light that appears white, in kelvin, and optionally its tint, positive
    /// for green light, such as 2700 or 4000,10 [default: 6504, no change]
    #[arg(help_heading = headings::IMAGE, long, value_name = "KELVIN[,TINT]", value_parser = white_balance, allow_negative_numbers = true)]
    white_balance: Option<WhiteBalance>,
    #[arg(help_heading = headings::IMAGE, long, value_name = "MAP", help = format!("Tone map of a PNG: {}", one_of::<ToneMap>()), value_parser = tone,
          default_value = ToneMap::default().name())]
    tone: ToneMap,
}

impl DisplayOptions {
    /// Says that these options have no effect on an output of this format, or on a file of samples; `None` if they have, or are not given.
    pub fn unused(&self, format: Option<Format>) -> Option<&'static str> {
        let said = match format {
            Some(Format::Png) => return None,
            Some(Format::Exr) => {
                "warning: an EXR stores the radiance unchanged; --exposure, --white-balance and --tone affect a PNG only"
            }
            None => "warning: a file of samples has no display; --exposure, --white-balance and --tone affect a PNG only",
        };
        self.is_given().then_some(said)
    }

    fn is_given(&self) -> bool {
        self.exposure.is_some() || self.white_balance.is_some() || self.tone != ToneMap::default()
    }

    /// The display of a scene that has this exposure.
    pub fn display(&self, of_scene: f32) -> Display {
        Display {
            exposure: self.exposure.unwrap_or(of_scene),
            white_balance: self.white_balance.unwrap_or_default(),
            tone_map: self.tone,
        }
    }
}

/// The value of a word.
pub fn word<T: Words>(text: &str) -> Result<T, String> {
    let found = T::words().iter().find(|(word, _)| word.name == text);
    found.map(|(_, value)| *value).ok_or_else(|| format!("expected {}", one_of::<T>()))
}

/// All words of a type, as a help text offers them: `a, b or c`.
pub fn one_of<T: Words>() -> String {
    either(&names::<T>())
}

fn names<T: Words>() -> Vec<String> {
    T::words().iter().map(|(word, _)| word.name.to_owned()).collect()
}

pub fn resolution(text: &str) -> Result<[u32; 2], String> {
    pair(text, &['x', 'X', '×']).ok_or_else(|| "expected WIDTHxHEIGHT, such as 640x480".to_owned())
}

pub fn pixel(text: &str) -> Result<[u32; 2], String> {
    pair(text, &[',']).ok_or_else(|| "expected X,Y, such as 12,34".to_owned())
}

fn pair(text: &str, separators: &[char]) -> Option<[u32; 2]> {
    let (a, b) = text.split_once(separators)?;
    Some([a.trim().parse().ok()?, b.trim().parse().ok()?])
}

/// Parses a number, a range `A-B`, or `lit`.
pub fn which(text: &str) -> Result<Which, String> {
    let expected = || "expected a number, a range such as 0-9999, or `lit`".to_owned();
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| expected());
    match text.split_once('-') {
        _ if text == "lit" => Ok(Which::Lit),
        None => Ok(Which::One(number(text)?)),
        Some((first, last)) => match (number(first)?, number(last)?) {
            (first, last) if first <= last => Ok(Which::Range(first, last)),
            _ => Err(expected()),
        },
    }
}

#[cfg(any(feature = "reports", test))]
pub fn whole(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("expected a whole number from 0 to {}", u32::MAX))
}

pub fn samples(text: &str) -> Result<u32, String> {
    let samples = text.parse().ok().filter(|samples| *samples > 0);
    samples.ok_or_else(|| "expected a whole number, 1 or more".to_owned())
}

/// Parses a range of sample indices `A..B`, without B.
pub fn sample_range(text: &str) -> Result<Range<u32>, String> {
    range(text).ok_or_else(|| {
        "expected A..B with A below B, such as 0..64: the samples from A to B - 1. '--spp' is the number of samples per pixel"
            .to_owned()
    })
}

/// Parses a range of frames `A..B`, without B; the first frame is 1.
pub fn frame_range(text: &str) -> Result<Range<u32>, String> {
    let frames = range(text).filter(|frames| frames.start > 0);
    frames
        .ok_or_else(|| "expected A..B with A below B, such as 1..11: the frames from A to B - 1; the first frame is 1".to_owned())
}

fn range(text: &str) -> Option<Range<u32>> {
    let (start, end) = text.split_once("..")?;
    let range = start.trim().parse().ok()?..end.trim().parse().ok()?;
    (!range.is_empty()).then_some(range)
}

/// Parses the number of frames of a turntable.
pub fn frames(text: &str) -> Result<u32, String> {
    const MOST: u32 = 100_000;
    let frames = text.parse().ok().filter(|frames| (1..=MOST).contains(frames));
    frames.ok_or_else(|| format!("expected a whole number from 1 to {MOST}"))
}

pub fn threads(text: &str) -> Result<u16, String> {
    let threads = text.parse().ok().filter(|threads| *threads <= 1024);
    threads.ok_or_else(|| "expected a whole number from 0 to 1024".to_owned())
}

pub fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|s: &f64| *s > 0.0);
    seconds.and_then(|s| Duration::try_from_secs_f64(s).ok()).ok_or_else(|| "expected a number of seconds above 0".to_owned())
}

/// Parses the constant that relMSE adds to the squared reference.
pub fn floor(text: &str) -> Result<Floor, String> {
    let floor = text.parse::<f64>().ok().filter(|floor| floor.is_finite() && *floor > 0.0);
    floor.map(Floor::Absolute).ok_or_else(|| "expected a number above 0, such as 0.01".to_owned())
}

pub fn noise(text: &str) -> Result<f64, String> {
    let noise = text.parse().ok().filter(|noise| *noise > 0.0 && *noise < f64::INFINITY);
    noise.ok_or_else(|| "expected a number above 0, such as 0.01 for 1 %".to_owned())
}

/// Parses a number of bytes with an optional suffix such as `K`, `M` or `G`.
pub fn memory(text: &str) -> Result<u64, String> {
    const UNITS: [(char, f64); 4] = [('K', 1e3), ('M', 1e6), ('G', 1e9), ('T', 1e12)];
    let upper = text.trim().to_ascii_uppercase();
    let short = upper.strip_suffix('B').unwrap_or(&upper);
    let (number, factor) =
        UNITS.iter().find_map(|(letter, factor)| Some((short.strip_suffix(*letter)?, *factor))).unwrap_or((short, 1.0));
    let bytes = number.trim_end().parse().ok().map(|number: f64| number * factor).filter(|bytes| (1.0..=1e18).contains(bytes));
    bytes.map(|bytes| bytes as u64).ok_or_else(|| "expected a size, such as 4G or 500M".to_owned())
}

/// Parses an exposure in stops.
pub fn exposure(text: &str) -> Result<f32, String> {
    let stops = text.parse().ok().filter(|stops: &f32| stops.abs() <= 100.0);
    stops.ok_or_else(|| "expected stops, from -100 to 100, such as -1.5".to_owned())
}

/// Parses a colour temperature in kelvin with an optional tint.
pub fn white_balance(text: &str) -> Result<WhiteBalance, String> {
    let (kelvin, tint) = text.split_once(',').unwrap_or((text, "0"));
    let number = |text: &str, [low, high]: [f32; 2]| text.trim().parse().ok().filter(|x: &f32| (low..=high).contains(x));
    let balance = number(kelvin, WhiteBalance::KELVIN).zip(number(tint, WhiteBalance::TINT));
    balance.map(|(kelvin, tint)| WhiteBalance { kelvin, tint }).ok_or_else(|| {
        "expected a temperature from 2000 to 25000 kelvin, and optionally a tint from -150 to 150, such as 4000,10".to_owned()
    })
}

pub fn tone(text: &str) -> Result<ToneMap, String> {
    word(&text.replace("color", "colour"))
}

pub fn format(text: &str) -> Result<Format, String> {
    Format::named(text).ok_or_else(|| "expected png or exr".to_owned())
}

#[cfg(test)]
mod tests {
    use noisefall_scene::{
        sampling::{Directions, Sampler},
        scene::{Estimator, Reuse},
    };

    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        assert!(
            seconds("-1").is_err()
                && seconds("inf").is_err()
                && floor("0").is_err()
                && floor("inf").is_err()
                && noise("0").is_err()
                && noise("nan").is_err()
        );
        assert!(whole("-1").is_err() && samples("0").is_err() && samples("1e3").is_err() && threads("1025").is_err());
        assert!(resolution("640").is_err() && resolution("-1x2").is_err() && pixel("1;2").is_err());
        assert!(
            word::<Estimator>("bdpt").is_err() && word::<Directions>("sphere").is_err() && word::<Sampler>("halton").is_err()
        );
    }

    #[test]
    fn values_at_the_ends_of_their_ranges_are_taken_and_those_beyond_are_not() {
        assert_eq!((threads("0"), threads("1024")), (Ok(0), Ok(1024)));
        assert_eq!((samples("1"), samples("4294967295")), (Ok(1), Ok(u32::MAX)));
        assert_eq!((whole("0"), whole("4294967295")), (Ok(0), Ok(u32::MAX)));
        assert!(samples("4294967296").is_err() && whole("4294967296").is_err());
        assert!(seconds("0").is_err() && seconds("nan").is_err() && seconds("1e300").is_err());
        assert!(noise("inf").is_err() && noise("-0.1").is_err());
        assert!(exposure("nan").is_err() && exposure("101").is_err() && tone("filmic").is_err());
        assert!(word::<Reuse>("yes").is_err() && format("jpg").is_err() && format(".png").is_err());
    }

    #[test]
    fn a_white_balance_is_a_temperature_with_or_without_a_tint() {
        let balance = |kelvin, tint| Ok(WhiteBalance { kelvin, tint });
        assert_eq!(
            ["2700", "4000, -10", "25000,150"].map(white_balance),
            [balance(2700.0, 0.0), balance(4000.0, -10.0), balance(25_000.0, 150.0)]
        );
        assert_eq!(white_balance("6504"), Ok(WhiteBalance::default()));
        assert!(["", "1999", "25001", "nan", "4000,", "4000,151", "4000,1,2", "warm"].iter().all(|x| white_balance(x).is_err()));
    }

    #[test]
    fn samples_are_numbers_ranges_or_the_first_lit() {
        assert_eq!(
            ["7", "0-9999", " 3 - 3", "lit"].map(which),
            [Which::One(7), Which::Range(0, 9999), Which::Range(3, 3), Which::Lit].map(Ok)
        );
        assert!(["", "-", "-1", "9-3", "1-", "first", "1-2-3", "4294967296"].iter().all(|text| which(text).is_err()));
    }

    #[test]
    fn ranges_have_a_start_below_their_end() {
        assert_eq!(["0..64", " 3 .. 4"].map(sample_range), [Ok(0..64), Ok(3..4)]);
        assert!(
            ["", "..", "4..4", "5..4", "-1..4", "0..", "..4", "1-2", "0..4294967296"].iter().all(|x| sample_range(x).is_err())
        );
        assert!(frame_range("0..3").is_err() && frame_range("1..3") == Ok(1..3));
    }

    #[test]
    fn every_name_is_its_own_value() {
        assert_eq!(["path", "light", "mis"].map(word::<Estimator>), [Estimator::Path, Estimator::Light, Estimator::Mis].map(Ok));
        let kinds = [Directions::Uniform, Directions::Cosine, Directions::Bsdf];
        assert_eq!(["uniform", "cosine", "bsdf"].map(word::<Directions>), kinds.map(Ok));
        assert_eq!(["auto", "suffixes", "off"].map(word::<Reuse>), [Reuse::Auto, Reuse::Suffixes, Reuse::Off].map(Ok));
        assert_eq!(["png", "EXR"].map(format), [Format::Png, Format::Exr].map(Ok));
        let samplers = [Sampler::Independent, Sampler::Stratified, Sampler::Sobol, Sampler::BlueNoise];
        assert_eq!(["independent", "stratified", "sobol", "bluenoise"].map(word::<Sampler>), samplers.map(Ok));
        let maps =
            [ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::Neutral, ToneMap::FalseColour].map(Ok);
        assert_eq!(["none", "reinhard", "aces", "agx", "neutral", "false-colour"].map(tone), maps);
        assert_eq!(["-1.5", "2"].map(exposure), [Ok(-1.5), Ok(2.0)]);
    }

    #[test]
    fn values_in_range_are_parsed() {
        assert_eq!(["640x480", "640X480", " 640 × 480 "].map(resolution), [Ok([640, 480]), Ok([640, 480]), Ok([640, 480])]);
        assert_eq!(pixel("12, 34"), Ok([12, 34]));
        assert_eq!((seconds("1.5"), noise("0.01")), (Ok(Duration::from_millis(1500)), Ok(0.01)));
        assert_eq!(floor("0.02"), Ok(Floor::Absolute(0.02)));
        assert_eq!(word::<Sampler>("stratified"), Ok(Sampler::Stratified));
        let sizes = ["4G", "500M", "1.5gb", "64 kB", "1000000", " 2T "].map(memory);
        assert_eq!(sizes, [4_000_000_000, 500_000_000, 1_500_000_000, 64_000, 1_000_000, 2_000_000_000_000].map(Ok));
        assert!(["", "0", "-1G", "nan", "inf", "G", "4X", "1e30", "4 G B"].iter().all(|text| memory(text).is_err()));
    }
}
