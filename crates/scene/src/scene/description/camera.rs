//! The camera of a scene file.
use glam::DVec3;

use crate::{
    sampling::Filter,
    scene::{Lens, Projection},
    shape::Transform,
};
use noisefall_base::declare::{Declare, Form, Parameter, Parameters, Range, Value};

/// The camera of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraDescription {
    /// Position of the camera, metres.
    pub eye: DVec3,
    /// The point at the centre of the image, metres.
    pub look_at: DVec3,
    /// The direction that points up in the image, of any length; `None` is +y.
    pub up: Option<DVec3>,
    /// Field of view across the width of the image, degrees; only for perspective cameras.
    pub fov: Option<f64>,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Perspective or parallel rays.
    pub projection: Projection,
    /// Shift of the image plane to the right and up, in widths of the image.
    pub shift: [f64; 2],
    /// The thin lens; `None` is a pinhole.
    pub lens: Option<Lens>,
    /// The pixel filter.
    pub filter: Filter,
    /// The times at which the shutter opens and closes, from 0 to 1; `None` is time 0.
    pub shutter: Option<[f64; 2]>,
    /// Transforms that move the camera from time 0 to 1.
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
            projection: Projection::default(),
            shift: [0.0; 2],
            lens: None,
            filter: Filter::default(),
            shutter: None,
            motion: Vec::new(),
        }
    }
}

impl CameraDescription {
    /// The position, as files and the window name it.
    pub const EYE: Parameter = Parameter::new("eye", "Position of the camera.")
        .symbol("x_0")
        .unit("m")
        .required()
        .aliases("position origin from pos location");
    /// The point at the centre of the image, as files and the window name it.
    pub const LOOK_AT: Parameter = Parameter::new("look_at", "Point that appears at the centre of the image.")
        .unit("m")
        .required()
        .aliases("target at to direction lookat");
    /// The direction that points up, as files and the window name it.
    pub const UP: Parameter = Parameter::new("up", "Direction that points up in the image. Default: [0, 1, 0].");
    /// The field of view, as files and the window name it.
    pub const FOV: Parameter = Parameter::new(
        "fov",
        "Field of view across the width of the image. Required for a perspective; other projections have none.",
    )
    .title("Field of view")
    .unit("°")
    .aliases("angle field_of_view vfov hfov")
    .advice("`fov` is the angle across the image's width, in degrees");
    /// Width and height, as files and the window name it.
    pub const RESOLUTION: Parameter = Parameter::new("resolution", "Width and height.")
        .unit("pixels")
        .required()
        .aliases("size width height")
        .advice("write resolution = [width, height]");
    /// The projection, as files and the window name it.
    pub const PROJECTION: Parameter = Parameter::new("projection", "How the scene is projected. Default: \"perspective\".");
    /// The lens, as files and the window name it.
    pub const LENS: Parameter = Parameter::new("lens", "A thin lens. Default: a pinhole.").aliases("aperture dof");
    /// The pixel filter, as files and the window name it.
    pub const FILTER: Parameter = Parameter::new("filter", "How a pixel weights the light around its centre. Default: \"box\".")
        .title("Pixel filter")
        .aliases("rfilter reconstruction");
}

impl Declare for CameraDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SHUTTER: Parameter = Parameter::new(
            "shutter",
            "Times at which the shutter opens and closes. Motion runs from time 0 to 1. Default: time 0.",
        );
        const SHIFT: Parameter = Parameter::new(
            "shift",
            "Shift of the image plane to the right and up, in widths of the image. Upright lines stay parallel.",
        )
        .aliases("lens_shift");
        const MOTION: Parameter = Parameter::new("motion", "Transforms that move the camera from time 0 to 1.");
        p.point(&Self::EYE, &mut self.eye);
        p.point(&Self::LOOK_AT, &mut self.look_at);
        p.optional(&Self::UP, &mut self.up, || DVec3::Y, |p, up| p.point(&Self::UP, up));
        p.optional(&Self::FOV, &mut self.fov, || 40.0, |p, fov| p.number(&Self::FOV, fov, Range::linear(0.001, 179.9)));
        p.value(&Self::RESOLUTION, Value::Counts(&mut self.resolution));
        p.optional_choice(&Self::PROJECTION, Form::NameOrTable, &mut self.projection);
        p.value(&SHIFT, Value::Pair(&mut self.shift));
        p.optional_table(&Self::LENS, &mut self.lens);
        p.optional_choice(&Self::FILTER, Form::NameOrTable, &mut self.filter);
        p.optional(&SHUTTER, &mut self.shutter, || [0.0, 1.0], |p, times| p.value(&SHUTTER, Value::Pair(times)));
        p.list(&MOTION, &mut self.motion);
    }
}

impl Default for Lens {
    fn default() -> Self {
        Lens { radius: 0.05, focus: 4.0 }
    }
}

impl Lens {
    /// The radius, as files and the window name it.
    pub const RADIUS: Parameter =
        Parameter::new("radius", "Radius of the lens; 0 is a pinhole.").title("Lens radius").unit("m").required();
    /// The distance in focus, as files and the window name it.
    pub const FOCUS: Parameter =
        Parameter::new("focus", "Distance of the plane in focus from the eye, along the axis.").unit("m").required();
}

impl Declare for Lens {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.number(&Self::RADIUS, &mut self.radius, Range::log(0.0, 1e9));
        p.number(&Self::FOCUS, &mut self.focus, Range::log(1e-9, 1e12));
    }
}
