//! The layers of an EXR file beside its image, as channels of one part that other programs group by name.
//!
//! | layer | channels | contents |
//! |---|---|---|
//! | `bounces` | `Bounce0.R` … `Bounce6.B`, `Bounce7AndMore.R` … | radiance reflected exactly k times, W·sr⁻¹·m⁻² |
//! | `albedo` | `Albedo.R`, `Albedo.G`, `Albedo.B` | scale of the BSDF at the first surface |
//! | `normal` | `Normal.X`, `Normal.Y`, `Normal.Z` | its shading normal on the viewer's side, world space, unit length |
//! | `depth` | `Depth.Z` | its distance along the camera ray, metres; infinite without a surface |
//! | `position` | `Position.X`, `Position.Y`, `Position.Z` | its position in world space, metres |
//! | `object` | `IndexOB.X` | number of the object from 1; 0 without a surface |
//! | `material` | `IndexMA.X` | number of the material from 1; 0 without a surface |
//! | `samples` | `SampleCount.X` | number of samples of the pixel |
//!
//! The names are those of Blender's passes where it has one, without a view layer in front: Blender and tev take the part before
//! the last dot for the pass, and R, G, B or X, Y, Z for its components. Every channel is a 32-bit float, as in Blender's files;
//! numbers of objects and materials are exact up to 2²⁴.
use super::{frame::Frame, series::Series};
use noisefall_base::memory::{self, Reservation, TooMuch};
use noisefall_kernel::integrator::{Features, TERMS};
use noisefall_scene::geometry::MISS;

noisefall_base::declare::words! {
    /// A layer of an EXR file.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Layer {
        Bounces: "bounces", "Bounces", "Light of each number of bounces.";
        Albedo: "albedo", "Albedo", "Albedo of the first surface.";
        Normal: "normal", "Normal", "Shading normal of the first surface.";
        Depth: "depth", "Depth", "Distance of the first surface.";
        Position: "position", "Position", "Position of the first surface.";
        Object: "object", "Object", "Number of the first object.";
        Material: "material", "Material", "Number of the first material.";
        Samples: "samples", "Samples", "Samples per pixel.";
    }
}

/// A channel of an EXR file beside those of the image.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its full name, such as `Normal.X`.
    pub name: String,
    /// A value for each pixel, row by row from the top left.
    pub values: Vec<f32>,
}

/// The data that layers need beside the frame.
#[derive(Clone, Copy, Default)]
pub struct LayerSources<'a> {
    /// The first surfaces, at the resolution of the frame.
    pub features: Option<&'a Features>,
    /// The series by bounces, at the resolution of the frame.
    pub series: Option<&'a Series>,
}

impl Layer {
    /// Whether the layer shows features of first hits.
    pub fn needs_features(self) -> bool {
        !matches!(self, Layer::Bounces | Layer::Samples)
    }

    /// The reason why an image has no such layer.
    fn absence(self, frame: &Frame, sources: &LayerSources) -> &'static str {
        match (self, sources.features, sources.series) {
            _ if [frame.width, frame.height] != frame.full_resolution => "the image is still coarse",
            (Layer::Bounces, _, None) => "no bounces are recorded",
            (Layer::Bounces, _, Some(_)) => "the bounces were recorded at another resolution",
            (_, None, _) => "no surfaces are recorded",
            (_, Some(features), _) if !is_of_frame(features, frame) => "the surfaces were recorded at another resolution",
            (_, Some(_), _) => "the camera sees no surface",
        }
    }

    /// Its channels; none if the image lacks the data.
    fn channels(self, frame: &Frame, sources: &LayerSources) -> Vec<Channel> {
        let seen = |features: &&Features| is_of_frame(features, frame) && features.object.iter().any(|o| *o != MISS);
        let features = sources.features.filter(seen);
        let number = |index: u32| if index == MISS { 0.0 } else { index as f32 + 1.0 };
        let one = |name: &str, values: Vec<f32>| vec![Channel { name: name.to_owned(), values }];
        let all = |numbers: &[u32]| numbers.iter().map(|index| number(*index)).collect();
        match (self, features) {
            (Layer::Bounces, _) => bounces(frame, sources.series),
            (Layer::Samples, _) => one("SampleCount.X", (0..frame.radiance.len()).map(|i| frame.spp_at(i) as f32).collect()),
            (_, None) => Vec::new(),
            (Layer::Albedo, Some(features)) => vector("Albedo", "RGB", &features.albedo).collect(),
            (Layer::Normal, Some(features)) => vector("Normal", "XYZ", &features.normal).collect(),
            (Layer::Depth, Some(features)) => one("Depth.Z", features.depth.clone()),
            (Layer::Position, Some(features)) => vector("Position", "XYZ", &features.position).collect(),
            (Layer::Object, Some(features)) => one("IndexOB.X", all(&features.object)),
            (Layer::Material, Some(features)) => one("IndexMA.X", all(&features.material)),
        }
    }
}

/// The channels of layers, and a note for each layer that the image lacks.
pub fn channels(layers: &[Layer], frame: &Frame, sources: &LayerSources) -> (Vec<Channel>, Vec<String>) {
    let (mut channels, mut notes) = (Vec::new(), Vec::new());
    for layer in layers {
        let found = layer.channels(frame, sources);
        if found.is_empty() {
            notes.push(format!("the layer `{}` is left out: {}", layer.name(), layer.absence(frame, sources)));
        }
        channels.extend(found);
    }
    (channels, notes)
}

/// Reserves memory for the channels of layers of an image of this size: as they are collected, as the encoder takes them, and in the
/// file.
pub fn reserve(layers: &[Layer], [width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
    let planes = |layer: &Layer| match layer {
        Layer::Bounces => 3 * TERMS as u64,
        Layer::Albedo | Layer::Normal | Layer::Position => 3,
        Layer::Depth | Layer::Object | Layer::Material | Layer::Samples => 1,
    };
    let bytes = 3 * 4 * layers.iter().map(planes).sum::<u64>();
    memory::reserve(format_args!("layers of {width} × {height} pixels"), bytes * u64::from(width) * u64::from(height))
}

/// Whether features have the resolution of a frame.
fn is_of_frame(features: &Features, frame: &Frame) -> bool {
    features.depth.len() == frame.radiance.len()
}

/// The terms of a series up to the last one with light.
fn bounces(frame: &Frame, series: Option<&Series>) -> Vec<Channel> {
    let is_of_frame = |series: &&Series| series.terms.iter().all(|term| term.len() == frame.radiance.len());
    let terms = series.filter(is_of_frame).map_or(&[][..], |series| &series.terms);
    let is_black = |term: &[[f32; 3]]| term.iter().all(|radiance| *radiance == [0.0; 3]);
    let count = terms.iter().rposition(|term| !is_black(term)).map_or(terms.len().min(1), |last| last + 1);
    let name = |k: usize| if k + 1 == TERMS { format!("Bounce{k}AndMore") } else { format!("Bounce{k}") };
    terms[..count].iter().enumerate().flat_map(|(k, term)| vector(&name(k), "RGB", term).collect::<Vec<_>>()).collect()
}

/// A channel for each component of vectors.
fn vector(layer: &str, components: &str, values: &[[f32; 3]]) -> impl Iterator<Item = Channel> {
    let channel = move |(axis, component)| Channel {
        name: format!("{layer}.{component}"),
        values: values.iter().map(|vector| vector[axis]).collect(),
    };
    components.chars().enumerate().map(channel)
}
