//! An image that is cast from a point.
use glam::{DAffine3, DVec3};

use super::{Picture, PunctualLight, PunctualLightKind, Shine, intensity, slide::Slide, spot::axis};
use crate::{
    image::Encoding,
    texture::image::{TexelFilter, Wrap},
};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value};

/// An image that is cast from a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Projector {
    /// Position of the light.
    pub position: DVec3,
    /// Point that the light is aimed at.
    pub target: DVec3,
    /// Direction that points up in the image.
    pub up: DVec3,
    /// The image file, relative to the scene; a white square if it is empty.
    pub image: String,
    /// Encoding of the file's numbers; EXR, HDR and PFM are always linear.
    pub encoding: Encoding,
    /// Continuation of the image beyond its edges.
    pub wrap: Wrap,
    /// Interpolation between its texels.
    pub filter: TexelFilter,
    /// Angle across the width of the image.
    pub fov: f64,
    /// Width of the image divided by its height; 0 takes that of the file.
    pub aspect: f64,
    /// Radiant intensity on the axis where the image is 1.
    pub scale: f64,
    /// Factor of the colours of the image.
    pub tint: [f64; 3],
    /// Whether a screen that faces it is lit evenly, as by a slide projector; otherwise the intensity is the same in all directions.
    pub flat: bool,
    /// Angle between the axis and the edge of the cone, where the light ends; 180 for no cone.
    pub angle: f64,
    /// Angle up to which a cone does not dim the image; at most `angle`.
    pub inner: f64,
}

impl Default for Projector {
    fn default() -> Self {
        Projector {
            position: DVec3::new(0.0, 2.0, 0.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            image: String::new(),
            encoding: Encoding::Srgb,
            wrap: Wrap::Clamp,
            filter: TexelFilter::Bilinear,
            fov: 40.0,
            aspect: 0.0,
            scale: 1.0,
            tint: [1.0; 3],
            flat: false,
            angle: 180.0,
            inner: 180.0,
        }
    }
}

impl Kind for Projector {
    const KIND: Parameter = Parameter::new("projector", "An image that is cast from a point.").aliases("texture_light slide");
}

impl Declare for Projector {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const POSITION: Parameter = Parameter::new("position", "Position of the light.").unit("m");
        const TARGET: Parameter = Parameter::new("target", "Point that the light is aimed at.").unit("m");
        const UP: Parameter = Parameter::new("up", "Direction that points up in the image.");
        const IMAGE: Parameter = Parameter::new("image", "The image file, relative to the scene; a white square if it is empty.");
        const ENCODING: Parameter =
            Parameter::new("encoding", "Encoding of the file's numbers; EXR, HDR and PFM are always linear.");
        const WRAP: Parameter =
            Parameter::new("wrap", "How the image continues beyond its edges. Texels blend over half their width there.");
        const FILTER: Parameter = Parameter::new("filter", "Interpolation between texels.");
        const FOV: Parameter = Parameter::new("fov", "Angle across the width of the image.").unit("°");
        const ASPECT: Parameter = Parameter::new("aspect", "Width of the image divided by its height; 0 takes that of the file.");
        const TINT: Parameter = Parameter::new("tint", "Factor that multiplies the colours of the image.");
        const ANGLE: Parameter =
            Parameter::new("angle", "Angle between the axis and the edge of the cone, where the light ends; 180 for no cone.")
                .unit("°");
        const INNER: Parameter = Parameter::new(
            "inner",
            "Angle up to which the cone does not dim the image. From there to `angle`, the light falls linearly.",
        )
        .unit("°");
        const SCALE: Parameter = Parameter::new("scale", "Radiant intensity on the axis where the image is 1.").unit("W·sr⁻¹");
        const FLAT: Parameter = Parameter::new(
            "flat",
            "Whether a screen that faces the projector is lit evenly. Otherwise the intensity is the same in all directions.",
        );
        p.point(&POSITION, &mut self.position);
        p.point(&TARGET, &mut self.target);
        p.value(&UP, Value::Vector(&mut self.up));
        p.value(&IMAGE, Value::File(&mut self.image));
        p.word(&ENCODING, &mut self.encoding);
        p.word(&WRAP, &mut self.wrap);
        p.word(&FILTER, &mut self.filter);
        p.number(&FOV, &mut self.fov, Range::linear(0.01, 179.0));
        p.number(&ASPECT, &mut self.aspect, Range::linear(0.0, 1e3));
        p.number(&SCALE, &mut self.scale, Range::log(0.0, 1e12));
        p.colour(&TINT, &mut self.tint, Range::UNIT);
        p.flag(&FLAT, &mut self.flat);
        p.number(&ANGLE, &mut self.angle, Range::linear(0.01, 180.0));
        p.number(&INNER, &mut self.inner, Range::linear(0.0, 180.0));
    }
}

impl Shine for Projector {
    fn compile(&self, map: &DAffine3, resources: &Resources) -> Result<PunctualLight, Problem> {
        let forward = axis(self.position, self.target)?;
        let right = forward.cross(self.up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        let image = match self.image.as_str() {
            "" => None,
            file => Some(Slide::read(resources, file, self.encoding, (self.wrap, self.filter))?),
        };
        let own = image.as_ref().map_or(1.0, Slide::aspect);
        let aspect = if self.aspect > 0.0 { self.aspect } else { own };
        let half_width = (0.5 * self.fov).to_radians().tan();
        let forms = [right / half_width, right.cross(forward) * aspect / half_width, forward];
        // A form of directions before the transform becomes one of directions after it: also of mirrored and sheared ones.
        let covector = map.matrix3.inverse().transpose();
        let axes = forms.map(|form| covector * form);
        let cone = (self.angle < 180.0).then(|| [self.inner, self.angle].map(f64::to_radians));
        let picture = Picture { axes, flat: self.flat, image, cone };
        Ok(PunctualLight::projector(map.transform_point3(self.position), self.tint.map(|x| x * self.scale), picture))
    }

    fn without_files(&self) -> Option<PunctualLightKind> {
        Some(Projector { image: String::new(), ..self.clone() }.into())
    }

    fn position(&self) -> Option<DVec3> {
        Some(self.position)
    }

    fn moved(&self, map: &DAffine3) -> Vec<(&'static str, DVec3)> {
        vec![
            ("position", map.transform_point3(self.position)),
            ("target", map.transform_point3(self.target)),
            ("up", map.transform_vector3(self.up)),
        ]
    }

    fn placed(&self, position: DVec3, target: DVec3, irradiance: f64) -> PunctualLightKind {
        // The image of a projector that shines on a floor would have no direction upwards.
        let up =
            if (target - position).cross(DVec3::Y).length() < 1e-3 * position.distance(target) { DVec3::NEG_Z } else { DVec3::Y };
        Projector { position, target, up, scale: intensity(position, target, irradiance), ..Projector::default() }.into()
    }
}
