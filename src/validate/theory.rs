//! The chapter before the sections: the equation, when it has one solution, and what that says of the estimates.
use maud::{Markup, html as markup};

use crate::report::formula;

/// Headings with their paragraphs.
const CHAPTER: [(&str, &[&str]); 5] = [
    (
        "The equation",
        &[
            "L(x, ω) = L_e(x, ω) + ∫_S² f(x, ω, ω′) τ(x, x′) L(x′, −ω′) |cos θ′| dω′ with x′ = x_M(x, ω′), the first surface point seen \
             from x along ω′. An opaque surface has f = 0 unless ω and ω′ lie on the same side: there the integral is over the hemisphere \
             of n. Glass sends light through, so that ω′ runs over the whole sphere S² and the cosine counts by its size. Smooth mirrors and \
             glass have f with delta functions; their part of the integral is a sum over one or two directions.",
            "A ray that meets nothing brings the radiance of the background, L(x′, −ω′) = L_b(ω′), which from here on counts as a part of L_e. On the way the medium lets pass \
             τ(x, x′) = t^|x − x′|, t being what a metre of it lets pass (Beer’s law); it does not scatter. Where light crosses from an index \
             n_i to n_o, its solid angle changes, and radiance with it by (n_o/n_i)²: not L but L/n² is kept. f of glass contains that factor.",
        ],
    ),
    (
        "As an operator",
        &[
            "Let (T L)(x, ω) be the integral. It is linear, and L = L_e + T L. In the space of bounded functions with the norm \
             ‖L‖ = sup L/n², n being the index of the medium at the point, |T L|/n² ≤ ρ(x, ω) ‖L‖. Here ρ(x, ω) is what the surface \
             sends into ω of a light with L/n² = 1 from all directions, its directional albedo, by reciprocity the same as what it \
             reflects and transmits of light that comes along ω. As τ ≤ 1, ‖T‖ ≤ a, the largest albedo of the scene.",
            "If a < 1, T is a contraction. By Banach’s fixed-point theorem there is exactly one solution, and it is the Neumann series \
             L = Σ Tᵏ L_e: the k-th term is the light that bounced k times. What a cap of n bounces leaves out is at most \
             aⁿ⁺¹ ‖L_e‖/(1 − a).",
        ],
    ),
    (
        "Where surfaces absorb nothing",
        &[
            "With ρ = 1 somewhere (glass, perfect mirrors, white walls) ‖T‖ may be 1. If ‖Tᵐ‖ < 1 for some m, because from everywhere at \
             least a part ε of the light is absorbed or leaves within m bounces, the series still converges and the solution is unique.",
            "Without such a bound the partial sums of an L_e ≥ 0 still grow with every term, so that Σ Tᵏ L_e is the least of all solutions \
             that are not negative, wherever it is finite; it is what paths converge to. Clear glass is of this kind: near the critical \
             angle light stays for as long as one likes, and what is totally reflected for ever neither came from outside nor is seen \
             from there.",
            "A closed room all of whose surfaces have ρ = 1 is not. There T n² = n²: with a solution L, L + c n² is one for any c. With L_e = 0 \
             every c n² is; with L_e > 0 none is, for in balance the absorbed power, which is 0, would have to be the \
             emitted one: the partial sums grow without bound. The scene format allows such a room; its picture does not converge, and \
             paths in it end at 4096 bounces or by roulette.",
        ],
    ),
    (
        "What a sample is",
        &[
            "A path draws ω′ with a density p, multiplies its throughput by f τ |cos θ′|/p and adds throughput × L_e at every vertex: its mean \
             is Σ Tᵏ L_e if p > 0 wherever the integrand is not 0. Sampling lights, and weighting both ways by weights that add up to 1, \
             changes the terms and not their sum. Roulette goes on with probability q and divides by q: the mean stays.",
            "The mean of N samples converges to the solution by the law of large numbers, and its error falls as σ/√N if the variance σ² is \
             finite. That is a second condition. The mean square obeys the same kind of equation, with the kernel (f τ cos θ′)²/(p q) in \
             place of f τ cos θ′: its series must converge, too. In the furnace of section 1 the condition is ρ² E w² < q, w being the weight \
             of a direction, E w² = 1 for cosine directions and 4/3 for uniform ones. With q ≤ ρ² the mean is still right, but the variance is \
             infinite: rare samples of enormous weight carry it, the error falls more slowly than 1/√N, and no standard error can be \
             trusted. Section 3 shows that. Roulette by throughput leaves its survivors a throughput of about 1, so that weights do not pile up; but it \
             survives with 0.95 at most, and so has the same limit with q = 0.95: albedos below 0.97 for cosine directions and 0.84 for \
             uniform ones. The program notes settings that are beyond it for the albedos of a scene.",
        ],
    ),
    (
        "What this report cannot show",
        &[
            "Statements hold at the parameters that they name. They say nothing of what is in no section: textures and skies from image files, \
             bump and normal maps, smooth normals, motion, pixel filters other than the box, instances, files of meshes, the window. \
             The tests of the program cover these, and `validate --stress` renders \
             meshes by formula, bump, motion and filters at random. Noise figures and stops by noise \
             are not covered either. For every row the report says how large a bias it would notice: what is smaller may be there.",
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
