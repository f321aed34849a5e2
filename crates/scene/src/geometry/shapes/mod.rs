//! All shapes of a scene.
mod at_point;

use std::{cell::Cell, sync::Arc, time::Duration};

use fearless_simd_macros::simd;
use glam::{DAffine3, DVec3};

use super::{
    MISS, Motion, Nearest, SurfacePoint,
    borders::any_borders,
    bvh::{Search, Stacks, Visits},
    clusters::take_clusters,
    identity::same_map,
    instance::{Body, Instance},
    lists::Lists,
    mesh::Mesh,
    mesh_trees::{MeshBuilder, MeshTrees},
    object::{Object, ObjectKind},
    objects::{Objects, few_and_many},
    shape::{Outline, Shape},
    tables::Tables,
};
use noisefall_base::{
    declare::Precision,
    math::{F, Lanes, M, One, Pick, U, V},
    progress::{Cancelled, Progress},
};

thread_local! {
    /// Room for the boxes of the rays of this thread. It is kept, because filling it with zeros for every register of rays takes up to
    /// 4 % of their time.
    static STACKS: Cell<Option<Box<[Stacks; 2]>>> = const { Cell::new(None) };
}

/// All shapes of a scene.
#[derive(Default)]
pub struct Shapes {
    tables: Tables,
    instances: Vec<Instance>,
    /// Shapes that every ray tests: analytic ones, and indices of instances.
    lists: Lists,
    loops: Vec<u32>,
    /// Shapes in a tree.
    objects: Option<Objects>,
    /// The first primitive that is not in lists; [`MISS`] if all are.
    first_unlisted: u32,
    /// Whether there are meshes, whose triangles are elements.
    has_elements: bool,
    moves: bool,
    /// Number of degenerate triangles, which are left out.
    dropped: usize,
    /// The point that coordinates are anchored near.
    near: DVec3,
    meshes: MeshTrees,
    have_moved_meshes: bool,
    /// Whether some mesh has tangents.
    have_tangents: bool,
}

impl Shapes {
    /// Builds all shapes. Their pieces are numbered in order. `near` is a point in the middle of the scene.
    pub fn new<'a>(shapes: impl Iterator<Item = (&'a Shape, &'a Motion)> + Clone, near: DVec3) -> Shapes {
        Shapes::after(None, Precision::Exact, shapes, near, &Progress::default()).expect("nobody cancels").0
    }

    /// Builds all shapes, and reuses the mesh trees of the shapes `before` where `precision` allows it. Also returns the time that
    /// each of these trees took to build, or `None` for trees that are reused.
    pub fn after<'a>(
        before: Option<&Shapes>,
        precision: Precision,
        shapes: impl Iterator<Item = (&'a Shape, &'a Motion)> + Clone,
        near: DVec3,
        progress: &Progress,
    ) -> Result<(Shapes, Vec<Option<Duration>>), Cancelled> {
        let mut meshes = MeshBuilder::new(shapes.clone(), before.map(|before| &before.meshes), precision, progress);
        let have_borders = any_borders(shapes.clone().filter(|(_, motion)| motion.0.is_empty()).map(|(shape, _)| shape));
        let mut all = Shapes { tables: Tables::new(have_borders), near, first_unlisted: MISS, ..Shapes::default() };
        let mut objects = Vec::new();
        for (shape, motion) in shapes {
            let kind = all.push(shape, motion, &mut meshes, near)?;
            objects.push(Object { bounds: shape.bounds(motion), kind });
        }
        let [mut few, many] = few_and_many(objects);
        let first = |kind: &ObjectKind| match kind {
            ObjectKind::Analytic { first, .. } => *first,
            ObjectKind::Instance(index) => all.instances[*index as usize].first,
        };
        let looped = few.iter().filter(|object| matches!(object.kind, ObjectKind::Instance(_)));
        all.first_unlisted = looped.chain(&many).map(|object| first(&object.kind)).min().unwrap_or(MISS);
        all.lists.set_clusters(take_clusters(&mut few, near));
        for object in few {
            match object.kind {
                ObjectKind::Analytic { first, shape } => {
                    all.lists.push(first, shape, near);
                }
                ObjectKind::Instance(index) => all.loops.push(index),
            }
        }
        all.objects = (!many.is_empty()).then(|| Objects::new(&many, near));
        (all.meshes, all.have_moved_meshes) = (meshes.trees, meshes.have_moved);
        Ok((all, meshes.times))
    }

    /// Number of trees of meshes; meshes in the same pose share theirs.
    pub fn count_mesh_trees(&self) -> usize {
        self.meshes.len()
    }

    /// The point in the middle of the scene that they were built with.
    pub fn near(&self) -> DVec3 {
        self.near
    }

    /// Whether some mesh has the tree of another pose: see [`Precision::Interactive`].
    pub fn have_moved_meshes(&self) -> bool {
        self.have_moved_meshes
    }

    /// Whether a primitive has the same triangles in both, in the same pose, or none in either.
    pub fn has_same_triangles(&self, other: &Shapes, primitive: u32) -> bool {
        match (self.mesh_at(primitive), other.mesh_at(primitive)) {
            (Some((a, here)), Some((b, there))) => Arc::ptr_eq(a, b) && same_map(here.still(), there.still()),
            (None, None) => true,
            _ => false,
        }
    }

    /// The mesh that a primitive is, if it is one.
    fn mesh_at(&self, primitive: u32) -> Option<(&Arc<Mesh>, &Instance)> {
        let instance = &self.instances[self.tables.instance_at(primitive)?];
        if let Body::Mesh(mesh) = &instance.body { Some((mesh, instance)) } else { None }
    }

    /// Adds the pieces of a shape to the tables, but not to lists or trees.
    fn push<'a>(
        &mut self,
        shape: &'a Shape,
        motion: &Motion,
        meshes: &mut MeshBuilder,
        near: DVec3,
    ) -> Result<ObjectKind<'a>, Cancelled> {
        let first = self.tables.len() as u32;
        let (body, still) = match shape {
            Shape::Mesh { data, map, .. } => {
                self.has_elements = true;
                let (mesh, still) = meshes.place(data, map)?;
                self.dropped += mesh.dropped();
                self.have_tangents |= mesh.has_tangents();
                (Body::Mesh(mesh), still)
            }
            Shape::Isosurface { surface, map } => (Body::Isosurface(surface.clone()), *map),
            _ if motion.0.is_empty() => {
                self.tables.push_shape(shape, near);
                return Ok(ObjectKind::Analytic { first, shape });
            }
            _ => {
                let (mut tables, mut list) = <(Box<Tables>, Box<Lists>)>::default();
                tables.push_shape(shape, near);
                list.push(0, shape, near);
                (Body::Shape(tables, list), DAffine3::IDENTITY)
            }
        };
        self.moves |= !motion.0.is_empty();
        let index = self.instances.len();
        for _ in 0..shape.piece_count() {
            self.tables.push_instance(index);
        }
        self.instances.push(Instance::new(first, body, still, motion, shape));
        Ok(ObjectKind::Instance(index as u32))
    }

    /// The triangles of a mesh in the order of its elements.
    pub fn triangles(&self, primitive: u32) -> Vec<Shape> {
        let Some((mesh, instance)) = self.mesh_at(primitive) else { return Vec::new() };
        let triangle = |id: u32| {
            let [a, b, c] = mesh.corners(id).map(|corner| glam::Vec3::from(corner).as_dvec3());
            let flat = Shape::Flat { outline: Outline::Triangle, origin: a, edges: [b - a, c - a], mirrored: false };
            flat.transformed(instance.still())
        };
        (0..mesh.len() as u32).map(triangle).collect()
    }

    /// Whether primitives have elements.
    pub fn have_elements(&self) -> bool {
        self.has_elements
    }

    /// Whether any shape moves.
    pub fn move_in_time(&self) -> bool {
        self.moves
    }

    /// Number of degenerate triangles, which are left out.
    pub fn dropped_triangles(&self) -> usize {
        self.dropped
    }

    /// Whether objects are in a tree.
    #[cfg(test)]
    pub fn has_tree(&self) -> bool {
        self.objects.is_some()
    }

    /// The longest edge of the box around the tree.
    #[cfg(test)]
    pub fn tree_reach(&self) -> f32 {
        self.objects.as_ref().map_or(0.0, |objects| objects.bounds().size().into_iter().fold(0.0, f32::max))
    }

    /// Whether there are only static spheres, and few.
    pub fn are_spheres(&self) -> bool {
        self.instances.is_empty() && self.objects.is_none() && self.lists.are_spheres()
    }

    /// Whether there are only lists, and no trees.
    pub fn are_listed(&self) -> bool {
        self.objects.is_none() && self.loops.is_empty()
    }

    /// The primitives before this one are in lists, which rays test first.
    pub fn first_unlisted(&self) -> u32 {
        self.first_unlisted
    }

    /// Whether all surfaces are static spheres, or static, open and flat.
    pub fn are_simple(&self) -> bool {
        self.instances.is_empty() && self.tables.are_simple()
    }

    /// [`Shapes::closest`] for scenes whose shapes all [are spheres](Shapes::are_spheres).
    #[inline(always)]
    pub fn closest_sphere<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> Nearest<L> {
        let (t, primitive) = self.lists.closest_sphere(l, o, d);
        Nearest { t, primitive, element: l.u(0) }
    }

    /// [`Shapes::surface_point`] for scenes whose shapes all [are simple](Shapes::are_simple).
    #[inline(always)]
    pub fn simple_point<L: Lanes>(&self, l: L, primitive: U<L>, p: V<L>) -> SurfacePoint<L> {
        self.tables.simple_point(l, primitive, p)
    }

    /// The first surface along o + td, d of unit length, in the lanes of `live`.
    #[inline(always)]
    pub fn closest<L: Lanes>(&self, l: L, live: M<L>, o: V<L>, d: V<L>, time: F<L>) -> Nearest<L> {
        let listed = self.closest_listed(l, o, d);
        if self.are_listed() { listed } else { self.nearer(l, (live, l.f(0.0)), (o, d), time, listed) }
    }

    /// The first of the surfaces in lists.
    #[inline(always)]
    pub fn closest_listed<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> Nearest<L> {
        let (t, primitive) = self.lists.closest(l, o, d);
        Nearest { t, primitive, element: l.u(0) }
    }

    /// Work of one ray in trees, on its way to the first surface.
    pub fn visits(&self, (o, d): (V<One>, V<One>), time: F<One>) -> Visits {
        let mut stacks = <[Stacks<true>; 2]>::default();
        self.nearer_by(One, &mut stacks, (M(true), F(0.0)), (o, d), time, self.closest_listed(One, o, d));
        stacks.as_flattened().iter().fold(Visits::default(), |all, stack| all + stack.visits)
    }

    /// The first of the surfaces that are not in lists, in the lanes of `live`, or `listed` if that is nearer. Any before `enough` will
    /// do: for rays that only ask whether something is in their way. A call, which scenes of lists do not make.
    #[simd]
    pub fn nearer<L: Lanes>(
        &self,
        l: L,
        (live, enough): (M<L>, F<L>),
        ray: (V<L>, V<L>),
        time: F<L>,
        listed: Nearest<L>,
    ) -> Nearest<L> {
        let mut stacks = STACKS.take().unwrap_or_default();
        let nearest = self.nearer_by(l, &mut stacks, (live, enough), ray, time, listed);
        STACKS.set(Some(stacks));
        nearest
    }

    /// Implements [`Shapes::nearer`], with stacks for the boxes of the tree over objects and of the trees below.
    #[inline(always)]
    fn nearer_by<L: Lanes, const COUNTS: bool>(
        &self,
        l: L,
        stacks: &mut [Stacks<COUNTS>; 2],
        (mut live, enough): (M<L>, F<L>),
        (o, d): (V<L>, V<L>),
        time: F<L>,
        listed: Nearest<L>,
    ) -> Nearest<L> {
        let mut nearest = listed;
        for &index in &self.loops {
            let instance = &self.instances[index as usize];
            let near = instance.near(live, o, d);
            if !near.any() {
                continue;
            }
            let search = Search { limit: near.pick(nearest.t, l.f(0.0)), enough };
            let found = instance.closest(l, &mut stacks[1], (o, d), time, search);
            let nearer = found.t.lt(nearest.t);
            nearest.t = nearer.pick(found.t, nearest.t);
            nearest.primitive = nearer.pick(found.piece + instance.first, nearest.primitive);
            nearest.element = nearer.pick(found.element, nearest.element);
            live = live & !(nearer & nearest.t.lt(enough));
        }
        if let Some(objects) = &self.objects
            && live.any()
        {
            objects.closest(l, &self.instances, stacks, (live, enough), ((o, d), time), &mut nearest);
        }
        nearest
    }
}
