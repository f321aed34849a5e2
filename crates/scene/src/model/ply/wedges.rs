//! Texture coordinates of the corners of faces, as MeshLab writes them: `texcoord`, a list of u and v for each corner of a face.
use super::{
    super::{
        Model, ModelFormatError,
        polygon::{self, Polygon},
        weld::distinct,
    },
    elements::{REPORT, corners, in_element, skip_property},
    header::{Element, Layout, Property},
    values::Values,
};
use noisefall_base::{
    memory::{Reservation, reserve},
    progress::Progress,
};

/// Marks a corner without coordinates.
const NONE: u32 = u32::MAX;
/// Bytes of a corner in the lists of distinct corners and their attributes.
const CORNER: u64 = 80;

/// Faces with coordinates of their corners.
#[derive(Default)]
pub struct Wedges {
    /// Vertices of the corners of all faces, and indices of their coordinates.
    corners: Vec<(u32, u32)>,
    uvs: Vec<[f32; 2]>,
    /// Indices into `corners`: fans.
    triangles: Vec<[u32; 3]>,
    /// Faces with more than three corners.
    polygons: Vec<Polygon>,
}

/// Whether faces have coordinates of their corners.
pub fn are_there(element: &Element) -> bool {
    element.properties.iter().any(is_list)
}

fn is_list(property: &Property) -> bool {
    let names = ["texcoord", "texcoords", "texture_coordinates"];
    matches!(property.layout, Layout::List(..)) && names.iter().any(|name| property.name.eq_ignore_ascii_case(name))
}

impl Wedges {
    pub fn read(
        element: &Element,
        vertices: u64,
        values: &mut impl Values,
        room: &mut Reservation,
        progress: &Progress,
    ) -> Result<Wedges, ModelFormatError> {
        let mut wedges = Wedges::default();
        for index in 0..element.count {
            if index.is_multiple_of(REPORT) {
                progress.check()?;
            }
            wedges.read_face(element, vertices, values, room).map_err(|problem| in_element(problem, &element.name, index))?;
        }
        Ok(wedges)
    }

    fn read_face(
        &mut self,
        element: &Element,
        vertices: u64,
        values: &mut impl Values,
        room: &mut Reservation,
    ) -> Result<(), ModelFormatError> {
        let (first, first_uv) = (self.corners.len(), self.uvs.len());
        for property in &element.properties {
            match property.layout {
                Layout::List(count, kind) if property.is_polygon() => {
                    corners((count, kind), vertices, values, |vertex| room.push(&mut self.corners, (vertex, NONE), "corners"))?;
                }
                Layout::List(count, kind) if is_list(property) => {
                    let numbers = values.integer(count)?;
                    for _ in 0..numbers / 2 {
                        let uv = [values.number(kind)?, values.number(kind)?].map(|x| if x.is_finite() { x } else { 0.0 });
                        room.push(&mut self.uvs, uv, "texture coordinates")?;
                    }
                    values.skip(kind, (numbers.max(0) % 2) as u64)?;
                }
                layout => skip_property(layout, values)?,
            }
        }
        let count = self.corners.len() - first;
        if self.uvs.len() - first_uv == count {
            self.corners[first..].iter_mut().zip(first_uv as u32..).for_each(|(corner, uv)| corner.1 = uv);
        } else {
            self.uvs.truncate(first_uv);
        }
        let (first, start) = (first as u32, self.triangles.len() as u32);
        for last in first + 2..self.corners.len() as u32 {
            room.push(&mut self.triangles, [first, last - 1, last], "triangles")?;
        }
        if count > 3 {
            room.push(&mut self.polygons, Polygon { first: start, count: count as u32 - 2 }, "polygons")?;
        }
        Ok(())
    }

    /// The mesh with these faces besides its own. Vertices are repeated where coordinates differ.
    pub fn joined(mut self, model: Model) -> Result<Model, ModelFormatError> {
        let all = self.corners.len() + 3 * model.triangles.len();
        let _room = reserve(format_args!("{all} corners"), CORNER * all as u64)?;
        polygon::cut(&mut self.triangles, &self.polygons, |corner| model.vertices[self.corners[corner as usize].0 as usize]);
        for triangle in &model.triangles {
            let first = self.corners.len() as u32;
            self.corners.extend(triangle.map(|vertex| (vertex, NONE)));
            self.triangles.push([first, first + 1, first + 2]);
        }
        let (distinct, numbers) = distinct(&self.corners, model.vertices.len(), |(vertex, _)| *vertex as usize);
        let uv = |(vertex, uv): &(u32, u32)| {
            let of_vertex = || Some(model.uvs.as_ref()?[*vertex as usize]);
            self.uvs.get(*uv as usize).copied().or_else(of_vertex).unwrap_or_default()
        };
        let gathered = |list: &Vec<[f32; 3]>| distinct.iter().map(|(vertex, _)| list[*vertex as usize]).collect();
        let fours = |list: &Vec<[f32; 4]>| distinct.iter().map(|(vertex, _)| list[*vertex as usize]).collect();
        let [colours, tangents] = [&model.colours, &model.tangents].map(|list| list.as_ref().map(fours));
        Ok(Model {
            vertices: gathered(&model.vertices),
            triangles: self.triangles.iter().map(|triangle| triangle.map(|corner| numbers[corner as usize])).collect(),
            normals: model.normals.as_ref().map(gathered),
            uvs: Some(distinct.iter().map(uv).collect()),
            colours,
            tangents,
            smoothing: model.smoothing,
        })
    }
}
