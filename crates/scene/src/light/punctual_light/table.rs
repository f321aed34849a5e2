//! All lights of a scene, as the renderer looks them up.
use fearless_simd_macros::simd;

use super::{Beam, PunctualLight, slide::Slide};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// The lights of a scene.
#[derive(Default)]
pub struct PunctualLights {
    /// Five rows for each light: see [`PunctualRow`](super::row::PunctualRow).
    rows: Vec<[f32; 4]>,
    /// Number of lights.
    count: usize,
    /// The images that lights cast.
    images: Vec<Slide>,
    powers: Vec<f32>,
}

/// The light that arrives at a point.
pub struct PunctualSample<L: Lanes> {
    /// Unit direction towards the light.
    pub wi: V<L>,
    /// Unoccluded irradiance of a surface that faces the light, W/m².
    pub irradiance: V<L>,
}

/// Light that leaves a light.
pub struct PunctualRay<L: Lanes> {
    /// The position; of directional lights the unit direction towards them.
    pub origin: V<L>,
    /// Lanes of directional lights.
    pub far: M<L>,
    /// Unit direction of the light.
    pub d: V<L>,
    /// Radiant intensity, W/sr; of directional lights the irradiance, W/m².
    pub light: V<L>,
    /// Pdf of the direction per solid angle; 1 for directional lights.
    pub pdf: F<L>,
}

impl PunctualLights {
    /// Makes the table.
    pub fn new(punctual_lights: &[PunctualLight]) -> PunctualLights {
        let mut images: Vec<Slide> = Vec::new();
        let mut number = |punctual_light: &PunctualLight| {
            let Some(image) = punctual_light.image() else { return 0 };
            let known = images.iter().position(|known| known.is_same(image));
            let place = known.unwrap_or_else(|| {
                images.push(image.clone());
                images.len() - 1
            });
            place as u32 + 1
        };
        let rows = punctual_lights.iter().flat_map(|punctual_light| punctual_light.rows(number(punctual_light))).collect();
        PunctualLights {
            rows,
            count: punctual_lights.len(),
            images,
            powers: punctual_lights.iter().map(PunctualLight::light).collect(),
        }
    }

    /// The luminance of the power of a light; of an image, of its mean.
    pub fn power(&self, punctual_light: usize) -> f32 {
        self.powers[punctual_light]
    }

    /// Number of lights.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether both have the same bits.
    pub fn are_same(&self, other: &PunctualLights) -> bool {
        let bits =
            |punctual_lights: &PunctualLights| punctual_lights.rows.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        bits(self) == bits(other)
            && self.images.len() == other.images.len()
            && self.images.iter().zip(&other.images).all(|(a, b)| a.is_same(b))
    }

    /// The light that arrives at the points `p`.
    #[simd]
    pub fn sample<L: Lanes>(&self, l: L, punctual_light: U<L>, p: V<L>) -> PunctualSample<L> {
        let beam = Beam::read(l, &self.rows, punctual_light);
        let way = beam.way_from(l, p);
        PunctualSample { wi: way.wi, irradiance: self.light(l, &beam, -way.wi, way.spread) }
    }

    /// The power of beams in the unit direction `d` away from them, times `spread`.
    #[inline(always)]
    fn light<L: Lanes>(&self, l: L, beam: &Beam<L>, d: V<L>, spread: F<L>) -> V<L> {
        let mut light = beam.power() * (spread * beam.strength(l, d));
        for (number, image) in self.images.iter().enumerate() {
            let casts = beam.casts(number as u32 + 1);
            if casts.any() {
                let (u, v, _) = beam.picture_place(l, d);
                light = casts.pick(light * image.colour(l, u, v), light);
            }
        }
        light
    }

    /// Samples light that leaves lights.
    #[simd]
    pub fn emit<L: Lanes>(&self, l: L, punctual_light: U<L>, u: (F<L>, F<L>)) -> PunctualRay<L> {
        let beam = Beam::read(l, &self.rows, punctual_light);
        let (origin, far) = beam.origin();
        let d = far.pick(-origin, beam.sample_direction(l, u));
        PunctualRay { origin, far, d, light: self.light(l, &beam, d, l.f(1.0)), pdf: far.pick(l.f(1.0), beam.direction_pdf(l)) }
    }

    /// The pdf of the directions of [`PunctualLights::emit`] per solid angle, and the lanes of directional lights, where it is 1.
    #[simd]
    pub fn direction_pdf<L: Lanes>(&self, l: L, punctual_light: U<L>) -> (F<L>, M<L>) {
        let beam = Beam::read(l, &self.rows, punctual_light);
        let (_, far) = beam.origin();
        (far.pick(l.f(1.0), beam.direction_pdf(l)), far)
    }

    /// The distance of lights from the points `p`, metres; infinite for directional lights.
    #[simd]
    pub fn distance<L: Lanes>(&self, l: L, punctual_light: U<L>, p: V<L>) -> F<L> {
        Beam::read(l, &self.rows, punctual_light).way_from(l, p).distance
    }
}
