//! Meshes that do not come from a file.
use rayon::prelude::*;

use super::{Model, Smoothing, normals};

impl Model {
    /// Memory of the lists, bytes.
    pub fn bytes(&self) -> u64 {
        let vertices = size_of_val(&self.vertices[..]) + size_of_val(&self.triangles[..]);
        let normals = self.normals.as_deref().map_or(0, size_of_val);
        let uvs = self.uvs.as_deref().map_or(0, size_of_val);
        let colours = self.colours.as_deref().map_or(0, size_of_val);
        let tangents = self.tangents.as_deref().map_or(0, size_of_val);
        let groups = if let Smoothing::Groups(groups) = &self.smoothing { size_of_val(&groups[..]) } else { 0 };
        (vertices + normals + uvs + colours + tangents + groups) as u64
    }

    /// The mesh as a reader returns it: with unit normals and finite coordinates. An error is the end of a sentence about the mesh.
    pub fn checked(mut self) -> Result<Model, String> {
        let count = self.vertices.len();
        if self.triangles.is_empty() {
            return Err("the mesh is empty: it has no faces".to_owned());
        }
        let missing = |triangle: &[u32; 3]| triangle.iter().find(|index| **index as usize >= count).copied();
        if let Some(index) = self.triangles.par_iter().find_map_first(missing) {
            return Err(format!("vertex {index} does not exist: there are {count}, counted from 0"));
        }
        if let Some(at) = self.vertices.par_iter().position_first(|vertex| !vertex.iter().all(|x| x.is_finite())) {
            return Err(format!("vertex {at} is not finite"));
        }
        let fours = [&self.colours, &self.tangents].map(|values| values.as_ref().map(Vec::len));
        let lengths = [self.normals.as_ref().map(Vec::len), self.uvs.as_ref().map(Vec::len), fours[0], fours[1]];
        if let Some(length) = lengths.into_iter().flatten().find(|length| *length != count) {
            return Err(format!("there are {count} vertices, and {length} values for them"));
        }
        if matches!(&self.smoothing, Smoothing::Groups(groups) if groups.len() != self.triangles.len()) {
            return Err("there is not one smoothing group for each triangle".to_owned());
        }
        let finite = |x: &mut f32| *x = if x.is_finite() { *x } else { 0.0 };
        self.uvs.iter_mut().flatten().flatten().for_each(finite);
        self.colours.iter_mut().flatten().flatten().for_each(finite);
        self.tangents.iter_mut().flatten().flatten().for_each(finite);
        if let Some(normals) = &mut self.normals {
            normals.iter_mut().flatten().for_each(finite);
            normals::complete(normals, &self.vertices, &self.triangles);
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Model {
        Model { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]], ..Model::default() }
    }

    #[test]
    fn normals_become_unit_vectors_and_coordinates_finite() {
        let normals = Some(vec![[0.0, 0.0, 3.0], [0.0; 3], [f32::NAN, 0.0, 0.0]]);
        let model = Model { normals, uvs: Some(vec![[f32::NAN, 1.0]; 3]), ..triangle() }.checked().expect("it is a mesh");
        assert_eq!((model.normals, model.uvs), (Some(vec![[0.0, 0.0, 1.0]; 3]), Some(vec![[0.0, 1.0]; 3])));
    }

    #[test]
    fn models_that_cannot_be_rendered_are_refused() {
        let refused = |model: Model, reason: &str| {
            assert!(model.checked().is_err_and(|error| error.contains(reason)), "{reason}");
        };
        refused(Model::default(), "no faces");
        refused(Model { triangles: vec![[0, 1, 3]], ..triangle() }, "vertex 3 does not exist");
        refused(Model { vertices: vec![[f32::INFINITY; 3]; 3], ..triangle() }, "vertex 0 is not finite");
        refused(Model { uvs: Some(Vec::new()), ..triangle() }, "0 values");
    }
}
