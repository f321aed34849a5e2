//! Transforms: the steps of a `<transform>` as a matrix.
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};

use super::{tree::Element, values::words};
use noisefall_scene::scene::SceneError;

impl Element<'_> {
    /// The transform with this name; the identity if there is none.
    pub fn transform(self, name: &str) -> Result<DMat4, SceneError> {
        let Some(transform) = self.property(name)? else { return Ok(DMat4::IDENTITY) };
        if transform.tag() != "transform" {
            return Err(transform.error(format!("`{name}` is not a transform"), "write `<transform name=\"…\">`"));
        }
        transform.children().try_fold(DMat4::IDENTITY, |before, step| Ok(step.see().step()? * before))
    }

    /// The affine transform with this name: its last row must be 0, 0, 0, 1.
    pub fn affine(self, name: &str) -> Result<DAffine3, SceneError> {
        let matrix = self.transform(name)?;
        let is_affine = matrix.row(3).abs_diff_eq(DVec4::W, 1e-9) && matrix.is_finite();
        if !is_affine || matrix.determinant() == 0.0 {
            let place = self.property(name)?.unwrap_or(self);
            return Err(place.error(format!("`{name}` flattens space or is not affine"), "check its numbers"));
        }
        Ok(DAffine3::from_mat4(matrix))
    }

    fn step(self) -> Result<DMat4, SceneError> {
        match self.tag() {
            "translate" => Ok(DMat4::from_translation(self.components(0.0)?)),
            "scale" => Ok(DMat4::from_scale(self.components(1.0)?)),
            "rotate" => self.rotation(),
            "lookat" | "look_at" => self.look_at(),
            "matrix" => self.matrix(),
            tag => {
                Err(self
                    .error(format!("`<{tag}>` is not a step of a transform"), "use translate, scale, rotate, lookat or matrix"))
            }
        }
    }

    fn rotation(self) -> Result<DMat4, SceneError> {
        let axis = self.components(0.0)?;
        if axis == DVec3::ZERO {
            return Err(self.error("the axis of the rotation has no direction", "such as y=\"1\""));
        }
        let angle = self.parse_number(self.attribute("angle").unwrap_or("0"))?;
        // Rodrigues' formula. Mitsuba does not normalize the axis, and another length than 1 distorts.
        let (sin, cos) = angle.to_radians().sin_cos();
        let cross = DMat3::from_cols(axis.cross(DVec3::X), axis.cross(DVec3::Y), axis.cross(DVec3::Z));
        let outer = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
        Ok(DMat4::from_mat3(DMat3::IDENTITY * cos + cross * sin + outer * (1.0 - cos)))
    }

    /// Its x axis points to the left, y up and z forward.
    fn look_at(self) -> Result<DMat4, SceneError> {
        let point = |name: &str| -> Result<Option<DVec3>, SceneError> {
            self.attribute(name).map(|text| self.parse_three(text).map(DVec3::from)).transpose()
        };
        let origin = point("origin")?.unwrap_or(DVec3::ZERO);
        let forward = (point("target")?.unwrap_or(DVec3::Z) - origin).try_normalize();
        let forward = forward.ok_or_else(|| self.error("the target of the lookat is its origin", "move one of them"))?;
        let up = point("up")?.filter(|up| *up != DVec3::ZERO).unwrap_or_else(|| forward.any_orthonormal_vector());
        let left = up.cross(forward).try_normalize();
        let left = left.ok_or_else(|| self.error("`up` is parallel to the direction of the lookat", "choose another one"))?;
        let up = forward.cross(left);
        Ok(DMat4::from_cols(left.extend(0.0), up.extend(0.0), forward.extend(0.0), origin.extend(1.0)))
    }

    /// Row by row: 16 numbers, or the first three columns of the first three rows.
    fn matrix(self) -> Result<DMat4, SceneError> {
        let numbers = words(self.value()?).map(|word| self.parse_number(word)).collect::<Result<Vec<_>, _>>()?;
        match numbers[..] {
            [a, b, c, d, e, f, g, h, i] => Ok(DMat4::from_mat3(DMat3::from_cols_array(&[a, d, g, b, e, h, c, f, i]))),
            _ => match <[f64; 16]>::try_from(numbers) {
                Ok(rows) => Ok(DMat4::from_cols_array(&rows).transpose()),
                Err(_) => Err(self.error("a matrix has 16 or 9 numbers", "write them row by row")),
            },
        }
    }
}
