//! Meshes in PLY files.
use std::{io::Read, path::Path};

use super::{Areas, Built};
use crate::import::pbrt::{import::Import, parameters::Entity, source::unpacked};
use noisefall_base::file::open_regular;
use noisefall_scene::{model::decode_ply, scene::SceneError};

/// Longest header that is searched for normals.
const LONGEST_HEADER: u64 = 1 << 16;

impl Import {
    pub(super) fn ply_mesh(&mut self, entity: &Entity) -> Result<Built, SceneError> {
        let path = self.required_file(entity, "filename")?;
        self.remark_parameter(entity, "displacement", "the mesh without displacement", "its outline is smoother");
        entity.ignore(&["displacement.edgelength"]);
        let file_name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let name = file_name.split('.').next().unwrap_or_default().to_owned();
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz")) {
            return self.packed_mesh(entity, &path, &name);
        }
        let smooth = has_normals(&path);
        Ok(Built::mesh(&name, self.files.folder.described(&path), smooth, Areas::Unknown))
    }

    /// A mesh that is packed by gzip. Shapes with the same file share it.
    fn packed_mesh(&mut self, entity: &Entity, path: &Path, name: &str) -> Result<Built, SceneError> {
        let key = path.display().to_string();
        if let Some((known, smooth)) = self.packed_meshes.get(&key) {
            return Ok(Built::mesh(name, known.clone(), *smooth, Areas::Unknown));
        }
        let wrong = |message: String| entity.error(message, "this mesh cannot be used");
        let (bytes, _room) = unpacked(path, &self.files.folder).map_err(wrong)?;
        let read = decode_ply(&bytes, &self.files.folder.progress);
        let mut model = read.map_err(|problem| wrong(format!("`{name}`: {problem}")))?;
        super::meshes::face_normals(&mut model);
        let smooth = model.normals.is_some();
        let described = self.new_files.add_model(name, model);
        self.packed_meshes.insert(key, (described.clone(), smooth));
        Ok(Built::mesh(name, described, smooth, Areas::Unknown))
    }
}

/// Whether the header of a PLY file declares normals. Without them, triangles are flat.
fn has_normals(path: &Path) -> bool {
    let mut start = Vec::new();
    let read = open_regular(path).and_then(|file| file.take(LONGEST_HEADER).read_to_end(&mut start));
    let text = String::from_utf8_lossy(&start);
    let header = text.split("end_header").next().unwrap_or_default();
    read.is_ok() && header.lines().any(|line| line.starts_with("property") && line.trim_end().ends_with(" nx"))
}
