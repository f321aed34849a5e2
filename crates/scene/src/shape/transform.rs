//! Transforms that place shapes or move them from time 0 to 1.
use glam::{DAffine3, DMat3, DVec3};

use super::FLATTEST;
use crate::geometry::{Motion, TransformStep, Turns};
use noisefall_base::declare::{Declare, OneOf, Parameter, Parameters, Path, Problem, Range, Value};

/// Limits of scale factors, beyond which f32 overflows.
const SMALLEST_SCALE: f64 = 1e-12;
const LARGEST_SCALE: f64 = 1e12;
/// Relative tolerance of lengths, so that the ends of the range are accepted.
const ROUNDING: f64 = 1e-12;

/// One transform as a scene describes it.
#[derive(Clone, Debug, PartialEq)]
pub enum Transform {
    /// A translation, metres.
    Translate(DVec3),
    /// Factors along the axes.
    Scale(DVec3),
    /// A rotation.
    Rotate(Rotation),
    /// Row by row; the last row is 0 0 0 1.
    Matrix([[f64; 4]; 4]),
}

/// A rotation about an axis through the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// Direction of the axis, of any length.
    pub axis: DVec3,
    /// Angle in degrees, counter-clockwise when the axis points at the viewer.
    pub degrees: f64,
}

const TRANSLATE: Parameter = Parameter::new("translate", "Translation.").unit("m").required().aliases("move translation");
const SCALE: Parameter = Parameter::new("scale", "Scale factors of x, y and z, or one factor for all.").required();
const ROTATE: Parameter = Parameter::new("rotate", "Rotation about an axis through the origin.").required().aliases("rotation");
const MATRIX: Parameter = Parameter::new("matrix", "Four rows of four numbers; the last row is 0, 0, 0, 1.").required();

impl Default for Transform {
    fn default() -> Self {
        Transform::Translate(DVec3::ZERO)
    }
}

impl Declare for Transform {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}

impl OneOf for Transform {
    const WHAT: &'static str = "transform";

    fn alternatives() -> Vec<Self> {
        let identity = [0, 1, 2, 3].map(|row| [0, 1, 2, 3].map(|column| if row == column { 1.0 } else { 0.0 }));
        vec![
            Transform::default(),
            Transform::Scale(DVec3::ONE),
            Transform::Rotate(Rotation { axis: DVec3::Y, degrees: 0.0 }),
            Transform::Matrix(identity),
        ]
    }

    fn place(&self) -> usize {
        match self {
            Transform::Translate(_) => 0,
            Transform::Scale(_) => 1,
            Transform::Rotate(_) => 2,
            Transform::Matrix(_) => 3,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Transform::Translate(_) => TRANSLATE.key,
            Transform::Scale(_) => SCALE.key,
            Transform::Rotate(_) => ROTATE.key,
            Transform::Matrix(_) => MATRIX.key,
        }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            Transform::Translate(by) => p.value(&TRANSLATE, Value::Vector(by)),
            Transform::Scale(factors) => p.value(&SCALE, Value::Factors(factors)),
            Transform::Rotate(rotation) => p.table(&ROTATE, rotation),
            Transform::Matrix(rows) => p.value(&MATRIX, Value::Matrix(rows)),
        }
    }
}

impl Declare for Rotation {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const AXIS: Parameter = Parameter::new("axis", "Direction of the axis, of any length.").required();
        const DEGREES: Parameter = Parameter::new("degrees", "Angle, counter-clockwise when the axis points at the viewer.")
            .unit("°")
            .required()
            .aliases("angle");
        p.value(&AXIS, Value::Vector(&mut self.axis));
        p.number(&DEGREES, &mut self.degrees, Range::FINITE);
    }
}

impl Transform {
    /// Converts an affine map to a list of transforms, empty for the identity.
    pub fn list_of(map: &DAffine3) -> Vec<Transform> {
        if *map == DAffine3::IDENTITY {
            return Vec::new();
        }
        let (m, t) = (map.matrix3, map.translation);
        let row = |i: usize| [m.x_axis[i], m.y_axis[i], m.z_axis[i], t[i]];
        vec![Transform::Matrix([row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]])]
    }

    /// Converts the transform to a step of a motion.
    fn step(&self) -> Result<TransformStep, Problem> {
        let error = |message: &str, label: &str| Err(Problem::at("", message, label));
        let step = match self {
            Transform::Translate(by) => TransformStep::Translate(*by),
            Transform::Scale(factors) => TransformStep::Scale(*factors),
            Transform::Rotate(rotation) => match rotation.axis.try_normalize() {
                Some(axis) => TransformStep::Rotate { axis, turns: Turns::from_degrees(rotation.degrees) },
                None => return error("the axis of rotation has no direction", "it must not be zero"),
            },
            Transform::Matrix([x, y, z, last]) => {
                if *last != [0.0, 0.0, 0.0, 1.0] {
                    return error("the matrix is not affine", "the last row must be 0, 0, 0, 1");
                }
                let column = |i: usize| DVec3::new(x[i], y[i], z[i]);
                TransformStep::Matrix(DAffine3 {
                    matrix3: DMat3::from_cols(column(0), column(1), column(2)),
                    translation: column(3),
                })
            }
        };
        let map = step.at(1.0);
        if !map.is_finite() {
            return error("the transform is not finite", "all of its numbers must be");
        }
        let columns = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
        let lengths = columns.map(DVec3::length);
        let range = SMALLEST_SCALE * (1.0 - ROUNDING)..=LARGEST_SCALE * (1.0 + ROUNDING);
        if lengths.iter().any(|length| !range.contains(length))
            || map.matrix3.determinant().abs() <= FLATTEST * lengths.iter().product::<f64>()
        {
            return error("the transform cannot be inverted", "it flattens space, or scales it beyond 1e-12 to 1e12");
        }
        Ok(step)
    }
}

/// The steps of a list of transforms. Paths of problems are indices into the list.
fn steps(list: &[Transform]) -> Result<Vec<TransformStep>, Problem> {
    let step = |(place, transform): (usize, &Transform)| {
        transform.step().map_err(|problem| problem.within(&Path::default().item(place)))
    };
    list.iter().enumerate().map(step).collect()
}

/// The product of a list of transforms, the first one applied first.
pub fn product(list: &[Transform]) -> Result<DAffine3, Problem> {
    Ok(steps(list)?.iter().fold(DAffine3::IDENTITY, |before, step| step.at(1.0) * before))
}

/// The motion that reaches a list of transforms at time 1.
pub fn motion(list: &[Transform]) -> Result<Motion, Problem> {
    let motion = Motion(steps(list)?);
    if !list.is_empty() && !motion.is_invertible() {
        let last = list.len() - 1;
        return Err(Problem::at(&last.to_string(), "the motion cannot be inverted", "it mirrors or flattens space on its way"));
    }
    Ok(motion)
}
