//! Small files that ask for much: what a scene makes of its files has one budget.
use std::io::Write;

use flate2::{Compression, write::GzEncoder};

use super::{SceneFolder, remarks};
use noisefall_scene::model::Model;

/// A triangle, and bytes behind it that pack well.
const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
                        property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

impl SceneFolder {
    /// Adds a packed file.
    fn pack(&self, name: &str, start: &str, filler: &str, bytes: usize) {
        let mut packer = GzEncoder::new(std::fs::File::create(self.0.path().join(name)).expect("a file"), Compression::fast());
        packer.write_all(start.as_bytes()).expect("it is packed");
        let block = filler.repeat((1 << 16) / filler.len());
        (0..bytes / block.len()).for_each(|_| packer.write_all(block.as_bytes()).expect("it is packed"));
        packer.finish().expect("it is packed");
    }

    fn refusal(&self) -> String {
        self.read()
            .err()
            .expect("it is refused")
            .report()
            .replace(['\n', '│'], " ")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    }
}

#[test]
fn packed_files_of_a_scene_unpack_to_little_more_than_their_size_together() {
    const FAR_MORE: &str = "the packed files of the scene unpack to far more than their size";
    let text = SceneFolder::new(&[("a.pbrt", "WorldBegin\nInclude \"b.pbrt.gz\"\n")]);
    text.pack("b.pbrt.gz", "# a long scene\n", " ", 160 << 20);
    assert!(text.refusal().contains(FAR_MORE), "{}", text.refusal());
    let mesh = |number: usize| format!("Shape \"plymesh\" \"string filename\" \"{number}.ply.gz\"\n");
    let meshes = SceneFolder::new(&[("a.pbrt", &format!("WorldBegin\n{}", (0..24).map(mesh).collect::<String>()))]);
    (0..24).for_each(|number| meshes.pack(&format!("{number}.ply.gz"), TRIANGLE, " ", 6 << 20));
    assert!(meshes.refusal().contains(FAR_MORE), "{}", meshes.refusal());
    let few = SceneFolder::new(&[("a.pbrt", &format!("WorldBegin\n{}", (0..4).map(mesh).collect::<String>()))]);
    (0..4).for_each(|number| few.pack(&format!("{number}.ply.gz"), TRIANGLE, " ", 6 << 20));
    assert_eq!(few.read().unwrap_or_else(|error| panic!("{}", error.report())).description.objects.len(), 4);
}

#[test]
fn a_mesh_whose_header_has_no_end_is_refused() {
    let scene = SceneFolder::new(&[("a.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"a.ply.gz\"\n")]);
    let start = "ply\nformat ascii 1.0\nelement vertex 3\n";
    scene.pack("a.ply.gz", start, "property char a\n", 32 << 20);
    assert!(scene.refusal().contains("the header is longer than"), "{}", scene.refusal());
}

#[test]
fn subdivisions_and_patches_of_a_scene_have_a_budget_of_triangles_together() {
    let cube = "Shape \"loopsubdiv\" \"integer levels\" 9 \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \
                \"integer indices\" [0 2 1 0 1 3 1 2 3 2 0 3]\n";
    let count = 12;
    let scene = SceneFolder::new(&[("a.pbrt", &format!("WorldBegin\n{}", cube.repeat(count)))]);
    let imported = scene.read().unwrap_or_else(|error| panic!("{}", error.report()));
    assert_eq!(imported.description.objects.len(), count);
    let triangles = imported.assets.paths().filter_map(|path| imported.assets.get::<Model>(path));
    let triangles: usize = triangles.map(|model| model.triangles.len()).sum();
    assert!((1 << 20..1 << 22).contains(&triangles), "{triangles}");
    assert!(remarks(&imported).iter().any(|line| line.contains("levels of subdivision")), "{:?}", remarks(&imported));
}
