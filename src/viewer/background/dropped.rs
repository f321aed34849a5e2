//! Finds out what a file is that was dropped on the window. Files are read for that, on other threads.
use std::{
    collections::VecDeque,
    path::{Path, PathBuf},
};

use glam::DVec3;
use noisefall_base::file::open_regular;
use noisefall_scene::{
    image::{Encoding, Picture, embedded_text, read as read_image},
    model::{Model, read as read_model},
};

use super::background_task::BackgroundTask;

/// A file and what it is for.
#[derive(Clone, Debug, PartialEq)]
pub enum DroppedFile {
    /// A scene, or an image that carries one.
    Scene(PathBuf),
    /// A mesh, and the corners of its box in metres.
    Mesh(PathBuf, [DVec3; 2]),
    /// An image for a surface.
    Texture(PathBuf),
    /// An image of all directions.
    Sky(PathBuf),
    /// An image to compare with.
    Reference(PathBuf),
}

/// The dropped file, or the reason why it cannot be used, and the pixel that it was dropped on, if the pointer was over one.
pub type DropResult = (Result<DroppedFile, String>, Option<[u32; 2]>);

/// A file that was dropped.
struct Pending {
    path: PathBuf,
    /// Resolution of the rendered image.
    resolution: [u32; 2],
    /// The pixel that it was dropped on.
    pixel: Option<[u32; 2]>,
}

/// Reads files one by one, in the order in which they were dropped.
pub struct DropReader {
    ctx: egui::Context,
    /// The first one is being read if there is a task.
    pending: VecDeque<Pending>,
    task: Option<BackgroundTask<Result<DroppedFile, String>>>,
}

impl DropReader {
    pub fn new(ctx: &egui::Context) -> DropReader {
        DropReader { ctx: ctx.clone(), pending: VecDeque::new(), task: None }
    }

    /// Reads a file that was dropped on a pixel, if the pointer was over one. `resolution` is that of the rendered image.
    pub fn read(&mut self, path: PathBuf, resolution: [u32; 2], pixel: Option<[u32; 2]>) {
        self.pending.push_back(Pending { path, resolution, pixel });
        self.start();
    }

    /// Takes the next file, or the reason why it cannot be used, and the pixel that it was dropped on, if it has been read.
    pub fn take(&mut self) -> Option<DropResult> {
        let failed = |_| Err("Reading the file failed unexpectedly".to_owned());
        let file = BackgroundTask::take(&mut self.task)?.unwrap_or_else(failed);
        let Pending { pixel, .. } = self.pending.pop_front()?;
        self.start();
        Some((file, pixel))
    }

    /// The name of the file that is being read.
    pub fn reading(&self) -> Option<String> {
        let Pending { path, .. } = self.pending.front().filter(|_| self.task.is_some())?;
        Some(path.file_name().unwrap_or_default().to_string_lossy().into_owned())
    }

    /// Forgets the files: they were dropped on another scene.
    pub fn forget(&mut self) {
        self.pending.clear();
        self.task = None;
    }

    fn start(&mut self) {
        if let Some(Pending { path, resolution, .. }) = self.pending.front().filter(|_| self.task.is_none()) {
            let (path, resolution) = (path.clone(), *resolution);
            self.task = Some(BackgroundTask::start(&self.ctx, move |_| purpose(path, resolution)));
        }
    }
}

fn purpose(path: PathBuf, resolution: [u32; 2]) -> Result<DroppedFile, String> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        Some("toml" | "nf" | "gltf" | "glb" | "xml" | "pbrt") => Ok(DroppedFile::Scene(path)),
        Some("obj" | "ply" | "stl") => {
            let model = read_model(&path).map_err(|error| error.to_string())?;
            Ok(DroppedFile::Mesh(path, bounds(&model)))
        }
        Some("png") if carries_scene(&path) => Ok(DroppedFile::Scene(path)),
        Some("png" | "jpg" | "jpeg" | "tga" | "webp" | "bmp") => {
            image(&path)?;
            Ok(DroppedFile::Texture(path))
        }
        // An image that this program rendered is a reference; so is one of the same size by another program.
        Some("exr") if carries_scene(&path) => Ok(DroppedFile::Reference(path)),
        Some("exr" | "hdr" | "pfm") => {
            let Picture { width, height, .. } = image(&path)?;
            let is_sky = width == 2 * height && [width, height] != resolution;
            Ok(if is_sky { DroppedFile::Sky(path) } else { DroppedFile::Reference(path) })
        }
        _ => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            Err(format!(
                "{name} cannot be used. Drop a scene (TOML, glTF, GLB, XML, PBRT), a mesh (OBJ, PLY, STL), a texture (PNG, JPEG, TGA, WebP, BMP), or a sky or \
                 reference (EXR, HDR, PFM)."
            ))
        }
    }
}

fn image(path: &Path) -> Result<Picture, String> {
    read_image(path, Encoding::Srgb).map_err(|error| error.to_string())
}

fn carries_scene(path: &Path) -> bool {
    open_regular(path).ok().and_then(embedded_text).is_some()
}

/// The corners of the box around all triangles.
fn bounds(model: &Model) -> [DVec3; 2] {
    let corners = model.triangles.iter().flatten().map(|vertex| DVec3::from(model.vertices[*vertex as usize].map(f64::from)));
    corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[min, max], corner| [min.min(corner), max.max(corner)])
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// The file of a grey Radiance image.
    pub fn hdr(width: usize, height: usize) -> Vec<u8> {
        let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
        bytes.extend(std::iter::repeat_n([128, 128, 128, 129], width * height).flatten());
        bytes
    }

    #[test]
    fn files_are_known_by_name_and_content() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = |name: &str, bytes: &[u8]| {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).expect("it is written");
            path
        };
        let of = |path: &PathBuf| purpose(path.clone(), [40, 20]);
        let scene = file("scene.TOML", b"");
        assert_eq!(of(&scene), Ok(DroppedFile::Scene(scene.clone())));
        let mesh = file("mesh.obj", b"v 0 0 1\nv 2 0 0\nv 0 -3 0\nv 9 9 9\nf 1 2 3\n");
        let corners = [DVec3::new(0.0, -3.0, 0.0), DVec3::new(2.0, 0.0, 1.0)];
        assert_eq!(of(&mesh), Ok(DroppedFile::Mesh(mesh.clone(), corners)), "no triangle has the last vertex");
        let sky = file("sky.hdr", &hdr(8, 4));
        assert_eq!(of(&sky), Ok(DroppedFile::Sky(sky.clone())));
        for size in [[8, 5], [40, 20]] {
            let reference = file("reference.hdr", &hdr(size[0], size[1]));
            assert_eq!(of(&reference), Ok(DroppedFile::Reference(reference.clone())), "{size:?}");
        }
        let texture = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/icon.png");
        assert_eq!(of(&texture), Ok(DroppedFile::Texture(texture.clone())));
    }

    #[test]
    fn unusable_files_are_refused_with_a_reason() {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, reason) in [
            ("notes.txt", "notes.txt cannot be used"),
            ("no_name", "Drop a scene"),
            ("a.ply", "not a mesh"),
            ("a.jpg", "not an image"),
        ] {
            let path = folder.path().join(name);
            std::fs::write(&path, "text").expect("it is written");
            let refusal = purpose(path, [1, 1]).expect_err("it is no such file");
            assert!(refusal.contains(reason), "{name}: {refusal}");
        }
        assert!(purpose("no/such.obj".into(), [1, 1]).is_err());
    }
}
