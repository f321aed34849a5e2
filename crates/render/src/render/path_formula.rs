//! The estimate of a path as a nested sum with its numbers, as text and as LaTeX.
//!
//! L = τ₀ (w₀ L_e(x₀) + D₀ + f₀ cos θ₀/(p₀ q₀) · τ₁ (w₁ L_e(x₁) + D₁ + …)), where D is the light sample of a vertex, τ the
//! transmittance on the way to it, w the weight of emitted light, and q the survival probability of roulette. Factors of 1 are
//! omitted.
use noisefall_kernel::integrator::{LightOutcome, Replay, Vertex};

/// Number of vertices in the formula without numbers.
const SHOWN: usize = 2;

type Colour = [f64; 3];

/// The terms of one vertex.
struct Level {
    transmittance: Colour,
    /// Weight and radiance; zero if nothing emits.
    emission: (f64, Colour),
    /// D.
    light: Colour,
    /// The factor of the next vertex, if there is one.
    factor: Option<Factor>,
}

/// The factor of the radiance of the next vertex.
struct Factor {
    /// BSDF, cosine and pdf; `None` for a delta lobe.
    f_cos_pdf: Option<(Colour, f64, f64)>,
    /// f cos/p, also of a delta lobe.
    weight: Colour,
    survival: f64,
}

fn levels(replay: &Replay) -> Vec<Level> {
    replay.vertices.iter().map(level).collect()
}

fn level(vertex: &Vertex) -> Level {
    let wide = |rgb: [f32; 3]| rgb.map(f64::from);
    let emission = vertex.emission.as_ref().map_or((1.0, [0.0; 3]), |met| (met.weight.into(), wide(met.radiance)));
    let seen = vertex.light.as_ref().filter(|light| light.outcome == LightOutcome::Seen);
    let light = seen.map_or([0.0; 3], |light| {
        let scale = f64::from(light.weight) / f64::from(light.pdf);
        [0, 1, 2].map(|c| f64::from(light.f_cos[c]) * f64::from(light.radiance[c]) * f64::from(light.passed[c]) * scale)
    });
    let factor = vertex.reflection.as_ref().filter(|reflection| reflection.goes_on).map(|reflection| Factor {
        f_cos_pdf: reflection.f.zip(reflection.pdf).map(|(f, pdf)| (wide(f), reflection.cos.into(), pdf.into())),
        weight: wide(reflection.weight),
        survival: reflection.survival.into(),
    });
    Level { transmittance: wide(vertex.transmittance), emission, light, factor }
}

/// The value of the nested sum.
fn value(levels: &[Level]) -> Colour {
    levels.iter().rev().fold([0.0; 3], |next, level| {
        let of = |c: usize| {
            let (weight, radiance) = level.emission;
            let further = level.factor.as_ref().map_or(0.0, |factor| factor.weight[c] / factor.survival * next[c]);
            level.transmittance[c] * (weight * radiance[c] + level.light[c] + further)
        };
        [0, 1, 2].map(of)
    })
}

/// The notation of the formula.
struct Writer {
    times: &'static str,
    /// Brackets around the sum of a vertex.
    brackets: [&'static str; 2],
    /// The line break before the next vertex.
    line: fn(usize) -> String,
    number: fn(f64) -> String,
    /// Formats the symbol of a vertex.
    index: fn(&str, usize) -> String,
    tau: &'static str,
    cos: &'static str,
    dots: &'static str,
    fraction: fn(&str, &str) -> String,
}

const TEXT: Writer = Writer {
    times: " · ",
    brackets: ["(", ")"],
    line: |depth| format!("\n    {}", "  ".repeat(depth.min(16))),
    number: short,
    index: |symbol, k| format!("{symbol}{}", ["₀", "₁"][k % SHOWN]),
    tau: "τ",
    cos: "cos θ",
    dots: "…",
    fraction: |above, below| if below.contains(' ') { format!("{above}/({below})") } else { format!("{above}/{below}") },
};

const LATEX: Writer = Writer {
    times: " \\cdot ",
    brackets: ["\\Bigl(", "\\Bigr)"],
    line: |depth| format!(" \\\\\n  &{} ", "\\quad".repeat(depth.min(8))),
    number: |x| match short(x).split_once('e') {
        Some((digits, power)) => format!("{digits} \\cdot 10^{{{power}}}"),
        None => short(x),
    },
    index: |symbol, k| format!("{symbol}_{{{k}}}"),
    tau: "\\tau",
    cos: "\\cos\\theta",
    dots: "\\dots",
    fraction: |above, below| format!("\\frac{{{above}}}{{{below}}}"),
};

/// The formula, then its numbers, then its value, each on separate lines.
pub fn text(replay: &Replay) -> String {
    let [symbols, numbers, sum] = parts(&TEXT, replay);
    format!("L = {symbols}\n  = {numbers}\n  = {sum}")
}

/// The formula for a LaTeX document that uses the package amsmath.
pub fn latex(replay: &Replay) -> String {
    let [symbols, numbers, sum] = parts(&LATEX, replay);
    format!("\\begin{{align*}}\n  L &= {symbols} \\\\\n  &= {numbers} \\\\\n  &= {sum}\n\\end{{align*}}")
}

fn parts(writer: &Writer, replay: &Replay) -> [String; 3] {
    let levels = levels(replay);
    [symbols(writer, &levels), numbers(writer, &levels), writer.colour(value(&levels))]
}

impl Writer {
    /// Formats a colour; as one number if all channels are equal.
    fn colour(&self, rgb: Colour) -> String {
        let [r, g, b] = rgb.map(self.number);
        if r == g && g == b { r } else { format!("({r}, {g}, {b})") }
    }

    fn factor(&self, factor: &Factor) -> String {
        let survival = (factor.survival < 1.0).then(|| (self.number)(factor.survival));
        match (factor.f_cos_pdf, survival) {
            (Some((f, cos, pdf)), survival) => {
                let (cos, pdf) = ((self.number)(cos), (self.number)(pdf));
                let below = survival.map_or_else(|| pdf.clone(), |survival| format!("{pdf}{}{survival}", self.times));
                format!("{}{}{}", self.colour(f), self.times, (self.fraction)(&cos, &below))
            }
            (None, Some(survival)) => (self.fraction)(&self.colour(factor.weight), &survival),
            (None, None) => self.colour(factor.weight),
        }
    }
}

/// The sum with its numbers.
fn numbers(writer: &Writer, levels: &[Level]) -> String {
    let mut text = String::new();
    let mut open = 0;
    for (depth, level) in levels.iter().enumerate() {
        if level.transmittance != [1.0; 3] {
            text += &format!("{}{}{}", writer.colour(level.transmittance), writer.times, writer.brackets[0]);
            open += 1;
        }
        let (weight, radiance) = level.emission;
        if weight != 1.0 && radiance != [0.0; 3] {
            text += &format!("{}{}", (writer.number)(weight), writer.times);
        }
        text += &writer.colour(radiance);
        if level.light != [0.0; 3] {
            text += &format!(" + {}", writer.colour(level.light));
        }
        if let Some(factor) = &level.factor {
            text += &format!(" + {} {}{}", writer.factor(factor), writer.brackets[0], (writer.line)(depth + 1));
            open += 1;
        }
    }
    text + &writer.brackets[1].repeat(open)
}

/// The sum without numbers, for the first vertices and the terms of this path.
fn symbols(writer: &Writer, levels: &[Level]) -> String {
    let lights = levels.iter().any(|level| level.light != [0.0; 3] || level.emission.0 != 1.0);
    let roulette = levels.iter().filter_map(|level| level.factor.as_ref()).any(|factor| factor.survival < 1.0);
    let media = levels.iter().any(|level| level.transmittance != [1.0; 3]);
    let (mut text, mut open) = (String::new(), 0);
    for (k, level) in levels.iter().enumerate().take(SHOWN) {
        let of = |symbol: &str| (writer.index)(symbol, k);
        if media {
            text += &format!("{} {}", of(writer.tau), writer.brackets[0]);
            open += 1;
        }
        let emitted = format!("L_e({})", of("x"));
        text += &if lights { format!("{} {emitted} + {}", of("w"), of("D")) } else { emitted };
        if level.factor.is_some() {
            let below = if roulette { format!("{} {}", of("p"), of("q")) } else { of("p") };
            let above = format!("{} {}", of("f"), of(writer.cos));
            text += &format!(" + {} {}", (writer.fraction)(&above, &below), writer.brackets[0]);
            open += 1;
        }
    }
    let dots = if levels.len() > SHOWN { writer.dots } else { "" };
    text + dots + &writer.brackets[1].repeat(open)
}

/// Five significant digits.
pub fn short(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e5).contains(&size) => {
            let digits = (4.0 - size.log10().floor()).max(0.0) as usize;
            let text = format!("{x:.digits$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
        }
        _ => format!("{x:.4e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::{Camera, Estimator, RenderSettings, Reuse, Roulette, Scene, built_in, parse};

    fn replay(scene: &Scene, settings: &RenderSettings, pixel: [u32; 2], sample: u32) -> Replay {
        let rays = scene.rays(&Camera { resolution: [32, 32], ..scene.camera });
        noisefall_kernel::integrator::replay(scene, &rays, settings, pixel, sample)
    }

    fn furnace() -> Scene {
        parse("furnace.toml", include_str!("../../../../scenes/furnace.toml").to_owned()).expect("a scene")
    }

    #[test]
    fn the_nested_sum_is_the_sample() {
        let (mut lit, mut refracted) = (0, 0);
        let glass = include_str!("../../../../scenes/glass_and_mirror.toml");
        let glass = parse("scenes/glass_and_mirror.toml", glass.to_owned()).expect("a scene");
        for scene in [&built_in(), &glass, &furnace()] {
            for estimator in Estimator::ALL {
                let settings = RenderSettings { estimator, reuse: Reuse::Off, ..scene.settings };
                for sample in 0..40 {
                    let replay = replay(scene, &settings, [7 + sample % 20, 9 + sample / 2], sample);
                    let nested = value(&levels(&replay));
                    for (nested, sum) in nested.iter().zip(replay.alone.unwrap_or(replay.radiance)) {
                        let scale = f64::from(sum).max(1e-3);
                        assert!((nested - f64::from(sum)).abs() < 1e-4 * scale, "{nested} {sum}:\n{}", text(&replay));
                    }
                    lit += u32::from(replay.radiance != [0.0; 3]);
                    refracted += u32::from(replay.vertices.iter().any(|v| v.reflection.as_ref().is_some_and(|r| r.refracted)));
                }
            }
        }
        assert!(lit > 100 && refracted > 5, "{lit} {refracted}");
    }

    /// In the furnace by the cosine every factor is ρ = 0.5, and every vertex emits 1.
    #[test]
    fn a_path_of_the_furnace_is_written_as_on_paper() {
        let scene = furnace();
        let settings = RenderSettings {
            estimator: Estimator::Path,
            directions: noisefall_scene::sampling::Directions::Cosine,
            roulette: Roulette::Off,
            max_bounces: Some(2),
            reuse: Reuse::Off,
            ..scene.settings
        };
        let replay = replay(&scene, &settings, [3, 4], 0);
        let lines: Vec<String> = text(&replay).lines().map(str::to_owned).collect();
        assert_eq!(lines[0], "L = L_e(x₀) + f₀ cos θ₀/p₀ (L_e(x₁) + f₁ cos θ₁/p₁ (…))");
        assert!(lines[1].starts_with("  = 1 + 0.15915 · ") && lines[1].ends_with(" ("), "{lines:?}");
        assert!(lines[2].starts_with("      1 + 0.15915 · ") && lines[3] == "        1))" && lines[4] == "  = 1.75", "{lines:?}");
        let latex = latex(&replay);
        assert!(
            latex.starts_with("\\begin{align*}\n  L &= L_e(x_{0}) + \\frac{f_{0} \\cos\\theta_{0}}{p_{0}} \\Bigl("),
            "{latex}"
        );
        assert!(latex.ends_with("&= 1.75\n\\end{align*}"), "{latex}");
        assert_eq!(latex.matches("\\Bigl(").count(), latex.matches("\\Bigr)").count(), "{latex}");
        assert_eq!(latex.matches('{').count(), latex.matches('}').count(), "{latex}");
    }

    /// By hand: 0.25 · 3 + 2 + 0.35/0.8 · 0.9 · 0.6/0.5 · 4.
    #[test]
    fn roulette_light_samples_media_and_delta_lobes_have_their_places() {
        let level = |transmittance, (weight, radiance), light, factor| Level {
            transmittance: [transmittance; 3],
            emission: (weight, [radiance; 3]),
            light: [light; 3],
            factor,
        };
        let factor = |f_cos_pdf, weight, survival| Some(Factor { f_cos_pdf, weight: [weight; 3], survival });
        let levels = [
            level(1.0, (0.25, 3.0), 2.0, factor(Some(([0.2; 3], 0.7, 0.4)), 0.35, 0.8)),
            level(0.9, (1.0, 0.0), 0.0, factor(None, 0.6, 0.5)),
            level(1.0, (1.0, 4.0), 0.0, None),
        ];
        assert_eq!(
            symbols(&TEXT, &levels),
            "τ₀ (w₀ L_e(x₀) + D₀ + f₀ cos θ₀/(p₀ q₀) (τ₁ (w₁ L_e(x₁) + D₁ + f₁ cos θ₁/(p₁ q₁) (…))))"
        );
        let sum = "0.25 · 3 + 2 + 0.2 · 0.7/(0.4 · 0.8) (\n      0.9 · (0 + 0.6/0.5 (\n        4)))";
        assert_eq!((numbers(&TEXT, &levels).as_str(), TEXT.colour(value(&levels)).as_str()), (sum, "4.64"));
    }

    #[test]
    fn numbers_have_five_digits_that_count() {
        let numbers = [0.0, 1.0, 0.5, 1.0 / 3.0, 123.456, 0.0012345678, 1e-7, 98765.4, -2.5].map(short);
        assert_eq!(numbers, ["0", "1", "0.5", "0.33333", "123.46", "0.0012346", "1.0000e-7", "98765", "-2.5"]);
    }
}
