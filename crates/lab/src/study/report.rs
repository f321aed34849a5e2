//! The report of a study as one HTML file.
use maud::{Markup, PreEscaped, html as markup};

use super::{
    Eligibility, Findings, Machine, Outcome, Plan,
    figures::{Pair, by_setting, overview},
    ranking::SettingGain,
    wording::{certainty, command, error, mean_error, percent, significant, slope, verdict},
};
use crate::report;
use noisefall_scene::scene::{RenderSettings, Reuse, Setting};

const STYLE: &str = "
:root { --width: 72rem; }
p, pre, li { max-width: 60rem; }
h3 { font-size: 1.05rem; margin: 2rem 0 .2rem; }
pre { background: #f4f4f4; padding: .5rem .8rem; overflow-x: auto; font-size: .86rem; }
.formula { white-space: nowrap; } .verdict { font-size: 1.1rem; font-weight: 600; }
.pair { margin: .4rem 0 1.4rem; } .pair div { display: grid; grid-template-columns: 1fr 1fr; gap: 1rem; }
table.short { width: auto; min-width: 36rem; }
tr.weak td { color: #666; } tr.first td { font-weight: 600; }
td { white-space: nowrap; } table.contents td { white-space: normal; }
summary { cursor: pointer; font-size: .86rem; }
@media print { details::details-content { content-visibility: visible; } }
";
/// Rows of a table that are shown without a click.
const ROWS: usize = 20;

/// The report of a study.
pub fn html(findings: &[Findings], plan: &Plan, machine: &Machine) -> String {
    let content = markup! {
        h1 { "Run time against error" }
        p.source { "noisefall " (machine.version) ", commit " (machine.commit) ", " (machine.date) " UTC" }
        (introduction(plan))
        (circumstances(plan, machine))
        @if findings.len() > 1 { (contents(findings)) }
        @for (i, scene) in findings.iter().enumerate() { (section(i + 1, scene)) }
    };
    report::page("Noisefall: run time against error", STYLE, &content)
}

fn introduction(plan: &Plan) -> Markup {
    let repeats = plan.repeats;
    markup! {
        p { "Every combination of settings rendered each scene " @if repeats == 1 { "once" } @else { (repeats) " times with different seeds" }
            ", and was compared with a reference at every doubling of its samples. The " b { "error" } " is the root of relMSE, the \
             mean over pixels and channels of " span.formula { (plan.floor.formula()) } " for the image x and the reference r. " b { "Time" } " is that of \
             rendering alone. " b { "Efficiency" } " is " span.formula { "1/(relMSE · s)" } " at the end of a run: twice the efficiency means the same error in half the time if both errors fall at the same rate." }
        p { "The " b { "slope" } " is the power of the number of samples N with which the error falls: −1/2 for independent samples, steeper for stratified and Sobol samples. It is a least-squares fit from 4 samples on, with a 95 % confidence interval that accounts for the samples that successive points share." }
    }
}

fn circumstances(plan: &Plan, machine: &Machine) -> Markup {
    let count = |n: usize, what: &str| if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") };
    markup! {
        table.short {
            tr { th { "processor" } td { (machine.cpu) } }
            tr { th { "used" } td { (count(machine.threads, "thread")) " on " (count(machine.cores, "core")) ", SIMD: " (machine.simd) } }
            tr { th { "system" } td { (machine.os) } }
            tr { th { "each run" } td { "up to " (plan.spp) " samples per pixel; a doubling is skipped if it would end after "
                (significant(plan.time.as_secs_f64())) " s" } }
        }
    }
}

fn contents(findings: &[Findings]) -> Markup {
    markup! {
        h2 { "The best settings" }
        table.contents {
            thead { tr { th { "scene" } th { "best" } } }
            tbody { @for (i, scene) in findings.iter().enumerate() {
                tr { td { a href={ "#scene-" (i + 1) } { (scene.title) } } td { (verdict(scene)) } }
            } }
        }
    }
}

fn section(number: usize, findings: &Findings) -> Markup {
    let [width, height] = findings.resolution;
    let invalid: u64 = findings.outcomes.iter().map(|outcome| outcome.invalid_samples).sum();
    markup! {
        section id={ "scene-" (number) } {
            h2 { (findings.title) }
            p.source { (findings.path.display()) ", " (width) " × " (height) " pixels, against " (findings.reference)
                @if findings.limits.floor > 0.0 { ", which itself has an estimated error of " (percent(findings.limits.floor)) }
                @if findings.reference_is_taken_for_exact { ", whose own error is unknown and assumed to be 0" } "." }
            p.verdict { (verdict(findings)) }
            p { (certainty(findings)) }
            @if let Some(command) = command(findings) { pre { (command) } }
            @if invalid > 0 { p.fails { (invalid) " samples were negative or not finite and count as black." } }
            @if let Some(pair) = overview(findings) { (figure(&pair)) }
            (gains(findings))
            @for pair in RenderSettings::axes().filter_map(|setting| by_setting(findings, setting)) { (figure(&pair)) }
            (ranking(findings))
        }
    }
}

fn figure(pair: &Pair) -> Markup {
    markup! {
        h3 { (pair.title) }
        figure.pair {
            div { @for plot in &pair.plots { (PreEscaped(plot.svg())) } }
            figcaption { (pair.caption) }
        }
    }
}

fn gains(findings: &Findings) -> Markup {
    let settings: Vec<(Setting, Vec<SettingGain>)> =
        RenderSettings::axes().map(|setting| (setting, findings.gains(setting))).collect();
    let row = |setting: &str, gain: &SettingGain| {
        markup! {
            tr {
                th { (setting) } td { (gain.value) }
                @for part in [gain.alone, gain.at_best] { td.n { (part.map_or_else(|| "–".to_owned(), significant)) } }
            }
        }
    };
    markup! {
        @if settings.iter().any(|(_, values)| !values.is_empty()) {
            h3 { "Gain from each setting" }
            table.short {
                thead { tr { th { "setting" } th { "value" } th.n { "others as in the best" } th.n { "others at their best" } } }
                tbody { @for (setting, values) in &settings { @for (i, gain) in values.iter().enumerate() {
                    (row(&if i == 0 { setting.name() } else { String::new() }, gain))
                } } }
            }
            p.source { "Efficiency relative to the best: with this value and all other settings as in the best combination, and with this value and the other settings that are best with it. A dash marks combinations that are not ranked, or that have noise although the best has none." }
        }
    }
}

fn ranking(findings: &Findings) -> Markup {
    let outcomes = &findings.outcomes;
    let is_told = |setting: &Setting| outcomes.iter().flat_map(Outcome::alike).any(|settings| setting.is_told(settings));
    let shown: Vec<Setting> =
        RenderSettings::axes().filter(|setting| *setting == RenderSettings::REUSE || is_told(setting)).collect();
    let twins: usize = outcomes.iter().map(|outcome| outcome.twins.len()).sum();
    let table = |rows: &[Outcome], first: usize| {
        markup! {
            table {
                thead { (heading(&shown)) }
                tbody { @for (i, outcome) in rows.iter().enumerate() { (row(first + i, outcome, &shown, findings)) } }
            }
        }
    };
    markup! {
        h3 { "All combinations" }
        (table(&outcomes[..outcomes.len().min(ROWS)], 1))
        @if outcomes.len() > ROWS {
            details { summary { "the other " (outcomes.len() - ROWS) } (table(&outcomes[ROWS..], ROWS + 1)) }
        }
        p.source {
            "± is the standard error of the efficiency, from the repeats. The bias is the mean of the image minus the reference at the end of the runs, with its standard error from the sample variance, which is an upper bound for stratified and Sobol samples. Combinations that are biased, or too noisy (a relMSE above half of that of a black image), are not ranked and come last."
            @if twins > 0 { " Values joined by = gave the same image, bit for bit, in a trial and were measured once, which saved "
                (twins) " of " (outcomes.len() + twins) " combinations." }
        }
    }
}

fn heading(shown: &[Setting]) -> Markup {
    markup! {
        tr {
            th.n { "" }
            @for setting in shown { th { (setting.name()) } }
            th.n { "samples" } th.n { "s" } th.n { "error" } th.n { "slope" } th.n { "efficiency" } th.n { "±" } th.n { "of the best" } th.n { "bias" } th {}
        }
    }
}

fn row(place: usize, outcome: &Outcome, shown: &[Setting], findings: &Findings) -> Markup {
    let moments = outcome.log_efficiency();
    let spread = 100.0 * (moments.variance / moments.count).sqrt();
    let class = match (place, outcome.eligibility) {
        (1, Eligibility::Sound) => "first",
        (_, Eligibility::Sound) => "",
        _ => "weak",
    };
    markup! {
        tr class=(class) {
            td.n { (place) }
            @for setting in shown { td { (values(*setting, outcome)) } }
            td.n { (outcome.last().spp) }
            td.n { (significant(outcome.last().seconds)) }
            td.n { (error(outcome)) }
            td.n { (slope(outcome.slope)) }
            td.n { (significant(outcome.efficiency())) }
            td.n { @if spread.is_finite() { (format!("{spread:.0} %")) } @else { "–" } }
            td.n { (findings.ratio(outcome).map_or_else(|| "–".to_owned(), significant)) }
            td.n { (mean_error(outcome.mean_error)) }
            td { (remark(outcome)) }
        }
    }
}

/// The value of a setting, and the values that give the same image.
pub fn values(setting: Setting, outcome: &Outcome) -> String {
    let only_this_differs = |twin: &&_| setting.with(twin, &outcome.settings) == outcome.settings;
    let same = outcome.twins.iter().filter(only_this_differs).map(|twin| setting.value(twin));
    let values = std::iter::once(setting.value(&outcome.settings)).chain(same).collect::<Vec<_>>().join(" = ");
    if setting == RenderSettings::REUSE && outcome.settings.reuse == Reuse::Auto {
        format!("{values}: {}", outcome.path_reuse.reuse().name())
    } else if setting == RenderSettings::ADAPTIVE && outcome.settings.adaptive && !outcome.adapts {
        format!("{values}: without effect")
    } else {
        values
    }
}

/// Why a combination is not ranked; empty if it is.
pub fn remark(outcome: &Outcome) -> String {
    match outcome.eligibility {
        Eligibility::Sound => String::new(),
        Eligibility::TooNoisy => "too noisy".to_owned(),
        Eligibility::Biased => format!("biased: {}", outcome.bias),
    }
}
