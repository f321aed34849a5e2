//! Walks that test whether the media of paths are the same in reverse.
//!
//! A path keeps a stack of the media around it: it pushes the medium of a dielectric that it enters, and pops one where it leaves. Where
//! dielectrics overlap, or surfaces do not close, a path from one end may thus be in another medium than one from the other end. Shapes
//! alone do not tell such surfaces from open ones that close with each other. Random walks do: they start at the lights, go straight on
//! through glass, are reflected elsewhere, and must arrive at the camera and far away in the media that are known there.
use glam::DVec3;

use super::{
    Scene,
    surface::{FLIPPED, SHEET, transmits},
};
use crate::{
    geometry::{MISS, PrimitiveRef},
    light::{LightRays, RayCoordinates},
    sampling::{
        hash::{hash_one, unit},
        warp::cosine_hemisphere,
    },
};
use noisefall_base::math::{F, Frame, Lanes, One, U, V};

const WALKS: u32 = 512;
const MOST_REFLECTIONS: u32 = 6;
/// The fraction of walks that glass reflects.
const REFLECTED: f32 = 0.25;
/// Surfaces that a ray crosses before it is given up.
const MOST_CROSSINGS: u32 = 100;

/// A walk is in another medium than paths the other way.
struct Mismatch;

/// A ray of a walk, with the media around its origin.
#[derive(Clone, Copy)]
struct Ray {
    o: V<One>,
    /// Unit.
    d: V<One>,
    media: u32,
}

/// A walk at a time.
struct Walk<'a> {
    scene: &'a Scene,
    time: F<One>,
    /// The state of its random numbers.
    numbers: u32,
}

impl Scene {
    /// Whether walks that start with `rays` find the same media in both directions. `outside` lies outside of all objects.
    pub(super) fn has_reversible_media(&self, rays: &LightRays, outside: DVec3) -> bool {
        let known = [self.camera.eye, outside].map(|p| self.media_at(p, 0.0));
        (0..WALKS).all(|number| Walk::new(self, number).run(rays, known).is_ok())
    }
}

impl<'a> Walk<'a> {
    fn new(scene: &'a Scene, number: u32) -> Self {
        let mut walk = Walk { scene, time: F(0.0), numbers: hash_one(number) };
        walk.time = walk.number();
        walk
    }

    /// A random number in (0, 1).
    fn number(&mut self) -> F<One> {
        self.numbers = self.numbers.wrapping_add(1);
        unit(U(hash_one(self.numbers)))
    }

    fn pair(&mut self) -> (F<One>, F<One>) {
        (self.number(), self.number())
    }

    /// Walks from a light. `at_camera` and `far_away` are the media there.
    fn run(mut self, rays: &LightRays, [at_camera, far_away]: [u32; 2]) -> Result<(), Mismatch> {
        let [choice, place, direction, cell] = [(); 4].map(|()| self.pair());
        let u = RayCoordinates { choice, place, direction, cell, side: self.number() };
        let start = rays.sample(One, &self.scene.lights, &self.scene.shapes, self.time, &u);
        if start.inverse_density.0 <= 0.0 {
            return Ok(());
        }
        let mut ray = Ray { o: start.o, d: start.d, media: start.media.0 };
        for _ in 0..MOST_REFLECTIONS {
            let way = V::splat(One, self.scene.camera.eye.as_vec3().to_array()) - ray.o;
            let distance = way.dot(way).sqrt();
            let mut join = Ray { d: way * (1.0 / distance), ..ray };
            if self.follow(&mut join, distance.0, 0.0)?.is_none() {
                self.expect(join.media, at_camera)?;
            }
            match self.follow(&mut ray, f32::INFINITY, REFLECTED)? {
                Some(reflected) => ray = reflected,
                None => return self.expect(ray.media, far_away),
            }
        }
        Ok(())
    }

    /// Follows a ray up to a distance. Surfaces that transmit reflect it with this probability, all others always. Returns the
    /// reflected ray, or `None` if it arrives.
    fn follow(&mut self, ray: &mut Ray, distance: f32, reflected: f32) -> Result<Option<Ray>, Mismatch> {
        let (mut left, mut last) = (distance, None);
        for _ in 0..MOST_CROSSINGS {
            let nearest = self.scene.shapes.closest(One, One.first(1), ray.o, ray.d, self.time);
            if nearest.primitive.0 == MISS || nearest.t.0 >= left {
                return Ok(None);
            }
            let place = PrimitiveRef { primitive: nearest.primitive, element: nearest.element, time: self.time };
            let point = self.scene.shapes.surface_point(One, &place, ray.o + ray.d * nearest.t);
            let is_front = point.n_geometric.dot(ray.d).0 < 0.0;
            let n = if is_front { point.n_geometric } else { -point.n_geometric };
            // No line crosses the same side of a surface twice in succession: because of rounding it is the same crossing.
            let side = Some((nearest.primitive.0, nearest.element.0, is_front));
            if side != last {
                if !self.passes(nearest.primitive.0) || self.number().0 < reflected {
                    let d = Frame::new(n).world_from_local(cosine_hemisphere(self.pair()));
                    return Ok(Some(Ray { o: point.p + n * point.error, d, media: ray.media }));
                }
                ray.media = self.beyond(nearest.primitive.0, is_front, ray.media)?;
            }
            last = side;
            let behind = point.p - n * point.error;
            left -= (behind - ray.o).dot(ray.d).0;
            ray.o = behind;
        }
        Ok(None)
    }

    fn word(&self, primitive: u32) -> u32 {
        self.scene.surfaces.rows[primitive as usize][3].to_bits()
    }

    fn passes(&self, primitive: u32) -> bool {
        let object = &self.scene.objects[self.scene.owners[primitive as usize] as usize];
        transmits(self.word(primitive)) || self.scene.lets_pass(object)
    }

    /// The media behind a surface.
    fn beyond(&self, primitive: u32, is_front: bool, media: u32) -> Result<u32, Mismatch> {
        let medium = self.scene.surfaces.varying[primitive as usize][3].to_bits();
        let word = self.word(primitive);
        if medium == 0 || word & SHEET != 0 {
            return Ok(media);
        }
        if is_front != (word & FLIPPED != 0) {
            return Ok(media << 8 | medium);
        }
        self.expect(media & 0xff, medium)?;
        Ok(media >> 8)
    }

    /// Compares the tints of media.
    fn expect(&self, media: u32, expected: u32) -> Result<(), Mismatch> {
        let tints = |media: u32| media.to_le_bytes().map(|medium| self.scene.surfaces.media[usize::from(medium)]);
        if tints(media) == tints(expected) { Ok(()) } else { Err(Mismatch) }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Estimator, RenderSettings, parse};

    /// Whether paths start at a light above a floor with these surfaces of tinted glass.
    fn starts_paths(red: &[&str], blue: &[&str]) -> bool {
        let text = "format = 1
            camera = { eye = [0, 1.2, 4], look_at = [0, 0.4, 0], fov = 40, resolution = [16, 16] }
            materials.white.lambertian.albedo = 0.8
            materials.red.dielectric = { ior = 1.2, transmittance = [0.5, 0.1, 0.1] }
            materials.blue.dielectric = { ior = 1.2, transmittance = [0.1, 0.1, 0.5] }
            [[objects]]
            shape.rectangle = { origin = [-2, 0, 2], edge_u = [4, 0, 0], edge_v = [0, 0, -4] }
            material = 'white'
            [[objects]]
            shape.sphere = { center = [0, 1.5, 0], radius = 0.2 }
            emission.radiance = 1";
        let object = |shape: &str, glass: &str| format!("\n[[objects]]\nshape.{shape}\nmaterial = '{glass}'");
        let red = red.iter().map(|shape| object(shape, "red"));
        let text = red.chain(blue.iter().map(|shape| object(shape, "blue"))).fold(text.to_owned(), |text, object| text + &object);
        let scene = parse("glass.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        scene.traces_light_paths(&RenderSettings { estimator: Estimator::Bidirectional, ..RenderSettings::default() })
    }

    #[test]
    fn surfaces_that_close_with_each_other_are_told_from_open_ones() {
        let tube = "cylinder = { base = [0, 0.1, 0], top = [0, 1.0, 0], radius = 0.6, capped = false }";
        let bottom = "disk = { center = [0, 0.1, 0], normal = [0, -1, 0], radius = 0.6 }";
        let lid = "disk = { center = [0, 1.0, 0], normal = [0, 1, 0], radius = 0.6 }";
        for (glass, expected) in
            [(&[tube, bottom, lid][..], true), (&[tube, bottom], false), (&[tube], false), (&[lid], false), (&[], true)]
        {
            assert_eq!(starts_paths(glass, &[]), expected, "{glass:?}");
        }
        // The floor closes what stands on it.
        let standing = "cylinder = { base = [0, 0, 0], top = [0, 1.0, 0], radius = 0.6, capped = false }";
        assert!(starts_paths(&[standing, lid], &[]));
    }

    #[test]
    fn objects_within_each_other_are_told_from_those_that_overlap() {
        let ball = |x: f32, radius: f32| format!("sphere = {{ center = [{x}, 0.6, 0], radius = {radius} }}");
        let large = ball(0.0, 0.5);
        for (other, expected) in [(ball(1.2, 0.5), true), (ball(0.1, 0.3), true), (ball(0.5, 0.5), false)] {
            assert_eq!(starts_paths(&[&large], &[&other]), expected, "{other}");
            assert!(starts_paths(&[&large, &other], &[]), "of the same glass they may overlap: {other}");
        }
    }
}
