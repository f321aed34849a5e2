//! Shading normals by viewer. One that faces away from the viewer is mirrored or replaced: see [`super::super::normal_mapping`].
use crate::integrator::{
    normal_mapping::{GRAZING, reflecting_normal, seen_from_behind, visible_normal},
    normal_shadowing::shadowing_of_normals,
    records::MappedNormals,
};
use noisefall_base::math::{Lanes, M, Pick, U, V};
use noisefall_scene::scene::surface::{ON_BOTH_SIDES, is_set};

/// The normals of surface points, on the side the path arrived from.
pub(super) struct Normals<L: Lanes> {
    pub surface: V<L>,
    /// The shading normal, whether or not a viewer sees its front.
    pub shading: V<L>,
    /// Normals of bump and normal maps, in scenes with any.
    pub relief: Option<MappedNormals<L>>,
}

/// The normal that a viewer sees.
pub(super) struct ViewedNormal<L: Lanes> {
    pub n: V<L>,
    /// The normal without bump and normal maps.
    untilted: V<L>,
    /// Which of the possible normals both are.
    choice: U<L>,
    /// Lanes where the normal is turned for this viewer alone.
    is_turned: M<L>,
}

impl<L: Lanes> Normals<L> {
    /// The normal for a viewer in the direction `d`. It may point to the other side. `reflects`: the surface has highlights.
    #[inline(always)]
    pub fn towards(&self, l: L, d: V<L>, reflects: bool) -> ViewedNormal<L> {
        let viewed = self.seen_from(l, d);
        if !reflects {
            return viewed;
        }
        let side = l.f(1.0).copysign(d.dot(self.surface));
        let (n, is_turned) = reflecting_normal(l, viewed.n * side, self.surface * side, d);
        ViewedNormal { n: n * side, is_turned, ..viewed }
    }

    #[inline(always)]
    fn seen_from(&self, l: L, d: V<L>) -> ViewedNormal<L> {
        let side = l.f(1.0).copysign(d.dot(self.surface));
        let smooth = self.relief.as_ref().map_or(self.shading, |relief| relief.smooth);
        let is_smooth = (smooth.dot(d) * side).above(GRAZING);
        let untilted = is_smooth.pick(smooth, self.surface);
        let choice = is_smooth.pick(l.u(1), l.u(0));
        let Some(relief) = &self.relief else { return ViewedNormal { n: untilted, untilted, choice, is_turned: l.first(0) } };
        let tilted = is_smooth.pick(self.shading, relief.tilted_surface);
        // Of relief on both sides, the other side shows another one than a path sees that arrived from here.
        let is_other = side.below(0.0) & is_set(relief.flags, ON_BOTH_SIDES);
        let tilted = is_other.pick(seen_from_behind(tilted, untilted), tilted);
        let (n, form) = visible_normal(l, relief.flags, tilted * side, untilted * side, d);
        let choice = choice + (form << 1) + is_other.pick(l.u(8), l.u(0));
        ViewedNormal { n: n * side, untilted, choice, is_turned: l.first(0) }
    }

    /// The fraction of light from the direction `wi` that the relief does not shadow for a viewer.
    #[inline(always)]
    pub fn shadowing(&self, l: L, viewed: &ViewedNormal<L>, wi: V<L>) -> Option<noisefall_base::math::F<L>> {
        let relief = self.relief.as_ref()?;
        Some(shadowing_of_normals(l, relief.flags, viewed.untilted, viewed.n).towards(l, wi))
    }
}

impl<L: Lanes> ViewedNormal<L> {
    /// Lanes where two viewers see the same normal.
    #[inline(always)]
    pub fn equals(&self, other: &ViewedNormal<L>) -> M<L> {
        self.choice.equals(other.choice) & !self.is_turned & !other.is_turned
    }
}
