//! Properties that vary over a surface: colour, roughness and shading normal at the points where paths arrive.
use super::{interaction::SurfaceInteraction, normal_mapping::shading_normal, records::Detail};
use crate::{
    geometry::Coordinates,
    math::{Lanes, M, Pick, U, V},
    scene::{
        Scene,
        surface::{FLIPPED, ONE_SIDED, SQUARED, is_set},
    },
    texture::TextureCoordinates,
};

/// Minimum height of the viewer over a shading normal; below it, the geometric normal is used.
const GRAZING: f32 = 1e-3;

/// Paths at a surface.
pub(super) struct IncidentPaths<L: Lanes> {
    pub d: V<L>,
    pub interaction: SurfaceInteraction<L>,
    /// Media around the paths.
    pub media: U<L>,
    /// See [`crate::scene::surface`].
    pub word: U<L>,
}

impl<L: Lanes> IncidentPaths<L> {
    /// Whether the paths are at the front, and whether the surface reflects on their side.
    #[inline(always)]
    pub fn sides(&self) -> (M<L>, M<L>) {
        let front = self.interaction.cos.above(0.0) ^ is_set(self.word, FLIPPED);
        (front, front | !is_set(self.word, ONE_SIDED))
    }
}

/// Evaluates textures in the lanes of `mask`, for surfaces of colour `colour` and normal `n` without them. Returns colour and
/// details.
#[inline(always)]
pub(super) fn vary<L: Lanes>(
    l: L,
    scene: &Scene,
    incident: &IncidentPaths<L>,
    mask: M<L>,
    colour: V<L>,
    n: V<L>,
) -> (V<L>, Detail<L>) {
    let Scene { surfaces, textures, .. } = scene;
    let IncidentPaths { d, interaction, media, word } = incident;
    let SurfaceInteraction { place, row, point, cos } = interaction;
    let [mut alpha, colour_texture, alpha_texture, medium] = l.rows(&surfaces.varying, *row);
    let wo = -*d;
    let (mut colour, mut n) = (colour, n);
    if scene.shapes.have_elements() {
        let smooth = scene.shapes.smooth_normal(l, place, point) * l.f(1.0).copysign(*cos);
        n = smooth.dot(wo).above(GRAZING).pick(smooth, n);
    }
    if surfaces.textured || !surfaces.relief.is_empty() {
        let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
        let at = TextureCoordinates { u, v, p: point.p };
        let id = colour_texture.bits();
        let coloured = mask & !id.is(0);
        if coloured.any() {
            colour = coloured.pick(textures.colour(l, id + u32::MAX, coloured, &at), colour);
        }
        let id = alpha_texture.bits();
        let rough = mask & !id.is(0);
        if rough.any() {
            let value = textures.height(l, id + u32::MAX, rough, &at);
            alpha = rough.pick(is_set(*word, SQUARED).pick(value * value, value), alpha);
        }
        if !surfaces.relief.is_empty() {
            let side = l.f(1.0).copysign(*cos);
            let tilted = shading_normal(l, scene, interaction, mask, n * side, &at) * side;
            // A normal that the viewer could not see is not used.
            n = tilted.dot(wo).above(GRAZING).pick(tilted, n);
        }
    }
    (colour, Detail { wo, n, alpha, error: point.error, surface: *word, media: *media, medium: medium.bits() })
}

/// Diffuse transmittance in the lanes of `mask`.
#[inline(always)]
pub(super) fn transmittance_of_surface<L: Lanes>(l: L, scene: &Scene, incident: &IncidentPaths<L>, mask: M<L>) -> V<L> {
    let SurfaceInteraction { place, row, point, .. } = &incident.interaction;
    let [x, y, z, texture] = l.rows(&scene.surfaces.transmittance, *row);
    let (constant, id) = (V { x, y, z }, texture.bits());
    let textured = mask & !id.is(0);
    if !textured.any() {
        return constant;
    }
    let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
    let at = TextureCoordinates { u, v, p: point.p };
    textured.pick(scene.textures.colour(l, id + u32::MAX, textured, &at), constant)
}
