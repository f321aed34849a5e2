//! Shading normals by bump and normal maps.
use super::interaction::SurfaceInteraction;
use noisefall_base::math::{F, Lanes, M, Pick, U, V};
use noisefall_scene::{
    scene::{
        Scene,
        surface::{MIRRORED, is_set},
    },
    texture::{TextureCoordinates, Textures},
};

/// The shading normal on the front of a surface: in the lanes of `mask`, `n` tilted by the textures in its row of
/// [`noisefall_scene::scene::surface::Surfaces::relief`].
///
/// A height h displaces the surface to p + h n; without the small terms from the curvature of n, its normal is n − ∇h (J. Blinn,
/// "Simulation of Wrinkled Surfaces", SIGGRAPH 1978). A normal map holds (x, y, z)/2 + ½ of the normal, with x along ∂p/∂u, y
/// against ∂p/∂v (up in the image) and z along n, or along given tangents. A flipped surface turns this frame about x by half a turn.
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
    let derivatives = scene.shapes.tangents(l, place, point);
    let mut tilted = n;
    if mapped.any() {
        let code = scene.textures.colour(l, map + u32::MAX, mapped, at);
        let [x, y, z] = [code.x * 2.0 - 1.0, code.y * 2.0 - 1.0, code.z * 2.0 - 1.0];
        let [red, green] = scene.shapes.axes(l, place, point, derivatives);
        // Unlike `n`, the geometric normal is never flipped.
        let y = n.dot(point.n_geometric).below(0.0).pick(-y, y);
        let normal = red.normalized() * x + green.normalized() * y + n * z;
        tilted = mapped.pick(normal.normalized(), n);
    }
    if bumped.any() {
        let id = bumped.pick(bump + u32::MAX, l.u(0));
        let slope = gradient(l, &scene.textures, id, bumped, derivatives, at) * height;
        tilted = bumped.pick((tilted - slope).normalized(), tilted);
    }
    tilted
}

/// The normal that a viewer behind the surface sees if relief rises from both of its sides: `tilted`, which is on the side of the viewer
/// and shows bumps of the front as dents, with its part along the surface turned round. `n` is the normal of the surface.
#[inline(always)]
pub(super) fn seen_from_behind<L: Lanes>(tilted: V<L>, n: V<L>) -> V<L> {
    n * (n.dot(tilted) * 2.0) - tilted
}

/// Minimum height of the viewer over a shading normal.
pub(super) const GRAZING: f32 = 1e-3;

/// The normal of a smooth surface, or the plain one `n` where the viewer in the direction `wo` could not see the front of the former.
#[inline(always)]
pub(super) fn visible_smooth_normal<L: Lanes>(smooth: V<L>, n: V<L>, wo: V<L>) -> V<L> {
    smooth.dot(wo).above(GRAZING).pick(smooth, n)
}

/// A shading normal `n` that leans so far from the viewer in the direction `wo` that a mirror would reflect below the surface is turned
/// back towards the normal `surface` until the reflection leaves at a grazing angle. Both are on the side of the viewer. Also returns the
/// lanes where it is turned.
///
/// In the plane of both normals, with the angle θ between the turned one and that of the surface, the reflection has the height
/// x sin 2θ + z cos 2θ, where x and z are the parts of `wo`.
#[inline(always)]
pub(super) fn reflecting_normal<L: Lanes>(l: L, n: V<L>, surface: V<L>, wo: V<L>) -> (V<L>, M<L>) {
    /// Height of the reflection of a normal that is turned.
    const LOW: f32 = 1e-2;
    let reflected = n * (n.dot(wo) * 2.0) - wo;
    let dives = !reflected.dot(surface).above(0.0);
    if !dives.any() {
        return (n, dives);
    }
    let flat = n - surface * n.dot(surface);
    let axis = flat * (1.0 / flat.length_squared().sqrt());
    let (x, z) = (axis.dot(wo), surface.dot(wo));
    let square = x * x + z * z;
    let height = (z * 0.5).min(l.f(LOW));
    let rest = (square - height * height).max(l.f(0.0)).sqrt();
    let [cos, sin] = [z * height - x * rest, x * height + z * rest].map(|value| value / square);
    let half = ((1.0 + cos) * 0.5).max(l.f(0.0)).sqrt();
    let turned = surface * half + axis * (sin / (half * 2.0));
    let is_turned = dives & half.above(0.0);
    (is_turned.pick(turned.normalized(), n), is_turned)
}

/// A tilted normal that the viewer in the direction `wo` can see, and the number of the case. One that faces away is mirrored in the
/// normal `n` of the surface if its `flags` in [`noisefall_scene::scene::surface::Surfaces::relief`] say so (V. Schüßler et al.,
/// "Microfacet-based Normal Mapping for Robust Monte Carlo Path Tracing", SIGGRAPH Asia 2017), and is replaced by it otherwise.
#[inline(always)]
pub(super) fn visible_normal<L: Lanes>(l: L, flags: U<L>, tilted: V<L>, n: V<L>, wo: V<L>) -> (V<L>, U<L>) {
    let mirrored = seen_from_behind(tilted, n);
    let faces_away = !tilted.dot(wo).above(0.0);
    let is_mirrored = faces_away & is_set(flags, MIRRORED);
    let tilted = is_mirrored.pick(mirrored, tilted);
    let is_tilted = tilted.dot(wo).above(GRAZING);
    (is_tilted.pick(tilted, n), is_tilted.pick(is_mirrored.pick(l.u(2), l.u(1)), l.u(0)))
}

/// ∇h along the surface, per metre, by finite differences.
#[inline(always)]
fn gradient<L: Lanes>(
    l: L,
    textures: &Textures,
    id: U<L>,
    mask: M<L>,
    (along_u, along_v): (V<L>, V<L>),
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

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;
    use noisefall_scene::scene::parse;

    fn direction([x, y, z]: [f32; 3]) -> V<One> {
        V::splat(One, [x, y, z]).normalized()
    }

    /// The normal that stands for a tilted one that faces away from a viewer.
    fn seen(flags: &str, tilted: V<One>, wo: V<One>) -> V<One> {
        let text = format!(
            "format = 1
            environment.radiance = 1
            camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }}
            textures.dents.checker = {{ even = 0.2, odd = 0.6, scale = 3 }}
            [materials.ball]
            lambertian.albedo = 0.5
            bump = {{ texture = 'dents', height = 1 }}
            {flags}
            [[objects]]
            shape.sphere = {{ center = [0, 0, 0], radius = 1 }}
            material = 'ball'"
        );
        let scene = parse("ball.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        let flags = U(scene.surfaces.relief[0][3].to_bits());
        visible_normal(One, flags, tilted, direction([0.0, 0.0, 1.0]), wo).0
    }

    #[test]
    fn normals_that_face_away_are_replaced_or_mirrored() {
        let (n, wo) = (direction([0.0, 0.0, 1.0]), direction([1.0, 0.0, 0.5]));
        let (towards, away) = (direction([0.6, 0.0, 0.8]), direction([-0.8, 0.0, 0.6]));
        let near = |a: V<One>, b: V<One>| (a - b).length_squared().0 < 1e-10;
        for flags in ["", "mirrored_normals = true"] {
            assert!(near(seen(flags, towards, wo), towards), "one that the viewer sees stays");
        }
        assert!(near(seen("", away, wo), n));
        assert!(near(seen("mirrored_normals = true", away, wo), direction([0.8, 0.0, 0.6])));
    }
}
