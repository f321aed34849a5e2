//! Copies of the mesh of a node, by EXT_mesh_gpu_instancing.
use glam::{DAffine3, DQuat, DVec3};

use super::{
    accessor::{Column, Picks},
    animation::quaternion,
    buffers::Buffers,
    document::{Document, Index},
    extensions::Instancing,
    refusal::Found,
};

/// From each copy to the node.
pub fn copies(document: &Document, buffers: &Buffers, described: &Instancing) -> Found<Vec<DAffine3>> {
    let open = |index: Option<Index>| index.map(|index| Column::open(document, buffers, index)).transpose();
    let attributes = &described.attributes;
    let columns = [open(attributes.translation)?, open(attributes.rotation)?, open(attributes.scale)?];
    let count = columns.iter().flatten().next().map_or(1, |column| column.count);
    if columns.iter().flatten().any(|column| column.count != count) {
        return Err("the copies of a mesh have different numbers of translations, rotations and scales".into());
    }
    // Each is read as three columns of 32-bit numbers, and becomes a map.
    buffers.spend((count * (size_of::<DAffine3>() + 40)) as u64, "copies of a mesh")?;
    let picks = Picks::First(count);
    let [translation, rotation, scale] = &columns;
    let triples = |column: &Option<Column>| column.as_ref().map(|column| column.reals::<3>(&picks)).transpose();
    let (translations, scales) = (triples(translation)?, triples(scale)?);
    let rotations = rotation.as_ref().map(|column| column.reals::<4>(&picks)).transpose()?;
    let vector = |list: &Option<Vec<[f32; 3]>>, at: usize, usual: DVec3| {
        list.as_ref().map_or(usual, |list| DVec3::from(list[at].map(f64::from)))
    };
    let copy = |at: usize| {
        let rotation = rotations.as_ref().map_or(DQuat::IDENTITY, |list| quaternion(list[at].map(f64::from)));
        let (scale, translation) = (vector(&scales, at, DVec3::ONE), vector(&translations, at, DVec3::ZERO));
        DAffine3::from_scale_rotation_translation(scale, rotation, translation)
    };
    Ok((0..count).map(copy).collect())
}
