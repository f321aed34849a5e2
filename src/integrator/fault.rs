//! Faults that tests inject to prove that the validation notices them. Not part of the program.
use crate::{
    math::{F, Lanes, V},
    scene::InjectedFault,
};

/// The weight of the direction of a path's `reflection`-th reflection at cosine `cos`, with the injected fault.
#[inline(always)]
pub(super) fn spoil<L: Lanes>(fault: Option<InjectedFault>, reflection: u32, weight: V<L>, cos: F<L>) -> V<L> {
    match fault {
        Some(InjectedFault::WrongPdf) => weight * (1.0 / 1.03),
        // Once only: the light would grow without end.
        Some(InjectedFault::DroppedCosine) if reflection == 1 => weight * (1.0 / cos.abs().max(cos.splat(1e-3))),
        _ => weight,
    }
}
