//! The constants of a material in [`Materials`]: rows of the kind with the numbers, and further rows with the textures of those that
//! have one.
use fearless_simd_macros::simd;

use super::super::{
    Materials,
    lookup::{Lookup, number},
};
use noisefall_base::math::{F, Lanes, U};

/// The parameters besides base colour and roughness, with the names of the description.
#[derive(Clone, Copy)]
pub struct DisneyRow<T> {
    pub ior: T,
    pub metallic: T,
    pub anisotropic: T,
    pub spec_tint: T,
    pub spec_trans: T,
    pub flatness: T,
    pub sheen: T,
    pub sheen_tint: T,
    pub clearcoat: T,
    pub clearcoat_gloss: T,
}

impl<T: Copy> DisneyRow<T> {
    /// Applies a function to all values.
    pub fn map<U>(&self, of: impl Fn(T) -> U) -> DisneyRow<U> {
        DisneyRow {
            ior: of(self.ior),
            metallic: of(self.metallic),
            anisotropic: of(self.anisotropic),
            spec_tint: of(self.spec_tint),
            spec_trans: of(self.spec_trans),
            flatness: of(self.flatness),
            sheen: of(self.sheen),
            sheen_tint: of(self.sheen_tint),
            clearcoat: of(self.clearcoat),
            clearcoat_gloss: of(self.clearcoat_gloss),
        }
    }

    /// The rows; the last number is for the place of the further rows.
    pub fn pack(&self, none: T) -> [[T; 4]; 3] {
        [
            [self.ior, self.metallic, self.anisotropic, self.spec_tint],
            [self.spec_trans, self.flatness, self.sheen, self.sheen_tint],
            [self.clearcoat, self.clearcoat_gloss, none, none],
        ]
    }
}

/// The parameters of materials at surface points; constants alone without a `lookup`.
///
/// This is a call, so that the lookups are compiled once per SIMD level, and not once more for each stage.
#[simd]
pub fn read<'a, L: Lanes>(l: L, materials: &Materials, material: U<L>, lookup: Lookup<'a, L>) -> DisneyRow<F<L>> {
    let mut rows = [materials.row(l, material, 0), materials.row(l, material, 1), materials.row(l, material, 2)];
    if lookup.is_some() {
        let first = rows[2][3].bits();
        for (offset, row) in rows.iter_mut().enumerate() {
            let ids = l.rows(&materials.further, first + offset as u32);
            for (value, id) in row.iter_mut().zip(ids) {
                *value = number(l, *value, id.bits(), &lookup);
            }
        }
    }
    let [[ior, metallic, anisotropic, spec_tint], [spec_trans, flatness, sheen, sheen_tint], [clearcoat, clearcoat_gloss, _, _]] =
        rows;
    DisneyRow { ior, metallic, anisotropic, spec_tint, spec_trans, flatness, sheen, sheen_tint, clearcoat, clearcoat_gloss }
}
