//! Hits of rays in a scene, compared with formulas in f64.
use glam::{DVec3, Vec3};

use super::dice::Dice;
use noisefall_base::math::{F, M, One, U, V};
use noisefall_kernel::integrator::replay;
use noisefall_scene::{
    geometry::{
        MISS, Nearest, Shape,
        oracle::{distance, intersections, pieces, point_at},
    },
    scene::{CameraRays, RenderSettings, Scene},
};

/// Limit of the rounding error, in units of εS (see [`World::scale`]): beyond it a point is off its surface, and a surface in
/// front of it is missed.
pub const LIMIT: f64 = 32.0;
/// ε = 2⁻²³.
const EPSILON: f64 = f32::EPSILON as f64;
/// Scenes with more pieces are not tested.
const MOST_FACES: usize = 3000;
/// Number of reflections that are followed.
const DEPTH: u32 = 24;

/// Agreement of the rays of a scene with f64.
#[derive(Default)]
pub struct Comparison {
    pub rays: u64,
    /// Largest distance of a hit from its surface, in εS.
    pub worst: f64,
    /// Rays that passed through a surface.
    pub missed: u64,
    /// Rays that hit the surface that they leave.
    pub self_hits: u64,
    /// Paths that left a closed room.
    pub escaped: u64,
    /// Description of the first wrong ray.
    pub first: Option<String>,
}

/// A primitive and its flat or quadric pieces.
struct PrimitivePieces {
    primitive: u32,
    faces: Vec<Shape>,
    is_mesh: bool,
}

struct World<'a> {
    scene: &'a Scene,
    known: Vec<PrimitivePieces>,
    near: f64,
}

#[derive(Clone, Copy)]
struct Ray {
    o: DVec3,
    d: DVec3,
    /// The primitive and element that it leaves.
    from: Option<(u32, u32)>,
}

/// Compares rays of replayed paths and rays aimed at surfaces with f64. No ray may leave a `closed` scene.
pub fn compare(scene: &Scene, settings: &RenderSettings, rays: &CameraRays, closed: bool) -> Comparison {
    let mut found = Comparison::default();
    let Some(world) = World::new(scene) else { return found };
    let settings = RenderSettings { max_bounces: Some(settings.last_bounce().min(DEPTH)), ..*settings };
    // Moving objects are left out, because the formulas have no time.
    if !scene.moves() {
        let [width, height] = scene.camera.resolution;
        for i in 0..64 {
            let pixel = [(i % 8) * width / 8, (i / 8) * height / 8];
            let mut from = None;
            for vertex in replay(scene, rays, &settings, pixel, 0).vertices {
                let [o, d] = [vertex.origin, vertex.direction].map(|v| Vec3::from(v).as_dvec3());
                from = world.judge(Ray { o, d, from }, closed, &mut found);
            }
        }
    }
    let mut dice = Dice::new("rays", settings.seed);
    for _ in 0..256 {
        let Some((target, size)) = world.somewhere(&mut dice) else { break };
        let start = scene.camera.eye + dice.in_ball() * size * dice.pick(&[0.0, 0.1]);
        let o = start.as_vec3().as_dvec3();
        if let Some(d) = (target - o).try_normalize() {
            world.judge(Ray { o, d: d.as_vec3().as_dvec3(), from: None }, false, &mut found);
        }
    }
    found
}

impl World<'_> {
    fn new(scene: &Scene) -> Option<World<'_>> {
        let mut first = 0;
        let known: Vec<PrimitivePieces> = scene
            .objects
            .iter()
            .flat_map(|object| {
                let faces = pieces(&object.shape);
                let (primitive, is_mesh) = (first, matches!(object.shape, Shape::Mesh { .. }));
                first += object.shape.piece_count() as u32;
                if is_mesh || faces.is_empty() {
                    return vec![PrimitivePieces { primitive, faces, is_mesh }];
                }
                (primitive..)
                    .zip(faces)
                    .map(|(primitive, face)| PrimitivePieces { primitive, faces: vec![face], is_mesh })
                    .collect()
            })
            .collect();
        let count: usize = known.iter().map(|known| known.faces.len()).sum();
        (count <= MOST_FACES).then(|| World { scene, known, near: scene.camera.look_at.length() })
    }

    /// A random point of a surface, sometimes near its edge, and the size of the surface.
    fn somewhere(&self, dice: &mut Dice) -> Option<(DVec3, f64)> {
        let known = &self.known[dice.below(self.known.len().max(1)).min(self.known.len().checked_sub(1)?)];
        let face = known.faces.get(dice.below(known.faces.len()))?;
        let near_edge = |x: f64, dice: &mut Dice| if dice.chance(0.8) { x } else { x.round() + (x - x.round()) * 1e-6 };
        let (a, b) = (dice.unit(), dice.unit());
        let at = [near_edge(a, dice), near_edge(b, dice)];
        Some((point_at(face, at), face.bounding_sphere().1))
    }

    /// Tests one ray, and returns the primitive and element that it hits.
    fn judge(&self, ray: Ray, closed: bool, found: &mut Comparison) -> Option<(u32, u32)> {
        let splat = |v: DVec3| V::splat(One, v.as_vec3().to_array());
        let Nearest { t, primitive: U(primitive), element: U(element) } =
            self.scene.shapes.closest(One, M(true), splat(ray.o), splat(ray.d), F(0.0));
        let t = if primitive == MISS { f64::INFINITY } else { f64::from(t.0) };
        found.rays += 1;
        let mut wrong = |what: &str| {
            found.first.get_or_insert_with(|| format!("{what}: from {} along {}, primitive {primitive} at {t:e}", ray.o, ray.d));
        };
        if closed && primitive == MISS {
            wrong("a ray escapes");
            found.escaped += 1;
        }
        if self.passes_a_surface(ray, t) {
            wrong("a surface is missed");
            found.missed += 1;
        }
        let here = self.known.iter().find(|known| known.primitive == primitive)?;
        let p = ray.o + ray.d * t;
        let error = |face: &Shape| {
            // This distance is accurate to first order. At strong curvature the distance along the ray may be smaller.
            let along = intersections(face, ray.o, ray.d, 0.0)
                .iter()
                .map(|intersection| (intersection.t - t).abs())
                .fold(f64::INFINITY, f64::min);
            distance(face, p).min(along) / (EPSILON * self.scale(face, ray.o, p, t))
        };
        let error = here.faces.iter().map(error).reduce(f64::min).unwrap_or(0.0);
        if error > LIMIT {
            wrong(&format!("{error:.0} εS off the surface"));
        }
        found.worst = found.worst.max(error);
        if ray.from == Some((primitive, element)) && is_self_hit(here, ray, t) {
            wrong("a ray hits the surface that it leaves");
            found.self_hits += 1;
        }
        Some((primitive, element))
    }

    /// Whether f64 finds a surface in front of t, beyond what rounding sideways and along the ray explains.
    fn passes_a_surface(&self, ray: Ray, t: f64) -> bool {
        let surely = |face: &Shape| {
            intersections(face, ray.o, ray.d, 0.0).iter().any(|intersection| {
                let p = ray.o + ray.d * intersection.t;
                let rounding = LIMIT * EPSILON * self.scale(face, ray.o, p, intersection.t.abs());
                let along = rounding / intersection.cos.max(1e-9);
                intersection.clearance > rounding && intersection.t > along && intersection.t < t - along
            })
        };
        self.known.iter().flat_map(|known| &known.faces).any(surely)
    }

    /// S, the scale in metres at which f32 rounds coordinates on the way from o to p. Spheres are anchored near the scene; other
    /// shapes count with their full size.
    fn scale(&self, face: &Shape, o: DVec3, p: DVec3, t: f64) -> f64 {
        let (center, radius) = face.bounding_sphere();
        let shape = match face {
            // The rounding of f64 itself.
            Shape::Sphere { .. } => (radius + center.length()) * (4.0 * f64::EPSILON / EPSILON),
            _ => radius + center.length(),
        };
        o.length() + p.length() + t + self.near + shape
    }
}

/// Whether a ray that leaves a primitive hits it again much nearer than f64 does.
fn is_self_hit(known: &PrimitivePieces, ray: Ray, t: f64) -> bool {
    if known.faces.is_empty() {
        return false;
    }
    if known.is_mesh || matches!(known.faces[..], [Shape::Flat { .. }]) {
        return true;
    }
    let next = known
        .faces
        .iter()
        .flat_map(|face| intersections(face, ray.o, ray.d, 1e-3))
        .map(|intersection| intersection.t)
        .find(|t| *t > 0.0);
    next.is_none_or(|next| t < 0.5 * next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::check::scene;

    fn with_world(shape: &str, look: impl Fn(&World)) {
        let scene = scene(&format!(
            "camera = {{ eye = [0.0, 0.0, 3.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }}\n\
             [[objects]]\nshape.{shape}\nemission = {{ radiance = 1.0, two_sided = true }}"
        ));
        look(&World::new(&scene).expect("it is small"));
    }

    fn ray(o: [f64; 3], d: [f64; 3]) -> Ray {
        Ray { o: o.into(), d: d.into(), from: None }
    }

    const BALL: &str = "sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }";

    #[test]
    fn a_surface_in_front_of_the_hit_was_missed() {
        with_world(BALL, |world| {
            let ahead = ray([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]);
            assert_eq!([1.0, 2.0, 2.001, f64::INFINITY].map(|t| world.passes_a_surface(ahead, t)), [false, false, true, true]);
            // From inside, the far side counts, and the side that the ray leaves does not.
            assert_eq!([1.0, 2.5].map(|t| world.passes_a_surface(ray([0.0; 3], [0.0, 0.0, 1.0]), t)), [false, true]);
            let beside = |x: f64| world.passes_a_surface(ray([x, 0.0, 3.0], [0.0, 0.0, -1.0]), f64::INFINITY);
            assert_eq!([0.9, 1.0 - 1e-7, 1.1].map(beside), [true, false, false], "rounding decides at the rim");
        });
    }

    #[test]
    fn rays_are_judged_by_their_hits_and_closed_rooms_let_none_out() {
        with_world(BALL, |world| {
            let mut found = Comparison::default();
            let met = world.judge(ray([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]), true, &mut found);
            assert!(met.is_some_and(|(primitive, _)| primitive == 0) && found.first.is_none() && found.worst < 1.0);
            assert_eq!(world.judge(ray([0.0, 0.0, 3.0], [0.0, 0.0, 1.0]), false, &mut found), None);
            assert_eq!((found.rays, found.escaped), (2, 0));
            world.judge(ray([0.0, 0.0, 3.0], [0.0, 0.0, 1.0]), true, &mut found);
            assert_eq!((found.rays, found.escaped, found.missed, found.self_hits), (3, 1, 0, 0));
            assert!(found.first.is_some_and(|first| first.starts_with("a ray escapes")));
        });
    }

    #[test]
    fn a_flat_shape_is_never_met_twice_and_a_ball_only_where_it_ends() {
        let inwards = ray([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
        with_world(BALL, |world| {
            assert_eq!([1e-4, 0.9, 1.1, 2.0].map(|t| is_self_hit(&world.known[0], inwards, t)), [true, true, false, false]);
        });
        with_world("disk = { center = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0], radius = 1.0 }", |world| {
            assert!(is_self_hit(&world.known[0], inwards, 1.0));
        });
    }

    #[test]
    fn rounding_is_in_proportion_to_all_coordinates_on_the_way() {
        let disk = "disk = { center = [0.0, 3.0, 4.0], normal = [0.0, 0.0, 1.0], radius = 2.0 }";
        with_world(disk, |world| {
            let scale = world.scale(&world.known[0].faces[0], DVec3::X * 10.0, DVec3::Y * 100.0, 1000.0);
            // Origin, point, distance, target (0), and the shape, which is 5 away and has size 2.
            assert!((scale - 1117.0).abs() < 1e-4, "{scale}");
        });
        with_world("sphere = { center = [0.0, 0.0, 0.0], radius = 1e6 }", |world| {
            let scale = world.scale(&world.known[0].faces[0], DVec3::X, DVec3::Y, 1.0);
            // Origin, point and distance in single precision, and the sphere itself, anchored near the scene, in double precision.
            assert!((scale - (3.0 + 1e6 * 4.0 / f64::from(1 << 29))).abs() < 1e-6, "{scale}");
        });
    }
}
