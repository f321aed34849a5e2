//! Shapes of a scene file, and the transforms that place them.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use toml::Spanned;

use super::mesh::Meshes;
use crate::{
    geometry::{Expression, Isosurface, Motion, Outline, Shape, Step, Turns, sphere_field},
    scene::{
        check::Checker,
        desc::{
            CuboidDesc, CylinderDesc, DiskDesc, Exactly, IsosurfaceDesc, RectangleDesc, ShapeDesc, TransformDesc, TriangleDesc,
        },
        diagnostic::SceneError,
    },
};

/// The sine of the angle between edges below which a shape is taken as degenerate.
const FLATTEST: f64 = 1e-9;
/// Bytes of a sphere as a shape and as an object.
const SPHERE: u64 = 1500;
/// Spheres of a field.
const MOST_SPHERES: u32 = 1_000_000;
/// Scales beyond these leave the range of f32.
const SMALLEST_SCALE: f64 = 1e-12;
const LARGEST_SCALE: f64 = 1e12;
/// Of lengths, so that the ends of the range lie within it.
const ROUNDING: f64 = 1e-12;

/// The shape that is described, or the many.
pub fn shapes(check: &Checker, desc: &Spanned<ShapeDesc>, meshes: &mut Meshes) -> Result<Vec<Shape>, SceneError> {
    let shape = match desc.as_ref() {
        ShapeDesc::SphereField(field) => {
            let (min, size) = bounds(check, &field.bounds.min, &field.bounds.max)?;
            let count = check.count(&field.count, 1, MOST_SPHERES)?;
            check.reserve(field.count.span(), format_args!("{count} spheres"), SPHERE * u64::from(count))?;
            return Ok(sphere_field(count, min, size, field.seed));
        }
        ShapeDesc::Sphere(sphere) => {
            Shape::Sphere { center: check.point("center", &sphere.center)?, radius: check.radius(&sphere.radius)? }
        }
        ShapeDesc::Cuboid(cuboid_desc) => cuboid(check, cuboid_desc)?,
        ShapeDesc::Cylinder(cylinder_desc) => cylinder(check, cylinder_desc)?,
        ShapeDesc::Disk(disk_desc) => disk(check, disk_desc)?,
        ShapeDesc::Rectangle(rectangle_desc) => rectangle(check, rectangle_desc)?,
        ShapeDesc::Triangle(triangle_desc) => triangle(check, triangle_desc)?,
        ShapeDesc::Mesh(mesh_desc) => Shape::mesh(meshes.mesh(check, mesh_desc, desc.span())?),
        ShapeDesc::Isosurface(isosurface_desc) => isosurface(check, isosurface_desc)?,
    };
    Ok(vec![shape])
}

/// The least corner of a box, and its size.
fn bounds(check: &Checker, min: &Spanned<Exactly<f64, 3>>, max: &Spanned<Exactly<f64, 3>>) -> Result<(DVec3, DVec3), SceneError> {
    let (min, max, end) = (check.point("min", min)?, check.point("max", max)?, max.span());
    let size = max - min;
    if let Some(axis) = (0..3).find(|axis| size[*axis] <= 0.0) {
        let name = ["x", "y", "z"][axis];
        let message = format!("the bounds are inverted or empty in {name}: {} to {}", min[axis], max[axis]);
        return Err(check.0.error(end, message, "`max` must lie above `min` in every coordinate"));
    }
    Ok((min, size))
}

fn cuboid(check: &Checker, desc: &CuboidDesc) -> Result<Shape, SceneError> {
    let (origin, size) = bounds(check, &desc.min, &desc.max)?;
    Ok(Shape::Cuboid { origin, edges: DMat3::from_diagonal(size) })
}

fn isosurface(check: &Checker, desc: &IsosurfaceDesc) -> Result<Shape, SceneError> {
    let (min, size) = bounds(check, &desc.bounds.min, &desc.bounds.max)?;
    let text = desc.expression.as_ref();
    let expression = Expression::parse(text).map_err(|error| {
        // Within the quotes, unless they hold escapes: then only the whole is known.
        let start = desc.expression.span().start + 1;
        let plain = check.0.text.get(start..start + text.len()) == Some(text);
        let place = if plain { start + error.at.start..start + error.at.end } else { desc.expression.span() };
        check.0.error(place, error.message, error.label)
    })?;
    let [min, max] = [min, min + size].map(|corner| corner.as_vec3().to_array());
    Ok(Shape::Isosurface { surface: Arc::new(Isosurface::new(expression, min, max)), map: DAffine3::IDENTITY })
}

fn cylinder(check: &Checker, desc: &CylinderDesc) -> Result<Shape, SceneError> {
    let (base, top) = (check.point("base", &desc.base)?, check.point("top", &desc.top)?);
    if (top - base).try_normalize().is_none() {
        return Err(check.0.error(desc.top.span(), "the cylinder has no height", "`top` must differ from `base`"));
    }
    Ok(Shape::cylinder(base, top, check.radius(&desc.radius)?, desc.capped.unwrap_or(true)))
}

fn disk(check: &Checker, desc: &DiskDesc) -> Result<Shape, SceneError> {
    let normal = check.point("normal", &desc.normal)?.try_normalize();
    let normal = normal.ok_or_else(|| check.0.error(desc.normal.span(), "the normal has no direction", "it must not be zero"))?;
    Ok(Shape::disk(check.point("center", &desc.center)?, normal, check.radius(&desc.radius)?))
}

fn rectangle(check: &Checker, desc: &RectangleDesc) -> Result<Shape, SceneError> {
    let edges = [check.point("edge_u", &desc.edge_u)?, check.point("edge_v", &desc.edge_v)?];
    if are_parallel(edges) {
        let label = "`edge_u` and `edge_v` must not be zero or parallel";
        return Err(check.0.error(desc.edge_v.span(), "the rectangle has no area", label));
    }
    let origin = check.point("origin", &desc.origin)?;
    Ok(Shape::Flat { outline: Outline::Parallelogram, origin, edges, mirrored: false })
}

fn triangle(check: &Checker, desc: &TriangleDesc) -> Result<Shape, SceneError> {
    let [a, b, c] = [check.point("a", &desc.a)?, check.point("b", &desc.b)?, check.point("c", &desc.c)?];
    let edges = [b - a, c - a];
    if are_parallel(edges) {
        return Err(check.0.error(desc.c.span(), "the triangle has no area", "its corners must not lie on a line"));
    }
    Ok(Shape::Flat { outline: Outline::Triangle, origin: a, edges, mirrored: false })
}

fn are_parallel([a, b]: [DVec3; 2]) -> bool {
    a.cross(b).length() <= FLATTEST * a.length() * b.length()
}

/// The product of a list of transforms, the first one applied first.
pub fn transform(check: &Checker, list: &[Spanned<TransformDesc>]) -> Result<DAffine3, SceneError> {
    list.iter().try_fold(DAffine3::IDENTITY, |before, entry| Ok(single(check, entry)?.at(1.0) * before))
}

/// A list of transforms that are reached at time 1.
pub fn motion(check: &Checker, list: &[Spanned<TransformDesc>]) -> Result<Motion, SceneError> {
    let motion = Motion(list.iter().map(|entry| single(check, entry)).collect::<Result<_, _>>()?);
    match list.last() {
        Some(last) if !motion.is_invertible() => {
            Err(check.0.error(last.span(), "the motion cannot be inverted", "it mirrors or flattens space on its way"))
        }
        _ => Ok(motion),
    }
}

fn single(check: &Checker, entry: &Spanned<TransformDesc>) -> Result<Step, SceneError> {
    let error = |message: &str, label: &str| Err(check.0.error(entry.span(), message.to_owned(), label));
    let step = match entry.as_ref() {
        TransformDesc::Translate(by) => Step::Translate(DVec3::from_array(by.0)),
        TransformDesc::Scale(factors) => Step::Scale(DVec3::from_array(factors.0)),
        TransformDesc::Rotate(rotate) => match DVec3::from_array(rotate.axis.0).try_normalize() {
            Some(axis) => Step::Rotate { axis, turns: Turns::from_degrees(rotate.degrees) },
            None => return error("the axis of rotation has no direction", "it must not be zero"),
        },
        TransformDesc::Matrix(rows) => {
            let [x, y, z, last] = rows.0.each_ref().map(|row| row.0);
            if last != [0.0, 0.0, 0.0, 1.0] {
                return error("the matrix is not affine", "the last row must be 0, 0, 0, 1");
            }
            let column = |i: usize| DVec3::new(x[i], y[i], z[i]);
            Step::Matrix(DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) })
        }
    };
    let map = step.at(1.0);
    if !map.is_finite() {
        return error("the transform is not finite", "all of its numbers must be");
    }
    let [a, b, c] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
    let lengths = [a.length(), b.length(), c.length()];
    if lengths.iter().any(|length| !(SMALLEST_SCALE * (1.0 - ROUNDING)..=LARGEST_SCALE * (1.0 + ROUNDING)).contains(length))
        || map.matrix3.determinant().abs() <= FLATTEST * lengths.iter().product::<f64>()
    {
        return error("the transform cannot be inverted", "it flattens space, or scales it beyond 1e-12 to 1e12");
    }
    Ok(step)
}
