//! Wavefront OBJ: reads all polygons, by material if that is asked for, and ignores objects, groups of elements, points and lines.
//!
//! Wavefront Technologies, "Appendix B1. Object Files (.obj)", Advanced Visualizer manual, 1995. A corner of a face refers to a
//! position, a texture coordinate and a normal separately; each distinct combination becomes a vertex. Colours after a position,
//! which the standard does not have, are sRGB, as Blender writes them.
//!
//! Chunks of whole lines are read at the same time, twice: first their lists, whose lengths say what negative indices refer to, and
//! then their faces. The result does not depend on the chunks.
mod corner;
mod faces;
mod groups;
mod lists;
mod parts;
#[cfg(test)]
mod tests;
mod text;

use std::borrow::Cow;

use rayon::prelude::*;

use self::{
    corner::{Corner, NONE},
    faces::Faces,
    lists::{Lists, WHITE},
    text::Chunks,
};
use super::{Model, ModelFormatError, ObjParts, Part, Smoothing, polygon, weld::distinct, without_faces};
use noisefall_base::{
    memory::{Reservation, reserve},
    progress::{Progress, Stage},
};

/// Reads the file as one mesh.
pub(super) fn decode(bytes: &[u8], progress: &Progress) -> Result<Model, ModelFormatError> {
    read(bytes, progress, |lists, faces| {
        let count = lists.places.len();
        model(lists, faces, count, |corner| corner.place as usize)
    })
}

/// Reads the file as one mesh per material.
pub(super) fn decode_parts(bytes: &[u8], progress: &Progress) -> Result<ObjParts, ModelFormatError> {
    read(bytes, progress, |lists, faces| {
        let libraries = faces.libraries.iter().map(|library| (*library).to_owned()).collect();
        let (mut local, _room) = parts::local_table(lists)?;
        let mut list = Vec::new();
        for part in parts::split(&faces, parts::ranges(&faces)?) {
            let used = parts::own_places(&part.faces.corners, &mut local);
            let model = model(lists, part.faces, used.len(), |corner| local[corner.place as usize] as usize)?;
            list.push(Part { material: part.material.map(str::to_owned), model });
        }
        if list.is_empty() {
            return Err(without_faces(lists.places.len()));
        }
        Ok(ObjParts { libraries, list, is_flat: true, missing: faces.missing })
    })
}

fn read<T>(
    bytes: &[u8],
    progress: &Progress,
    make: impl Fn(&Lists, Faces) -> Result<T, ModelFormatError>,
) -> Result<T, ModelFormatError> {
    /// How often the lines are read.
    const PASSES: u64 = 2;
    let mut room = Reservation::none();
    let text = &text::decode(bytes)?;
    progress.expect(Stage::Files, PASSES * text.len() as u64);
    let chunks = Chunks::new(text, progress);
    let (lists, before) = Lists::read(&chunks, &mut room)?;
    if let Cow::Owned(copy) = text {
        room.grow("copies of what is not UTF-8", copy.len() as u64)?;
    }
    let faces = Faces::read(&chunks, &lists, &before, &mut room)?;
    progress.check()?;
    make(&lists, faces)
}

/// The mesh of some faces. `place` numbers the positions of their corners, less than `places`.
fn model(lists: &Lists, faces: Faces, places: usize, place: impl Fn(&Corner) -> usize + Sync) -> Result<Model, ModelFormatError> {
    /// Bytes per corner in the lists of distinct corners and their attributes.
    const CORNER: u64 = 48;
    const COLOUR: u64 = size_of::<[f32; 4]>() as u64;
    let Faces { corners, mut triangles, polygons, groups, .. } = faces;
    if triangles.is_empty() {
        return Err(without_faces(lists.places.len()));
    }
    let has_normals = corners.par_iter().all(|corner| corner.normal != NONE);
    let smoothing = if has_normals { Smoothing::Unstated } else { groups::smoothing(&groups, triangles.len())? };
    let bytes = CORNER + if lists.colours.is_empty() { 0 } else { COLOUR };
    let _more = reserve(format_args!("{} corners", corners.len()), bytes * corners.len() as u64)?;
    polygon::cut(&mut triangles, &polygons, |corner| lists.places[corners[corner as usize].place as usize]);
    let has_attributes = !lists.uvs.is_empty() || !lists.normals.is_empty();
    let (distinct, vertices) = if has_attributes { distinct(&corners, places, place) } else { used(&corners, places, place) };
    drop(corners);
    triangles.par_iter_mut().for_each(|corners| *corners = corners.map(|corner| vertices[corner as usize]));
    let uvs = attribute(&distinct, &lists.uvs, |corner| corner.uv);
    let normals = attribute(&distinct, &lists.normals, |corner| corner.normal);
    let vertices = distinct.iter().map(|corner| lists.places[corner.place as usize]).collect();
    let colour = |corner: &Corner| lists.colours.get(corner.place as usize).copied().unwrap_or(WHITE);
    let colours = (!lists.colours.is_empty()).then(|| distinct.iter().map(colour).collect());
    Ok(Model { vertices, triangles, normals, uvs, colours, smoothing, ..Model::default() })
}

/// The result of [`distinct`] for corners that are positions only.
fn used(corners: &[Corner], places: usize, place: impl Fn(&Corner) -> usize + Sync) -> (Vec<Corner>, Vec<u32>) {
    // First the position in the file, and then the number.
    let mut numbers = vec![NONE; places];
    corners.iter().for_each(|corner| numbers[place(corner)] = corner.place);
    let mut distinct = Vec::new();
    for number in numbers.iter_mut().filter(|number| **number != NONE) {
        distinct.push(Corner { place: *number, uv: NONE, normal: NONE });
        *number = distinct.len() as u32 - 1;
    }
    (distinct, corners.par_iter().map(|corner| numbers[place(corner)]).collect())
}

/// Looks up an attribute of each corner, 0 where it is missing; `None` if all corners lack it.
fn attribute<const N: usize>(corners: &[Corner], list: &[[f32; N]], index: impl Fn(&Corner) -> u32) -> Option<Vec<[f32; N]>> {
    let value = |corner| list.get(index(corner) as usize).copied().unwrap_or([0.0; N]);
    corners.iter().any(|corner| index(corner) != NONE).then(|| corners.iter().map(value).collect())
}
