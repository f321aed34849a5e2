//! A thin pane of glass: both of its interfaces at once, without refraction.
//!
//! An interface reflects R(θ), and a crossing transmits τ = t^(1/cos θ_t), where t is the transmittance at normal incidence and
//! θ_t the angle inside the pane (Snell, Bouguer). The reflections between the faces sum to
//!
//! reflected = R + (1 − R)² R τ²/(1 − R² τ²),  transmitted = (1 − R)² τ/(1 − R² τ²)
//!
//! (G. G. Stokes, "On the intensity of the light reflected from or transmitted through a pile of plates", 1862). What passes leaves
//! in the direction in which it came, so that radiance is not scaled. This is the limit of a slab of [`super::Dielectric`] whose
//! thickness goes to 0 while t stays.
use super::{
    Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Shade, Stage,
    dielectric::{SPECULAR_REFLECTANCE, SPECULAR_TRANSMITTANCE},
    fresnel, ior,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range},
    math::{F, Lanes, One, Pick, U, V, exp::exp2_of_negative},
};

/// A thin pane of glass in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct ThinDielectric {
    /// Refractive index of the pane relative to the outside.
    pub ior: f64,
    /// Transmittance of a crossing at normal incidence, without reflections at the faces.
    pub transmittance: [f64; 3],
    /// Factor of the light that the pane reflects.
    pub specular_reflectance: [f64; 3],
    /// Factor of the light that passes the pane.
    pub specular_transmittance: [f64; 3],
}

impl Default for ThinDielectric {
    fn default() -> Self {
        ThinDielectric { ior: 1.5, transmittance: [1.0; 3], specular_reflectance: [1.0; 3], specular_transmittance: [1.0; 3] }
    }
}

impl Kind for ThinDielectric {
    const KIND: Parameter = Parameter::new("thin_dielectric", "A thin pane of glass: reflects and transmits without refraction.")
        .aliases("pane thin_glass thindielectric window")
        .advice("such as thin_dielectric = { ior = 1.5 }");
}

impl Declare for ThinDielectric {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const IOR: Parameter = ior("Index of refraction of the pane relative to its surroundings.");
        const TRANSMITTANCE: Parameter =
            Parameter::new("transmittance", "Fraction of the light that the inside of the pane transmits at normal incidence.")
                .symbol("t")
                .aliases("tint absorption color colour");
        p.number(&IOR, &mut self.ior, Range::INDEX);
        let range = Range::UNIT.expected("every channel must lie in [0, 1]: the fraction that one crossing transmits");
        p.colour(&TRANSMITTANCE, &mut self.transmittance, range);
        p.colour(&SPECULAR_REFLECTANCE, &mut self.specular_reflectance, Range::UNIT);
        p.colour(&SPECULAR_TRANSMITTANCE, &mut self.specular_transmittance, Range::UNIT);
    }
}

impl Compile for ThinDielectric {
    fn compile(&self, _: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let octaves = self.transmittance.map(|t| (-t.log2()).min(1e30) as f32);
        let tints = [self.specular_reflectance, self.specular_transmittance].map(|tint| tint.map(|x| x as f32));
        let rows = PaneRow { eta: self.ior as f32, octaves, tints }.pack();
        Ok(CompiledMaterial { rows, ..CompiledMaterial::colourless(Stage::ThinDielectric) })
    }
}

/// The constants of a pane.
struct PaneRow {
    eta: f32,
    /// −log₂ t.
    octaves: [f32; 3],
    /// Factors of reflected and of transmitted light.
    tints: [[f32; 3]; 2],
}

impl PaneRow {
    fn pack(&self) -> [[f32; 4]; 3] {
        let [r, g, b] = self.octaves;
        let [[rr, rg, rb], [tr, tg, tb]] = self.tints;
        [[r, g, b, self.eta], [rr, rg, rb, 0.0], [tr, tg, tb, 0.0]]
    }

    /// Factors of reflected and of transmitted light.
    #[inline(always)]
    fn read_tints<L: Lanes>(l: L, materials: &Materials, material: U<L>) -> (V<L>, V<L>) {
        let [rr, rg, rb, _] = materials.row(l, material, 1);
        let [tr, tg, tb, _] = materials.row(l, material, 2);
        (V { x: rr, y: rg, z: rb }, V { x: tr, y: tg, z: tb })
    }

    /// η and −log₂ t.
    #[inline(always)]
    fn read<L: Lanes>(l: L, materials: &Materials, material: U<L>) -> (F<L>, V<L>) {
        let [x, y, z, eta] = materials.row(l, material, 0);
        (eta, V { x, y, z })
    }
}

impl Shade for ThinDielectric {
    type Bsdf<'a, L: Lanes> = ThinDielectricBsdf<L>;
    const STAGE: Stage = Stage::ThinDielectric;
    const SEES_LIGHTS: bool = false;
    const TRANSMITS: bool = true;
    const ENTERS: bool = false;

    #[inline(always)]
    fn at<L: Lanes>(l: L, materials: &Materials, _: Directions, at: &Local<L>) -> ThinDielectricBsdf<L> {
        let (eta, octaves) = PaneRow::read(l, materials, at.material);
        ThinDielectricBsdf { eta, octaves, tints: PaneRow::read_tints(l, materials, at.material) }
    }
}

/// The BSDF of a pane at a point.
#[derive(Clone, Copy)]
pub struct ThinDielectricBsdf<L: Lanes> {
    eta: F<L>,
    octaves: V<L>,
    /// Factors of reflected and of transmitted light.
    tints: (V<L>, V<L>),
}

impl<L: Lanes> ThinDielectricBsdf<L> {
    /// Reflectance and transmittance at cos θ > 0.
    #[inline(always)]
    fn shares(&self, cos: F<L>) -> (V<L>, V<L>) {
        let (r, cos_t) = fresnel::dielectric(cos, self.eta);
        let through = 1.0 - r;
        // Beyond the critical angle nothing enters.
        let way = 1.0 / cos_t.max(cos.splat(1e-6));
        let channel = |octaves: F<L>| {
            let crossing = exp2_of_negative(-(octaves * way));
            let echo = through / (1.0 - (r * crossing) * (r * crossing)).max(cos.splat(f32::MIN_POSITIVE));
            let passed = through * crossing * echo;
            (r + r * crossing * passed, passed)
        };
        let [x, y, z] = [channel(self.octaves.x), channel(self.octaves.y), channel(self.octaves.z)];
        (self.tints.0 * V { x: x.0, y: y.0, z: z.0 }, self.tints.1 * V { x: x.1, y: y.1, z: z.1 })
    }

    /// The probability of choosing reflection: its fraction of the light in the channel with the most reflected or transmitted
    /// light.
    #[inline(always)]
    fn chance((reflected, passed): (V<L>, V<L>)) -> F<L> {
        let (reflected, passed) = (reflected.max_component(), passed.max_component());
        reflected / (reflected + passed).max(reflected.splat(f32::MIN_POSITIVE))
    }
}

impl<L: Lanes> Bsdf<L> for ThinDielectricBsdf<L> {
    #[inline(always)]
    fn sample(&self, wo: V<L>, _: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let (reflected, passed) = self.shares(wo.z);
        let chance = Self::chance((reflected, passed));
        let reflects = lobe.lt(chance);
        let wi = V { x: -wo.x, y: -wo.y, z: reflects.pick(wo.z, -wo.z) };
        let weight = reflects.pick(reflected * (1.0 / chance), passed * (1.0 / (1.0 - chance)));
        let zero = wo.z.splat(0.0);
        BsdfSample { wi, weight, pdf: zero, delta: zero.ge(zero) }
    }
}

impl Lobes for ThinDielectricBsdf<One> {
    fn chosen(&self, wo: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        let chance = Self::chance(self.shares(wo.z));
        ChosenLobe::of_two(["reflection off both faces", "passage"], chance.0, lobe)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::M;

    fn pane(ior: f64, transmittance: f64) -> Materials {
        Materials::new(&[ThinDielectric { ior, transmittance: [transmittance, 1.0, 0.0], ..ThinDielectric::default() }.into()])
    }

    fn shares(materials: &Materials, cos: f64) -> ([f32; 3], [f32; 3]) {
        let at = Local { material: U(0), colour: V::splat(One, [1.0; 3]), alpha: F(0.0), front: M(true) };
        let (reflected, passed) = ThinDielectric::at(One, materials, Directions::Bsdf, &at).shares(F(cos as f32));
        (reflected.lane(0), passed.lane(0))
    }

    #[test]
    fn a_clear_pane_keeps_all_light_and_a_black_one_reflects_once() {
        for ior in [0.7, 1.0, 1.3, 1.5, 2.4] {
            let materials = pane(ior, 0.5);
            for cos in [1e-3, 0.1, 0.3, 0.7, 1.0] {
                let (reflected, passed) = shares(&materials, cos);
                assert!((reflected[1] + passed[1] - 1.0).abs() < 1e-6, "{ior} {cos}: {reflected:?} {passed:?}");
                let once = fresnel::dielectric(F::<One>(cos as f32), F(ior as f32)).0.0;
                assert!((reflected[2] - once).abs() < 1e-6 && passed[2] < 1e-6, "{ior} {cos}");
            }
        }
    }

    #[test]
    fn tints_are_factors_of_reflection_and_transmission() {
        let clear = ThinDielectric::default();
        let tinted =
            ThinDielectric { specular_reflectance: [0.5, 0.2, 0.0], specular_transmittance: [0.3, 0.8, 1.0], ..clear.clone() };
        let [clear, tinted] = [clear, tinted].map(|pane| shares(&Materials::new(&[pane.into()]), 0.4));
        let scaled = |light: [f32; 3], by: [f32; 3]| [0, 1, 2].map(|c| light[c] * by[c]);
        assert_eq!(tinted, (scaled(clear.0, [0.5, 0.2, 0.0]), scaled(clear.1, [0.3, 0.8, 1.0])));
    }

    #[test]
    fn the_reflections_between_the_faces_are_those_of_a_thin_slab() {
        let (ior, t) = (1.5f64, 0.5f64);
        let materials = pane(ior, t);
        for cos in [0.05, 0.2, 0.6, 1.0] {
            // Sums the reflections inside a slab one by one, in f64.
            let inside = (1.0 - (1.0 - cos * cos) / (ior * ior)).sqrt();
            let [s, p] = [(cos - ior * inside) / (cos + ior * inside), (ior * cos - inside) / (ior * cos + inside)];
            let r = 0.5 * (s * s + p * p);
            let crossing = t.powf(1.0 / inside);
            let (mut reflected, mut passed, mut within) = (r, 0.0, (1.0 - r) * crossing);
            for face in 0..200 {
                *(if face % 2 == 0 { &mut passed } else { &mut reflected }) += within * (1.0 - r);
                within *= r * crossing;
            }
            let (found_reflected, found_passed) = shares(&materials, cos);
            let error = (f64::from(found_reflected[0]) - reflected).abs().max((f64::from(found_passed[0]) - passed).abs());
            assert!(error < 1e-6, "{cos}: {error:e}");
        }
    }

    #[test]
    fn samples_have_the_shares_of_their_lobes_on_average() {
        let materials = pane(1.5, 0.3);
        let at = Local { material: U(0), colour: V::splat(One, [1.0; 3]), alpha: F(0.0), front: M(false) };
        let bsdf = ThinDielectric::at(One, &materials, Directions::Bsdf, &at);
        let wo = V::<One> { x: F(0.8), y: F(0.0), z: F(0.6) };
        let (reflected, passed) = bsdf.shares(wo.z);
        let mut sums = [[0.0f64; 3]; 2];
        const COUNT: u32 = 1 << 16;
        for i in 0..COUNT {
            let lobe = F((i as f32 + 0.5) / COUNT as f32);
            let sample = bsdf.sample(wo, (F(0.5), F(0.5)), lobe);
            let side = usize::from(sample.wi.z.0 < 0.0);
            assert_eq!((sample.wi.x.0, sample.wi.z.0.abs()), (-0.8, 0.6));
            let lobe = bsdf.chosen(wo, (F(0.5), F(0.5)), lobe);
            assert_eq!(lobe.name == "passage", side == 1);
            sample
                .weight
                .lane(0)
                .iter()
                .zip(&mut sums[side])
                .for_each(|(weight, sum)| *sum += f64::from(*weight) / f64::from(COUNT));
        }
        for (found, share) in sums.iter().zip([reflected.lane(0), passed.lane(0)]) {
            for channel in 0..3 {
                assert!((found[channel] - f64::from(share[channel])).abs() < 1e-4, "{found:?} {share:?}");
            }
        }
    }
}
