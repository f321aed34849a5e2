//! Light from flat, round and stretched lights on a diffuse point, ρ E/π, with E in closed form or by integration; and the
//! projected area of such lights.
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DAffine3, DMat3, DVec3};
use noisefall_kernel::measure::exact::polygon_irradiance;
use noisefall_scene::scene::{Estimator, RenderSettings};

use crate::{
    picture::{Mean, RED, WITH_CAMERA_PATHS, picture, scene, settings},
    statistics::assert_within,
};

const RADIANCE: f64 = 7.0;
const ALBEDO: f64 = 0.8;

/// The radiance of a small diffuse square at the origin, facing upwards, under this object.
fn lit_by(light: &str, estimator: Estimator) -> Mean {
    let scene = scene(&format!(
        "camera = {{ eye = [0.0, 0.05, 0.1], look_at = [0.0, 0.0, 0.0], fov = 0.1, resolution = [32, 32] }}
        materials.ground.lambertian.albedo = {ALBEDO}
        [[objects]]
        shape.rectangle = {{ origin = [-0.005, 0.0, 0.005], edge_u = [0.01, 0.0, 0.0], edge_v = [0.0, 0.0, -0.01] }}
        material = 'ground'
        [[objects]]
        {light}"
    ));
    picture(&scene, RenderSettings { max_bounces: Some(1), ..settings(estimator) }, RED, 256).whole()
}

fn assert_lights(light: &str, irradiance: f64, what: &str) {
    for estimator in WITH_CAMERA_PATHS {
        let found = lit_by(light, estimator);
        let exact = ALBEDO / PI * irradiance;
        let (error, z) = (found.variance_of_mean.sqrt(), found.z(exact));
        println!("{what}, {}: {:.6} ± {error:.1e}, exact {exact:.6}, {z:.2} σ", estimator.name(), found.mean);
        assert_within(z, &format!("{what}, {}", estimator.name()));
    }
}

fn emitting(shape: &str, rest: &str) -> String {
    format!("shape.{shape}\nemission = {{ radiance = {RADIANCE:?} }}\n{rest}")
}

fn text(p: DVec3) -> String {
    format!("{:?}", p.to_array())
}

const TRIANGLE: bool = true;
const PARALLELOGRAM: bool = false;

/// Flat lights by a corner and two edges.
fn polygons() -> Vec<(&'static str, bool, [DVec3; 3])> {
    let at = |a: [f64; 3], u: [f64; 3], v: [f64; 3]| [a, u, v].map(DVec3::from_array);
    vec![
        ("level rectangle", PARALLELOGRAM, at([-0.4, 1.0, -0.3], [0.8, 0.0, 0.0], [0.0, 0.0, 0.6])),
        ("turned rectangle", PARALLELOGRAM, at([0.5, 0.6, -0.2], [0.3, 0.4, 0.5], [0.2, 0.6, -0.6])),
        ("parallelogram", PARALLELOGRAM, at([-1.2, 0.3, 0.2], [0.6, 0.9, -0.1], [0.7, 0.3, 0.8])),
        ("long and thin rectangle", PARALLELOGRAM, at([-3.0, 0.8, 0.4], [6.0, 0.3, 0.0], [0.0, 0.01, 0.05])),
        ("rectangle that stands below the horizon", PARALLELOGRAM, at([0.5, -0.7, -0.4], [0.0, 0.0, 1.0], [0.1, 1.2, 0.0])),
        ("rectangle with one corner up", PARALLELOGRAM, at([-0.3, 0.2, -0.6], [0.9, -0.5, -0.1], [-0.6, -0.7, -0.4])),
        ("triangle", TRIANGLE, at([-0.6, 0.7, -0.5], [1.1, 0.4, 0.1], [0.3, 0.2, 0.9])),
        ("triangle with two corners up", TRIANGLE, at([0.6, 0.5, -0.8], [-0.2, 0.3, 1.4], [0.3, -1.1, 0.5])),
        ("triangle with one corner up", TRIANGLE, at([0.6, 0.7, 0.1], [0.2, -1.3, 0.6], [0.3, -1.1, -0.5])),
    ]
}

#[test]
fn a_polygon_lights_the_ground_by_lamberts_formula() {
    for (what, is_triangle, [a, u, v]) in polygons() {
        // The front faces the origin.
        let away = u.cross(v).dot(a) > 0.0;
        let (corners, shape) = if is_triangle {
            let (b, c) = (a + u, a + v);
            (vec![a, b, c], format!("triangle = {{ a = {}, b = {}, c = {} }}", text(a), text(b), text(c)))
        } else {
            let shape = format!("rectangle = {{ origin = {}, edge_u = {}, edge_v = {} }}", text(a), text(u), text(v));
            (vec![a, a + u, a + u + v, a + v], shape)
        };
        assert_lights(&emitting(&shape, &format!("flip = {away}")), polygon_irradiance(RADIANCE, &corners), what);
    }
}

#[test]
fn a_polygon_lights_nothing_behind_it_unless_it_has_two_sides() {
    let (_, _, [a, u, v]) = polygons()[1];
    let corners = [a, a + u, a + u + v, a + v];
    let shape = format!("shape.rectangle = {{ origin = {}, edge_u = {}, edge_v = {} }}", text(a), text(u), text(v));
    let behind = u.cross(v).dot(a) > 0.0;
    for flip in [false, true] {
        let both = format!("{shape}\nemission = {{ radiance = {RADIANCE:?}, two_sided = true }}\nflip = {flip}");
        assert_lights(&both, polygon_irradiance(RADIANCE, &corners), "two sides");
    }
    let back = format!("{shape}\nemission = {{ radiance = {RADIANCE:?} }}\nflip = {}", !behind);
    for estimator in WITH_CAMERA_PATHS {
        let found = lit_by(&back, estimator);
        assert!(found.mean == 0.0 && found.variance_of_mean == 0.0, "{}: {found:?}", estimator.name());
    }
}

/// Irradiance by a disk of radius r at the distance h of its plane and a of its axis, of a surface whose normal leans by the angle
/// β from the perpendicular of the disk towards its axis, while all of the disk is above its horizon. By components, with
/// q² = (a² + h² + r²)² − 4 a² r²:
///
///   E = π L { cos β [1 − (a² + h² − r²)/q] + sin β (h/a) [(a² + h² + r²)/q − 1] }/2
///
/// J. R. Howell, M. P. Mengüç, "Radiative transfer configuration factor catalog", JQSRT 112, 2011, B-12 and B-13.
fn disk_irradiance(r: f64, h: f64, a: f64, beta: f64) -> f64 {
    let sum = a * a + h * h + r * r;
    let q = (sum * sum - 4.0 * a * a * r * r).sqrt();
    let along = 1.0 - (sum - 2.0 * r * r) / q;
    let across = if a == 0.0 { 0.0 } else { h / a * (sum / q - 1.0) };
    PI * RADIANCE / 2.0 * (beta.cos() * along + beta.sin() * across)
}

#[test]
fn a_disk_lights_the_ground_as_its_closed_form_says() {
    for (r, h, a, degrees) in [
        (0.3f64, 1.0f64, 0.0f64, 0.0f64),
        (2.0, 0.5, 0.0, 0.0),
        (0.6, 0.8, 0.7, 0.0),
        (0.5, 0.4, 1.2, 30.0),
        (0.5, 0.6, 1.0, 75.0),
    ] {
        let beta = degrees.to_radians();
        // In the frame of the ground, with the axis leaning in the plane of x and y.
        let (perpendicular, sideways) = (DVec3::new(-beta.sin(), beta.cos(), 0.0), DVec3::new(beta.cos(), beta.sin(), 0.0));
        let center = perpendicular * h + sideways * a;
        let highest = center.y - r * sideways.y.abs();
        assert!(highest > 0.0, "all of it is up");
        let irradiance = disk_irradiance(r, h, a, beta);
        let area = TestLight::Disk
            .irradiance(&DAffine3 { matrix3: DMat3::from_cols(sideways * r, DVec3::Z * r, -perpendicular), translation: center });
        assert!((irradiance - area).abs() < 5e-4 * irradiance, "{irradiance} and {area} by integration");
        let shape = format!("disk = {{ center = {}, normal = {}, radius = {r:?} }}", text(center), text(-perpendicular));
        assert_lights(&emitting(&shape, ""), irradiance, &format!("disk of {r} at {h}, {a} off its axis, {degrees}°"));
    }
}

/// A light of about a metre at the origin of its own space.
#[derive(Clone, Copy, Debug)]
enum TestLight {
    /// Of radius 1, facing z.
    Disk,
    /// From −1 to 1 in x and y, facing z.
    Rectangle,
    /// Of radius 1.
    Ball,
    /// Around the y axis from −1 to 1, of radius 1.
    Cylinder { capped: bool },
    /// From −1 to 1.
    Cuboid,
}

impl TestLight {
    const ALL: [TestLight; 6] = [
        TestLight::Disk,
        TestLight::Rectangle,
        TestLight::Ball,
        TestLight::Cylinder { capped: true },
        TestLight::Cylinder { capped: false },
        TestLight::Cuboid,
    ];

    fn text(self) -> String {
        match self {
            TestLight::Disk => "disk = { center = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0], radius = 1.0 }".to_owned(),
            TestLight::Rectangle => {
                "rectangle = { origin = [-1.0, -1.0, 0.0], edge_u = [2.0, 0.0, 0.0], edge_v = [0.0, 2.0, 0.0] }".to_owned()
            }
            TestLight::Ball => "sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }".to_owned(),
            TestLight::Cylinder { capped } => {
                format!("cylinder = {{ base = [0.0, -1.0, 0.0], top = [0.0, 1.0, 0.0], radius = 1.0, capped = {capped} }}")
            }
            TestLight::Cuboid => "cuboid = { min = [-1.0, -1.0, -1.0], max = [1.0, 1.0, 1.0] }".to_owned(),
        }
    }

    /// Its surface: points of (s, t) in the unit square, and the normal times the area of the square there.
    fn pieces(self) -> Vec<Piece> {
        const X: DVec3 = DVec3::X;
        const Y: DVec3 = DVec3::Y;
        const Z: DVec3 = DVec3::Z;
        let square = |n: DVec3, u: DVec3, v: DVec3| -> Piece {
            Box::new(move |s, t| (n + u * (2.0 * s - 1.0) + v * (2.0 * t - 1.0), n.normalize_or(u.cross(v)) * 4.0))
        };
        let round = |center: DVec3, n: DVec3, u: DVec3, v: DVec3| -> Piece {
            Box::new(move |s, t| (center + (u * (TAU * t).cos() + v * (TAU * t).sin()) * s.sqrt(), n * PI))
        };
        match self {
            TestLight::Disk => vec![round(DVec3::ZERO, Z, X, Y)],
            TestLight::Rectangle => vec![square(DVec3::ZERO, X, Y)],
            TestLight::Ball => vec![Box::new(|s, t| {
                let (height, around) = (2.0 * s - 1.0, TAU * t);
                let r = (1.0 - height * height).sqrt();
                let p = DVec3::new(r * around.cos(), height, r * around.sin());
                (p, p * (4.0 * PI))
            })],
            TestLight::Cylinder { capped } => {
                let side: Piece = Box::new(|s, t| {
                    let n = DVec3::new((TAU * t).cos(), 0.0, (TAU * t).sin());
                    (n + Y * (2.0 * s - 1.0), n * (2.0 * TAU))
                });
                let mut pieces = vec![side];
                if capped {
                    pieces.extend([round(Y, Y, X, Z), round(-Y, -Y, X, Z)]);
                }
                pieces
            }
            TestLight::Cuboid => {
                [(X, Y, Z), (Y, Z, X), (Z, X, Y)].into_iter().flat_map(|(n, u, v)| [square(n, u, v), square(-n, u, v)]).collect()
            }
        }
    }

    /// Irradiance at the origin of the ground by the front of the light, transformed by `map`: ∫ L cos θ cos θ′/d² dA. The light is
    /// convex, so every part of its front that faces a point is visible from there.
    fn irradiance(self, map: &DAffine3) -> f64 {
        const STEPS: u32 = 400;
        // n dA becomes det M M⁻ᵀ n dA, on the side of M⁻ᵀ n.
        let normals = map.matrix3.inverse().transpose() * map.matrix3.determinant().abs();
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
        let cell = |piece: &Piece, i: u32, j: u32| {
            let (p, n) = piece(at(i), at(j));
            let (p, n) = (map.transform_point3(p), normals * n);
            (-n.dot(p)).max(0.0) * p.y.max(0.0) / p.length_squared().powi(2)
        };
        let whole = |piece: &Piece| (0..STEPS * STEPS).map(|i| cell(piece, i / STEPS, i % STEPS)).sum::<f64>();
        RADIANCE * self.pieces().iter().map(whole).sum::<f64>() / f64::from(STEPS).powi(2)
    }

    /// Projected area along the unit vector w of the front of the light, transformed by `map`: Σ |n dA · w| over the parts that
    /// face the viewer.
    fn projected_area(self, map: &DAffine3, w: DVec3) -> f64 {
        let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
        let area = |a: DVec3, b: DVec3| a.cross(b).dot(w).abs();
        // The normal is opposite to w where the front is visible.
        let facing = (map.matrix3.inverse().transpose() * DVec3::Z).dot(w) < 0.0;
        let side = 4.0 * area(x, y).hypot(area(z, y));
        match self {
            TestLight::Disk => {
                if facing {
                    PI * area(x, y)
                } else {
                    0.0
                }
            }
            TestLight::Rectangle => {
                if facing {
                    4.0 * area(x, y)
                } else {
                    0.0
                }
            }
            // The silhouette of the image of a sphere: π |det M| |M⁻¹ w|.
            TestLight::Ball => PI * map.matrix3.determinant().abs() * (map.matrix3.inverse() * w).length(),
            TestLight::Cylinder { capped: true } => side + PI * area(x, z),
            TestLight::Cylinder { capped: false } => side,
            TestLight::Cuboid => 4.0 * (area(x, y) + area(y, z) + area(z, x)),
        }
    }

    fn is_closed(self) -> bool {
        matches!(self, TestLight::Ball | TestLight::Cylinder { capped: true } | TestLight::Cuboid)
    }
}

type Piece = Box<dyn Fn(f64, f64) -> (DVec3, DVec3)>;

/// Transforms of every kind, as text and as maps.
fn placements() -> Vec<(&'static str, String, DAffine3)> {
    let turn = |axis: [f64; 3], degrees: f64| {
        let map = DAffine3::from_axis_angle(DVec3::from_array(axis).normalize(), degrees.to_radians());
        (format!("{{ rotate = {{ axis = {axis:?}, degrees = {degrees:?} }} }}"), map)
    };
    let scale = |by: [f64; 3]| (format!("{{ scale = {by:?} }}"), DAffine3::from_scale(DVec3::from_array(by)));
    let shear = |[a, b, c]: [f64; 3]| {
        let columns = DMat3::from_cols(DVec3::X, DVec3::new(a, 1.0, 0.0), DVec3::new(b, c, 1.0));
        let rows = [[1.0, a, b, 0.0], [0.0, 1.0, c, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
        (format!("{{ matrix = {rows:?} }}"), DAffine3::from_mat3(columns))
    };
    let list = |parts: &[(String, DAffine3)]| {
        let text: Vec<&str> = parts.iter().map(|(text, _)| text.as_str()).collect();
        (text.join(", "), parts.iter().fold(DAffine3::IDENTITY, |before, (_, map)| *map * before))
    };
    let cases = [
        ("turned", list(&[scale([0.3; 3]), turn([1.0, 0.2, -0.4], 70.0)])),
        ("stretched", list(&[scale([0.5, 0.2, 0.3]), turn([1.0, 1.0, 0.3], 50.0)])),
        ("sheared", list(&[scale([0.25, 0.4, 0.3]), shear([0.7, -0.4, 0.5]), turn([0.8, 0.1, 0.4], 80.0)])),
        ("mirrored", list(&[turn([1.0, 0.4, 0.1], 60.0), scale([0.35, 0.25, -0.3])])),
        ("mirrored twice", list(&[scale([-0.4, 0.3, 0.25]), turn([0.3, 0.2, -1.0], 130.0), scale([1.0, -1.0, 1.0])])),
    ];
    cases.into_iter().map(|(what, (text, map))| (what, text, map)).collect()
}

#[test]
fn lights_that_are_stretched_sheared_or_mirrored_light_the_ground() {
    let place = DVec3::new(0.3, 1.1, -0.4);
    for light in TestLight::ALL {
        for (what, list, map) in placements() {
            let map = DAffine3::from_translation(place) * map;
            // The front of flat lights faces the ground.
            let normal = map.matrix3.inverse().transpose() * DVec3::Z;
            let away = !light.is_closed() && !matches!(light, TestLight::Cylinder { .. }) && normal.dot(place) > 0.0;
            let irradiance = if away {
                light.irradiance(&(map * DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0))))
            } else {
                light.irradiance(&map)
            };
            assert!(irradiance > 0.0, "{light:?}, {what}");
            let rest = format!("transform = [ {list}, {{ translate = {} }} ]\nflip = {away}", text(place));
            assert_lights(&emitting(&light.text(), &rest), irradiance, &format!("{light:?}, {what}"));
        }
    }
}

/// The mean radiance in a view of 3 m by 3 m along w, times its area.
fn seen(light: TestLight, list: &str, w: DVec3, emission: &str, flip: bool) -> Mean {
    const WIDTH: f64 = 3.0;
    let scene = scene(&format!(
        "camera = {{ eye = {}, look_at = [0.0, 0.0, 0.0], projection.orthographic.width = {WIDTH:?}, resolution = [64, 64] }}
        [[objects]]
        shape.{}
        emission = {{ {emission} }}
        transform = [ {list} ]
        flip = {flip}",
        text(w * -5.0),
        light.text()
    ));
    let found = picture(&scene, settings(Estimator::Path), RED, 64).whole();
    let area = WIDTH * WIDTH;
    Mean { mean: found.mean * area, variance_of_mean: found.variance_of_mean * area * area }
}

#[test]
fn lights_have_their_projected_area_and_shine_from_the_front_only() {
    for light in TestLight::ALL {
        for (what, list, map) in placements() {
            for w in [DVec3::new(0.2, -0.9, 0.3), DVec3::new(-0.6, 0.5, 0.7), DVec3::new(0.9, 0.1, -0.3)].map(DVec3::normalize) {
                let what = format!("{light:?}, {what}, along {w:.2}");
                let front = light.projected_area(&map, w);
                // Surfaces show their front or their back: the whole silhouette, except through the hollow of an open cylinder.
                let turned = map * DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0));
                let back = if light.is_closed() { 0.0 } else { light.projected_area(&turned, w) };
                let found = seen(light, &list, w, "radiance = 1.0", false);
                println!("{what}: {:.5} ± {:.1e}, exact {front:.5}", found.mean, found.variance_of_mean.sqrt());
                assert_within(found.z(front), &what);
                if !matches!(light, TestLight::Cylinder { capped: false }) {
                    assert_within(seen(light, &list, w, "radiance = 1.0", true).z(back), &format!("{what}, flipped"));
                    let both = seen(light, &list, w, "radiance = 1.0, two_sided = true", false);
                    assert_within(both.z(front + back), &format!("{what}, two-sided"));
                }
            }
        }
    }
}

#[test]
fn an_open_cylinder_shows_its_inside_through_its_end() {
    // The cylinder is so long that no line of sight passes both ends.
    let list = "{ scale = [0.3, 0.7, 0.3] }, { rotate = { axis = [1.0, 0.0, 0.0], degrees = 90.0 } }";
    let map = DAffine3::from_axis_angle(DVec3::X, FRAC_PI_2) * DAffine3::from_scale(DVec3::new(0.3, 0.7, 0.3));
    let w = DVec3::new(0.8, 0.2, -0.6).normalize();
    let light = TestLight::Cylinder { capped: false };
    let (side, whole) = (light.projected_area(&map, w), TestLight::Cylinder { capped: true }.projected_area(&map, w));
    assert_within(seen(light, list, w, "radiance = 1.0", false).z(side), "outside");
    assert_within(seen(light, list, w, "radiance = 1.0", true).z(whole - side), "inside");
    assert_within(seen(light, list, w, "radiance = 1.0, two_sided = true", false).z(whole), "both");
}
