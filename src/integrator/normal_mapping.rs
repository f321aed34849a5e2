//! Shading normals by bump and normal maps.
use super::interaction::SurfaceInteraction;
use crate::{
    math::{F, Lanes, M, Pick, U, V},
    scene::Scene,
    texture::{TextureCoordinates, Textures},
};

/// The shading normal on the front of a surface: in the lanes of `mask`, `n` tilted by the textures in its row of
/// [`crate::scene::surface::Surfaces::relief`].
///
/// A height h displaces the surface to p + h n; without the small terms from the curvature of n, its normal is n − ∇h (J. Blinn,
/// "Simulation of Wrinkled Surfaces", SIGGRAPH 1978). A normal map holds (x, y, z)/2 + ½ of the normal, with x along ∂p/∂u, y
/// against ∂p/∂v (up in the image) and z along n.
#[inline(always)]
pub(super) fn shading_normal<L: Lanes>(
    l: L,
    scene: &Scene,
    SurfaceInteraction { place, row, point, .. }: &SurfaceInteraction<L>,
    mask: M<L>,
    n: V<L>,
    at: &TextureCoordinates<L>,
) -> V<L> {
    let [bump, height, map, _] = l.rows(&scene.surfaces.relief, *row);
    let (bump, map) = (bump.bits(), map.bits());
    let (bumped, mapped) = (mask & !bump.is(0), mask & !map.is(0));
    if !(bumped | mapped).any() {
        return n;
    }
    let (along_u, along_v) = scene.shapes.tangents(l, place, point);
    let mut tilted = n;
    if mapped.any() {
        let code = scene.textures.colour(l, map + u32::MAX, mapped, at);
        let [x, y, z] = [code.x * 2.0 - 1.0, code.y * 2.0 - 1.0, code.z * 2.0 - 1.0];
        let normal = along_u.normalized() * x - along_v.normalized() * y + n * z;
        tilted = mapped.pick(normal.normalized(), n);
    }
    if bumped.any() {
        let id = bumped.pick(bump + u32::MAX, l.u(0));
        let slope = gradient(l, &scene.textures, id, bumped, along_u, along_v, at) * height;
        tilted = bumped.pick((tilted - slope).normalized(), tilted);
    }
    tilted
}

/// ∇h along the surface, per metre, by finite differences.
#[inline(always)]
fn gradient<L: Lanes>(
    l: L,
    textures: &Textures,
    id: U<L>,
    mask: M<L>,
    along_u: V<L>,
    along_v: V<L>,
    at: &TextureCoordinates<L>,
) -> V<L> {
    let steps = textures.steps(l, id);
    let (length_u, length_v) = (along_u.length_squared().sqrt(), along_v.length_squared().sqrt());
    let (du, dv) = (steps.u.min(steps.p / length_u), steps.v.min(steps.p / length_v));
    // Backwards at the end of u and of v: beyond it the texture may go on otherwise than it begins.
    let (du, dv) = (within(at.u, du), within(at.v, dv));
    let here = textures.height(l, id, mask, at);
    let right = textures.height(l, id, mask, &TextureCoordinates { u: at.u + du, p: at.p + along_u * du, ..*at });
    let down = textures.height(l, id, mask, &TextureCoordinates { v: at.v + dv, p: at.p + along_v * dv, ..*at });
    // By the metric of directions that need not be at right angles.
    let (by_u, by_v) = ((right - here) / du, (down - here) / dv);
    let (uu, uv, vv) = (along_u.length_squared(), along_u.dot(along_v), along_v.length_squared());
    let scale = 1.0 / (uu * vv - uv * uv);
    along_u * ((vv * by_u - uv * by_v) * scale) + along_v * ((uu * by_v - uv * by_u) * scale)
}

/// A step from `x` that stays below 1 if `x` is below 1.
#[inline(always)]
fn within<L: Lanes>(x: F<L>, step: F<L>) -> F<L> {
    (x + step).below(1.0).pick(step, -step)
}
