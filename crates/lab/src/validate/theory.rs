//! The chapter before the sections: the equation, when it has exactly one solution, and what the estimates converge to.
use maud::{Markup, html as markup};

use crate::report::formula;

/// Headings and their paragraphs.
const CHAPTER: [(&str, &[&str]); 5] = [
    (
        "The equation",
        &[
            "L(x, ω) = L_e(x, ω) + ∫_S² f(x, ω, ω′) τ(x, x′) L(x′, −ω′) |cos θ′| dω′ with x′ = x_M(x, ω′), the first surface point seen \
             from x along ω′. An opaque surface has f = 0 unless ω and ω′ lie on the same side: there the integral is over the hemisphere \
             of n. Glass transmits light, so ω′ ranges over the whole sphere S² and the cosine enters as |cos θ′|. For smooth mirrors and glass f contains delta functions; their part of the integral is a sum over one or two directions.",
            "A ray that hits nothing returns the environment, L(x′, −ω′) = L_b(ω′), which is counted as a part of L_e below. The medium transmits τ(x, x′) = t^|x − x′|, where t is the transmittance of one metre (Beer’s law); it does not scatter. At an interface from index n_i to n_o the solid angle of a beam changes, and its radiance by the factor (n_o/n_i)²: the conserved quantity is L/n², not L. The f of glass contains this factor.",
        ],
    ),
    (
        "As an operator",
        &[
            "Let (T L)(x, ω) denote the integral. T is linear, and the equation reads L = L_e + T L. On bounded functions with the norm ‖L‖ = sup |L|/n², where n is the index of the medium at the point, |T L|/n² ≤ ρ(x, ω) ‖L‖. Here ρ(x, ω) is the directional albedo: the radiance that the surface sends into ω when L/n² = 1 arrives from all directions. By reciprocity it equals the fraction of the light from ω that the surface reflects and transmits. Since τ ≤ 1, ‖T‖ ≤ a, where a is the largest albedo of the scene.",
            "If a < 1, T is a contraction. By Banach’s fixed-point theorem there is exactly one solution, and it is the Neumann series \
             L = Σ Tᵏ L_e: the k-th term is the light that has bounced k times. A cap of n bounces omits at most aⁿ⁺¹ ‖L_e‖/(1 − a).",
        ],
    ),
    (
        "Where surfaces absorb nothing",
        &[
            "With ρ = 1 somewhere (glass, perfect mirrors, white walls) ‖T‖ may be 1. If ‖Tᵐ‖ < 1 for some m, because from every point at least a fraction ε of the light is absorbed or escapes within m bounces, the series still converges and the solution is unique.",
            "Without such a bound the partial sums for L_e ≥ 0 still increase with every term. Where Σ Tᵏ L_e is finite, it is the smallest non-negative solution, and the estimate converges to it. Clear glass is an example: near the critical angle light can stay inside for arbitrarily many bounces, and light that is totally reflected for ever neither comes from outside nor is visible from there.",
            "A closed room whose surfaces all have ρ = 1 has no such solution. There T n² = n²: if L is a solution, so is L + c n² for any c. For L_e = 0 every c n² is a solution. For L_e > 0 there is none, because in equilibrium the absorbed power, which is 0, would have to equal the emitted power: the partial sums grow without bound. The scene format allows such a room; its image does not converge, and its paths end after 4096 bounces or by roulette.",
        ],
    ),
    (
        "What a sample is",
        &[
            "A path draws ω′ with a density p, multiplies its throughput by f τ |cos θ′|/p and adds throughput × L_e at every vertex: its mean is Σ Tᵏ L_e if p > 0 wherever the integrand is not 0. Multiple importance sampling adds light samples and weights both strategies by weights that add up to 1: this changes the terms, not their sum. Roulette continues a path with probability q and divides by q, which leaves the mean unchanged.",
            "The mean of N samples converges to the solution by the law of large numbers, and its error falls as σ/√N if the variance σ² is finite. This is a second condition: the mean square obeys an equation of the same form, with the kernel (f τ cos θ′)²/(p q) in place of f τ cos θ′, and its series must converge too. In the furnace of section 1 the condition is ρ² E w² < q, w being the weight \
             of a direction, E w² = 1 for cosine directions and 4/3 for uniform ones. For q ≤ ρ² the estimate is still unbiased, but its variance is infinite: rare samples of enormous weight dominate, the error falls more slowly than 1/√N, and no standard error can be trusted. Section 3 shows an example. Roulette by throughput keeps the throughput of survivors at about 1 or less, so weights do not accumulate; but its survival probability is at most 0.95, which gives the same limit with q = 0.95: albedos below 0.97 for cosine directions and below 0.84 for uniform ones. The program warns when the settings exceed this limit for the albedos of a scene.",
        ],
    ),
    (
        "What this report cannot show",
        &[
            "A statement holds for the parameters that it names. No section covers these: textures and skies from image files, \
             noise textures, bump and normal maps, smooth normals, motion, instances, files of meshes, \
             media within media, lights that are ellipsoids, cuboids, cylinders or isosurfaces, the window. \
             The tests of the program do, and `validate --stress` renders \
             meshes by formula, bump, motion and filters at random. Estimated errors and stops by them \
             are not covered either. Every row states the smallest bias that it would notice; a smaller bias may remain.",
            "Does the report notice a mistake? 35 mutants were made in the code that computes the image, one at a time: a wrong density, a \
             lost cosine, a light that shines from its back. They were written down before anyone looked at what the report tests \
             (crates/lab/mutants.toml in the source). The quick run noticed 31 of them. It missed a random number that is used twice in the \
             tree of lights, a cosine in the weights of reused suffixes, the sides of flipped surfaces, and the largest survival probability.",
        ],
    ),
];

pub fn chapter() -> Markup {
    markup! {
        div.theory {
            h2 { "Theory" }
            @for (heading, paragraphs) in CHAPTER {
                h3 { (heading) }
                @for paragraph in paragraphs { p { (formula(paragraph)) } }
            }
            p.source {
                "J. T. Kajiya, “The Rendering Equation”, SIGGRAPH 1986; J. Arvo, “Analytic Methods for Simulated Light Transport”, 1995, for the \
                 norms of its operators; E. Veach, “Robust Monte Carlo Methods for Light Transport Simulation”, 1997, for n² and for the \
                 estimators; J. Arvo and D. Kirk, “Particle Transport and Image Synthesis”, SIGGRAPH 1990, for roulette."
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mutants_are_as_many_as_are_told() {
        let mutants = include_str!("../../mutants.toml").matches("[[mutant]]").count();
        let told = format!("{mutants} mutants were made");
        assert!(CHAPTER.iter().flat_map(|(_, paragraphs)| *paragraphs).any(|paragraph| paragraph.contains(&told)), "{told}");
    }
}
