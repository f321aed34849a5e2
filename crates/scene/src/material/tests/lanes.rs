//! BSDFs have the same bits in any number of lanes.
use fearless_simd_macros::simd;

use super::{
    super::{
        Bsdf, Conductor, Distribution, Material, Materials, Plastic, RoughPlastic, Shade,
        albedo_table::{Tabulated, build},
        conductor::BeckmannConductor,
        dielectric::TintedDielectric,
        disney::{Disney, DisneyGlass},
        principled::{Principled, PrincipledGlass},
    },
    mixed::{local, mixed, mixed_disney, mixed_facets, mixed_principled},
};
use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, MAX_LANES, SimdLevel, V, in_lanes};

const POINTS: usize = 16 * MAX_LANES;

/// Numbers in (0, 1): column `k` of the points.
fn column(k: u32) -> Vec<f32> {
    (0..POINTS as u32).map(|i| ((i * 40_503 + 7919 * k * (i + 1)) % 65_521) as f32 / 65_521.0 + 1e-6).collect()
}

/// All results of a BSDF, for all points.
#[simd]
fn answers<L: Lanes, K: Shade>(l: L, materials: &Materials, columns: &[Vec<f32>], out: &mut Vec<u32>) {
    for start in (0..POINTS).step_by(L::N) {
        let read = Columns { l, columns, start };
        let cos = read.at(0);
        let sin = ((1.0 - cos) * (1.0 + cos)).max(l.f(0.0)).sqrt();
        let wo = V { x: sin, y: l.f(0.0), z: cos };
        let number = (l.iota() + start as u32) & 3;
        let at = local(number, V { x: read.at(1), y: read.at(2), z: read.at(3) }, read.at(4));
        let u = (read.at(5), read.at(6));
        let (values, pdf) = answer(&K::at(l, materials, Directions::Bsdf, &at), wo, u, read.at(7));
        for lane in 0..L::N {
            out.extend(values.map(|v| v.lane(lane).map(f32::to_bits)).as_flattened());
            out.push(pdf.to_array()[lane].to_bits());
        }
    }
}

struct Columns<'a, L: Lanes> {
    l: L,
    columns: &'a [Vec<f32>],
    start: usize,
}

impl<L: Lanes> Columns<'_, L> {
    #[inline(always)]
    fn at(&self, column: usize) -> F<L> {
        self.l.load(&self.columns[column][self.start..])
    }
}

#[inline(always)]
fn answer<L: Lanes>(bsdf: &impl Bsdf<L>, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> ([V<L>; 3], F<L>) {
    let sample = bsdf.sample(wo, u, lobe);
    let (f, pdf) = bsdf.eval(wo, sample.wi);
    ([sample.wi, sample.weight, f], pdf)
}

#[test]
fn any_number_of_lanes_gives_the_same_bits() {
    let [conductors, plastics] = mixed();
    let [opaque, clear] = mixed_principled();
    let [beckmann, rough, glass] = mixed_facets();
    let [opaque_disney, clear_disney] = mixed_disney();
    assert!(are_alike::<Conductor>(&conductors), "conductors");
    assert!(are_alike::<Plastic>(&plastics), "plastics");
    assert!(are_alike::<BeckmannConductor>(&beckmann), "Beckmann conductors");
    assert!(are_alike::<RoughPlastic>(&rough), "plastics of single scattering");
    assert!(are_alike::<TintedDielectric>(&glass), "tinted glass");
    assert!(are_alike::<Principled>(&opaque), "opaque principled materials");
    assert!(are_alike::<PrincipledGlass>(&clear), "clear principled materials");
    assert!(are_alike::<Disney>(&opaque_disney), "opaque materials of Disney's BSDF");
    assert!(are_alike::<DisneyGlass>(&clear_disney), "clear materials of Disney's BSDF");
}

/// Whether four materials of a kind have the same bits at every level.
fn are_alike<K: Shade>(list: &[Material]) -> bool {
    let columns: Vec<_> = (0..8).map(column).collect();
    let materials = Materials::new(list);
    let answers = SimdLevel::available().into_iter().map(|level| {
        let mut out = Vec::new();
        in_lanes!(level, l => answers::<_, K>(l, &materials, &columns, &mut out));
        out
    });
    let all: Vec<Vec<u32>> = answers.collect();
    all.windows(2).all(|pair| pair[0] == pair[1])
}

#[test]
fn tables_are_built_alike_at_every_level() {
    for of in [Tabulated::Coat(1.5), Tabulated::Refraction(1.5, Distribution::Beckmann)] {
        let all: Vec<_> = SimdLevel::available().into_iter().map(|level| build(level, of)).collect();
        assert!(all.windows(2).all(|pair| pair[0] == pair[1]), "{of:?}");
    }
}
