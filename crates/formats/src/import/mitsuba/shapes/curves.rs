//! Curves, as meshes.
use std::io::Read;

use glam::DAffine3;

use super::{
    super::{context::Import, tree::Element},
    Geometry, Placed, meshes,
};
use crate::import::tube::{CurvePoint, TubeMesh, spline};
use noisefall_base::file::open_regular;
use noisefall_scene::{model::Model, scene::SceneError};

/// Sides of a tube, and pieces of each segment of a spline, from fine to coarse.
const DETAILS: [[u32; 2]; 6] = [[48, 16], [24, 8], [12, 4], [8, 2], [4, 1], [3, 1]];
/// Vertices of the curves of a small file, and the number of its bytes that allow another one. Many curves have fewer sides.
const MOST_VERTICES: usize = 1 << 20;
const BYTES_OF_VERTEX: usize = 8;
/// Most bytes of a file.
const LARGEST_FILE: u64 = 256 << 20;

/// The coordinate v at a place along a curve, in segments.
type Coordinate<'a> = &'a dyn Fn(f64) -> f64;

/// How a family of curves becomes a mesh.
struct Family {
    /// Control points that a curve needs.
    least: usize,
    /// Number of vertices of a curve with so many control points, at a level of detail.
    vertices: fn(usize, [u32; 2]) -> usize,
    /// Adds a curve, each segment of a spline in so many pieces.
    add: fn(&mut TubeMesh, &[CurvePoint], u32, Coordinate<'_>),
    effect: &'static str,
}

/// Tubes that are open at their ends.
const SPLINES: Family = Family {
    least: 4,
    vertices: |points, [sides, pieces]| TubeMesh::vertices_of_tube((points - 3) * pieces as usize + 1, sides),
    add: add_spline,
    effect: "its outline is a polygon, its open ends show the inside, and textures are turned around it",
};

/// Cones between balls, tangent to them.
const LINES: Family = Family {
    least: 2,
    vertices: |points, [sides, _]| {
        points * TubeMesh::vertices_of_ball(sides) + (points - 1) * TubeMesh::vertices_of_tube(2, sides)
    },
    add: add_lines,
    effect: "its outline is a polygon, and textures are turned around it",
};

pub fn splines(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    curves(import, element, placed, &SPLINES)
}

pub fn lines(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    curves(import, element, placed, &LINES)
}

fn curves(import: &mut Import, element: Element, placed: Placed, family: &Family) -> Result<Geometry, SceneError> {
    let path = import.file(element, "filename")?;
    let map = element.affine("to_world")?;
    let key = format!("{} {} {map}", element.kind(), path.display());
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let help = "a file of curves has x y z radius per line, and an empty line between curves";
    let file = import.shared_model(&key, &name, |import| {
        let error = |message: String| element.error(format!("the curves cannot be read: {message}"), help);
        let mut bytes = Vec::new();
        let read = open_regular(&path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
        let length = read.map_err(|reason| error(reason.to_string()))?;
        if length as u64 > LARGEST_FILE {
            return Err(error(format!("the file is larger than {} MB", LARGEST_FILE >> 20)));
        }
        let curves = parse(&String::from_utf8_lossy(&bytes), &map).map_err(error)?;
        let most = MOST_VERTICES.max(bytes.len() / BYTES_OF_VERTEX);
        let (model, sides) = mesh(&curves, family, most).map_err(error)?;
        import.remark(element, &format!("a mesh with {sides} sides"), family.effect);
        Ok(model)
    })?;
    Ok(Geometry { shape: meshes::in_memory(file, true), map: placed.around, flip: placed.flip })
}

/// The control points of each curve. `map` moves them, but does not change their radii, as in Mitsuba.
fn parse(text: &str, map: &DAffine3) -> Result<Vec<Vec<CurvePoint>>, String> {
    let mut curves = vec![Vec::new()];
    for (number, line) in text.lines().enumerate() {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers.as_deref() {
            Ok([]) => curves.push(Vec::new()),
            Ok(&[x, y, z, radius]) if [x, y, z, radius].iter().all(|number| number.abs() < 1e30) && radius >= 0.0 => {
                let at = map.transform_point3([x, y, z].into());
                curves.last_mut().into_iter().for_each(|curve| curve.push(at.extend(radius)));
            }
            _ => return Err(format!("line {} is not x y z radius", number + 1)),
        }
    }
    curves.retain(|curve| !curve.is_empty());
    if curves.is_empty() { Err("there are no control points".to_owned()) } else { Ok(curves) }
}

/// The mesh with as many sides as a limit of its vertices allows, and their number.
fn mesh(curves: &[Vec<CurvePoint>], family: &Family, most: usize) -> Result<(Model, u32), String> {
    if let Some(short) = curves.iter().find(|curve| curve.len() < family.least) {
        return Err(format!("a curve has {} control points, and needs {}", short.len(), family.least));
    }
    let vertices =
        |detail: [u32; 2]| curves.iter().map(|curve| (family.vertices)(curve.len(), detail)).fold(0, usize::saturating_add);
    let fits = |detail: &[u32; 2]| vertices(*detail) <= most;
    let Some([sides, pieces]) = DETAILS.into_iter().find(fits) else {
        return Err(format!("they would have more than {most} vertices"));
    };
    let segments = |curve: &Vec<CurvePoint>| curve.len() + 1 - family.least;
    let all = curves.iter().map(segments).sum::<usize>() as f64;
    let mut mesh = TubeMesh::new(sides, vertices([sides, pieces]));
    let mut before = 0;
    for curve in curves {
        // v of a model runs upwards.
        (family.add)(&mut mesh, curve, pieces, &|place| 1.0 - (before as f64 + place) / all);
        before += segments(curve);
    }
    Ok((mesh.into_model(), sides))
}

fn add_spline(mesh: &mut TubeMesh, points: &[CurvePoint], pieces: u32, v: Coordinate<'_>) {
    let mut line = Vec::new();
    for (segment, p) in points.array_windows::<4>().enumerate() {
        let first = u32::from(segment > 0);
        line.extend((first..=pieces).map(|piece| {
            let t = f64::from(piece) / f64::from(pieces);
            (spline(p, t), v(segment as f64 + t))
        }));
    }
    mesh.add_tube(&line);
}

fn add_lines(mesh: &mut TubeMesh, points: &[CurvePoint], _: u32, v: Coordinate<'_>) {
    for (place, point) in points.iter().enumerate() {
        mesh.add_ball(*point, v(place as f64));
    }
    for (segment, [a, b]) in points.array_windows().enumerate() {
        let step = (b - a).truncate();
        // The cone that touches both balls (Han et al. 2019, generalized tubes) does so beside their centres, by the sine of its half angle.
        let sin = (a.w - b.w) / step.length();
        if sin.abs() < 1.0 {
            let cos = (1.0 - sin * sin).sqrt();
            let touched = |ball: CurvePoint| (ball.truncate() + step.normalize() * ball.w * sin).extend(ball.w * cos);
            mesh.add_tube(&[(touched(*a), v(segment as f64)), (touched(*b), v(segment as f64 + 1.0))]);
        }
    }
}
