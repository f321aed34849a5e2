//! Values of a fixed layout, decoded on all threads.
//!
//! Each function returns `None` if the layout is another one or a value is not valid. Then nothing is consumed, and reading value by
//! value finds the place of the error.
use rayon::prelude::*;

use super::{
    super::Model,
    FIRST_COLOUR, NUMBERS, OPACITY,
    header::{Element, Kind, Layout},
    linear,
    values::Values,
};

/// Offset and type of a number in a row, if it is there.
type Column = Option<(usize, Kind)>;

/// The vertices of an element without lists, and their size in bytes. `slots` says what its properties mean.
pub fn vertices<V: Values>(element: &Element, slots: &[(Layout, Option<usize>)], values: &V) -> Option<(Model, u64)> {
    let (mut columns, mut size) = ([None; NUMBERS], 0);
    for (layout, slot) in slots {
        let Layout::One(kind) = layout else { return None };
        if let Some(slot) = slot {
            columns[*slot] = Some((size, *kind));
        }
        size += kind.size();
    }
    let length = usize::try_from(element.count).ok()?.checked_mul(size)?;
    let rows = values.block(length)?.par_chunks_exact(size);
    let is_there = |first: usize, end: usize| columns[first..end].iter().all(Option::is_some);
    let place = |row: &[u8]| [0, 1, 2].map(|axis| raw::<V>(row, columns[axis]));
    let vertices: Vec<[f32; 3]> = rows.clone().map(place).collect();
    if !vertices.par_iter().all(|place| place.iter().all(|x| x.is_finite())) {
        return None;
    }
    let model = Model {
        vertices,
        normals: is_there(3, 6).then(|| rows.clone().map(|row| attribute::<V, 3>(row, &columns, 3)).collect()),
        uvs: is_there(6, FIRST_COLOUR).then(|| rows.clone().map(|row| attribute::<V, 2>(row, &columns, 6)).collect()),
        colours: is_there(FIRST_COLOUR, OPACITY)
            .then(|| rows.clone().map(|row| attribute::<V, 4>(row, &columns, FIRST_COLOUR)).collect()),
        ..Model::default()
    };
    Some((model, length as u64))
}

/// A number of the file, which may be infinite or NaN; 0 without a column.
fn raw<V: Values>(row: &[u8], column: Column) -> f32 {
    column.map_or(0.0, |(offset, kind)| V::number_at(&row[offset..], kind))
}

fn attribute<V: Values, const N: usize>(row: &[u8], columns: &[Column; NUMBERS], first: usize) -> [f32; N] {
    std::array::from_fn(|i| {
        let slot = first + i;
        let number = Some(raw::<V>(row, columns[slot])).filter(|x| x.is_finite()).unwrap_or(0.0);
        match columns[slot] {
            Some((_, kind)) if slot >= FIRST_COLOUR => linear(number, kind, slot),
            None if slot == OPACITY => 1.0,
            _ => number,
        }
    })
}

/// The faces of an element that has only triangles and no other property, and their size in bytes.
pub fn triangles<V: Values>(element: &Element, vertices: u64, values: &V) -> Option<(Vec<[u32; 3]>, u64)> {
    let [property] = &element.properties[..] else { return None };
    let Layout::List(count, item) = property.layout else { return None };
    let size = count.size() + 3 * item.size();
    let length = usize::try_from(element.count).ok()?.checked_mul(size)?;
    let rows = values.block(length)?.par_chunks_exact(size);
    let corner = |row: &[u8], i: usize| V::integer_at(&row[count.size() + i * item.size()..], item);
    let is_there = |corner: i64| u64::try_from(corner).is_ok_and(|corner| corner < vertices);
    let is_valid = |row: &[u8]| V::integer_at(row, count) == 3 && (0..3).all(|i| is_there(corner(row, i)));
    if !property.is_polygon() || !rows.clone().all(is_valid) {
        return None;
    }
    let triangles = rows.map(|row| [0, 1, 2].map(|i| corner(row, i) as u32)).collect();
    Some((triangles, length as u64))
}
