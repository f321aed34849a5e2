//! Vertex merging: a camera path adds the light of light paths that end nearby (I. Georgiev, J. Křivánek,
//! T. Davidovič and P. Slusallek, "Light Transport Simulation with Vertex Connection and Merging", 2012).
//!
//! The light of N paths, those of all pixels of the tile, is averaged over a disk of radius r. It finds what no connection can, such as a
//! caustic that is seen in a mirror. The image is blurred by r, which is a bias; r shrinks with the number of samples, and the bias with it.
//!
//! With η = N π r², a merge has η times the pdf per area of the last vertex that the light path has. So η joins the partial sums
//! of all strategies wherever a vertex could have been merged, and those of a merge are divided by it ([`Partial::sum`],
//! [`Partial::scatter`]; sections 4.2 and 4.3 of I. Georgiev, "Implementing Vertex Connection and Merging", 2012).
//!
//! [`Partial::sum`]: crate::integrator::light_paths::partial::Partial::sum
//! [`Partial::scatter`]: crate::integrator::light_paths::partial::Partial::scatter
use super::{
    connect::Connector,
    radius::radius,
    scatter::{Evaluated, evaluate},
};
use crate::integrator::{
    batch::add,
    light_paths::{partial::cosine, path_state::PathVertex, paths::LightPaths},
    work::Work,
};
use noisefall_base::math::{Lanes, MAX_LANES, Pick};

/// Makes the vertices of the light paths ready to be found.
pub(super) fn prepare(work: &Work, state: &mut LightPaths) {
    state.grid.fill(state.vertices.positions(), radius(work));
}

impl<L: Lanes> Connector<'_, '_, L> {
    /// Adds the light of all light paths that end nearby.
    #[inline(always)]
    pub fn merge(&self, l: L, state: &mut LightPaths, radiance: &mut [[f32; 4]]) {
        let Connector { work, stage, hits, at, vertex, reflection, merged } = self;
        let PathVertex { live, hit, back, partial } = vertex;
        let LightPaths { vertices, grid, near, .. } = state;
        let ([x, y, z], live) = ([hit.p.x.to_array(), hit.p.y.to_array(), hit.p.z.to_array()], live.bits());
        for (lane, near) in near.iter_mut().enumerate() {
            near.clear();
            if live >> lane & 1 == 1 {
                grid.find([x[lane], y[lane], z[lane]], near);
            }
        }
        let most = near.iter().map(Vec::len).max().unwrap_or(0);
        let end_of_bounces = work.settings.last_bounce() + 1 - reflection;
        let per_path = 1.0 / *merged;
        for number in 0..most {
            let mut indices = [f32::from_bits(u32::MAX); MAX_LANES];
            for (index, near) in indices.iter_mut().zip(&*near) {
                *index = f32::from_bits(near.get(number).copied().unwrap_or(u32::MAX));
            }
            let index = l.load(&indices).bits();
            let open = !index.is(u32::MAX);
            let index = open.pick(index, l.u(0));
            let (light, end) = (vertices.read(l, index), vertices.read_end(l, index));
            let Evaluated { f_cos, pdf, reverse } = evaluate(l, work, *stage, hits, *at, [*back, end.back]);
            let contribution = hit.throughput * f_cos * end.light * (per_path / cosine(end.back, hit.n));
            let others = (end.partial.before(pdf) + partial.before(reverse)) * per_path;
            let keep = open & light.bounce.below(end_of_bounces) & contribution.max_component().above(0.0);
            add(radiance, keep, hit.slot, contribution * (1.0 / (1.0 + others)));
        }
    }
}
