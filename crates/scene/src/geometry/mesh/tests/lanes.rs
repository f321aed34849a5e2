//! Rays in lanes: the same bits at every level, and searches that end early.
use rand::{SeedableRng, rngs::SmallRng};

use super::{Mesh, NONE, Ray, closest, in_columns, meshes, rays};
use crate::geometry::bvh::{Search, Stacks};
use noisefall_base::math::{F, Lanes, One, Pick, SimdLevel, in_lanes};

/// A hit before a distance may end the search, but none behind the nearest one beyond it.
#[test]
fn a_search_ends_at_the_nearest_hit_or_at_one_that_is_near_enough() {
    const ENOUGH: f32 = 1.2;
    fn ends<L: Lanes>(l: L, mesh: &Mesh, rays: &[Ray]) -> Vec<f32> {
        let mut ends = Vec::new();
        for rays in rays.chunks(L::N) {
            let search = Search { limit: l.f(f32::INFINITY), enough: l.f(ENOUGH) };
            let (t, _) = mesh.closest_by(l.token(), l, &mut Stacks::<false>::default(), in_columns(l, rays), search);
            ends.extend(&t.to_array()[..rays.len()]);
        }
        ends
    }
    let (mut rng, mut others) = (SmallRng::seed_from_u64(12), 0);
    for mesh in meshes(&mut rng) {
        let rays = rays(&mesh, 1600, &mut rng);
        let ends = in_lanes!(SimdLevel::best(), l => ends(l, &mesh, &rays));
        for (end, (nearest, _)) in ends.into_iter().zip(closest(&mesh, &rays)) {
            assert!(end == nearest || nearest < end && end < ENOUGH, "{end} {nearest}");
            others += usize::from(end != nearest);
        }
    }
    assert!(others > 0, "no search ended early");
}

#[test]
fn every_level_gives_the_same_bits() {
    let mut rng = SmallRng::seed_from_u64(11);
    for mesh in meshes(&mut rng) {
        let rays = rays(&mesh, 4800, &mut rng);
        let expected = bits(One, &mesh, &rays);
        for level in SimdLevel::available() {
            assert!(in_lanes!(level, l => bits(l, &mesh, &rays)) == expected, "{level:?}");
        }
    }
}

/// Bits of all data of the hits.
fn bits<L: Lanes>(l: L, mesh: &Mesh, rays: &[Ray]) -> Vec<(u32, u32, [u32; 4], [u32; 4])> {
    let mut all = Vec::new();
    for rays in rays.chunks_exact(L::N) {
        let (o, d) = in_columns(l, rays);
        let (t, triangle) = mesh.closest(l, o, d, l.f(f32::INFINITY));
        let some = triangle.equals(l.u(NONE)).pick(l.u(0), triangle);
        let at = mesh.surface_point(l, some, o + d * t);
        let (coordinates, [along_u, _]) = mesh.coordinates(l, some, at.p);
        let normal = if mesh.is_smooth() { mesh.smooth_normal(l, some, at.p) } else { at.n_geometric };
        let shading = [coordinates.u, coordinates.v, along_u.x, normal.z];
        let of_point = [at.p.x, at.n_geometric.y, at.error, at.barycentrics[0]];
        for lane in 0..L::N {
            let bits = |x: &F<L>| x.bits().to_array()[lane];
            all.push((bits(&t), triangle.to_array()[lane], of_point.each_ref().map(bits), shading.each_ref().map(bits)));
        }
    }
    all
}
