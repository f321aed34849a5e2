//! Rows of blends and of their parts.
//!
//! A blend is a tree whose nodes name the rows of their two parts. Equal parts share a row, so a material that many blends name has
//! few rows.
use std::collections::BTreeMap;

use super::{
    BLENDED, Columns, FLIPPED, Surfaces,
    applied::{AppliedMaterial, Key},
    rows::number_row,
};
use crate::scene::{MaterialInstance, Object, material_instance::BlendParts};

/// Adds the rows of the parts of all blends, and links the primitives of the objects to them.
pub fn add(surfaces: &mut Surfaces, objects: &[Object], instances: &[MaterialInstance], columns: Columns) {
    let mut first = 0;
    let mut rows = BlendRows { surfaces, instances, columns, known: BTreeMap::new() };
    for object in objects {
        let pieces = first..first + object.shape.piece_count();
        first = pieces.end;
        if let Some(applied) = AppliedMaterial::of_object(object, instances).filter(|applied| applied.instance.blend.is_some()) {
            let row = rows.row(&applied);
            pieces.for_each(|piece| rows.surfaces.copy(row, piece));
        }
    }
}

struct BlendRows<'a> {
    surfaces: &'a mut Surfaces,
    instances: &'a [MaterialInstance],
    columns: Columns,
    known: BTreeMap<Key, usize>,
}

impl<'a> BlendRows<'a> {
    /// The row of a part or of a whole blend. Blends are nested only a few levels deep.
    fn row(&mut self, applied: &AppliedMaterial<'a>) -> usize {
        let key = applied.key();
        if let Some(row) = self.known.get(&key) {
            return *row;
        }
        let instances = self.instances;
        let parts = applied
            .instance
            .blend
            .map(|BlendParts { materials, weight }| (materials.map(|number| self.row(&applied.part(number, instances))), weight));
        let row = self.surfaces.rows.len();
        self.surfaces.push(Some(applied), self.columns);
        if let Some((parts, weight)) = parts {
            let [weight, texture] = number_row(weight);
            let node = self.surfaces.blends.len() as u32;
            self.surfaces.blends.push([weight, texture, f32::from_bits(parts[0] as u32), f32::from_bits(parts[1] as u32)]);
            let word = BLENDED | if applied.flip { FLIPPED } else { 0 };
            self.surfaces.rows[row] = [f32::from_bits(node), 0.0, 0.0, f32::from_bits(word)];
            // The medium that a camera inside the object is in.
            let media = parts.map(|part| {
                let [.., medium] = self.surfaces.varying[part];
                medium
            });
            let [.., medium] = &mut self.surfaces.varying[row];
            *medium = media.into_iter().find(|medium| medium.to_bits() != 0).unwrap_or(0.0);
        }
        self.known.insert(key, row);
        row
    }
}

impl Surfaces {
    /// Copies what kernel and scene read of the row of a blend.
    fn copy(&mut self, from: usize, to: usize) {
        self.rows[to] = self.rows[from];
        self.varying[to] = self.varying[from];
        self.opacity[to] = self.opacity[from];
    }
}
