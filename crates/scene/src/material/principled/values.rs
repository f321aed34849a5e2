//! The parameters of a principled material at surface points: constants, or lookups of its textures.
use fearless_simd_macros::simd;

use super::{
    super::lookup::{Lookup, colour, number},
    layout::{BASE, COATING, FIBRES, IDS_OF_COLORS, IDS_OF_WEIGHTS, INTERFERENCE, LAYERS, SPECULAR, TO_IDS, TRANSMISSION},
};
use noisefall_base::math::{F, Lanes, U, V};

/// The parameters that textures may vary, with the names of the description, besides base colour and specular roughness.
#[derive(Clone, Copy)]
pub struct Values<L: Lanes> {
    pub specular_color: V<L>,
    pub specular_weight: F<L>,
    pub transmission_color: V<L>,
    pub transmission_weight: F<L>,
    pub coat_color: V<L>,
    pub coat_weight: F<L>,
    pub fuzz_color: V<L>,
    pub fuzz_weight: F<L>,
    pub base_weight: F<L>,
    pub metalness: F<L>,
    pub diffuse_roughness: F<L>,
    pub anisotropy: F<L>,
    pub coat_roughness: F<L>,
    pub coat_anisotropy: F<L>,
    pub coat_darkening: F<L>,
    pub fuzz_roughness: F<L>,
    pub film_weight: F<L>,
    /// µm.
    pub film_thickness: F<L>,
}

/// The parameters of the materials whose further rows begin at `first` of `rows`; constants alone without a `lookup`.
///
/// This is a call, so that the lookups are compiled once per SIMD level, and not once more for each stage.
#[simd]
pub fn values<'a, L: Lanes>(l: L, rows: &[[f32; 4]], first: U<L>, lookup: Lookup<'a, L>) -> Values<L> {
    let reader = RowReader { l, rows, first, lookup };
    let none = [l.u(0); 4];
    let (colors, weights) = if lookup.is_some() { (reader.ids(IDS_OF_COLORS), reader.ids(IDS_OF_WEIGHTS)) } else { (none, none) };
    let (specular_color, specular_weight) = reader.layer(SPECULAR, &colors, &weights);
    let (transmission_color, transmission_weight) = reader.layer(TRANSMISSION, &colors, &weights);
    let (coat_color, coat_weight) = reader.layer(COATING, &colors, &weights);
    let (fuzz_color, fuzz_weight) = reader.layer(FIBRES, &colors, &weights);
    let [base_weight, metalness, diffuse_roughness, anisotropy] = reader.numbers(BASE);
    let [coat_roughness, coat_anisotropy, coat_darkening, fuzz_roughness] = reader.numbers(LAYERS);
    let [film_weight, film_thickness, ..] = reader.numbers(INTERFERENCE);
    Values {
        specular_color,
        specular_weight,
        transmission_color,
        transmission_weight,
        coat_color,
        coat_weight,
        fuzz_color,
        fuzz_weight,
        base_weight,
        metalness,
        diffuse_roughness,
        anisotropy,
        coat_roughness,
        coat_anisotropy,
        coat_darkening,
        fuzz_roughness,
        film_weight,
        film_thickness,
    }
}

/// Reads the further rows of materials.
struct RowReader<'a, L: Lanes> {
    l: L,
    rows: &'a [[f32; 4]],
    first: U<L>,
    lookup: Lookup<'a, L>,
}

impl<L: Lanes> RowReader<'_, L> {
    #[inline(always)]
    fn row(&self, row: u32) -> [F<L>; 4] {
        self.l.rows(self.rows, self.first + row)
    }

    #[inline(always)]
    fn ids(&self, row: u32) -> [U<L>; 4] {
        let [a, b, c, d] = self.row(row);
        [a.bits(), b.bits(), c.bits(), d.bits()]
    }

    /// The colour and the weight of a layer.
    #[inline(always)]
    fn layer(&self, row: u32, colors: &[U<L>; 4], weights: &[U<L>; 4]) -> (V<L>, F<L>) {
        let [x, y, z, w] = self.row(row);
        (
            colour(self.l, V { x, y, z }, colors[row as usize], &self.lookup),
            number(self.l, w, weights[row as usize], &self.lookup),
        )
    }

    #[inline(always)]
    fn numbers(&self, row: u32) -> [F<L>; 4] {
        let [a, b, c, d] = self.row(row);
        if self.lookup.is_none() {
            return [a, b, c, d];
        }
        let [ids_a, ids_b, ids_c, ids_d] = self.ids(row + TO_IDS);
        let RowReader { l, lookup, .. } = self;
        [number(*l, a, ids_a, lookup), number(*l, b, ids_b, lookup), number(*l, c, ids_c, lookup), number(*l, d, ids_d, lookup)]
    }
}
