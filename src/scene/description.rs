//! What a scene file says: every table of the format with its parameters.
use std::collections::BTreeMap;

use glam::DVec3;

use super::RenderSettings;
use crate::{
    declare::{CountRange, Declare, Family, Form, OneOf, Parameter, Parameters, Range, Value},
    material::Material,
    sampling::Filter,
    shape::{ShapeKind, Transform},
    texture::TextureKind,
};

/// A scene as its file describes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDescription {
    pub title: String,
    pub notes: String,
    pub camera: CameraDescription,
    pub background: Option<BackgroundDescription>,
    pub textures: BTreeMap<String, TextureKind>,
    pub materials: BTreeMap<String, MaterialDescription>,
    pub objects: Vec<ObjectDescription>,
    pub render: RenderDescription,
    pub truth: Option<TruthDescription>,
}

/// The version of the scene format that this program reads.
pub const FORMAT: u32 = 1;

impl Declare for SceneDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const VERSION: Parameter = Parameter::new("format", "The version of the format: 1.").required();
        const TITLE: Parameter = Parameter::new("title", "What the window and reports call the scene.").aliases("name");
        const NOTES: Parameter = Parameter::new("notes", "A text for people.").aliases("description comment");
        const CAMERA: Parameter = Parameter::new("camera", "Where the picture is taken from.").required().aliases("sensor view");
        const BACKGROUND: Parameter = Parameter::new("background", "Light from every direction that meets no surface.")
            .aliases("environment sky envmap world");
        const TEXTURES: Parameter = Parameter::new("textures", "Textures by name.").aliases("texture");
        const MATERIALS: Parameter = Parameter::new("materials", "Materials by name.").aliases("material bsdfs");
        const OBJECTS: Parameter =
            Parameter::new("objects", "What the scene is made of; each has a table of its own.").aliases("object shapes");
        const RENDER: Parameter =
            Parameter::new("render", "The settings that the scene opens with.").aliases("integrator settings");
        const TRUTH: Parameter =
            Parameter::new("truth", "What the picture must converge to, where that is known.").aliases("reference");
        p.count(&VERSION, &mut FORMAT.clone(), CountRange::new(FORMAT, FORMAT));
        p.value(&TITLE, Value::Text(&mut self.title));
        p.value(&NOTES, Value::Text(&mut self.notes));
        p.table(&CAMERA, &mut self.camera);
        p.optional_table(&BACKGROUND, &mut self.background);
        p.map(&TEXTURES, &mut self.textures);
        p.map(&MATERIALS, &mut self.materials);
        p.list(&OBJECTS, &mut self.objects);
        p.optional_part(&RENDER, &mut self.render);
        p.optional_table(&TRUTH, &mut self.truth);
    }
}

/// The camera of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraDescription {
    pub eye: DVec3,
    pub look_at: DVec3,
    pub up: Option<DVec3>,
    pub fov: Option<f64>,
    pub resolution: [u32; 2],
    pub projection: Projection,
    pub lens: Option<super::Lens>,
    pub filter: Filter,
    pub shutter: Option<[f64; 2]>,
    /// What carries the camera from time 0 to 1.
    pub motion: Vec<Transform>,
}

impl Default for CameraDescription {
    fn default() -> Self {
        CameraDescription {
            eye: DVec3::new(0.0, 0.0, 4.0),
            look_at: DVec3::ZERO,
            up: None,
            fov: Some(40.0),
            resolution: [640, 480],
            projection: Projection::Perspective,
            lens: None,
            filter: Filter::Box,
            shutter: None,
            motion: Vec::new(),
        }
    }
}

impl Declare for CameraDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const EYE: Parameter = Parameter::new("eye", "Where the camera stands.")
            .symbol("x_0")
            .unit("m")
            .required()
            .aliases("position origin from pos location");
        const LOOK_AT: Parameter = Parameter::new("look_at", "The point in the middle of the picture.")
            .unit("m")
            .required()
            .aliases("target at to direction lookat");
        const UP: Parameter = Parameter::new("up", "The direction that is up in the picture: [0, 1, 0] where it is absent.");
        const FOV: Parameter = Parameter::new("fov", "Full angle across the picture's width, of perspective cameras.")
            .unit("°")
            .aliases("angle field_of_view vfov hfov")
            .advice("`fov` is the angle across the picture's width, in degrees");
        const RESOLUTION: Parameter = Parameter::new("resolution", "Width and height.")
            .unit("pixels")
            .required()
            .aliases("size width height")
            .advice("write resolution = [width, height]");
        const PROJECTION: Parameter = Parameter::new("projection", "\"perspective\" (the default), or orthographic.");
        const LENS: Parameter = Parameter::new("lens", "A thin lens; a pinhole where it is absent.").aliases("aperture dof");
        const FILTER: Parameter =
            Parameter::new("filter", "How a pixel weighs the light around its centre: \"box\" (the default), tent or gaussian.")
                .aliases("rfilter reconstruction");
        const SHUTTER: Parameter = Parameter::new("shutter", "When it opens and closes, as parts of the motion; absent: time 0.");
        const MOTION: Parameter = Parameter::new("motion", "Transforms that carry the camera from time 0 to 1.");
        p.point(&EYE, &mut self.eye);
        p.point(&LOOK_AT, &mut self.look_at);
        p.optional(&UP, &mut self.up, || DVec3::Y, |p, up| p.point(&UP, up));
        p.optional(&FOV, &mut self.fov, || 40.0, |p, fov| p.number(&FOV, fov, Range::linear(0.001, 179.9)));
        p.value(&RESOLUTION, Value::Counts(&mut self.resolution));
        p.optional_choice(&PROJECTION, Form::NameOrTable, &mut self.projection);
        p.optional_table(&LENS, &mut self.lens);
        p.optional_choice(&FILTER, Form::NameOrTable, &mut self.filter);
        p.optional(&SHUTTER, &mut self.shutter, || [0.0, 1.0], |p, times| p.value(&SHUTTER, Value::Pair(times)));
        p.list(&MOTION, &mut self.motion);
    }
}

impl Default for super::Lens {
    fn default() -> Self {
        super::Lens { radius: 0.05, focus: 4.0 }
    }
}

impl Declare for super::Lens {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const RADIUS: Parameter = Parameter::new("radius", "Of the lens; 0 is a pinhole.").unit("m").required();
        const FOCUS: Parameter =
            Parameter::new("focus", "Distance of the plane in focus from the eye, along the axis.").unit("m").required();
        p.number(&RADIUS, &mut self.radius, Range::log(0.0, 1e9));
        p.number(&FOCUS, &mut self.focus, Range::log(1e-9, 1e12));
    }
}

/// How the world is projected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Projection {
    #[default]
    Perspective,
    Orthographic(Orthographic),
}

/// Parallel rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthographic {
    /// Of the picture, metres.
    pub width: f64,
}

const ORTHOGRAPHIC: Parameter = Parameter::new("orthographic", "Parallel rays.").required();

impl Declare for Orthographic {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const WIDTH: Parameter = Parameter::new("width", "Of the picture.").unit("m").required();
        p.number(&WIDTH, &mut self.width, Range::log(1e-9, 1e9));
    }
}

impl OneOf for Projection {
    const WHAT: &'static str = "projection";

    fn alternatives() -> Vec<Self> {
        vec![Projection::Perspective, Projection::Orthographic(Orthographic { width: 4.0 })]
    }

    fn place(&self) -> usize {
        usize::from(*self != Projection::Perspective)
    }

    fn name(&self) -> &'static str {
        if *self == Projection::Perspective { "perspective" } else { ORTHOGRAPHIC.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        if let Projection::Orthographic(orthographic) = self {
            p.table(&ORTHOGRAPHIC, orthographic);
        }
    }
}

/// The background of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub enum BackgroundDescription {
    Radiance([f64; 3]),
    Image { path: String, rotate: f64, scale: f64 },
}

/// Of lamps, backgrounds and truths.
const RADIANCE: Parameter = Parameter::new("radiance", "Radiance of each channel.")
    .symbol("L_e")
    .unit("W/(m² sr)")
    .required()
    .aliases("power intensity flux strength brightness watts le Le L_e color colour rgb")
    .advice("radiance is in W/(m² sr): a flat lamp of area A with the power Φ has Φ/(π A)");
const IMAGE: Parameter = Parameter::new("image", "An equirectangular picture, EXR, HDR or PNG; its middle is towards −z.")
    .required()
    .aliases("file filename src path");

impl Default for BackgroundDescription {
    fn default() -> Self {
        BackgroundDescription::Radiance([1.0; 3])
    }
}

impl Declare for BackgroundDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}

impl OneOf for BackgroundDescription {
    const WHAT: &'static str = "background";

    fn alternatives() -> Vec<Self> {
        vec![Self::default(), BackgroundDescription::Image { path: String::new(), rotate: 0.0, scale: 1.0 }]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, BackgroundDescription::Image { .. }))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { IMAGE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        const ROTATE: Parameter =
            Parameter::new("rotate", "Turns the picture counter-clockwise, seen from above.").unit("degrees");
        const SCALE: Parameter = Parameter::new("scale", "Factor of its radiance.");
        match self {
            BackgroundDescription::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            BackgroundDescription::Image { path, rotate, scale } => {
                p.value(&IMAGE, Value::File(path));
                p.number(&ROTATE, rotate, Range::FINITE);
                p.number(&SCALE, scale, Range::log(1e-12, 1e12));
            }
        }
    }
}

/// A material of a scene file: its kind, and what any kind may have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialDescription {
    pub kind: Material,
    pub bump: Option<Bump>,
    /// A picture file of normals.
    pub normal_map: Option<String>,
    pub two_sided: Option<bool>,
}

impl Declare for MaterialDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const BUMP: Parameter = Parameter::new("bump", "Heights that tilt the shading normal.").aliases("bump_map displacement");
        const NORMAL_MAP: Parameter = Parameter::new("normal_map", "A linear picture of shading normals.").aliases("normals");
        const TWO_SIDED: Parameter = Parameter::new("two_sided", "Whether it reflects from behind too; true where it is absent.")
            .aliases("twosided double_sided");
        p.one_of(&mut self.kind);
        p.optional_table(&BUMP, &mut self.bump);
        p.optional(&NORMAL_MAP, &mut self.normal_map, String::new, |p, path| p.value(&NORMAL_MAP, Value::File(path)));
        p.optional(&TWO_SIDED, &mut self.two_sided, || true, |p, two_sided| p.flag(&TWO_SIDED, two_sided));
    }
}

/// A texture of heights.
#[derive(Clone, Debug, PartialEq)]
pub struct Bump {
    pub texture: String,
    /// Metres that the brightest texel rises above the darkest.
    pub height: f64,
}

impl Default for Bump {
    fn default() -> Self {
        Bump { texture: String::new(), height: 0.01 }
    }
}

impl Declare for Bump {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const HEIGHT: Parameter =
            Parameter::new("height", "How far the brightest texel rises above the darkest.").symbol("h").unit("m").required();
        p.value(&TEXTURE.required(), Value::Name(&mut self.texture, Family::Texture));
        p.number(&HEIGHT, &mut self.height, Range::linear(-1e6, 1e6));
    }
}

const TEXTURE: Parameter = Parameter::new("texture", "The name of a texture.");

/// An object of a scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjectDescription {
    pub name: String,
    pub shape: ShapeKind,
    pub material: Option<String>,
    pub emission: Option<EmissionDescription>,
    pub flip: bool,
    pub transform: Vec<Transform>,
    pub motion: Vec<Transform>,
}

impl Declare for ObjectDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const NAME: Parameter = Parameter::new("name", "What the window calls it.").aliases("id label");
        const SHAPE: Parameter = Parameter::new("shape", "Its surface.").required().aliases("geometry");
        const MATERIAL: Parameter =
            Parameter::new("material", "The name of its material; without one it is black.").aliases("bsdf");
        const EMISSION: Parameter =
            Parameter::new("emission", "The light that it emits.").aliases("light emitter emissive area_light lamp");
        const FLIP: Parameter = Parameter::new("flip", "Whether the normal is turned around.").aliases("flip_normals invert");
        const TRANSFORM: Parameter =
            Parameter::new("transform", "A list, applied from the first to the last.").aliases("to_world transforms");
        const MOTION: Parameter = Parameter::new("motion", "Transforms that carry it from time 0 to 1.");
        p.value(&NAME, Value::Text(&mut self.name));
        p.choice(&SHAPE, Form::Table, &mut self.shape);
        p.optional(&MATERIAL, &mut self.material, String::new, |p, name| {
            p.value(&MATERIAL, Value::Name(name, Family::Material));
        });
        p.optional_table(&EMISSION, &mut self.emission);
        p.flag(&FLIP, &mut self.flip);
        p.list(&TRANSFORM, &mut self.transform);
        p.list(&MOTION, &mut self.motion);
    }
}

/// Emission of an object of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct EmissionDescription {
    pub source: EmissionSource,
    pub two_sided: bool,
    pub scale: f64,
}

/// What an emission varies by.
#[derive(Clone, Debug, PartialEq)]
pub enum EmissionSource {
    Radiance([f64; 3]),
    Texture(String),
}

impl Default for EmissionDescription {
    fn default() -> Self {
        EmissionDescription { source: EmissionSource::Radiance([1.0; 3]), two_sided: false, scale: 1.0 }
    }
}

impl Declare for EmissionDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const TWO_SIDED: Parameter =
            Parameter::new("two_sided", "Whether it emits from behind too.").aliases("twosided double_sided");
        const SCALE: Parameter = Parameter::new("scale", "Factor of the radiance.");
        p.one_of(&mut self.source);
        p.flag(&TWO_SIDED, &mut self.two_sided);
        p.number(&SCALE, &mut self.scale, Range::log(0.0, 1e12));
    }
}

impl OneOf for EmissionSource {
    const WHAT: &'static str = "emission";

    fn alternatives() -> Vec<Self> {
        vec![EmissionSource::Radiance([1.0; 3]), EmissionSource::Texture(String::new())]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, EmissionSource::Texture(_)))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { TEXTURE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            EmissionSource::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            EmissionSource::Texture(name) => p.value(&TEXTURE.required(), Value::Name(name, Family::Texture)),
        }
    }
}

/// The settings that a scene opens with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderDescription {
    pub settings: RenderSettings,
    /// Samples a pixel to stop at.
    pub spp: Option<u32>,
}

impl Declare for RenderDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SPP: Parameter = Parameter::new("spp", "Samples a pixel to stop at.")
            .symbol("N")
            .aliases("samples samples_per_pixel sample_count num_samples n");
        self.settings.parameters(p);
        p.optional(&SPP, &mut self.spp, || 64, |p, spp| p.count(&SPP, spp, CountRange::new(1, u32::MAX)));
    }
}

/// What the picture of a scene file must converge to.
#[derive(Clone, Debug, PartialEq)]
pub enum TruthDescription {
    Radiance([f64; 3]),
    Image(String),
}

impl Default for TruthDescription {
    fn default() -> Self {
        TruthDescription::Radiance([1.0; 3])
    }
}

impl Declare for TruthDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}

impl OneOf for TruthDescription {
    const WHAT: &'static str = "truth";

    fn alternatives() -> Vec<Self> {
        vec![Self::default(), TruthDescription::Image(String::new())]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, TruthDescription::Image(_)))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { IMAGE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            TruthDescription::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            TruthDescription::Image(path) => p.value(&IMAGE, Value::File(path)),
        }
    }
}
