//! The faces of a file by material.
use std::collections::HashMap;

use super::{
    super::{ModelFormatError, polygon::Polygon},
    corner::Corner,
    faces::{Faces, Switch},
    groups,
    lists::Lists,
};
use noisefall_base::memory::reserve;

/// Files with more materials are refused: each one is an object of the scene.
const MOST: usize = 1 << 16;

/// The faces of a material, as a file of their own would have them.
pub struct PartFaces<'a> {
    /// The text after `usemtl`; `None` for faces before the first such line.
    pub material: Option<&'a str>,
    pub faces: Faces<'a>,
}

/// Ranges of faces by material, in the order in which materials come first.
type Ranges<'a> = Vec<(Option<&'a str>, Vec<[Switch<'a>; 2]>)>;

/// The materials of a file with the ranges of their faces. Materials without faces are left out.
pub fn ranges<'a>(faces: &Faces<'a>) -> Result<Ranges<'a>, ModelFormatError> {
    let start = Switch { material: "", corner: 0, triangle: 0, polygon: 0 };
    let end = Switch {
        material: "",
        corner: faces.corners.len() as u32,
        triangle: faces.triangles.len() as u32,
        polygon: faces.polygons.len() as u32,
    };
    let first = [(None, start)].into_iter();
    let starts: Vec<_> = first.chain(faces.switches.iter().map(|of| (Some(of.material), *of))).collect();
    let ends = starts[1..].iter().map(|(_, next)| *next).chain([end]);
    let (mut known, mut ranges) = (HashMap::new(), Ranges::new());
    for ((material, from), to) in starts.iter().zip(ends).filter(|((_, from), to)| from.triangle < to.triangle) {
        let number = *known.entry(*material).or_insert(ranges.len());
        if number == MOST {
            return Err(ModelFormatError::TooManyMaterials);
        }
        if number == ranges.len() {
            ranges.push((*material, Vec::new()));
        }
        ranges[number].1.push([*from, to]);
    }
    Ok(ranges)
}

/// Splits the faces by material.
pub fn split<'a>(faces: &Faces<'a>, ranges: Ranges<'a>) -> impl Iterator<Item = PartFaces<'a>> {
    ranges.into_iter().map(|(material, ranges)| {
        let mut part = Faces::default();
        for [from, to] in ranges {
            let (corner, triangle) = (part.corners.len() as u32, part.triangles.len() as u32);
            part.corners.extend(&faces.corners[from.corner as usize..to.corner as usize]);
            let triangles = &faces.triangles[from.triangle as usize..to.triangle as usize];
            part.triangles.extend(triangles.iter().map(|corners| corners.map(|id| id - from.corner + corner)));
            let polygons = &faces.polygons[from.polygon as usize..to.polygon as usize];
            part.polygons.extend(polygons.iter().map(|of| Polygon { first: of.first - from.triangle + triangle, ..*of }));
            part.groups
                .extend(groups::within(&faces.groups, [from.triangle, to.triangle]).map(|(at, group)| (triangle + at, group)));
        }
        PartFaces { material, faces: part }
    })
}

/// Replaces the positions of a part's corners by numbers from 0, in their order, and returns the positions by number. `local` has an
/// entry per position of the file; its values do not matter.
pub fn own_places(corners: &[Corner], local: &mut [u32]) -> Vec<u32> {
    let mut used: Vec<u32> = corners.iter().map(|corner| corner.place).collect();
    used.sort_unstable();
    used.dedup();
    used.iter().enumerate().for_each(|(number, place)| local[*place as usize] = number as u32);
    used
}

/// The table of [`own_places`] for all parts of a file.
pub fn local_table(lists: &Lists) -> Result<(Vec<u32>, noisefall_base::memory::Reservation), ModelFormatError> {
    let count = lists.places.len();
    let room = reserve(format_args!("{count} vertices"), (count * size_of::<u32>()) as u64)?;
    Ok((vec![0; count], room))
}
