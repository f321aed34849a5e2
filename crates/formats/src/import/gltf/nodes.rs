//! The hierarchy of nodes.
use glam::{DAffine3, DMat3, DVec3};

use super::{
    accessor::{Column, Picks},
    animation::{Poses, quaternion},
    buffers::Buffers,
    document::{Document, Index, Node, element},
    refusal::{Found, Refusal},
};

/// Where nodes are.
pub struct Hierarchy {
    /// From each node to the world.
    pub worlds: Vec<DAffine3>,
    /// The nodes of the scene, parents before their children.
    pub shown: Vec<Index>,
}

impl Hierarchy {
    /// Follows the nodes. A node with two parents, or one that is its own ancestor, is refused.
    pub fn new(document: &Document, poses: &Poses) -> Found<Hierarchy> {
        let parents = parents(document)?;
        let mut worlds = vec![DAffine3::IDENTITY; document.nodes.len()];
        let roots = (0..parents.len() as u32).filter(|node| parents[*node as usize].is_none()).collect();
        let reached = descend(document, roots, |node, parent: Option<Index>| {
            let local = local(&document.nodes[node as usize], node, poses);
            worlds[node as usize] = parent.map_or(local, |parent| worlds[parent as usize] * local);
        });
        if reached.len() < parents.len() {
            return Err("a node is its own ancestor".into());
        }
        let roots = match document.scene.or((!document.scenes.is_empty()).then_some(0)) {
            Some(scene) => element(&document.scenes, scene, "scene")?.nodes.clone(),
            None => (0..parents.len() as u32).filter(|node| parents[*node as usize].is_none()).collect(),
        };
        if let Some(node) = roots.iter().find(|node| **node as usize >= parents.len()) {
            return Err(format!("the scene names node {node}; there are {}", parents.len()).into());
        }
        Ok(Hierarchy { worlds, shown: descend(document, roots, |_, _| {}) })
    }

    /// For each joint of a skin, the map from the mesh at its bind pose to the world.
    pub fn joints(&self, document: &Document, buffers: &Buffers, skin: Index) -> Found<Vec<DAffine3>> {
        let skin = element(&document.skins, skin, "skin")?;
        let binds = match skin.inverse_bind_matrices {
            Some(index) => {
                let column = Column::open(document, buffers, index)?;
                column.reals::<16>(&Picks::First(column.count.min(skin.joints.len())))?
            }
            None => Vec::new(),
        };
        let joint = |(place, joint): (usize, &Index)| {
            let world = element(&self.worlds, *joint, "node")?;
            let bind = binds.get(place).map_or(DAffine3::IDENTITY, |numbers| affine(&numbers.map(f64::from)));
            Ok(*world * bind)
        };
        skin.joints.iter().enumerate().map(joint).collect()
    }
}

fn parents(document: &Document) -> Found<Vec<Option<Index>>> {
    let mut parents = vec![None; document.nodes.len()];
    for (node, children) in document.nodes.iter().map(|node| &node.children).enumerate() {
        for child in children {
            let parent = parents.get_mut(*child as usize).ok_or_else(|| Refusal::from(format!("there is no node {child}")))?;
            if parent.replace(node as Index).is_some() {
                return Err(format!("node {child} has two parents").into());
            }
        }
    }
    Ok(parents)
}

/// Visits nodes and all below them, parents first, each once. The nodes form trees of any depth.
fn descend(document: &Document, roots: Vec<Index>, mut visit: impl FnMut(Index, Option<Index>)) -> Vec<Index> {
    let mut is_known = vec![false; document.nodes.len()];
    let mut order = Vec::new();
    let mut waiting: Vec<(Index, Option<Index>)> = roots.into_iter().rev().map(|root| (root, None)).collect();
    while let Some((node, parent)) = waiting.pop() {
        if std::mem::replace(&mut is_known[node as usize], true) {
            continue;
        }
        visit(node, parent);
        order.push(node);
        waiting.extend(document.nodes[node as usize].children.iter().rev().map(|child| (*child, Some(node))));
    }
    order
}

/// From a node to its parent.
fn local(node: &Node, index: Index, poses: &Poses) -> DAffine3 {
    let pose = poses.by_node.get(&index).cloned().unwrap_or_default();
    let is_posed = pose.translation.is_some() || pose.rotation.is_some() || pose.scale.is_some();
    if let Some(matrix) = &node.matrix
        && !is_posed
    {
        return affine(matrix);
    }
    let translation = pose.translation.or(node.translation.as_deref().copied()).unwrap_or_default();
    let rotation = pose.rotation.or(node.rotation.as_deref().copied()).map_or(glam::DQuat::IDENTITY, quaternion);
    let scale = pose.scale.or(node.scale.as_deref().copied()).unwrap_or([1.0; 3]);
    DAffine3::from_scale_rotation_translation(scale.into(), rotation, translation.into())
}

/// A matrix of the file, column by column. Its last row is 0, 0, 0, 1.
fn affine(m: &[f64; 16]) -> DAffine3 {
    let column = |i: usize| DVec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) }
}
