//! Meshes of a scene file: from files, from lists, or made by formula. A file that several objects name is read once.
use std::{collections::HashMap, ops::Range, path::PathBuf, sync::Arc};

use toml::Spanned;

use crate::{
    geometry::{
        MeshData,
        mesh::generate::{heightfield, torus_knot},
    },
    model::{Model, read, smooth_normals},
    scene::{
        check::Checker,
        desc::{Exactly, MeshDesc},
        diagnostic::SceneError,
    },
};

/// Bytes of a triangle of a mesh made by formula, its share of vertices and the making of their normals included.
const MADE_TRIANGLE: u64 = 110;
/// Bytes of a vertex and of a triangle that are read, and of smooth normals while they are made.
const VERTEX: u64 = 32;
const TRIANGLE: u64 = 12;
const SMOOTHING: u64 = 120;
/// Triangles of a mesh made by formula.
const MOST_TRIANGLES: u32 = 50_000_000;

/// The meshes there are, by what they were made from.
#[derive(Default)]
pub struct Meshes(HashMap<Source, Arc<MeshData>>);

#[derive(Clone, PartialEq, Eq, Hash)]
enum Source {
    File { path: PathBuf, smooth: bool },
    Knot { triangles: u32, smooth: bool },
    Heightfield { quads: u32, seed: u32, smooth: bool },
}

impl Meshes {
    pub fn mesh(&mut self, check: &Checker, desc: &MeshDesc, span: Range<usize>) -> Result<Arc<MeshData>, SceneError> {
        let smooth = desc.smooth.unwrap_or(true);
        match desc {
            MeshDesc { path: Some(path), vertices: None, triangles: None, knot: None, heightfield: None, .. } => {
                let source = Source::File { path: check.path(path), smooth };
                self.known(source, || from_file(check, path, smooth))
            }
            MeshDesc {
                path: None, vertices: Some(vertices), triangles: Some(triangles), knot: None, heightfield: None, ..
            } => Ok(Arc::new(from_lists(check, vertices, triangles, desc.smooth.unwrap_or(false))?)),
            MeshDesc { path: None, vertices: None, triangles: None, knot: Some(knot), heightfield: None, .. } => {
                let triangles = check.count(&knot.triangles, 18, MOST_TRIANGLES)?;
                reserve(check, &knot.triangles, triangles.into())?;
                self.known(Source::Knot { triangles, smooth }, || Ok(shaded(torus_knot(triangles as usize), smooth)))
            }
            MeshDesc { path: None, vertices: None, triangles: None, knot: None, heightfield: Some(field), .. } => {
                let quads = check.count(&field.quads, 1, (MOST_TRIANGLES / 2).isqrt())?;
                reserve(check, &field.quads, 2 * u64::from(quads) * u64::from(quads))?;
                let source = Source::Heightfield { quads, seed: field.seed, smooth };
                self.known(source, || Ok(shaded(heightfield(quads as usize, field.seed), smooth)))
            }
            _ => {
                let label = "expected `path`, `knot`, `heightfield`, or `vertices` with `triangles`";
                Err(check.0.error(span, "a mesh must say one thing that it is made from", label))
            }
        }
    }

    fn known(
        &mut self,
        source: Source,
        make: impl FnOnce() -> Result<MeshData, SceneError>,
    ) -> Result<Arc<MeshData>, SceneError> {
        if let Some(data) = self.0.get(&source) {
            return Ok(data.clone());
        }
        let data = Arc::new(make()?);
        self.0.insert(source, data.clone());
        Ok(data)
    }
}

/// Room for a mesh of so many triangles and half as many vertices while it is made, normals and coordinates included.
fn reserve(check: &Checker, place: &Spanned<u32>, triangles: u64) -> Result<(), SceneError> {
    check.reserve(place.span(), format_args!("{triangles} triangles"), MADE_TRIANGLE * triangles)
}

fn from_file(check: &Checker, path: &Spanned<String>, smooth: bool) -> Result<MeshData, SceneError> {
    let model =
        read(&check.path(path)).map_err(|error| check.0.error(path.span(), error.to_string(), "this mesh cannot be used"))?;
    let Model { vertices, triangles, normals, uvs } = model;
    let smoothing = if smooth && normals.is_none() { SMOOTHING } else { 0 };
    let bytes = (VERTEX + smoothing) * vertices.len() as u64 + TRIANGLE * triangles.len() as u64;
    check.reserve(path.span(), format_args!("{} vertices and {} triangles", vertices.len(), triangles.len()), bytes)?;
    let normals = smooth.then(|| normals.unwrap_or_else(|| smooth_normals(&vertices, &triangles)));
    Ok(MeshData { vertices, triangles, normals: normals.unwrap_or_default(), uvs: uvs.unwrap_or_default() })
}

fn from_lists(
    check: &Checker,
    vertices: &Spanned<Vec<Exactly<f64, 3>>>,
    triangles: &Spanned<Vec<Spanned<Exactly<u32, 3>>>>,
    smooth: bool,
) -> Result<MeshData, SceneError> {
    let (vertex_count, triangle_count) = (vertices.as_ref().len(), triangles.as_ref().len());
    let bytes = (VERTEX + if smooth { SMOOTHING } else { 0 }) * vertex_count as u64 + TRIANGLE * triangle_count as u64;
    check.reserve(vertices.span(), format_args!("{vertex_count} vertices and {triangle_count} triangles"), bytes)?;
    let points: Vec<[f32; 3]> = vertices.as_ref().iter().map(|vertex| vertex.0.map(|x| x as f32)).collect();
    if let Some(at) = points.iter().position(|vertex| vertex.iter().any(|x| !x.is_finite())) {
        return Err(check.0.error(vertices.span(), format!("vertex {at} is not finite"), "all coordinates must be"));
    }
    if triangles.as_ref().is_empty() {
        return Err(check.0.error(triangles.span(), "the mesh is empty", "it has no triangles"));
    }
    for triangle in triangles.as_ref() {
        if let Some(index) = triangle.as_ref().0.iter().find(|index| **index as usize >= points.len()) {
            let message = format!("there is no vertex {index}");
            let label = format!("there are {}, counted from 0", points.len());
            return Err(check.0.error(triangle.span(), message, label));
        }
    }
    let triangles: Vec<[u32; 3]> = triangles.as_ref().iter().map(|triangle| triangle.as_ref().0).collect();
    let normals = if smooth { smooth_normals(&points, &triangles) } else { Vec::new() };
    Ok(MeshData { vertices: points, triangles, normals, uvs: Vec::new() })
}

fn shaded(data: MeshData, smooth: bool) -> MeshData {
    if smooth { data } else { MeshData { normals: Vec::new(), ..data } }
}
