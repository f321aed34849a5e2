//! Objects: the primitives of the meshes, at the nodes that show them. Equal triangles are one model.
use std::{cell::OnceCell, collections::HashMap, rc::Rc};

use glam::{DAffine3, DVec3, Vec3};

use super::{
    animation::Poses,
    buffers::Buffers,
    document::{Attributes, Document, Index, Mesh, Primitive, UvMap, Wanted, element},
    images::file_name,
    instancing,
    materials::Materials,
    nodes::Hierarchy,
    refusal::{Found, Refusal},
    triangles::Mode,
    vertices::{Deformation, Vertices},
};
use crate::import::{Imported, Names, lighting};
use noisefall_scene::{
    model::Model,
    scene::description::{ObjectDescription, Transform},
    shape::mesh,
};

/// Objects that any file may have, and the bytes of a file that allow a further one.
const MOST: u64 = 250_000;
pub const BYTES_OF_FILE: u64 = 150;
/// Limits of scale factors, and the least volume of a unit cube relative to its edges: beyond them a transform flattens.
const SCALES: std::ops::RangeInclusive<f64> = 1e-12..=1e12;
const FLATTEST: f64 = 1e-9;

/// Makes the objects of the description.
pub struct Instances<'a> {
    document: &'a Document,
    vertices: Vertices<'a>,
    hierarchy: &'a Hierarchy,
    poses: &'a Poses,
    materials: Materials<'a>,
    /// Name of the file, in remarks.
    file: &'a str,
    /// The variant of the materials.
    pub variant: Option<Index>,
    /// The largest number of objects.
    pub most: u64,
    /// Least and greatest coordinates of all objects, metres.
    pub bounds: [DVec3; 2],
    /// Of each object that emits, m².
    pub areas: Vec<f64>,
    models: HashMap<Key, Option<Rc<AssetModel>>>,
    files: Names,
    names: Names,
    /// By skin.
    joints: HashMap<Index, Rc<[DAffine3]>>,
    /// Primitives at nodes so far, also those that show nothing.
    visited: u64,
}

/// Key of the triangles of a primitive.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Key {
    attributes: Attributes,
    indices: Option<Index>,
    mode: Mode,
    map: UvMap,
    /// Whether it has tangents, of the file or not.
    has_tangents: bool,
    /// Mesh and primitive, and the node if its pose matters; only of deformed primitives.
    deformed: Option<(Index, usize, Option<Index>)>,
}

/// A model in the assets.
struct AssetModel {
    path: String,
    bounds: [DVec3; 2],
    has_normals: bool,
    /// Computed where it emits, m².
    area: OnceCell<f64>,
}

/// A node that shows a mesh.
struct Shown<'s> {
    node: Index,
    name: &'s str,
    mesh: Index,
    deformation: Deformation,
    /// Whether the deformation is that of this node alone.
    is_posed: bool,
}

impl<'a> Instances<'a> {
    pub fn new(
        document: &'a Document,
        buffers: &'a Buffers,
        hierarchy: &'a Hierarchy,
        poses: &'a Poses,
        materials: Materials<'a>,
        file: &'a str,
    ) -> Instances<'a> {
        Instances {
            document,
            vertices: Vertices::new(document, buffers),
            hierarchy,
            poses,
            materials,
            file,
            variant: None,
            most: MOST,
            bounds: [DVec3::INFINITY, DVec3::NEG_INFINITY],
            areas: Vec::new(),
            models: HashMap::new(),
            files: Names::default(),
            names: Names::default(),
            joints: HashMap::new(),
            visited: 0,
        }
    }

    /// Adds an object for every primitive at every node of the scene.
    pub fn add(&mut self, to: &mut Imported) -> Found<()> {
        let document = self.document;
        for node in &self.hierarchy.shown {
            let described = &document.nodes[*node as usize];
            let Some(mesh) = described.mesh else { continue };
            let primitives = element(&document.meshes, mesh, "mesh")?;
            let weights = self.poses.by_node.get(node).and_then(|pose| pose.weights.clone());
            let weights = weights.or_else(|| (!described.weights.is_empty()).then(|| described.weights.clone()));
            let is_posed = weights.is_some() || described.skin.is_some();
            let weights = weights.map_or_else(|| self.weights(primitives), Ok)?;
            let joints = described.skin.map(|skin| self.joints(skin)).transpose()?.unwrap_or_default();
            let shown = Shown {
                node: *node,
                name: if described.name.is_empty() { &primitives.name } else { &described.name },
                mesh,
                is_posed,
                deformation: Deformation { weights, joints },
            };
            for world in self.places(to, &shown)? {
                self.add_mesh(to, &shown, primitives, &world)?;
            }
        }
        Ok(())
    }

    /// The maps to the world at which a node shows its mesh: one, or one for each copy.
    fn places(&self, to: &mut Imported, shown: &Shown) -> Found<Vec<DAffine3>> {
        let extensions = self.document.nodes[shown.node as usize].extensions.as_deref();
        let described = extensions.and_then(|extensions| extensions.instancing.as_deref());
        // A skin puts vertices in the world, whatever the transform of the node.
        if !shown.deformation.joints.is_empty() {
            if described.is_some() {
                let place = format!("{}: node \"{}\"", self.file, shown.name);
                to.remarks.add(place, "copies of a mesh with a skin", "the mesh once", "the copies are missing");
            }
            return Ok(vec![DAffine3::IDENTITY]);
        }
        let world = self.hierarchy.worlds[shown.node as usize];
        let Some(described) = described else { return Ok(vec![world]) };
        let within = |error: Refusal| error.within(&format!("node {} \"{}\"", shown.node, shown.name));
        let copies = instancing::copies(self.document, self.vertices.buffers, described).map_err(within)?;
        Ok(copies.into_iter().map(|copy| world * copy).collect())
    }

    /// The weights of a mesh, for a node without its own.
    fn weights(&self, mesh: &Mesh) -> Found<Vec<f64>> {
        self.vertices.buffers.spend(8 * mesh.weights.len() as u64, "weights of morph targets")?;
        Ok(mesh.weights.clone())
    }

    fn joints(&mut self, skin: Index) -> Found<Rc<[DAffine3]>> {
        if !self.joints.contains_key(&skin) {
            let joints = self.hierarchy.joints(self.document, self.vertices.buffers, skin)?;
            self.joints.insert(skin, joints.into());
        }
        Ok(self.joints[&skin].clone())
    }

    fn add_mesh(&mut self, to: &mut Imported, shown: &Shown, mesh: &Mesh, world: &DAffine3) -> Found<()> {
        if !is_invertible(world) {
            let place = format!("{}: node \"{}\"", self.file, shown.name);
            to.remarks.add(
                place,
                "a transform that flattens the mesh, or scales it beyond 1e-12 to 1e12",
                "nothing",
                "it is missing",
            );
            return Ok(());
        }
        for (place, primitive) in mesh.primitives.iter().enumerate() {
            let within = |error: Refusal| error.within(&format!("mesh {} \"{}\"", shown.mesh, mesh.name));
            self.add_primitive(to, shown, (place, primitive), world).map_err(within)?;
        }
        Ok(())
    }

    fn add_primitive(
        &mut self,
        to: &mut Imported,
        shown: &Shown,
        (at, primitive): (usize, &Primitive),
        world: &DAffine3,
    ) -> Found<()> {
        self.visit(primitive)?;
        let place = format!("{}: mesh \"{}\"", self.file, self.document.meshes[shown.mesh as usize].name);
        if let Mode::None(what) = Mode::of(primitive.mode)? {
            to.remarks.add(place, format!("a primitive of {what}"), "nothing", "they have no surface and are missing");
            return Ok(());
        }
        check(to, primitive, &place);
        let material = self.material(primitive);
        let surface = self.materials.surface(primitive, material)?;
        let wanted = Wanted { uvs: surface.uvs, map: surface.map, tangents: self.materials.follows_tangents(material) };
        let Some(known) = self.model(to, shown, (at, primitive), &wanted)? else {
            to.remarks.add(place, "a primitive without triangles, or of one point", "nothing", "there is nothing to see");
            return Ok(());
        };
        if to.description.objects.len() as u64 >= self.most {
            return Err(Refusal::new(format!("it has more than {} objects", self.most), "join meshes, or split the file"));
        }
        let made = self.materials.make(to, material, &surface)?;
        self.enlarge(&known.bounds, world);
        self.areas.push(if made.emission.is_some() { area(to, &known, world) } else { 0.0 });
        let shape = mesh::Mesh {
            source: mesh::MeshSource::File(known.path.clone()),
            // Without normals, glTF wants flat triangles.
            smooth: (!known.has_normals).then_some(false),
        };
        to.description.objects.push(ObjectDescription {
            name: self.names.unique(shown.name, "object"),
            shape: shape.into(),
            material: Some(made.name),
            emission: made.emission,
            transform: Transform::list_of(world),
            ..ObjectDescription::default()
        });
        Ok(())
    }

    /// Counts a primitive at a node: nodes and primitives multiply, and those that show nothing take time too.
    fn visit(&mut self, primitive: &Primitive) -> Found<()> {
        const VISITS: u64 = 2;
        self.visited += 1;
        if self.visited > VISITS * self.most {
            return Err(Refusal::new("its nodes repeat too many primitives", "join primitives, or split the file"));
        }
        self.vertices.buffers.spend(16 * primitive.targets.len() as u64, "morph targets")
    }

    /// The material of a primitive in the chosen variant.
    fn material(&self, primitive: &Primitive) -> Option<Index> {
        let variants = primitive.extensions.as_deref().and_then(|extensions| extensions.variants.as_deref());
        let mapping = self
            .variant
            .zip(variants)
            .and_then(|(wanted, found)| found.mappings.iter().find(|mapping| mapping.variants.contains(&wanted)));
        mapping.map(|mapping| mapping.material).or(primitive.material)
    }

    /// The model of a primitive; `None` if there is nothing to see.
    fn model(
        &mut self,
        to: &mut Imported,
        shown: &Shown,
        (at, primitive): (usize, &Primitive),
        wanted: &Wanted,
    ) -> Found<Option<Rc<AssetModel>>> {
        let deformation = &shown.deformation;
        let is_morphed = primitive.targets.iter().zip(&deformation.weights).any(|(_, weight)| *weight != 0.0);
        let is_deformed = is_morphed || !deformation.joints.is_empty();
        let key = Key {
            attributes: primitive.attributes.visible(wanted),
            indices: primitive.indices,
            mode: Mode::of(primitive.mode)?,
            map: wanted.map,
            has_tangents: wanted.tangents,
            deformed: is_deformed.then(|| (shown.mesh, at, shown.is_posed.then_some(shown.node))),
        };
        if let Some(known) = self.models.get(&key) {
            return Ok(known.clone());
        }
        let model = self.vertices.model(primitive, wanted, deformation)?;
        if self.vertices.colours_were_cut.take() {
            let place = format!("{}: mesh \"{}\"", self.file, self.document.meshes[shown.mesh as usize].name);
            to.remarks.add(place, "COLOR_0 beyond 0 and 1", "the nearest colours in range", "the surface is less bright");
        }
        let known = model.and_then(|model| self.keep(to, model, &self.document.meshes[shown.mesh as usize].name)).map(Rc::new);
        self.models.insert(key, known.clone());
        Ok(known)
    }

    /// Adds a model to the assets; `None` if it is a point.
    fn keep(&mut self, to: &mut Imported, model: Model, name: &str) -> Option<AssetModel> {
        let points = || model.vertices.iter().map(|vertex| Vec3::from(*vertex));
        let least = points().fold(Vec3::INFINITY, Vec3::min).as_dvec3();
        let greatest = points().fold(Vec3::NEG_INFINITY, Vec3::max).as_dvec3();
        if least == greatest {
            return None;
        }
        let path = format!("meshes/{}.ply", self.files.unique(&file_name(name), "mesh"));
        let known = AssetModel {
            path: path.clone(),
            bounds: [least, greatest],
            has_normals: model.normals.is_some(),
            area: OnceCell::new(),
        };
        to.assets.insert(path, model);
        Some(known)
    }

    fn enlarge(&mut self, [least, greatest]: &[DVec3; 2], world: &DAffine3) {
        for corner in 0..8 {
            let pick = |axis: usize| if corner >> axis & 1 == 0 { least[axis] } else { greatest[axis] };
            let corner = world.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
            self.bounds = [self.bounds[0].min(corner), self.bounds[1].max(corner)];
        }
    }
}

/// The area of a model at a node, m². For uneven scales it is a mean over directions.
fn area(to: &Imported, model: &AssetModel, world: &DAffine3) -> f64 {
    let of_model = || to.assets.get::<Model>(&model.path).map_or(0.0, |model| lighting::area(&model));
    model.area.get_or_init(of_model) * world.matrix3.determinant().abs().powf(2.0 / 3.0)
}

/// Remarks on parts of a primitive that are not read.
fn check(to: &mut Imported, primitive: &Primitive, place: &str) {
    if primitive.targets.iter().any(|target| target.color.is_some() || (0..4).any(|set| target.uvs(set).is_some())) {
        let found = "morph targets of colours or texture coordinates";
        to.remarks.add(place, found, "those at rest", "textures do not follow the pose");
    }
}

/// Whether a scene description accepts the transform.
fn is_invertible(map: &DAffine3) -> bool {
    let m = &map.matrix3;
    let lengths = [m.x_axis, m.y_axis, m.z_axis].map(DVec3::length);
    let is_in_range = map.is_finite() && lengths.iter().all(|length| SCALES.contains(length));
    is_in_range && m.determinant().abs() > FLATTEST * lengths.iter().product::<f64>()
}
