//! Properties that vary over a surface: colour, roughness and shading normal at the points where paths arrive.
use super::{
    interaction::{SurfaceInteraction, vertex_colour},
    normal_mapping::{seen_from_behind, shading_normal, visible_normal, visible_smooth_normal},
    records::{Detail, MappedNormals, SurfaceCoordinates},
};
use noisefall_base::math::{Lanes, M, Pick, U, V};
use noisefall_scene::{
    geometry::Coordinates,
    scene::{
        Scene,
        surface::{FLIPPED, ON_BOTH_SIDES, ONE_SIDED, SQUARED, is_set},
    },
    texture::TextureCoordinates,
};

/// Paths at a surface.
pub(super) struct IncidentPaths<L: Lanes> {
    pub d: V<L>,
    pub interaction: SurfaceInteraction<L>,
    /// Media around the paths.
    pub media: U<L>,
    /// See [`noisefall_scene::scene::surface`].
    pub word: U<L>,
    /// Whether smooth normals stay as they are where the viewer cannot see their front.
    pub keeps_hidden_normals: bool,
}

impl<L: Lanes> IncidentPaths<L> {
    /// Whether the paths are at the front, and whether the surface reflects on their side.
    #[inline(always)]
    pub fn sides(&self) -> (M<L>, M<L>) {
        let front = self.interaction.cos.above(0.0) ^ is_set(self.word, FLIPPED);
        (front, front | !is_set(self.word, ONE_SIDED))
    }

    /// Whether highlights need normals whose reflections leave the surface; from either end, each viewer gets its own.
    pub fn bends_normals(&self, scene: &Scene) -> bool {
        !self.keeps_hidden_normals && (scene.shapes.have_elements() || !scene.surfaces.relief.is_empty())
    }

    /// The normal `n` on the side of the paths, tilted by the textures of the surface in the lanes of `mask`.
    #[inline(always)]
    fn tilted(&self, l: L, scene: &Scene, mask: M<L>, n: V<L>, at: &TextureCoordinates<L>) -> V<L> {
        let side = l.f(1.0).copysign(self.interaction.cos);
        let side = is_set(self.word, FLIPPED).pick(-side, side);
        let tilted = shading_normal(l, scene, &self.interaction, mask, n * side, at) * side;
        let [.., flags] = l.rows(&scene.surfaces.relief, self.interaction.row);
        (side.below(0.0) & is_set(flags.bits(), ON_BOTH_SIDES)).pick(seen_from_behind(tilted, n), tilted)
    }
}

/// Texture coordinates and tangents of the paths.
#[inline(always)]
pub(super) fn chart<L: Lanes>(l: L, scene: &Scene, incident: &IncidentPaths<L>) -> SurfaceCoordinates<L> {
    let SurfaceInteraction { place, point, .. } = &incident.interaction;
    let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
    let [along_u, up] = scene.shapes.axes(l, place, point, scene.shapes.tangents(l, place, point));
    let [x, y, z, vertex_opacity] = vertex_colour(l, scene, *place, *point).unwrap_or([l.f(1.0); 4]);
    let handedness = l.f(1.0).copysign(along_u.cross(up).dot(point.n_geometric));
    SurfaceCoordinates { u, v, along_u, handedness, vertex: V { x, y, z }, vertex_opacity }
}

/// Evaluates textures in the lanes of `mask`, for surfaces of colour `colour` and normal `n` without them. Returns colour, details,
/// and the normal without bump and normal maps.
#[inline(always)]
pub(super) fn vary<L: Lanes>(
    l: L,
    scene: &Scene,
    incident: &IncidentPaths<L>,
    mask: M<L>,
    colour: V<L>,
    n: V<L>,
) -> (V<L>, Detail<L>, V<L>) {
    let Scene { surfaces, textures, .. } = scene;
    let IncidentPaths { d, interaction, media, word, keeps_hidden_normals } = incident;
    let SurfaceInteraction { place, row, point, cos } = interaction;
    let [mut alpha, colour_texture, alpha_texture, medium] = l.rows(&surfaces.varying, *row);
    let wo = -*d;
    let (mut colour, mut n) = (colour, n);
    if scene.shapes.have_elements() {
        let smooth = scene.shapes.smooth_normal(l, place, point) * l.f(1.0).copysign(*cos);
        n = if *keeps_hidden_normals { smooth } else { visible_smooth_normal(smooth, n, wo) };
    }
    let untilted = n;
    if surfaces.textured || !surfaces.relief.is_empty() {
        let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
        let vertex = vertex_colour(l, scene, *place, *point);
        let at = TextureCoordinates { u, v, p: point.p, vertex: vertex.as_ref() };
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
            let [.., flags] = l.rows(&surfaces.relief, *row);
            let tilted = incident.tilted(l, scene, mask, n, &at);
            n = if *keeps_hidden_normals { tilted } else { visible_normal(l, flags.bits(), tilted, n, wo).0 };
        }
    }
    (colour, Detail { wo, n, alpha, error: point.error, surface: *word, media: *media, medium: medium.bits() }, untilted)
}

/// The relief of a surface with the normal `n`, whose smooth normal is `smooth`.
#[inline(always)]
pub(super) fn relief<L: Lanes>(
    l: L,
    scene: &Scene,
    incident: &IncidentPaths<L>,
    mask: M<L>,
    n: V<L>,
    smooth: V<L>,
) -> MappedNormals<L> {
    let SurfaceInteraction { place, row, point, .. } = &incident.interaction;
    let Coordinates { u, v } = scene.shapes.coordinates(l, place, point);
    let vertex = vertex_colour(l, scene, *place, *point);
    let at = TextureCoordinates { u, v, p: point.p, vertex: vertex.as_ref() };
    let [.., flags] = l.rows(&scene.surfaces.relief, *row);
    MappedNormals { smooth, tilted_surface: incident.tilted(l, scene, mask, n, &at), flags: flags.bits() }
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
    let vertex = vertex_colour(l, scene, *place, *point);
    let at = TextureCoordinates { u, v, p: point.p, vertex: vertex.as_ref() };
    textured.pick(scene.textures.colour(l, id + u32::MAX, textured, &at), constant)
}

#[cfg(test)]
mod tests {
    use crate::integrator::{Batch, Work, trace};
    use noisefall_base::math::SimdLevel;
    use noisefall_scene::scene::{RenderSettings, parse};

    /// Radiance of a ball of this material under a bright sky and a light.
    fn radiance(material: &str) -> Vec<[f32; 4]> {
        let text = format!(
            "format = 1
            environment.radiance = [0.2, 0.4, 0.6]
            camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }}
            textures.half.checker = {{ even = 0.5, odd = 0.5, scale = 3 }}
            textures.warm.checker = {{ even = [0.75, 0.5, 0.25], odd = [0.75, 0.5, 0.25], scale = 3 }}
            [materials.ball]
            principled = {{ {material} }}
            [[objects]]
            shape.sphere = {{ center = [0, 0, 0], radius = 1 }}
            material = 'ball'
            [[objects]]
            shape.sphere = {{ center = [0, 3, 3], radius = 0.5 }}
            emission.radiance = 9"
        );
        let scene = parse("ball.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        let (rays, settings) = (scene.rays(&scene.camera), RenderSettings::default());
        let work = Work::tile(&scene, &rays, &settings, [0, 0], [16, 16], 3);
        let mut batch = Batch::default();
        trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nothing interrupts");
        batch.radiance().to_vec()
    }

    /// One parameter is textured in each scene, so that both have the same frames.
    #[test]
    fn a_texture_of_one_value_is_that_value() {
        let constant = "base_metalness = 0.5, coat_weight = 0.5, coat_color = [0.75, 0.5, 0.25], fuzz_weight = 0.5";
        let expected = radiance(&format!("{constant}, coat_roughness = {{ texture = 'half' }}"));
        for textured in [
            "base_metalness = { texture = 'half' }, coat_weight = 0.5, coat_color = [0.75, 0.5, 0.25], fuzz_weight = 0.5",
            "base_metalness = 0.5, coat_weight = 0.5, coat_color = { texture = 'warm' }, fuzz_weight = 0.5",
            "base_metalness = 0.5, coat_weight = 0.5, coat_color = [0.75, 0.5, 0.25], fuzz_weight = { texture = 'half' }",
        ] {
            let found = radiance(&format!("{textured}, coat_roughness = 0.5"));
            let same = found.iter().zip(&expected).filter(|(a, b)| (a[0] - b[0]).abs() <= 1e-3 * b[0].max(1e-3)).count();
            assert!(same > found.len() - 4, "{textured}: {same} of {}", found.len());
        }
    }
}
