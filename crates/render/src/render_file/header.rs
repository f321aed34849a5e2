//! The header of a render file.
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::NamedFile;
use noisefall_base::quote;
use noisefall_scene::scene::{Camera, RenderSettings};

/// Everything that the image of a file depends on, and how far it is rendered. JSON in the file; later programs may add keys.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Type of the file, which decides its sections.
    pub kind: Kind,
    /// Name, version and commit of the program that wrote the file.
    pub program: String,
    /// The scene.
    pub scene: CheckpointScene,
    /// The camera, with the resolution of the image.
    pub camera: Camera,
    /// The settings of the estimate.
    pub settings: RenderSettings,
    /// Where the render stops.
    #[serde(default)]
    pub target: Target,
    /// The files that the scene names.
    pub files: Vec<NamedFile>,
    /// Hashes of the first sample of some tiles, by their place in the film. Another scene or program would give others.
    pub probe: Vec<(u32, String)>,
    /// Figures of the render.
    pub counters: Counters,
    /// Which samples of every pixel a file of [`Kind::Samples`] holds: ranges of indices, the second number excluded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub samples: Vec<[u32; 2]>,
    /// Facts of the scene for the image of a file of [`Kind::Samples`], which is made without the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageFacts>,
    /// How the image differs from one that was rendered in one go, if it does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
}

/// Facts of a scene that its image states and depends on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ImageFacts {
    /// Title of the scene.
    pub title: String,
    /// Exposure of the scene in stops.
    pub exposure: f32,
    /// Whether pixels reuse suffixes or outliers, or merge vertices.
    pub shares: bool,
}

/// Purpose of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The state of a render, which continues with its next sample.
    Progress,
    /// Some samples of every pixel, to be joined with others.
    Samples,
}

/// A scene, and how it is opened again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckpointScene {
    /// Its text in our format.
    pub text: String,
    /// Name of the file that it was read from.
    pub name: String,
    /// The absolute path of the folder of that file.
    pub folder: String,
    /// How the file of another program is read; absent for scenes of ours, which are read from `text`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub choices: Option<SceneChoices>,
}

/// Choices of the user about the file of another program.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneChoices {
    /// Values of parameters: `-D`.
    pub defines: Vec<(String, String)>,
    /// Time of animations: `--at`.
    pub time: Option<f64>,
    /// Variant of materials: `--variant`.
    pub variant: Option<String>,
    /// Size of the image, which cameras of glTF ask for: `--size`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<[u32; 2]>,
    /// Whether files outside of the folder may be read: `--allow-outside`.
    pub allow_outside: bool,
}

/// Where a render stops: at the first of these.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Samples per pixel.
    pub spp: Option<u32>,
    /// Seconds of rendering.
    pub seconds: Option<f64>,
    /// Relative noise.
    pub noise: Option<f64>,
}

/// Figures of a render so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counters {
    /// Seconds of rendering.
    pub seconds: f64,
    /// Rays traced.
    pub rays: u64,
    /// Paths cut because they were too long.
    pub cut_paths: u64,
    /// Column, row and index of the first invalid sample.
    pub first_invalid: Option<[u32; 3]>,
}

impl Header {
    /// Name, version and commit of this program.
    pub const PROGRAM: &str = concat!("Noisefall ", env!("CARGO_PKG_VERSION"), " (", env!("NOISEFALL_COMMIT"), ")");

    /// Says in what the image of this file differs from that of another one: the first thing found; `None` if they are the same.
    pub fn difference(&self, other: &Header) -> Option<String> {
        if self.program != other.program {
            return Some(format!("it was rendered by {}, and not by {}", self.program, other.program));
        }
        if (&self.scene.text, &self.scene.choices) != (&other.scene.text, &other.scene.choices) {
            return Some("it is of another scene".to_owned());
        }
        if self.camera.resolution != other.camera.resolution {
            let [size, of_other] = [self, other].map(|header| header.camera.resolution.map(|side| side.to_string()).join(" × "));
            return Some(format!("it has {size} pixels, and not {of_other}"));
        }
        if self.camera != other.camera {
            return Some("it has another camera".to_owned());
        }
        let has_other_bits = self.probe != other.probe || self.image != other.image;
        let bits = || "its samples differ: the scene or the program is not the same".to_owned();
        self.other_setting(other).or_else(|| self.other_file(other)).or_else(|| has_other_bits.then(bits))
    }

    fn other_setting(&self, other: &Header) -> Option<String> {
        let [settings, of_other] = [self, other].map(|header| serde_json::to_value(header.settings).unwrap_or_default());
        let name = settings.as_object()?.keys().find(|name| settings[*name] != of_other[*name])?;
        Some(format!("its setting `{name}` is {}, and not {}", settings[name], of_other[name]))
    }

    fn other_file(&self, other: &Header) -> Option<String> {
        let differs = |file: &&NamedFile| !(self.files.contains(file) && other.files.contains(file));
        let file = self.files.iter().chain(&other.files).find(differs)?;
        Some(format!("the scene's file {} has other contents", quote::path(Path::new(&file.path))))
    }
}
