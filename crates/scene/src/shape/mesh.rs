//! A triangle mesh: from a file, from lists, or procedural.
use std::{
    hash::{DefaultHasher, Hash, Hasher},
    sync::Arc,
};

use super::{Build, ShapeBuilder};
use crate::{
    geometry::{
        MeshData, Shape,
        mesh::generate::{heightfield, torus_knot},
    },
    model::{Model, Smoothing, read_watched, smooth_normals, smooth_normals_watched, turn_triangles},
};
use noisefall_base::{
    declare::{CountRange, Declare, Kind, NamedFile, OneOf, Parameter, Parameters, Problem, Resources, Value},
    memory,
    progress::Progress,
    quote,
};

/// Bytes per triangle of a procedural mesh, including its share of vertices and the computation of their normals.
const MADE_TRIANGLE: u64 = 110;
/// Bytes per vertex and per triangle of lists, of colours and of tangents each, and of smooth normals while they are computed.
const VERTEX: u64 = 32;
const FOUR: u64 = 16;
const TRIANGLE: u64 = 12;
const SMOOTHING: u64 = 64;
/// Range of the number of triangles of a procedural mesh.
const MOST_TRIANGLES: u32 = 50_000_000;
const MOST_QUADS: u32 = (MOST_TRIANGLES / 2).isqrt();

/// A triangle mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The triangles.
    pub source: MeshSource,
    /// Whether normals are interpolated. `None` means what the file states, and else yes, except for lists.
    pub smooth: Option<bool>,
}

/// The source of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSource {
    /// An OBJ, PLY or STL file.
    File(String),
    /// Lists in the scene file.
    Lists {
        /// Positions, metres.
        vertices: Vec<[f64; 3]>,
        /// The indices of three vertices each, counter-clockwise from the front.
        triangles: Vec<[u32; 3]>,
    },
    /// A torus knot.
    Knot(Knot),
    /// Hills over x and z from −1 to 1.
    Heightfield(Heightfield),
}

/// A torus knot.
#[derive(Clone, Debug, PartialEq)]
pub struct Knot {
    /// Number of triangles, approximately.
    pub triangles: u32,
}

/// Hills of noise over x and z from −1 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Heightfield {
    /// Quads along each side, of two triangles each.
    pub quads: u32,
    /// Seed of the noise.
    pub seed: u32,
}

const PATH: Parameter = Parameter::new("path", "OBJ, PLY or STL file.").required().aliases("file filename src");
const VERTICES: Parameter = Parameter::new("vertices", "Corners of the triangles.").unit("m").required();
const TRIANGLES: Parameter =
    Parameter::new("triangles", "Three vertex indices per triangle, counted from 0.").required().aliases("faces indices");
const KNOT: Parameter = Parameter::new("knot", "A torus knot.").required();
const HEIGHTFIELD: Parameter = Parameter::new("heightfield", "Hills of noise over x and z from −1 to 1.").required();

impl Default for MeshSource {
    fn default() -> Self {
        MeshSource::Knot(Knot { triangles: 10_000 })
    }
}

impl Kind for Mesh {
    const KIND: Parameter =
        Parameter::new("mesh", "Triangles from a file, from lists, or procedural.").aliases("obj ply trianglemesh");
}

impl Declare for Mesh {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SMOOTH: Parameter = Parameter::new(
            "smooth",
            "Whether to interpolate normals over the triangles. Default: as the file states; false for lists.",
        );
        p.one_of(&mut self.source);
        p.optional(&SMOOTH, &mut self.smooth, || true, |p, smooth| p.flag(&SMOOTH, smooth));
    }
}

impl OneOf for MeshSource {
    const WHAT: &'static str = "mesh";

    fn alternatives() -> Vec<Self> {
        vec![
            MeshSource::File(String::new()),
            MeshSource::Lists { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]] },
            MeshSource::default(),
            MeshSource::Heightfield(Heightfield { quads: 64, seed: 0 }),
        ]
    }

    fn place(&self) -> usize {
        match self {
            MeshSource::File(_) => 0,
            MeshSource::Lists { .. } => 1,
            MeshSource::Knot(_) => 2,
            MeshSource::Heightfield(_) => 3,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            MeshSource::File(_) => PATH.key,
            MeshSource::Lists { .. } => VERTICES.key,
            MeshSource::Knot(_) => KNOT.key,
            MeshSource::Heightfield(_) => HEIGHTFIELD.key,
        }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            MeshSource::File(path) => p.value(&PATH, Value::File(path)),
            MeshSource::Lists { vertices, triangles } => {
                p.value(&VERTICES, Value::Points(vertices));
                p.value(&TRIANGLES, Value::Triangles(triangles));
            }
            MeshSource::Knot(knot) => p.table(&KNOT, knot),
            MeshSource::Heightfield(field) => p.table(&HEIGHTFIELD, field),
        }
    }
}

impl Declare for Knot {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const TRIANGLES: Parameter = Parameter::new("triangles", "Approximate number of triangles.").required();
        p.count(&TRIANGLES, &mut self.triangles, CountRange::new(18, MOST_TRIANGLES));
    }
}

impl Declare for Heightfield {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const QUADS: Parameter = Parameter::new("quads", "Quads along each side, of two triangles each.").required();
        const SEED: Parameter = Parameter::new("seed", "Random seed of the hills.");
        p.count(&QUADS, &mut self.quads, CountRange::new(1, MOST_QUADS));
        p.count(&SEED, &mut self.seed, CountRange::ANY);
    }
}

impl Build for Mesh {
    fn shapes(&self, builder: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        self.shape(builder).map(|shape| vec![Shape::clone(&shape)])
    }

    fn is_quick(&self) -> bool {
        false
    }
}

/// Name of meshes in the report of a compile.
const MESHES: &str = "meshes";

impl Mesh {
    /// The mesh in its own space. Objects with the same file or formula share it.
    fn shape(&self, builder: &mut ShapeBuilder) -> Result<Arc<Shape>, Problem> {
        let resources = builder.resources;
        let smooth = self.smooth.unwrap_or(true);
        let known = |key: String, make: &dyn Fn() -> Result<MeshData, Problem>| {
            resources.once(MESHES, key, || make().map(|data| Shape::mesh(Arc::new(data))))
        };
        match &self.source {
            MeshSource::File(path) => {
                let file = resources.file(path);
                known(format!("mesh {} {:?}", file.key(), self.smooth), &|| from_file(resources, &file, self.smooth))
            }
            MeshSource::Lists { vertices, triangles } => {
                let smooth = self.smooth.unwrap_or(false);
                let hash = hash_of_lists(vertices, triangles);
                let number = builder.lists.entry(hash).or_default();
                *number += 1;
                known(format!("lists {hash:x} {number} {smooth}"), &|| from_lists(resources, vertices, triangles, smooth))
            }
            MeshSource::Knot(Knot { triangles }) => known(format!("knot {triangles} {smooth}"), &|| {
                reserve(resources, "knot.triangles", (*triangles).into())?;
                Ok(shaded(torus_knot(*triangles as usize), smooth))
            }),
            MeshSource::Heightfield(Heightfield { quads, seed }) => {
                known(format!("heightfield {quads} {seed} {smooth}"), &|| {
                    reserve(resources, "heightfield.quads", 2 * u64::from(*quads) * u64::from(*quads))?;
                    Ok(shaded(heightfield(*quads as usize, *seed), smooth))
                })
            }
        }
    }
}

/// 128 bits of hash: two different lists have the same one with a probability of 3·10⁻³⁹.
fn hash_of_lists(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> u128 {
    let half = |salt: u8| {
        let mut hasher = DefaultHasher::new();
        salt.hash(&mut hasher);
        vertices.iter().flatten().for_each(|x| x.to_bits().hash(&mut hasher));
        triangles.hash(&mut hasher);
        hasher.finish()
    };
    u128::from(half(0)) << 64 | u128::from(half(1))
}

/// Reserves memory for a mesh with a number of triangles and half as many vertices while it is built, including normals and
/// coordinates.
fn reserve(resources: &Resources, key: &str, triangles: u64) -> Result<(), Problem> {
    resources.reserve(key, format_args!("{triangles} triangles"), MADE_TRIANGLE * triangles)
}

fn from_file(resources: &Resources, file: &NamedFile, smooth: Option<bool>) -> Result<MeshData, Problem> {
    let progress = resources.progress();
    let model = match (file.content::<Model>(), file.take_loaded()) {
        (Some(model), _) => Model::clone(&model).checked().map_err(|problem| format!("{}: {problem}", quote::path(file.path()))),
        (None, Some(model)) => Ok(model),
        (None, None) => read_watched(file.path(), progress).map_err(|error| error.to_string()),
    };
    let model = model.map_err(|message| Problem::at("path", message, "this mesh cannot be used"))?;
    let model = if smooth.is_none() { grouped(model, progress)? } else { model };
    let Model { vertices, mut triangles, normals, uvs, colours, tangents, smoothing } = model;
    let smooth = smooth.unwrap_or(smoothing != Smoothing::Flat || normals.is_some());
    let fours = u64::from(colours.is_some()) + u64::from(tangents.is_some());
    let bytes = (VERTEX + FOUR * fours) * vertices.len() as u64 + TRIANGLE * triangles.len() as u64;
    resources.reserve("path", format_args!("{} vertices and {} triangles", vertices.len(), triangles.len()), bytes)?;
    let normals = match normals.filter(|_| smooth) {
        None if smooth => {
            let room = memory::reserve(format_args!("normals of {} vertices", vertices.len()), SMOOTHING * vertices.len() as u64);
            let _room = room.map_err(|error| Problem::at("path", error.to_string(), "too much memory"))?;
            Some(smooth_normals_watched(&vertices, &triangles, progress).map_err(Problem::cancelled)?)
        }
        normals => normals,
    };
    if let Some(normals) = &normals {
        turn_triangles(&vertices, normals, &mut triangles);
    }
    let mut colours = colours.unwrap_or_default();
    // Textures of vertex colours count on their range. NaN becomes 0.
    colours.as_flattened_mut().iter_mut().for_each(|x| *x = if *x > 0.0 { x.min(1.0) } else { 0.0 });
    let (normals, uvs, tangents) = (normals.unwrap_or_default(), uvs.unwrap_or_default(), tangents.unwrap_or_default());
    Ok(MeshData { vertices, triangles, normals, uvs, colours, tangents })
}

/// The mesh with edges between its smoothing groups.
fn grouped(model: Model, progress: &Progress) -> Result<Model, Problem> {
    let room = memory::reserve(format_args!("smoothing groups of {} triangles", model.triangles.len()), model.grouping());
    let _room = room.map_err(|error| Problem::at("path", error.to_string(), "too much memory"))?;
    model.grouped(progress).map_err(Problem::cancelled)
}

fn from_lists(resources: &Resources, vertices: &[[f64; 3]], triangles: &[[u32; 3]], smooth: bool) -> Result<MeshData, Problem> {
    let bytes = (VERTEX + if smooth { SMOOTHING } else { 0 }) * vertices.len() as u64 + TRIANGLE * triangles.len() as u64;
    resources.reserve("vertices", format_args!("{} vertices and {} triangles", vertices.len(), triangles.len()), bytes)?;
    let points: Vec<[f32; 3]> = vertices.iter().map(|vertex| vertex.map(|x| x as f32)).collect();
    if let Some(at) = points.iter().position(|vertex| vertex.iter().any(|x| !x.is_finite())) {
        return Err(Problem::at("vertices", format!("vertex {at} is not finite"), "all coordinates must be"));
    }
    if triangles.is_empty() {
        return Err(Problem::at("triangles", "the mesh is empty", "it has no triangles"));
    }
    for (place, triangle) in triangles.iter().enumerate() {
        if let Some(index) = triangle.iter().find(|index| **index as usize >= points.len()) {
            let label = format!("there are {}, counted from 0", points.len());
            return Err(Problem::at(&format!("triangles.{place}"), format!("there is no vertex {index}"), label));
        }
    }
    let normals = if smooth { smooth_normals(&points, triangles) } else { Vec::new() };
    Ok(MeshData { vertices: points, triangles: triangles.to_vec(), normals, ..MeshData::default() })
}

fn shaded(data: MeshData, smooth: bool) -> MeshData {
    if smooth { data } else { MeshData { normals: Vec::new(), ..data } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_of_a_formula_are_shared_and_each_pair_of_lists_is_a_mesh_of_its_own() {
        let resources = Resources::new("");
        let mut builder = ShapeBuilder::new(&resources);
        let mut are_same = |source: &MeshSource| {
            let mesh = Mesh { source: source.clone(), smooth: None };
            let [a, b] = [0; 2].map(|_| mesh.shape(&mut builder).expect("it is valid"));
            a.is_same(&b)
        };
        let found: Vec<bool> = MeshSource::alternatives()[1..].iter().map(&mut are_same).collect();
        assert_eq!(found, [false, true, true], "lists, a knot, and hills");
    }

    #[test]
    fn normals_of_files_decide_which_side_of_a_smooth_mesh_is_the_front() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.obj");
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1//2 2//2 3//2\n";
        std::fs::write(&path, text).expect("it is written");
        let resources = Resources::new("");
        let triangles = |smooth| {
            let data = from_file(&resources, &resources.file(&path.display().to_string()), smooth).expect("it is a mesh");
            let corners = data.triangles.iter().map(|triangle| triangle.map(|vertex| data.vertices[vertex as usize]));
            corners.map(|[_, b, _]| b[0] == 1.0).collect::<Vec<_>>()
        };
        assert_eq!(triangles(Some(true)), [false, true], "the first triangle is turned round");
        assert_eq!(triangles(Some(false)), [true, true], "flat meshes do not read the normals");
    }

    #[test]
    fn colours_of_files_are_brought_into_their_range() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.ply");
        let types = ["x", "y", "z", "red", "green", "blue"].map(|name| format!("property float {name}\n")).concat();
        let text = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\n{types}element face 1\nproperty list uchar int vertex_indices\nend_header\n\
             0 0 0 0.5 2 -1\n1 0 0 0 0 0\n0 1 0 1 1 1\n3 0 1 2\n"
        );
        std::fs::write(&path, text).expect("it is written");
        let resources = Resources::new("");
        let data = from_file(&resources, &resources.file(&path.display().to_string()), Some(true)).expect("it is a mesh");
        assert_eq!(data.colours, [[0.5, 1.0, 0.0, 1.0], [0.0, 0.0, 0.0, 1.0], [1.0; 4]]);
    }
}
