//! All lamps of a scene, as the renderer looks them up.
use fearless_simd_macros::simd;

use super::{Beam, Lamp, slide::Slide};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// The lamps of a scene.
#[derive(Default)]
pub struct Lamps {
    /// Five rows for each lamp: see [`LampRow`](super::row::LampRow).
    rows: Vec<[f32; 4]>,
    /// Number of lamps.
    count: usize,
    /// The images that lamps cast.
    images: Vec<Slide>,
    powers: Vec<f32>,
}

/// The light of a lamp at a point.
pub struct LampSample<L: Lanes> {
    /// Unit direction towards the lamp.
    pub wi: V<L>,
    /// Unoccluded irradiance of a surface that faces the lamp, W/m².
    pub irradiance: V<L>,
}

/// Light that leaves a lamp.
pub struct LampRay<L: Lanes> {
    /// The position; of directional lamps the unit direction towards them.
    pub origin: V<L>,
    /// Lanes of directional lamps.
    pub far: M<L>,
    /// Unit direction of the light.
    pub d: V<L>,
    /// Radiant intensity, W/sr; of directional lamps the irradiance, W/m².
    pub light: V<L>,
    /// Pdf of the direction per solid angle; 1 for directional lamps.
    pub pdf: F<L>,
}

impl Lamps {
    /// Makes the table.
    pub fn new(lamps: &[Lamp]) -> Lamps {
        let mut images: Vec<Slide> = Vec::new();
        let mut number = |lamp: &Lamp| {
            let Some(image) = lamp.image() else { return 0 };
            let known = images.iter().position(|known| known.is_same(image));
            let place = known.unwrap_or_else(|| {
                images.push(image.clone());
                images.len() - 1
            });
            place as u32 + 1
        };
        let rows = lamps.iter().flat_map(|lamp| lamp.rows(number(lamp))).collect();
        Lamps { rows, count: lamps.len(), images, powers: lamps.iter().map(Lamp::light).collect() }
    }

    /// The luminance of the power of a lamp; of a picture, of its mean.
    pub fn power(&self, lamp: usize) -> f32 {
        self.powers[lamp]
    }

    /// Number of lamps.
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
    pub fn are_same(&self, other: &Lamps) -> bool {
        let bits = |lamps: &Lamps| lamps.rows.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        bits(self) == bits(other)
            && self.images.len() == other.images.len()
            && self.images.iter().zip(&other.images).all(|(a, b)| a.is_same(b))
    }

    /// The light of lamps at the points `p`.
    #[simd]
    pub fn sample<L: Lanes>(&self, l: L, lamp: U<L>, p: V<L>) -> LampSample<L> {
        let beam = Beam::read(l, &self.rows, lamp);
        let way = beam.way_from(l, p);
        LampSample { wi: way.wi, irradiance: self.light(l, &beam, -way.wi, way.spread) }
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

    /// Samples light that leaves lamps.
    #[simd]
    pub fn emit<L: Lanes>(&self, l: L, lamp: U<L>, u: (F<L>, F<L>)) -> LampRay<L> {
        let beam = Beam::read(l, &self.rows, lamp);
        let (origin, far) = beam.origin();
        let d = far.pick(-origin, beam.sample_direction(l, u));
        LampRay { origin, far, d, light: self.light(l, &beam, d, l.f(1.0)), pdf: far.pick(l.f(1.0), beam.direction_pdf(l)) }
    }

    /// The pdf of the directions of [`Lamps::emit`] per solid angle, and the lanes of directional lamps, where it is 1.
    #[simd]
    pub fn direction_pdf<L: Lanes>(&self, l: L, lamp: U<L>) -> (F<L>, M<L>) {
        let beam = Beam::read(l, &self.rows, lamp);
        let (_, far) = beam.origin();
        (far.pick(l.f(1.0), beam.direction_pdf(l)), far)
    }

    /// The distance of lamps from the points `p`, metres; infinite for directional lamps.
    #[simd]
    pub fn distance<L: Lanes>(&self, l: L, lamp: U<L>, p: V<L>) -> F<L> {
        Beam::read(l, &self.rows, lamp).way_from(l, p).distance
    }
}
