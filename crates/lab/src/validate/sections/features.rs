//! Meshes, lenses, disks and many lights, in scenes with exact solutions.
use std::f64::consts::PI;

use glam::DVec3;

use super::{
    direct_light::{ALBEDO, RECTANGLES, lit},
    edges,
};
use crate::validate::{
    Section, Statement, Validation,
    check::{RED, largest, of_a_point, scene},
};
use noisefall_kernel::measure::{
    exact::{horizon_sphere_irradiance, polygon_irradiance},
    picture,
};
use noisefall_scene::{
    sampling::Directions,
    scene::{Estimator, RenderSettings, Roulette, Scene},
};

pub fn section(validation: &Validation) -> Section {
    let mut statements = vec![room(validation), checkered_light(validation)];
    statements.extend(turned_away(validation));
    let corners = corners();
    let triangles = format!(
        "shape.mesh = {{ vertices = {:?}, triangles = [[0, 1, 2], [0, 2, 3]] }}\nflip = {}",
        corners.map(|corner| corner.to_array()),
        (corners[1] - corners[0]).cross(corners[3] - corners[0]).dot(corners[0]) > 0.0
    );
    let disk = "shape.disk = { center = [0.0, 1.2, 0.0], normal = [0.0, -1.0, 0.0], radius = 0.5 }";
    let (lights, irradiance) = many_light();
    for (what, scene, irradiance) in [
        ("rectangle as a mesh", lit(&triangles), polygon_irradiance(1.0, &corners)),
        // π L r²/(r² + h²) below its centre.
        ("disk overhead", lit(disk), PI * 0.25 / (0.25 + 1.44)),
        ("300 spheres", lights, irradiance),
    ] {
        for estimator in of_a_point() {
            let settings = RenderSettings { max_bounces: Some(1), ..validation.settings(estimator) };
            let found = picture(&scene, settings, RED, validation.spp(1200)).whole();
            let exact = ALBEDO / PI * irradiance;
            statements.push(Statement::mean(format!("{what}, {}", estimator.name()), found, exact));
        }
    }
    statements.push(lens(validation));
    statements.extend(edges::statements(validation));
    Section {
        title: "Meshes, many lights, lenses and filters",
        claim: "The same scene described in another way gives the same light: triangles in place of faces, hundreds of lights in place of one, a lens in place of a pinhole. An edge is as soft as lens and pixel filter make it.",
        derivation: &[
            "A box of twelve triangles whose inside emits 1 and reflects 1/2 is a furnace: every sample is 2. A path that hits a wall within rounding of an edge continues from a rounded point that may lie outside; such losses must cost less than 10⁻⁶ of the light. The small rectangle of the section on direct \
             light as two triangles of a mesh has the same irradiance. A disk of radius r at the height h has E = π L r²/(r² + h²) under its \
             middle. The irradiances of lights that do not occlude each other add up; with 300 lights the light tree chooses among them.",
            "A checkered light is seen such that each square covers 2 × 2 pixels: every pixel has the radiance of its square. The small rectangle, turned away from the ground, does not light it.",
            "A lens averages over rays from all of its points. Where the radiance is the same everywhere, that changes nothing: 0.5 inside the closed sphere.",
            "For a half-plane of radiance 1 in front of black, a sample is 1 or 0, and the mean of n samples of probability p has the variance p (1 − p)/n. Every column of \
             the image has its own p. Behind a filter with the distribution function F it is 1 − F(e), e being the place of the edge relative to the middle of the \
             pixel; a tent of radius r has F(x) = 1/2 + y − y |y|/2 with y = x/r, and the Gaussian is cut off at 3σ. From a point u of a lens to the point v in focus, at the \
             distance f, a ray crosses the plane at the distance z in u (1 − z/f) + v z/f: a lens of radius R sees a disk of radius R |1 − z/f| there. The edge leaves the \
             fraction (acos e − e √(1 − e²))/π of the disk, with e in radii of the disk, averaged over the pixel.",
        ],
        source: "Form factors of parallel disks; J. H. Lambert, 1760; P. Moon, 1936; R. L. Cook, T. Porter and L. Carpenter, “Distributed Ray Tracing”, \
                 SIGGRAPH 1984.",
        statements,
        figures: Vec::new(),
        remark: None,
    }
}

/// Corners of the small rectangle in the section on direct light.
fn corners() -> [DVec3; 4] {
    let [origin, u, v] = RECTANGLES[0].1.map(DVec3::from_array);
    [origin, origin + u, origin + u + v, origin + v]
}

fn room(validation: &Validation) -> Statement {
    let scene = scene(
        "camera = { eye = [0.1, 0.2, -0.3], look_at = [1.0, 0.9, 0.8], fov = 100.0, resolution = [64, 64] }
        materials.wall.lambertian.albedo = 0.5
        [[objects]]
        shape.mesh.vertices = [[-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0], \
        [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]]
        shape.mesh.triangles = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6], [0, 4, 5], [0, 5, 1], \
        [3, 2, 6], [3, 6, 7], [0, 3, 7], [0, 7, 4], [1, 5, 6], [1, 6, 2]]
        material = 'wall'
        emission = { radiance = 1.0, two_sided = true }",
    );
    let found = picture(&scene, validation.path(Directions::Cosine), RED, validation.spp(200)).whole();
    Statement::within("furnace of twelve triangles: mean of the image", found.mean, 2.0, 2e-6)
}

/// A light with squares of two radiances. Their edges coincide with edges of pixels.
fn checkered_light(validation: &Validation) -> Statement {
    let scene = scene(
        "camera = { eye = [0.0, 0.0, 1.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 1.0, resolution = [8, 8] }
        textures.squares.checker = { even = 1.0, odd = 0.25, scale = 4.0 }
        [[objects]]
        shape.rectangle = { origin = [-0.5, -0.5, 0.0], edge_u = [1.0, 0.0, 0.0], edge_v = [0.0, 1.0, 0.0] }
        emission.texture = 'squares'",
    );
    let found = picture(&scene, validation.path(Directions::Cosine), RED, validation.spp(400));
    let exact = |i: usize| if (i % 8 / 2 + i / 8 / 2).is_multiple_of(2) { 1.0 } else { 0.25 };
    let worst = largest(found.pixels.iter().enumerate().map(|(i, pixel)| (pixel.mean - exact(i)).abs()));
    Statement::below("checkered light: largest error of a pixel", worst, 1e-5)
}

/// A light with its back to the ground.
fn turned_away(validation: &Validation) -> Vec<Statement> {
    let [origin, u, v] = RECTANGLES[0].1;
    let back = DVec3::from_array(u).cross(DVec3::from_array(v)).dot(DVec3::from_array(origin)) < 0.0;
    let scene = lit(&format!("shape.rectangle = {{ origin = {origin:?}, edge_u = {u:?}, edge_v = {v:?} }}\nflip = {back}"));
    let dark = |estimator: Estimator| {
        let settings = RenderSettings { max_bounces: Some(1), ..validation.settings(estimator) };
        let found = picture(&scene, settings, RED, validation.spp(400));
        let bright = found.pixels.iter().filter(|pixel| pixel.mean != 0.0).count();
        Statement::never(
            format!("rectangle turned away, {}: pixels that are not black", estimator.name()),
            bright as u32,
            found.pixels.len() as u32,
        )
    };
    Estimator::ALL.map(dark).into()
}

/// Small spheres distributed over the sky above a point, and their irradiance at the point.
fn many_light() -> (Scene, f64) {
    const COUNT: usize = 300;
    const RADIUS: f64 = 0.02;
    let mut irradiance = 0.0;
    let light = |i: usize| {
        // Distributed evenly over the upper part of the hemisphere; none covers another.
        let cos = 0.08 + 0.9 * (i as f64 + 0.5) / COUNT as f64;
        let (sin, turn) = ((1.0 - cos * cos).sqrt(), 2.399_963_23 * i as f64);
        let center = [sin * turn.cos(), cos, sin * turn.sin()];
        irradiance += horizon_sphere_irradiance(1.0, RADIUS, 1.0, cos);
        format!("shape.sphere = {{ center = {center:?}, radius = {RADIUS} }}")
    };
    let lights: Vec<String> = (0..COUNT).map(light).collect();
    (lit(&lights.join("\nemission.radiance = 1.0\n[[objects]]\n")), irradiance)
}

fn lens(validation: &Validation) -> Statement {
    let scene = scene(
        "camera = { eye = [0.0, 0.0, 0.5], look_at = [0.0, 0.0, 1.0], fov = 80.0, resolution = [32, 32], \
         lens = { radius = 0.1, focus = 0.3 } }
        materials.wall.lambertian.albedo = 0.5
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }
        material = 'wall'
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 0.0], radius = 0.25 }
        emission.radiance = 8.5",
    );
    let settings = RenderSettings { roulette: Roulette::BY_THROUGHPUT, ..validation.settings(Estimator::Mis) };
    Statement::mean("closed sphere through a lens", picture(&scene, settings, RED, validation.spp(2000)).whole(), 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::geometry::Shape;

    #[test]
    fn the_many_lights_lie_on_the_unit_sphere_and_none_covers_another() {
        let (scene, _) = many_light();
        let center = |shape: &Shape| if let Shape::Sphere { center, .. } = shape { Some(*center) } else { None };
        let centers: Vec<DVec3> = scene.objects.iter().filter_map(|object| center(&object.shape)).collect();
        assert_eq!(centers.len(), 300);
        for (i, a) in centers.iter().enumerate() {
            assert!((a.length() - 1.0).abs() < 1e-9, "light {i} is {} m from the point", a.length());
            assert!(centers[..i].iter().all(|b| a.distance(*b) > 0.05), "light {i} covers another");
        }
    }
}
