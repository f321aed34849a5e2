//! Trees of meshes, which the compile of a changed scene reuses.
use std::{
    collections::HashMap,
    sync::Arc,
    time::{Duration, Instant},
};

use glam::DAffine3;

use super::{
    Motion, Shape,
    identity::same_map,
    mesh::{Mesh, MeshData},
};
use noisefall_base::{
    declare::Precision,
    progress::{Cancelled, Progress, Stage},
};

/// The trees of the meshes of a scene.
#[derive(Clone, Default)]
pub(super) struct MeshTrees(Vec<MeshTree>);

/// The image of a mesh under `pose`, with its tree.
#[derive(Clone)]
struct MeshTree {
    data: Arc<MeshData>,
    pose: DAffine3,
    mesh: Arc<Mesh>,
}

impl MeshTrees {
    pub fn len(&self) -> usize {
        self.0.len()
    }

    fn find(&self, data: &Arc<MeshData>, pose: &DAffine3) -> Option<&MeshTree> {
        self.0.iter().find(|tree| Arc::ptr_eq(&tree.data, data) && same_map(&tree.pose, pose))
    }

    fn in_any_pose(&self, data: &Arc<MeshData>) -> Option<&MeshTree> {
        self.0.iter().find(|tree| Arc::ptr_eq(&tree.data, data))
    }
}

/// Places meshes. Each gets the tree of the previous compile, or a new one.
pub(super) struct MeshBuilder<'a> {
    /// Number of instances of the data.
    uses: HashMap<*const MeshData, usize>,
    before: Option<&'a MeshTrees>,
    precision: Precision,
    progress: &'a Progress,
    pub trees: MeshTrees,
    /// Whether some mesh has the tree of another pose.
    pub have_moved: bool,
    /// The time that each tree took to build; `None` for trees that were reused.
    pub times: Vec<Option<Duration>>,
}

impl<'a> MeshBuilder<'a> {
    pub fn new<'s>(
        shapes: impl Iterator<Item = (&'s Shape, &'s Motion)>,
        before: Option<&'a MeshTrees>,
        precision: Precision,
        progress: &'a Progress,
    ) -> MeshBuilder<'a> {
        let (mut uses, mut triangles) = (HashMap::new(), 0);
        for (shape, motion) in shapes {
            if let Shape::Mesh { data, .. } = shape {
                let uses = uses.entry(Arc::as_ptr(data)).or_insert(0);
                triangles += if *uses == 0 { data.triangles.len() as u64 } else { 0 };
                // A mesh that moves needs a space of its own as well.
                *uses += if motion.0.is_empty() { 1 } else { 2 };
            }
        }
        progress.expect(Stage::Trees, triangles);
        MeshBuilder { uses, before, precision, progress, trees: MeshTrees::default(), have_moved: false, times: Vec::new() }
    }

    /// The mesh with its tree, and the map from there to world space. A mesh with a single instance is built in world space.
    pub fn place(&mut self, data: &Arc<MeshData>, map: &DAffine3) -> Result<(Arc<Mesh>, DAffine3), Cancelled> {
        let is_single = self.uses.get(&Arc::as_ptr(data)).is_none_or(|uses| *uses == 1);
        let pose = if is_single { *map } else { DAffine3::IDENTITY };
        let still = if is_single { DAffine3::IDENTITY } else { *map };
        if let Some(tree) = self.known(|trees| trees.find(data, &pose)) {
            return Ok((self.take_over(tree), still));
        }
        if self.precision == Precision::Interactive
            && let Some(tree) = self.known(|trees| trees.in_any_pose(data))
        {
            self.have_moved = true;
            let moved = *map * tree.pose.inverse();
            return Ok((self.take_over(tree), moved));
        }
        let start = Instant::now();
        let mesh = Arc::new(Mesh::build(data, &pose, self.progress)?);
        self.times.push(Some(start.elapsed()));
        self.trees.0.push(MeshTree { data: data.clone(), pose, mesh: mesh.clone() });
        Ok((mesh, still))
    }

    /// The tree that `find` finds among those of this compile, or of the one before.
    fn known(&self, find: impl Fn(&MeshTrees) -> Option<&MeshTree>) -> Option<MeshTree> {
        find(&self.trees).or_else(|| find(self.before?)).cloned()
    }

    fn take_over(&mut self, tree: MeshTree) -> Arc<Mesh> {
        let mesh = tree.mesh.clone();
        if self.trees.find(&tree.data, &tree.pose).is_none() {
            self.times.push(None);
            self.trees.0.push(tree);
        }
        mesh
    }
}
