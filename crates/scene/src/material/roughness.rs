//! Roughness in scene descriptions: the width α of the GGX distribution, or its square root, which looks uniform to artists.
use noisefall_base::declare::{Meaning, OneOf, Parameter, Parameters, Range, Textured};

/// Roughness of a surface; smooth by default.
#[derive(Clone, Debug, PartialEq)]
pub enum Roughness {
    /// The square root of α.
    Roughness(Textured<f64>),
    /// The width α.
    Alpha(Textured<f64>),
}

const ROUGHNESS: Parameter = Parameter::new("roughness", "Square root of α; 0 is smooth.")
    .symbol("√α")
    .aliases("rough glossiness")
    .means(Meaning::Roughness);
const ALPHA: Parameter = Parameter::new("alpha", "Width of the distribution of microfacet slopes; 0 is smooth.")
    .symbol("α")
    .aliases("a")
    .means(Meaning::SlopeWidth);

impl Roughness {
    /// A smooth surface.
    pub const SMOOTH: Roughness = Roughness::Roughness(Textured::Constant(0.0));

    /// A constant α.
    pub fn alpha(alpha: f32) -> Roughness {
        // Rounds to the shortest decimal, so the description in double precision shows no digits of single precision.
        Roughness::Alpha(Textured::Constant(alpha.to_string().parse().unwrap_or(f64::from(alpha))))
    }

    /// The parameter that is given, its value, and whether the value is the root of α.
    pub(super) fn parts(&self) -> (&'static Parameter, &Textured<f64>, bool) {
        match self {
            Roughness::Roughness(value) => (&ROUGHNESS, value, true),
            Roughness::Alpha(value) => (&ALPHA, value, false),
        }
    }
}

impl Default for Roughness {
    fn default() -> Self {
        Roughness::SMOOTH
    }
}

impl OneOf for Roughness {
    const WHAT: &'static str = "roughness";

    fn alternatives() -> Vec<Self> {
        vec![Roughness::SMOOTH, Roughness::alpha(0.0)]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, Roughness::Alpha(_)))
    }

    fn name(&self) -> &'static str {
        self.parts().0.key
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            Roughness::Roughness(value) => p.textured_number(&ROUGHNESS, value, Range::ROUGHNESS),
            Roughness::Alpha(value) => p.textured_number(&ALPHA, value, Range::ROUGHNESS),
        }
    }
}
