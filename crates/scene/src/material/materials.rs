//! The materials of a scene as tables for the kernel.
use std::{
    collections::{BTreeMap, BTreeSet},
    time::Duration,
};

use super::{CompiledMaterial, Material, MaterialCompiler, Stage, tables::Tables};
use crate::texture::TextureCompiler;
use noisefall_base::{
    declare::{Precision, Problem, Resources},
    math::{F, Lanes, M, U, V},
};

/// Local parameters of a BSDF, per lane.
pub struct Local<L: Lanes> {
    /// Number of the material in [`Materials`].
    pub material: U<L>,
    /// Albedo, or reflectance at normal incidence, at the point; white for types without.
    pub colour: V<L>,
    /// Width of the distribution of microfacet slopes; rough kinds take it for at least [`super::ggx::SMOOTH`].
    pub alpha: F<L>,
    /// Lanes whose viewer is on the side of the geometric normal.
    pub front: M<L>,
}

/// Constants of the materials, by number.
#[derive(Default)]
pub struct Materials {
    /// [`ROWS`] a material: see the row of its kind.
    pub(super) rows: Vec<[f32; 4]>,
    /// Further rows of the kinds that need more.
    pub(super) further: Vec<[f32; 4]>,
    pub(super) tables: Tables,
    stages: Vec<Stage>,
}

const ROWS: u32 = 3;

impl Materials {
    /// Materials that name no textures.
    ///
    /// # Panics
    /// Panics if a material refers to a texture.
    pub fn new(materials: &[Material]) -> Self {
        let (resources, none) = (Resources::new(""), BTreeMap::new());
        let textures = TextureCompiler::new(&resources, &none, BTreeSet::new(), std::iter::empty(), &mut Vec::new());
        let mut all = Materials::default();
        for material in materials {
            let compiled = all.compile(material, &textures).expect("the material names no texture");
            all.push(&compiled);
        }
        all
    }

    /// No materials yet; tables of the previous compile are reused.
    pub fn after(before: &Materials, precision: Precision) -> Self {
        Materials { tables: Tables::after(&before.tables, precision), ..Materials::default() }
    }

    /// Whether all tables are exact: see [`Precision`].
    pub fn are_exact(&self) -> bool {
        self.tables.are_exact()
    }

    /// The time that each shared table took to make; `None` for tables that were reused.
    pub fn times_of_tables(&self) -> &[Option<Duration>] {
        &self.tables.times
    }

    /// Compiles a material; tables that it shares with others are made once.
    pub fn compile(&mut self, material: &Material, textures: &TextureCompiler) -> Result<CompiledMaterial, Problem> {
        material.compile(&mut MaterialCompiler::new(textures, &mut self.tables))
    }

    /// Adds a material and returns its number.
    pub fn push(&mut self, material: &CompiledMaterial) -> u32 {
        let mut rows = material.rows;
        if !material.further.is_empty() {
            rows[ROWS as usize - 1][3] = f32::from_bits(self.further.len() as u32);
            self.further.extend(&material.further);
        }
        self.rows.extend(rows);
        self.stages.push(material.stage);
        self.stages.len() as u32 - 1
    }

    /// Gives the material `to` the constants and the stage of another one.
    pub fn copy(&mut self, from: u32, to: u32) {
        let [from, to] = [from, to].map(|number| number as usize);
        let first = ROWS as usize * from;
        self.rows.copy_within(first..first + ROWS as usize, ROWS as usize * to);
        self.stages[to] = self.stages[from];
    }

    /// The constants of a material.
    #[cfg(test)]
    pub fn constants(&self, material: usize) -> &[[f32; 4]] {
        &self.rows[ROWS as usize * material..][..ROWS as usize]
    }

    /// Number of materials.
    pub fn len(&self) -> usize {
        self.stages.len()
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.stages.is_empty()
    }

    /// The stage that shades a material.
    pub fn stage(&self, material: usize) -> Stage {
        self.stages[material]
    }

    /// The rows of materials from one of their three on: 0, 1 or 2.
    #[inline(always)]
    pub(super) fn row<L: Lanes>(&self, l: L, material: U<L>, number: u32) -> [F<L>; 4] {
        l.rows(&self.rows, material * ROWS + number)
    }
}
