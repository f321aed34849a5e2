//! The report as one self-contained HTML file, which also prints well.
use maud::{Markup, html as markup};

use super::{Effort, Section, Statement, Suite, theory};
use crate::report::{self, formula};

/// Style rules of this report.
const STYLE: &str = "
:root { --width: 58rem; }
h3 { font-size: 1.02rem; margin: 1.4rem 0 .2rem; }
td.s { white-space: nowrap; }
.claim { font-size: 1.06rem; font-weight: 600; }
.derivation { border-left: 3px solid #bbb; padding-left: 1rem; }
figure:has(img) { display: inline-block; margin: .6rem .8rem .6rem 0; }
";

/// The report of all sections.
pub fn html(sections: &[Section], suite: Suite, effort: Effort, seed: u32) -> String {
    let statements: usize = sections.iter().map(|section| section.statements.len()).sum();
    let run = sections.iter().filter(|section| section.was_run()).count();
    let failed: usize = sections.iter().flat_map(|section| &section.statements).filter(|statement| !statement.holds).count();
    let content = markup! {
        h1 { (suite.question()) }
        p { (formula(suite.answer())) " " (statements) " statements of " (run) " sections. "
            @if failed == 0 { span.holds { "All hold." } } @else { span.fails { (failed) " fail." } } }
        p.source { "noisefall " (env!("CARGO_PKG_VERSION")) ", " "a " (effort.name()) " run, seed " (seed) ". " (suite.conditions()) }
        (contents(sections))
        @if suite == Suite::Exact { (theory::chapter()) }
        @for (i, section) in sections.iter().enumerate() { (body(i + 1, section)) }
    };
    report::page("Noisefall: validation", STYLE, &content)
}

impl Suite {
    fn question(self) -> &'static str {
        match self {
            Suite::Exact => "Does Noisefall solve the light transport equation?",
            Suite::Stress => "What does it take to break Noisefall?",
        }
    }

    fn answer(self) -> &'static str {
        match self {
            Suite::Exact => {
                "L(x, ω_o) = L_e(x, ω_o) + ∫ f(x, ω_o, ω_i) L(x_M(x, ω_i), −ω_i) |cos θ_i| dω_i, where x_M is the first surface point \
                 seen from x along ω_i: solved by Monte Carlo integration and compared with exact solutions in"
            }
            Suite::Stress => {
                "Random and adversarial scenes, each read, compiled and rendered like a user's file. No sample may be negative or not finite, known energy must be conserved, x_M must agree with double precision, no scene may hang, and a scene that cannot be rendered must be refused with a clear message:"
            }
        }
    }

    fn conditions(self) -> &'static str {
        match self {
            Suite::Exact => {
                "A statistical statement fails when it deviates by more than 4 standard errors, unless its row says otherwise. The column “notices” gives the smallest bias that would make it fail with 95 % probability: (4 + 1.645) standard errors, or the tolerance, in per cent of the exact number, of a share or of a probability, otherwise in the unit of the measured number. * marks statements that reuse the samples of an earlier statement. All samples are seeded and identical on every machine; only the times of direct light differ. The same folder has all rows as report.csv and report.json, and the figures as SVG."
            }
            Suite::Stress => {
                "A family and a number name a scene, which is the same on every machine; only times differ. Scenes that fail are written to the folder “stress” next to this report."
            }
        }
    }
}

fn contents(sections: &[Section]) -> Markup {
    markup! {
        table {
            @for (i, section) in sections.iter().enumerate() {
                tr {
                    td { (i + 1) }
                    td { a href={ "#section-" (i + 1) } { (formula(section.title)) } }
                    td.n { (section.statements.len()) }
                    td { (outcome(section)) }
                }
            }
        }
    }
}

fn body(number: usize, section: &Section) -> Markup {
    markup! {
        section id={ "section-" (number) } {
            h2 { (number) ". " (formula(section.title)) " " (outcome(section)) }
            p.claim { (formula(section.claim)) }
            div.derivation { @for paragraph in section.derivation { p { (formula(paragraph)) } } }
            p.source { (formula(section.source)) }
            @if let Some(remark) = &section.remark { p { (formula(remark)) } }
            @for figure in &section.figures {
                (figure.markup())
            }
            @if !section.statements.is_empty() {
                table {
                    thead { tr { th { "statement" } th.n { "measured" } th.n { "± standard error" } th.n { "exact" } th { "statistic" } th.n { "notices" } th { "verdict" } } }
                    tbody { @for statement in &section.statements { (row(statement)) } }
                }
            }
        }
    }
}

fn row(statement: &Statement) -> Markup {
    let error = if statement.error > 0.0 { typeset(&format!("{:.1e}", statement.error)) } else { "–".to_owned() };
    markup! {
        tr {
            td { (formula(&typeset(&statement.what))) @if statement.shares_samples { " *" } }
            td.n { (number(statement.measured)) }
            td.n { (error) }
            td.n { @if let Some(exact) = statement.exact { (number(exact)) } }
            td.s { (typeset(&statement.statistic)) }
            td.n { (typeset(&statement.notices.to_string())) }
            td { (verdict(statement.holds)) }
        }
    }
}

fn outcome(section: &Section) -> Markup {
    markup! { @if section.was_run() { (verdict(section.holds())) } @else { "not run" } }
}

fn verdict(holds: bool) -> Markup {
    markup! { @if holds { span.holds { "✓ holds" } } @else { span.fails { "✗ fails" } } }
}

/// Six digits.
fn number(x: f64) -> String {
    let size = x.abs();
    typeset(&if size == 0.0 || (1e-3..1e5).contains(&size) { format!("{x:.6}") } else { format!("{x:.5e}") })
}

/// Numbers as on paper: 1.2e-4 as 1.2 · 10⁻⁴, and a minus sign for a hyphen before a digit.
fn typeset(text: &str) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let mut written = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, number) = rest.split_at(at);
        let is_word = before.ends_with(char::is_alphanumeric);
        let follows_word = |before: &str| if before.is_empty() { &written } else { before }.ends_with(char::is_alphanumeric);
        match before.strip_suffix('-').filter(|before| !follows_word(before)) {
            Some(before) => written.extend([before, "−"]),
            None => written.push_str(before),
        }
        let end = number.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(number.len());
        let (mantissa, behind) = number.split_at(end);
        let power = behind.strip_prefix('e').and_then(|behind| {
            let sign = usize::from(behind.starts_with('-'));
            let digits = behind[sign..].find(|c: char| !c.is_ascii_digit()).unwrap_or(behind.len() - sign);
            (digits > 0 && !is_word).then(|| behind.split_at(sign + digits))
        });
        let Some((power, behind)) = power else {
            written.push_str(mantissa);
            rest = behind;
            continue;
        };
        rest = behind;
        let is_zero = mantissa.chars().all(|c| matches!(c, '0' | '.'));
        match (is_zero, mantissa, power) {
            (true, ..) => written.push('0'),
            (_, _, "0") => written.push_str(mantissa),
            (_, "1", _) => written.push_str("10"),
            _ => written.extend([mantissa, " · 10"]),
        }
        if !is_zero && power != "0" {
            written.extend(power.chars().map(|c| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])));
        }
    }
    written + rest
}

#[cfg(test)]
mod tests {
    use super::typeset;

    #[test]
    fn numbers_are_written_as_on_paper() {
        for (text, paper) in [
            ("1.2e-4", "1.2 · 10⁻⁴"),
            ("sphere of 1e-6 m", "sphere of 10⁻⁶ m"),
            ("sphere of 1e0 m, 1e3 m", "sphere of 1 m, 10³ m"),
            ("|Δ| = 0.0e0 ≤ 0e0", "|Δ| = 0 ≤ 0"),
            ("z = -1.16", "z = −1.16"),
            ("|-0.7| < 2.0e1", "|−0.7| < 2.0 · 10¹"),
            ("-4.50000e-12 %", "−4.50000 · 10⁻¹² %"),
            ("t = +1.91 of 9, |t| < 7.0", "t = +1.91 of 9, |t| < 7.0"),
            ("8 × 8, Avx2, 3 even, f16e2-3", "8 × 8, Avx2, 3 even, f16e2-3"),
        ] {
            assert_eq!(typeset(text), paper);
        }
    }
}
