//! Numbers of the format at the ends of their ranges: the last that is accepted, and the first that is rejected, with a message
//! that states the position and the range. `declared.rs` tests those of every declaration.
use std::{collections::BTreeSet, fs};

use noisefall_base::declare::{Choice, Declare, Form, Parameter, Parameters, Value};
use noisefall_scene::scene::{SceneError, description::SceneDescription, parse};

/// A number of the format.
struct Range {
    /// Tables and key, as [`KEYS`] collects them.
    key: &'static str,
    /// A file without its `format` line. `X` stands for the number, `VIEW` for a camera, and `BALL` for a shape.
    text: &'static str,
    accepted: &'static [&'static str],
    refused: &'static [&'static str],
    /// Text of every message: the error, or the expected value.
    says: &'static str,
}

const VIEW: &str = "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }";
const BALL: &str = "shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }";

const fn range(
    key: &'static str,
    text: &'static str,
    accepted: &'static [&'static str],
    refused: &'static [&'static str],
    says: &'static str,
) -> Range {
    Range { key, text, accepted, refused, says }
}

const FAR: &[&str] = &["-1e12", "0.5", "1e12"];
const BEYOND: &[&str] = &["1.000001e12", "-1.000001e12", "nan", "inf", "-inf"];
const POSITION: &str = "coordinates must be finite and at most 1e12 in magnitude";
const PART: &[&str] = &["0.0", "0", "1.0", "1", "[0.0, 1.0, 0.5]"];
const NO_PART: &[&str] = &["-1e-9", "1.000001", "nan", "inf", "[0.0, 0.0, 1.1]", "[-0.1, 0.0, 0.0]", "[0.5, 0.5]", "true"];
const NARROW: &[&str] = &["0.0", "1.0"];
const NOT_NARROW: &[&str] = &["-1e-9", "1.000001", "nan", "[0.1, 0.2, 0.3]"];
const LIGHT: &[&str] = &["0.0", "1e15", "[0.0, 1e15, 1.0]"];
const NO_LIGHT: &[&str] = &["-1e-9", "1.000001e15", "nan", "inf", "[1.0, 1.0, -1.0]"];
const RADIUS: &[&str] = &["1e-12", "1e12", "1"];
const NO_RADIUS: &[&str] = &["0.0", "-1.0", "0.99e-12", "1.000001e12", "nan", "inf"];
const COUNT: &[&str] = &["0", "4294967295"];
const NO_COUNT: &[&str] = &["-1", "4294967296", "1.5", "'one'"];
const SCALES: &[&str] = &["1e-6", "1e5"];
const NO_SCALES: &[&str] = &["0.99e-6", "1.000001e5", "0.0", "-1.0", "nan"];
const INDICES: &[&str] = &["0.05", "20.0"];
const NO_INDICES: &[&str] = &["0.0499", "20.001", "0.0", "-1.5", "nan"];

#[rustfmt::skip]
const RANGES: &[Range] = &[
    range("format", "", &[], &[], ""),
    range("camera.eye", "camera = { eye = [X, 0.1, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }", FAR, BEYOND, POSITION),
    range("camera.look_at", "camera = { eye = [0.0, 0.1, 4.0], look_at = [X, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }", FAR, BEYOND, POSITION),
    range("camera.up", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], up = [0.0, X, 0.0], fov = 40.0, resolution = [8, 8] }", FAR, BEYOND, POSITION),
    range("camera.up", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], up = [0.0, X, 1.0], fov = 40.0, resolution = [8, 8] }", &["1e-5", "-1.0"], &["0.0", "1e-7"], "`up` is parallel"),
    range("camera.fov", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = X, resolution = [8, 8] }", &["0.001", "179.9", "40"], &["0.00099", "179.91", "0.0", "-40.0"], "expected a number from 0.001 to 179.9"),
    range("camera.resolution", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [X] }", &["1, 1", "16384, 2048", "2048, 16384"], &["0, 8", "8, 0", "16385, 1", "1, 16385", "16384, 2049"], "the resolution must be at least 1 × 1, at most 16384 a side and 33554432 pixels"),
    range("camera.projection.orthographic.width", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = X, resolution = [8, 8] }", &["1e-9", "1e9"], &["0.99e-9", "1.000001e9", "0.0", "-1.0", "nan"], "expected a number from 1e-9 to 1e9"),
    range("camera.lens.radius", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], lens = { radius = X, focus = 1.0 } }", &["0.0", "1e9"], &["-1e-9", "1.000001e9", "nan"], "expected a number from 0 to 1e9"),
    range("camera.lens.focus", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], lens = { radius = 0.1, focus = X } }", &["1e-9", "1e12"], &["0.99e-9", "1.000001e12", "0.0", "nan"], "expected a number from 1e-9 to 1e12"),
    range("camera.shutter", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], shutter = [0.5, X] }", &["0.5", "1e6"], &["0.499", "1.000001e6", "nan", "inf"], "expected two times from -1e6 to 1e6, the earlier one first"),
    range("camera.shutter", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], shutter = [X, 0.5] }", &["0.5", "-1e6"], &["0.501", "-1.000001e6", "nan", "-inf"], "`shutter` is out of range"),
    range("camera.filter.tent.radius", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], filter.tent.radius = X }", &["0.01", "16.0"], &["0.0099", "16.001", "nan"], "expected a number from 0.01 to 16"),
    range("camera.filter.gaussian.sigma", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], filter.gaussian.sigma = X }", &["0.01", "16.0"], &["0.0099", "16.001", "nan"], "expected a number from 0.01 to 16"),
    range("environment.radiance", "VIEW\nenvironment.radiance = X", LIGHT, NO_LIGHT, "radiance"),
    range("environment.rotate", "VIEW\nenvironment = { image = 'sky.hdr', rotate = X }", &["0", "-1e300", "1e300", "3600.5"], &["nan", "inf", "-inf"], "`rotate` is not a finite number"),
    range("environment.scale", "VIEW\nenvironment = { image = 'sky.hdr', scale = X }", &["1e-12", "1e12"], &["0.99e-12", "1.000001e12", "0.0", "-1.0", "nan"], "expected a number from 1e-12 to 1e12"),
    range("environment.sky.turbidity", "VIEW\nenvironment.sky.turbidity = X", &["1.0", "10.0"], &["0.99", "10.01", "nan"], "expected a number from 1 to 10"),
    range("environment.sky.sun", "VIEW\nenvironment.sky.sun = [0, X, 0]", &["1e-9", "-1.0"], &["0.0"], "the sun has no direction"),
    range("lights.point.position", "VIEW\n[[lights]]\npoint.position = [X, 0.0, 0.0]", FAR, BEYOND, POSITION),
    range("lights.point.intensity", "VIEW\n[[lights]]\npoint.intensity = X", LIGHT, NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("lights.spot.angle", "VIEW\n[[lights]]\nspot.angle = X", &["0.01", "180.0"], &["0.0099", "180.001", "nan"], "expected a number from 0.01 to 180"),
    range("lights.spot.position", "VIEW\n[[lights]]\nspot = { target = [0, 1, 0], position = [0, X, 0] }", &["2.0"], &["1.0"], "are the same point"),
    range("lights.directional.direction", "VIEW\n[[lights]]\ndirectional.direction = [0, X, 0]", &["1e-9", "-1e100"], &["0.0"], "the light has no direction"),
    range("lights.directional.irradiance", "VIEW\n[[lights]]\ndirectional.irradiance = X", LIGHT, NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("lights.projector.fov", "VIEW\n[[lights]]\nprojector.fov = X", &["0.01", "179.0"], &["0.0099", "179.1", "nan"], "expected a number from 0.01 to 179"),
    range("textures.checker.even", "VIEW\ntextures.t.checker = { even = X, odd = 0.5, scale = 2.0 }", LIGHT, NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("textures.checker.odd", "VIEW\ntextures.t.checker = { even = 0.5, odd = X, scale = 2.0 }", LIGHT, NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("textures.checker.scale", "VIEW\ntextures.t.checker = { even = 0.5, odd = 0.5, scale = X }", SCALES, NO_SCALES, "expected a number from 1e-6 to 100000"),
    range("textures.noise.scale", "VIEW\ntextures.t.noise = { scale = X, octaves = 2, low = 0.1, high = 0.9 }", SCALES, NO_SCALES, "expected a number from 1e-6 to 100000"),
    range("textures.noise.octaves", "VIEW\ntextures.t.noise = { scale = 1.0, octaves = X, low = 0.1, high = 0.9 }", &["1", "16"], &["0", "17", "-1", "1.5"], "whole number"),
    range("textures.noise.low", "VIEW\ntextures.t.noise = { scale = 1.0, octaves = 2, low = X, high = 0.9 }", LIGHT, NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("textures.noise.high", "VIEW\ntextures.t.noise = { scale = 1.0, octaves = 2, low = 0.1, high = X }", LIGHT, NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("materials.lambertian.albedo", "VIEW\nmaterials.m.lambertian.albedo = X", PART, NO_PART, "albedo"),
    range("materials.mirror.reflectance", "VIEW\nmaterials.m.mirror.reflectance = X", PART, NO_PART, "reflectance"),
    range("materials.dielectric.ior", "VIEW\nmaterials.m.dielectric = { ior = X }", INDICES, NO_INDICES, "expected a number from 0.05 to 20"),
    range("materials.dielectric.ior_outside", "VIEW\nmaterials.m.dielectric = { ior = 1.5, ior_outside = X }", INDICES, NO_INDICES, "expected a number from 0.05 to 20"),
    range("materials.dielectric.roughness", "VIEW\nmaterials.m.dielectric = { ior = 1.5, roughness = X }", NARROW, NOT_NARROW, "roughness"),
    range("materials.dielectric.alpha", "VIEW\nmaterials.m.dielectric = { ior = 1.5, alpha = X }", NARROW, NOT_NARROW, "alpha"),
    range("materials.dielectric.transmittance", "VIEW\nmaterials.m.dielectric = { ior = 1.5, transmittance = X }", PART, NO_PART, "transmittance"),
    range("materials.conductor.eta", "VIEW\nmaterials.m.conductor = { eta = X, k = 1.0 }", &["0.0", "1000.0"], &["-1e-9", "1000.001", "nan"], "every channel of `eta` and `k` must be a number from 0 to 1000"),
    range("materials.conductor.k", "VIEW\nmaterials.m.conductor = { eta = 1.0, k = X }", &["0.0", "1000.0"], &["-1e-9", "1000.001", "nan"], "every channel of `eta` and `k` must be a number from 0 to 1000"),
    range("materials.conductor.k", "VIEW\nmaterials.m.conductor = { eta = [1.0, 0.0, 1.0], k = [1.0, X, 1.0] }", &["0.0", "1e-6"], &["-1e-9"], "every channel of `eta` and `k` must be a number from 0 to 1000"),
    range("materials.conductor.f0", "VIEW\nmaterials.m.conductor = { f0 = X }", PART, NO_PART, "f0"),
    range("materials.conductor.reflectance", "VIEW\nmaterials.m.conductor = { reflectance = X }", PART, NO_PART, "reflectance"),
    range("materials.conductor.roughness", "VIEW\nmaterials.m.conductor = { f0 = 0.5, roughness = X }", NARROW, NOT_NARROW, "roughness"),
    range("materials.conductor.alpha", "VIEW\nmaterials.m.conductor = { f0 = 0.5, alpha = X }", NARROW, NOT_NARROW, "alpha"),
    range("materials.plastic.albedo", "VIEW\nmaterials.m.plastic = { albedo = X, ior = 1.5 }", PART, NO_PART, "albedo"),
    range("materials.plastic.ior", "VIEW\nmaterials.m.plastic = { albedo = 0.5, ior = X }", &["1.0", "20.0"], &["0.999", "20.001", "-1.5", "nan"], "expected a number from 1 to 20"),
    range("materials.plastic.roughness", "VIEW\nmaterials.m.plastic = { albedo = 0.5, ior = 1.5, roughness = X }", NARROW, NOT_NARROW, "roughness"),
    range("materials.plastic.alpha", "VIEW\nmaterials.m.plastic = { albedo = 0.5, ior = 1.5, alpha = X }", NARROW, NOT_NARROW, "alpha"),
    range("materials.bump.height", "VIEW\ntextures.t.checker = { even = 0.1, odd = 0.5, scale = 2.0 }\nmaterials.m = { lambertian.albedo = 0.5, bump = { texture = 't', height = X } }", &["-1e6", "0.0", "1e6"], &["-1.000001e6", "1.000001e6", "nan"], "expected a number from -1e6 to 1e6"),
    range("objects.shape.sphere.center", "VIEW\n[[objects]]\nshape.sphere = { center = [X, 0.0, 0.0], radius = 1.0 }", FAR, BEYOND, POSITION),
    range("objects.shape.sphere.radius", "VIEW\n[[objects]]\nshape.sphere = { center = [0.0, 0.0, 0.0], radius = X }", RADIUS, NO_RADIUS, "expected a number from 1e-12 to 1e12"),
    range("objects.shape.sphere_field.count", "VIEW\n[[objects]]\nshape.sphere_field = { count = X, bounds = { min = [0, 0, 0], max = [1, 1, 1] } }", &["1", "9"], &["0", "1000001"], "expected a whole number from 1 to 1000000"),
    range("objects.shape.sphere_field.seed", "VIEW\n[[objects]]\nshape.sphere_field = { count = 9, bounds = { min = [0, 0, 0], max = [1, 1, 1] }, seed = X }", COUNT, NO_COUNT, "expected a whole number, 0 or more"),
    range("objects.shape.sphere_field.bounds.min", "VIEW\n[[objects]]\nshape.sphere_field = { count = 9, bounds = { min = [X, 0, 0], max = [2, 1, 1] } }", &["-1e12", "1.9"], &["-1.000001e12", "nan"], POSITION),
    range("objects.shape.sphere_field.bounds.max", "VIEW\n[[objects]]\nshape.sphere_field = { count = 9, bounds = { min = [0, 0, 0], max = [1, X, 1] } }", &["1e-3", "1e12"], &["0.0", "-1.0"], "`max` must lie above `min` in every coordinate"),
    range("objects.shape.cuboid.min", "VIEW\n[[objects]]\nshape.cuboid = { min = [X, 0, 0], max = [1, 1, 1] }", &["-1e12", "0.999"], BEYOND, POSITION),
    range("objects.shape.cuboid.max", "VIEW\n[[objects]]\nshape.cuboid = { min = [0, 0, 0], max = [1, 1, X] }", &["1e-3", "1e12"], BEYOND, POSITION),
    range("objects.shape.cuboid.max", "VIEW\n[[objects]]\nshape.cuboid = { min = [0, 0, 0], max = [1, 1, X] }", &["1e-3"], &["0.0", "-1e-9"], "`max` must lie above `min` in every coordinate"),
    range("objects.shape.cylinder.base", "VIEW\n[[objects]]\nshape.cylinder = { base = [0, X, 0], top = [0, 1, 0], radius = 1.0 }", FAR, BEYOND, POSITION),
    range("objects.shape.cylinder.top", "VIEW\n[[objects]]\nshape.cylinder = { base = [0, 0, 0], top = [0, X, 0], radius = 1.0 }", FAR, BEYOND, POSITION),
    range("objects.shape.cylinder.top", "VIEW\n[[objects]]\nshape.cylinder = { base = [0, 0, 0], top = [0, X, 0], radius = 1.0 }", &["1e-9"], &["0.0", "-0.0"], "`top` must differ from `base`"),
    range("objects.shape.cylinder.radius", "VIEW\n[[objects]]\nshape.cylinder = { base = [0, 0, 0], top = [0, 1, 0], radius = X }", &["1e-12", "1e11"], NO_RADIUS, "expected a number from 1e-12 to 1e12"),
    range("objects.shape.disk.center", "VIEW\n[[objects]]\nshape.disk = { center = [X, 0, 0], normal = [0, 1, 0], radius = 1.0 }", FAR, BEYOND, POSITION),
    range("objects.shape.disk.normal", "VIEW\n[[objects]]\nshape.disk = { center = [0, 0, 0], normal = [0, X, 0], radius = 1.0 }", FAR, BEYOND, POSITION),
    range("objects.shape.disk.normal", "VIEW\n[[objects]]\nshape.disk = { center = [0, 0, 0], normal = [0, X, 0], radius = 1.0 }", &["1e-9", "-1.0"], &["0.0"], "it must not be zero"),
    range("objects.shape.disk.radius", "VIEW\n[[objects]]\nshape.disk = { center = [0, 0, 0], normal = [0, 1, 0], radius = X }", &["1e-11", "1e11"], NO_RADIUS, "expected a number from 1e-12 to 1e12"),
    range("objects.shape.rectangle.origin", "VIEW\n[[objects]]\nshape.rectangle = { origin = [X, 0, 0], edge_u = [1, 0, 0], edge_v = [0, 1, 0] }", &["-0.9e12", "0.9e12"], BEYOND, POSITION),
    range("objects.shape.rectangle.edge_u", "VIEW\n[[objects]]\nshape.rectangle = { origin = [0, 0, 0], edge_u = [X, 0, 0], edge_v = [0, 1, 0] }", FAR, BEYOND, POSITION),
    range("objects.shape.rectangle.edge_v", "VIEW\n[[objects]]\nshape.rectangle = { origin = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [0, X, 0] }", FAR, BEYOND, POSITION),
    range("objects.shape.rectangle.edge_v", "VIEW\n[[objects]]\nshape.rectangle = { origin = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [1, X, 0] }", &["1e-8", "-1.0"], &["0.0", "1e-10"], "`edge_u` and `edge_v` must not be zero or parallel"),
    range("objects.shape.triangle.a", "VIEW\n[[objects]]\nshape.triangle = { a = [X, 0, 0], b = [0, 1e12, 0], c = [0, 0, 1e12] }", &["-1e12", "0.5", "1e12"], BEYOND, POSITION),
    range("objects.shape.triangle.b", "VIEW\n[[objects]]\nshape.triangle = { a = [1e12, 0, 0], b = [0, X, 0], c = [0, 0, 1e12] }", &["-1e12", "0.5", "1e12"], BEYOND, POSITION),
    range("objects.shape.triangle.c", "VIEW\n[[objects]]\nshape.triangle = { a = [1e12, 0, 0], b = [0, 1e12, 0], c = [0, 0, X] }", &["-1e12", "0.5", "1e12"], BEYOND, POSITION),
    range("objects.shape.triangle.c", "VIEW\n[[objects]]\nshape.triangle = { a = [0, 0, 0], b = [1, 0, 0], c = [2, X, 0] }", &["1e-8", "-1.0"], &["0.0", "1e-10"], "its corners must not lie on a line"),
    range("objects.shape.mesh.vertices", "VIEW\n[[objects]]\nshape.mesh = { triangles = [[0, 1, 2]], vertices = [[X, 0, 0], [0, 1, 0], [0, 0, 1]] }", &["-1e12", "1e12"], &["nan", "inf", "1e39"], "vertex 0 is not finite"),
    range("objects.shape.mesh.vertices", "VIEW\n[[objects]]\nshape.mesh = { triangles = [[0, 1, 2]], vertices = [[X, 0, 0], [0, 1, 0], [0, 0, 1]] }", &["1.9e12"], &["3e12", "-1e30"], "expected 1e-12 to 1e12 m"),
    range("objects.shape.mesh.triangles", "VIEW\n[[objects]]\nshape.mesh = { vertices = [[0, 0, 0], [0, 1, 0], [0, 0, 1]], triangles = [[0, 1, X]] }", &["2", "0"], &["3", "4294967295"], "there are 3, counted from 0"),
    range("objects.shape.mesh.knot.triangles", "VIEW\n[[objects]]\nshape.mesh.knot.triangles = X", &["18", "100"], &["17", "50000001", "0"], "expected a whole number from 18 to 50000000"),
    range("objects.shape.mesh.heightfield.quads", "VIEW\n[[objects]]\nshape.mesh.heightfield = { quads = X }", &["1", "9"], &["0", "5001"], "expected a whole number from 1 to 5000"),
    range("objects.shape.mesh.heightfield.seed", "VIEW\n[[objects]]\nshape.mesh.heightfield = { quads = 2, seed = X }", COUNT, NO_COUNT, "expected a whole number, 0 or more"),
    range("objects.shape.isosurface.bounds.min", "VIEW\n[[objects]]\nshape.isosurface = { expression = 'x', bounds = { min = [X, 0, 0], max = [2, 1, 1] } }", &["-1e12", "1.9"], BEYOND, POSITION),
    range("objects.shape.isosurface.bounds.max", "VIEW\n[[objects]]\nshape.isosurface = { expression = 'x', bounds = { min = [0, 0, 0], max = [X, 1, 1] } }", &["1e-3", "1e12"], BEYOND, POSITION),
    range("objects.transform.translate", "VIEW\n[[objects]]\nBALL\ntransform = [{ translate = [X, 0, 0] }]", &["-0.99e12", "1e12"], &["nan", "inf"], "the transform is not finite"),
    range("objects.transform.scale", "VIEW\n[[objects]]\nBALL\ntransform = [{ scale = X }]", &["1e-12", "1e12", "-1.0", "[1.0, 2.0, -3.0]"], &["0.99e-12", "1.01e12", "0.0", "[1.0, 0.0, 1.0]"], "it flattens space, or scales it beyond 1e-12 to 1e12"),
    range("objects.transform.rotate.axis", "VIEW\n[[objects]]\nBALL\ntransform = [{ rotate = { axis = [0, X, 0], degrees = 30.0 } }]", &["1e-9", "-1e100"], &["0.0"], "the axis of rotation has no direction"),
    range("objects.transform.rotate.degrees", "VIEW\n[[objects]]\nBALL\ntransform = [{ rotate = { axis = [0, 1, 0], degrees = X } }]", &["0.0", "-1e300", "1e300", "1.5e9"], &["nan", "inf", "-inf"], "`degrees` is not a finite number"),
    range("objects.transform.matrix", "VIEW\n[[objects]]\nBALL\ntransform = [{ matrix = [[X, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }]", &["1e-12", "1e12", "-1.0"], &["0.0", "0.99e-12", "1.01e12"], "it flattens space, or scales it beyond 1e-12 to 1e12"),
    range("objects.transform.matrix", "VIEW\n[[objects]]\nBALL\ntransform = [{ matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, X]] }]", &["1.0"], &["0.999", "0.0", "2.0"], "the last row must be 0, 0, 0, 1"),
    range("objects.motion.translate", "VIEW\n[[objects]]\nBALL\nmotion = [{ translate = [X, 0, 0] }]", &["-3.9e12", "3.9e12"], &["4.1e12", "-4.1e12", "1e100"], "its motion takes it"),
    range("objects.motion.rotate.degrees", "VIEW\n[[objects]]\nBALL\nmotion = [{ rotate = { axis = [0, 1, 0], degrees = X } }]", &["-1e300", "1.5e9"], &["nan", "inf"], "`degrees` is not a finite number"),
    range("camera.motion.translate", "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8], motion = [{ translate = [X, 0, 0] }] }", &["-1e12", "1e12"], &["nan", "inf"], "the transform is not finite"),
    range("objects.emission.radiance", "VIEW\n[[objects]]\nBALL\nemission.radiance = X", &["1e-30", "1e15", "[0.0, 1e15, 0.0]"], NO_LIGHT, "every channel must be a number from 0 to 1e15"),
    range("objects.emission.radiance", "VIEW\n[[objects]]\nBALL\nemission.radiance = X", &["1e-30"], &["0.0", "[0.0, 0.0, 0.0]"], "a light of zero power"),
    range("objects.emission.scale", "VIEW\n[[objects]]\nBALL\nemission = { radiance = 1.0, scale = X }", &["1e-12", "1e12"], &["-1e-9", "1.000001e12", "nan"], "expected a number from 0 to 1e12"),
    range("render.max_bounces", "VIEW\nrender.max_bounces = X", COUNT, NO_COUNT, "leave it out for no cap"),
    range("render.roulette.fixed", "VIEW\nrender.roulette.fixed = X", &["0.01", "1.0"], &["0.0099", "1.000001", "0.0", "nan"], "expected a number from 0.01 to 1"),
    range("render.roulette.throughput.start", "VIEW\nrender.roulette.throughput.start = X", COUNT, NO_COUNT, "expected a whole number, 0 or more"),
    range("render.spp", "VIEW\nrender.spp = X", &["1", "4294967295"], &["0"], "expected a whole number from 1 to 4294967295"),
    range("render.spp", "VIEW\nrender.spp = X", &["1"], &["-1", "4294967296", "1.5"], "expected a whole number, 0 or more"),
    range("render.exposure", "VIEW\nrender.exposure = X", &["-100.0", "0", "1.5", "100"], &["-100.1", "101", "nan"], "expected a number from -100 to 100"),
    range("render.seed", "VIEW\nrender.seed = X", COUNT, NO_COUNT, "expected a whole number, 0 or more"),
    range("reference.radiance", "VIEW\nreference.radiance = X", LIGHT, NO_LIGHT, "radiance"),
];

/// All keys of the format, as its declarations visit them: tables and key, joined by points.
struct Keys {
    path: Vec<&'static str>,
    all: BTreeSet<String>,
}

impl Keys {
    fn declared() -> BTreeSet<String> {
        let mut keys = Keys { path: Vec::new(), all: BTreeSet::new() };
        SceneDescription::default().parameters(&mut keys);
        keys.all
    }

    fn note(&mut self, key: &str) {
        let path: Vec<&str> = self.path.iter().copied().chain([key]).collect();
        self.all.insert(path.join("."));
    }
}

impl Parameters for Keys {
    fn value(&mut self, parameter: &Parameter, _: Value<'_>) {
        self.note(parameter.key);
    }
    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.note(parameter.key);
        self.path.push(parameter.key);
    }
    fn leave(&mut self) {
        self.path.pop();
    }
    fn present(&mut self, _: &Parameter, _: bool) -> bool {
        true
    }
    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        choice.alternatives.iter().for_each(|alternative| self.note(alternative.name));
        now
    }
    fn items(&mut self, _: &Parameter, _: usize) -> usize {
        1
    }
    fn item(&mut self, parameter: &Parameter, _: usize) {
        self.enter(parameter, Form::Table);
    }
    fn names(&mut self, _: &Parameter, _: Vec<String>) -> Vec<String> {
        vec!["name".to_owned()]
    }
    fn named(&mut self, parameter: &Parameter, _: &str) {
        self.enter(parameter, Form::Table);
    }
    fn sees_all(&self) -> bool {
        true
    }
}

/// Every table of the format with the unknown key `zzz`. The message lists the known keys.
#[rustfmt::skip]
const TABLES: &[(&str, &str)] = &[
    ("", "zzz = 1\nVIEW"),
    ("camera.", "camera.zzz = 1"),
    ("camera.projection.", "camera = { CAMERA, projection.zzz = 1 }"),
    ("camera.projection.orthographic.", "camera = { CAMERA, projection.orthographic.zzz = 1 }"),
    ("camera.lens.", "camera = { CAMERA, lens.zzz = 1 }"),
    ("camera.filter.", "camera = { CAMERA, filter.zzz = 1 }"),
    ("camera.filter.", "camera = { CAMERA, filter = 'zzz' }"),
    ("camera.filter.tent.", "camera = { CAMERA, filter.tent.zzz = 1 }"),
    ("camera.filter.gaussian.", "camera = { CAMERA, filter.gaussian.zzz = 1 }"),
    ("environment.", "VIEW\nenvironment.zzz = 1"),
    ("environment.sky.", "VIEW\nenvironment.sky.zzz = 1"),
    ("lights.", "VIEW\n[[lights]]\nzzz = 1"),
    ("lights.point.", "VIEW\n[[lights]]\npoint.zzz = 1"),
    ("lights.spot.", "VIEW\n[[lights]]\nspot.zzz = 1"),
    ("lights.directional.", "VIEW\n[[lights]]\ndirectional.zzz = 1"),
    ("lights.projector.", "VIEW\n[[lights]]\nprojector.zzz = 1"),
    ("textures.", "VIEW\ntextures.t.zzz = 1"),
    ("textures.image.", "VIEW\ntextures.t.image.zzz = 1"),
    ("textures.checker.", "VIEW\ntextures.t.checker.zzz = 1"),
    ("textures.noise.", "VIEW\ntextures.t.noise.zzz = 1"),
    ("materials.", "VIEW\nmaterials.m.zzz = 1"),
    ("materials.lambertian.", "VIEW\nmaterials.m.lambertian.zzz = 1"),
    ("materials.mirror.", "VIEW\nmaterials.m.mirror.zzz = 1"),
    ("materials.dielectric.", "VIEW\nmaterials.m.dielectric.zzz = 1"),
    ("materials.conductor.", "VIEW\nmaterials.m.conductor.zzz = 1"),
    ("materials.plastic.", "VIEW\nmaterials.m.plastic.zzz = 1"),
    ("materials.bump.", "VIEW\nmaterials.m.bump.zzz = 1"),
    ("objects.", "VIEW\n[[objects]]\nzzz = 1"),
    ("objects.shape.", "VIEW\n[[objects]]\nshape.zzz = {}"),
    ("objects.shape.sphere.", "VIEW\n[[objects]]\nshape.sphere.zzz = 1"),
    ("objects.shape.sphere_field.", "VIEW\n[[objects]]\nshape.sphere_field.zzz = 1"),
    ("objects.shape.sphere_field.bounds.", "VIEW\n[[objects]]\nshape.sphere_field.bounds.zzz = 1"),
    ("objects.shape.cuboid.", "VIEW\n[[objects]]\nshape.cuboid.zzz = 1"),
    ("objects.shape.cylinder.", "VIEW\n[[objects]]\nshape.cylinder.zzz = 1"),
    ("objects.shape.disk.", "VIEW\n[[objects]]\nshape.disk.zzz = 1"),
    ("objects.shape.rectangle.", "VIEW\n[[objects]]\nshape.rectangle.zzz = 1"),
    ("objects.shape.triangle.", "VIEW\n[[objects]]\nshape.triangle.zzz = 1"),
    ("objects.shape.mesh.", "VIEW\n[[objects]]\nshape.mesh.zzz = 1"),
    ("objects.shape.mesh.knot.", "VIEW\n[[objects]]\nshape.mesh.knot.zzz = 1"),
    ("objects.shape.mesh.heightfield.", "VIEW\n[[objects]]\nshape.mesh.heightfield.zzz = 1"),
    ("objects.shape.isosurface.", "VIEW\n[[objects]]\nshape.isosurface.zzz = 1"),
    ("objects.shape.isosurface.bounds.", "VIEW\n[[objects]]\nshape.isosurface.bounds.zzz = 1"),
    ("objects.transform.", "VIEW\n[[objects]]\nBALL\ntransform = [{ zzz = 1 }]"),
    ("objects.transform.rotate.", "VIEW\n[[objects]]\nBALL\ntransform = [{ rotate.zzz = 1 }]"),
    ("objects.emission.", "VIEW\n[[objects]]\nBALL\nemission.zzz = 1"),
    ("render.", "VIEW\nrender.zzz = 1"),
    ("render.roulette.", "VIEW\nrender.roulette.zzz = 1"),
    ("render.roulette.", "VIEW\nrender.roulette = 'zzz'"),
    ("render.roulette.throughput.", "VIEW\nrender.roulette.throughput.zzz = 1"),
    ("reference.", "VIEW\nreference.zzz = 1"),
];

fn full(text: &str) -> String {
    let inside = VIEW.trim_start_matches("camera = { ").trim_end_matches(" }");
    format!("format = 1\n{}\n", text.replace("VIEW", VIEW).replace("BALL", BALL).replace("CAMERA", inside))
}

#[test]
fn every_number_is_accepted_to_the_ends_of_its_range_and_refused_beyond() {
    let folder = tempfile::tempdir().expect("a folder");
    let sky = [b"#?RADIANCE\n\n-Y 1 +X 1\n".as_slice(), &[128, 128, 128, 129]].concat();
    fs::write(folder.path().join("sky.hdr"), sky).expect("it is written");
    let name = folder.path().join("ranges.toml").display().to_string();
    for Range { key, text, accepted, refused, says } in RANGES {
        let text = full(text);
        let at = text.find('X').unwrap_or_default();
        let with = |value: &str| parse(&name, text.replacen('X', value, 1));
        for value in *accepted {
            if let Err(error) = with(value) {
                panic!("{key} = {value} is refused:\n{}", error.report());
            }
        }
        for value in *refused {
            let Err(error) = with(value) else { panic!("{key} = {value} is accepted") };
            let report = plain(&error);
            assert!(report.contains(says), "{key} = {value}: {says:?} is not in:\n{}", error.report());
            let (line, column) = error.line_column().expect("a place");
            let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
            assert_eq!(line, text[..at].matches('\n').count() + 1, "{key} = {value}:\n{}", error.report());
            assert!(column <= at - start + 1, "{key} = {value} is pointed at after it is:\n{}", error.report());
        }
    }
}

/// A report without its line breaks.
fn plain(error: &SceneError) -> String {
    error.report().replace(['│', '\n'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The keys that the message about an unknown key lists, in backquotes after `expected`.
fn keys_of(table: &str, text: &str) -> Vec<String> {
    let Err(error) = parse("keys.toml", full(text)) else { panic!("{table} has a key `zzz`") };
    let report = plain(&error);
    assert!(report.contains("`zzz`"), "{table}: {report}");
    let (_, listed) = report.split_once("help: expected ").unwrap_or_else(|| panic!("{table}: {report}"));
    listed.split('`').skip(1).step_by(2).map(|key| format!("{table}{key}")).collect()
}

#[test]
fn messages_about_unknown_keys_list_the_declared_ones() {
    let declared = Keys::declared();
    let mut there = BTreeSet::new();
    for (table, text) in TABLES {
        let listed = keys_of(table, text);
        let missing: Vec<_> = listed.iter().filter(|key| !declared.contains(*key)).collect();
        assert!(missing.is_empty(), "these keys are not declared: {missing:?}");
        if !text.contains("'zzz'") {
            let inside = |key: &&String| key.strip_prefix(table).is_some_and(|rest| !rest.contains('.'));
            let named = |key: &&String| {
                ["camera.projection.perspective", "camera.filter.box", "render.roulette.off"].contains(&key.as_str())
            };
            let unlisted: Vec<_> =
                declared.iter().filter(inside).filter(|key| !named(key)).filter(|key| !listed.contains(key)).collect();
            assert!(unlisted.is_empty(), "{table}: these keys are not listed: {unlisted:?}");
        }
        there.extend(listed);
    }
    // Objects and the camera use the same kind of list, for transforms and for motion.
    let same_lists = |key: &str| key.starts_with("objects.motion.") || key.starts_with("camera.motion.");
    let gone: Vec<_> = RANGES.iter().map(|range| range.key).filter(|key| !there.contains(*key) && !same_lists(key)).collect();
    assert!(gone.is_empty(), "these keys are no longer there: {gone:?}");
    // A key with a table or several kinds is tested with these too.
    let asked: BTreeSet<String> = TABLES.iter().map(|(table, _)| table.trim_end_matches('.').to_owned()).collect();
    assert!(asked.len() > 40 && asked.iter().filter(|table| !table.is_empty()).all(|table| there.contains(table)));
}
