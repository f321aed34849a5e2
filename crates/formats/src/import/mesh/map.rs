//! Texture statements: `map_Kd -s 2 2 1 -clamp on wood planks.png`.
use noisefall_scene::texture::image::Channel;

/// Magnitude of the largest number of an option.
const LARGEST: f64 = 1e6;

/// A texture of a material, as its statement gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The file name.
    pub path: String,
    /// Factors of u and v: `-s`.
    pub scale: [f64; 2],
    /// Added to u and v: `-o`.
    pub offset: [f64; 2],
    /// Whether the texture is not repeated: `-clamp`.
    pub clamps: bool,
    /// Added to the values, and their factor: `-mm`.
    pub range: [f64; 2],
    /// Factor of heights: `-bm`.
    pub bump: f64,
    /// The channel: `-imfchan`. The depth buffer, `z`, is none.
    pub channel: Option<Channel>,
    /// Options without a counterpart.
    pub unknown: Vec<String>,
}

impl Map {
    /// Reads what stands after the keyword; `None` without a file name.
    pub fn read(text: &str) -> Option<Map> {
        let mut map = Map {
            path: String::new(),
            scale: [1.0; 2],
            offset: [0.0; 2],
            clamps: false,
            range: [0.0, 1.0],
            bump: 1.0,
            channel: None,
            unknown: Vec::new(),
        };
        let mut rest = Rest(text.trim());
        while let Some(option) = rest.option() {
            map.set(option, &mut rest);
        }
        map.path = rest.0.trim().trim_matches('"').to_owned();
        (!map.path.is_empty()).then_some(map)
    }

    /// The file name as it stands there, and without what may be a comment, the longest first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        const MOST: usize = 8;
        let before = self.path.rmatch_indices('#').map(|(at, _)| self.path[..at].trim().trim_matches('"'));
        [self.path.as_str()].into_iter().chain(before.filter(|name| !name.is_empty()).take(MOST))
    }

    fn set(&mut self, option: &str, rest: &mut Rest) {
        match option.to_ascii_lowercase().as_str() {
            "-s" => self.scale = pair(&rest.numbers::<3>(), 1.0),
            "-o" => self.offset = pair(&rest.numbers::<3>(), 0.0),
            "-mm" => {
                if let [base, gain] = rest.numbers::<2>()[..] {
                    self.range = [base, gain];
                }
            }
            "-bm" => self.bump = rest.numbers::<1>().first().copied().unwrap_or(1.0),
            "-clamp" => self.clamps = rest.word().eq_ignore_ascii_case("on"),
            "-imfchan" => {
                self.channel = match rest.word().to_ascii_lowercase().as_str() {
                    "r" => Some(Channel::Red),
                    "g" => Some(Channel::Green),
                    "b" => Some(Channel::Blue),
                    "m" => Some(Channel::Alpha),
                    _ => None,
                }
            }
            // Both smooth the image where it is far away, as many samples do.
            "-blendu" | "-blendv" => drop(rest.word()),
            "-texres" | "-boost" => drop(rest.numbers::<1>()),
            "-t" => {
                if rest.numbers::<3>().iter().any(|x| *x != 0.0) {
                    self.unknown.push("-t".to_owned());
                }
            }
            "-cc" | "-type" => {
                rest.word();
                self.unknown.push(option.to_owned());
            }
            _ => self.unknown.push(option.to_owned()),
        }
        self.unknown.truncate(8);
    }
}

/// The numbers of u and v. One number alone is that of u.
fn pair(numbers: &[f64], default: f64) -> [f64; 2] {
    [0, 1].map(|axis| numbers.get(axis).copied().unwrap_or(default))
}

/// The rest of a line. File names stand at its end and may have spaces.
struct Rest<'a>(&'a str);

impl<'a> Rest<'a> {
    /// The next word, which is `-` and letters.
    fn option(&mut self) -> Option<&'a str> {
        let (word, _) = split(self.0);
        let is_option =
            word.strip_prefix('-').is_some_and(|name| !name.is_empty() && name.bytes().all(|c| c.is_ascii_alphabetic()));
        is_option.then(|| self.word())
    }

    fn word(&mut self) -> &'a str {
        let (word, rest) = split(self.0);
        self.0 = rest;
        word
    }

    /// At most N numbers: those that are there, if more text follows.
    fn numbers<const N: usize>(&mut self) -> Vec<f64> {
        let mut numbers = Vec::new();
        while numbers.len() < N {
            let (word, rest) = split(self.0);
            let Some(number) = word.parse::<f64>().ok().filter(|x| x.is_finite() && !rest.is_empty()) else { break };
            self.0 = rest;
            numbers.push(number.clamp(-LARGEST, LARGEST));
        }
        numbers
    }
}

/// The first word and what follows.
fn split(text: &str) -> (&str, &str) {
    let end = text.find(|c: char| c.is_ascii_whitespace()).unwrap_or(text.len());
    (&text[..end], text[end..].trim_ascii_start())
}
