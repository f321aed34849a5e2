//! Rows of a fixed size, decoded on all threads while they are read.
//!
//! Each function returns `None` if the layout is another one, the file ends too early, or a value is not valid. Reading value by
//! value from the same place then finds the error.
use std::io::{Read, Take};

use super::{
    super::{Model, ModelFormatError},
    header::{Element, Kind, Layout},
    slots::{FIRST_COLOUR, FIRST_TANGENT, NUMBERS, OPACITY, Slots, linear},
    values::Values,
};
use noisefall_base::{
    parallel::in_parts,
    progress::{Cancelled, Progress},
};

/// Bytes that are read at a time, about.
pub const BLOCK: usize = 1 << 22;
/// Rows that a thread decodes at a time.
const ROWS: usize = 1 << 14;

/// Rows that are read block by block.
pub struct Rows<'a> {
    /// From the next row to the end of the file.
    pub bytes: Take<&'a mut dyn Read>,
    /// Bytes of a block, about; a row at least.
    pub block: usize,
}

impl<'a> Rows<'a> {
    /// The rows of the next `length` bytes.
    pub fn new(bytes: &'a mut dyn Read, length: u64, block: usize) -> Rows<'a> {
        Rows { bytes: bytes.take(length), block }
    }
}

/// Offset and type of a number in a row, if it is there.
type Column = Option<(usize, Kind)>;

/// The offset of each number in a row of vertices.
struct Columns {
    list: [Column; NUMBERS],
    /// Bytes of a row.
    size: usize,
}

impl Columns {
    /// `None` if there are lists, or no properties.
    fn of(slots: &Slots) -> Option<Columns> {
        let mut columns = Columns { list: [None; NUMBERS], size: 0 };
        for (layout, slot) in slots {
            let Layout::One(kind) = layout else { return None };
            if let Some(slot) = slot {
                columns.list[*slot] = Some((columns.size, *kind));
            }
            columns.size += kind.size();
        }
        Some(columns).filter(|columns| columns.size > 0)
    }

    fn are_there(&self, first: usize, end: usize) -> bool {
        self.list[first..end].iter().all(Option::is_some)
    }

    /// Decodes the numbers from `first` on, which may be infinite or NaN. Those without a column are 0.
    fn decoder<V: Values, const N: usize>(&self, first: usize) -> impl Fn(&[u8]) -> [f32; N] + Sync {
        let columns: [Column; N] = std::array::from_fn(|i| self.list[first + i]);
        let start = columns[0].map_or(0, |(offset, _)| offset);
        // Most files have reals that follow each other.
        let are_packed = columns.iter().enumerate().all(|(i, column)| *column == Some((start + 4 * i, Kind::F32)));
        move |row| match are_packed {
            true => {
                let numbers = row[start..].as_chunks().0;
                std::array::from_fn(|i| V::real(numbers[i]))
            }
            false => columns.map(|column| column.map_or(0.0, |(offset, kind)| V::number_at(&row[offset..], kind))),
        }
    }
}

/// Reads the vertices of an element without lists. `slots` says what its properties mean.
pub fn vertices<V: Values>(
    element: &Element,
    slots: &Slots,
    rows: &mut Rows,
    progress: &Progress,
) -> Result<Option<Model>, ModelFormatError> {
    let Some(columns) = Columns::of(slots) else { return Ok(None) };
    let Some(count) = count_in(element, columns.size, rows) else { return Ok(None) };
    let mut vertices = vec![[0.0; 3]; count];
    let mut normals = columns.are_there(3, 6).then(|| vec![[0.0; 3]; count]);
    let mut uvs = columns.are_there(6, FIRST_COLOUR).then(|| vec![[0.0; 2]; count]);
    let mut colours = columns.are_there(FIRST_COLOUR, OPACITY).then(|| vec![[0.0; 4]; count]);
    let mut tangents = columns.are_there(FIRST_TANGENT, NUMBERS).then(|| vec![[0.0; 4]; count]);
    let (place, normal, uv) = (columns.decoder::<V, 3>(0), columns.decoder::<V, 3>(3), columns.decoder::<V, 2>(6));
    let (colour, tangent) = (columns.decoder::<V, 4>(FIRST_COLOUR), columns.decoder::<V, 4>(FIRST_TANGENT));
    let finite = |x: f32| if x.is_finite() { x } else { 0.0 };
    let decoded = |colour: [f32; 4]| -> [f32; 4] {
        std::array::from_fn(|i| match columns.list[FIRST_COLOUR + i] {
            Some((_, kind)) => linear(finite(colour[i]), kind, FIRST_COLOUR + i),
            None => 1.0,
        })
    };
    let is_read = in_blocks(count, columns.size, rows, progress, |from, to, block| {
        let size = columns.size;
        fill(&mut vertices[from..to], block, size, |row| Some(place(row)).filter(|place| place.iter().all(|x| x.is_finite())))
            && fill(part(&mut normals, from, to), block, size, |row| Some(normal(row).map(finite)))
            && fill(part(&mut uvs, from, to), block, size, |row| Some(uv(row).map(finite)))
            && fill(part(&mut colours, from, to), block, size, |row| Some(decoded(colour(row))))
            && fill(part(&mut tangents, from, to), block, size, |row| Some(tangent(row).map(finite)))
    })?;
    Ok(is_read.then_some(Model { vertices, normals, uvs, colours, tangents, ..Model::default() }))
}

/// Reads the faces of an element that has only triangles and no other property.
pub fn triangles<V: Values>(
    element: &Element,
    vertices: u64,
    rows: &mut Rows,
    progress: &Progress,
) -> Result<Option<Vec<[u32; 3]>>, ModelFormatError> {
    let Some((count_kind, item)) = polygons(element) else { return Ok(None) };
    let size = count_kind.size() + 3 * item.size();
    let Some(count) = count_in(element, size, rows) else { return Ok(None) };
    let mut triangles = vec![[0; 3]; count];
    // As words without sign, negative numbers are beyond these.
    let vertices = if item == Kind::I32 { vertices.min(1 << 31) } else { vertices };
    let valid = |corners: [u32; 3]| Some(corners).filter(|corners| corners.iter().all(|corner| u64::from(*corner) < vertices));
    let of_words = |row: &[u8]| if row[0] == 3 { valid(row[1..].as_chunks().0.first_chunk::<3>()?.map(V::whole)) } else { None };
    let of_others = |row: &[u8]| {
        let corner = |i: usize| u32::try_from(V::integer_at(&row[count_kind.size() + i * item.size()..], item)).ok();
        let [a, b, c] = [0, 1, 2].map(corner);
        if V::integer_at(row, count_kind) == 3 { valid([a?, b?, c?]) } else { None }
    };
    let is_read = in_blocks(count, size, rows, progress, |from, to, block| match (count_kind.size(), item.size()) {
        (1, 4) => fill(&mut triangles[from..to], block, size, of_words),
        _ => fill(&mut triangles[from..to], block, size, of_others),
    })?;
    Ok(is_read.then_some(triangles))
}

/// The types of counts and corners, if the element has no other property.
pub fn polygons(element: &Element) -> Option<(Kind, Kind)> {
    match &element.properties[..] {
        [property] if property.is_polygon() => match property.layout {
            Layout::List(count, item) => Some((count, item)),
            Layout::One(_) => None,
        },
        _ => None,
    }
}

/// The number of rows, if the file has the bytes for them.
fn count_in(element: &Element, size: usize, rows: &Rows) -> Option<usize> {
    let fits = element.count.checked_mul(size as u64)? <= rows.bytes.limit();
    usize::try_from(element.count).ok().filter(|_| fits)
}

fn part<T>(list: &mut Option<Vec<T>>, from: usize, to: usize) -> &mut [T] {
    list.as_mut().map_or(&mut [], |list| &mut list[from..to])
}

/// Reads `count` rows of `size` bytes, and calls a function for the rows `from..to` of each block. False if the function returns
/// false or the rows cannot be read.
fn in_blocks(
    count: usize,
    size: usize,
    rows: &mut Rows,
    progress: &Progress,
    mut decode: impl FnMut(usize, usize, &[u8]) -> bool,
) -> Result<bool, Cancelled> {
    let at_once = (rows.block / size).clamp(1, count.max(1));
    let mut block = vec![0; at_once * size];
    for from in (0..count).step_by(at_once) {
        let to = count.min(from + at_once);
        let block = &mut block[..(to - from) * size];
        if rows.bytes.read_exact(block).is_err() || !decode(from, to, block) {
            return Ok(false);
        }
        progress.advance(block.len() as u64)?;
    }
    Ok(true)
}

/// Decodes rows on all threads into a list, which may be empty. False if one of them is not valid.
fn fill<T: Send>(into: &mut [T], rows: &[u8], size: usize, decode: impl Fn(&[u8]) -> Option<T> + Sync) -> bool {
    in_parts(into, ROWS, &|first, into| {
        let rows = rows[first * size..].chunks_exact(size);
        into.iter_mut().zip(rows).all(|(into, row)| decode(row).map(|value| *into = value).is_some())
    })
}
