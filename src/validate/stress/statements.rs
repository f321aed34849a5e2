//! Sections of the report from what came of the scenes.
use super::{
    Trial,
    families::{Family, Group},
    figures::figures,
    surfaces::LIMIT,
    trial::ENERGY,
};
use crate::validate::{SIGMAS, Section, Statement, check::largest};

/// Of some hundred means one or two may be beyond 4 standard errors by chance.
const SIGMAS_OF_MANY: f64 = SIGMAS + 0.5;

/// Why a scene breaks an invariant.
pub fn breaks(trial: &Trial) -> Option<String> {
    let outcome = &trial.outcome;
    let surfaces = &outcome.surfaces;
    let energy = outcome.energy.filter(|error| error.is_nan() || *error > ENERGY);
    let first = outcome.first_off.as_deref().unwrap_or_default();
    let energy = energy.map(|error| format!("energy off by up to {error:.1e} in {} samples, first {first}", outcome.off));
    let loss = trial.loss().filter(|(lost, most)| lost.is_nan() || lost > most);
    let loss = loss.map(|(lost, most)| format!("{lost:.1e} of the light is lost, {most:.1e} may be"));
    let z = outcome.z.filter(|z| z.is_nan() || z.abs() > SIGMAS_OF_MANY).map(|z| format!("mean off by {z:+.1} standard errors"));
    let invalid = (outcome.invalid > 0).then(|| format!("{} invalid samples", outcome.invalid));
    outcome.trouble.clone().or(invalid).or(energy).or(loss).or(z).or_else(|| surfaces.first.clone())
}

pub fn section(group: &Group, trials: &[Trial]) -> Section {
    let of = |family: &Family| trials.iter().filter(|trial| trial.family.name == family.name).collect::<Vec<_>>();
    let mut statements = Vec::new();
    for family in group.families {
        let trials = of(family);
        statements.push(samples(family, &trials));
        statements.extend(energy(&trials));
        statements.extend(losses(&trials));
        statements.extend(means(&trials));
        statements.extend(rays(&trials));
    }
    Section {
        title: group.title,
        claim: group.claim,
        derivation: group.derivation,
        source: group.source,
        statements,
        figures: figures(trials),
        remark: Some(remark(trials)),
    }
}

/// The names of some scenes, and what is wrong with the first.
fn named(trials: &[&Trial], is_bad: impl Fn(&Trial) -> bool) -> String {
    let bad: Vec<&&Trial> = trials.iter().filter(|trial| is_bad(trial)).collect();
    let Some(first) = bad.first() else { return String::new() };
    let names: Vec<&str> = bad.iter().take(8).map(|trial| trial.name.as_str()).collect();
    format!(" [{}: {}]", names.join(", "), breaks(first).unwrap_or_default())
}

fn samples(family: &Family, trials: &[&Trial]) -> Statement {
    let samples: u64 = trials.iter().map(|trial| trial.outcome.samples).sum();
    let refused = trials.iter().filter(|trial| trial.outcome.refused).count();
    let is_bad = |trial: &Trial| trial.outcome.invalid > 0 || trial.outcome.trouble.is_some();
    let bad = trials.iter().filter(|trial| is_bad(trial)).count();
    let mut what = format!("{}: {} scenes, ", family.what, trials.len());
    if refused > 0 {
        what += &format!("{refused} of them refused clearly, ");
    }
    what += &format!("{} samples: scenes with invalid samples, a panic or no end{}", count(samples), named(trials, is_bad));
    Statement::none(what, bad as u32)
}

fn energy(trials: &[&Trial]) -> Option<Statement> {
    let errors = trials.iter().filter_map(|trial| Some((trial.outcome.energy?, trial.name.as_str())));
    let (worst, name) = errors.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let bad = named(trials, |trial| trial.outcome.energy.is_some_and(|error| error.is_nan() || error > ENERGY));
    let bad = if bad.is_empty() { format!(" ({name})") } else { bad };
    Some(Statement::below(format!("— largest relative error of a sample{bad}"), worst, ENERGY))
}

fn losses(trials: &[&Trial]) -> Option<Statement> {
    let parts = trials.iter().filter_map(|trial| Some((trial.loss()?, trial.name.as_str())));
    let (part, name) = parts.map(|((lost, most), name)| (lost / most, name)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Statement::below(format!("— light lost, of what may be, at most ({name})"), part, 1.0))
}

fn means(trials: &[&Trial]) -> Option<Statement> {
    let z = trials.iter().filter_map(|trial| Some((trial.outcome.z?.abs(), trial.name.as_str())));
    let (worst, name) = z.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Statement::below(format!("— largest |z| of a mean ({name})"), worst, SIGMAS_OF_MANY))
}

fn rays(trials: &[&Trial]) -> Vec<Statement> {
    let sum = |of: fn(&Trial) -> u64| trials.iter().map(|trial| of(trial)).sum::<u64>();
    let rays = sum(|trial| trial.outcome.surfaces.rays);
    if rays == 0 {
        return Vec::new();
    }
    let wrong = |trial: &Trial| {
        let surfaces = &trial.outcome.surfaces;
        surfaces.missed + surfaces.self_hits + surfaces.escaped
    };
    let count_wrong: u64 = trials.iter().map(|trial| wrong(trial)).sum();
    let worst = trials.iter().max_by(|a, b| a.outcome.surfaces.worst.total_cmp(&b.outcome.surfaces.worst));
    let (worst, name) = worst.map_or((0.0, ""), |trial| (trial.outcome.surfaces.worst, trial.name.as_str()));
    vec![
        Statement::none(
            format!(
                "— {} rays: surfaces missed, self-hits, ways out of a closed room{}",
                count(rays),
                named(trials, |trial| wrong(trial) > 0)
            ),
            count_wrong as u32,
        ),
        Statement::below(format!("— largest distance of x_M from its surface, in εS ({name})"), worst, LIMIT),
    ]
}

fn remark(trials: &[Trial]) -> String {
    let slowest = trials.iter().max_by(|a, b| a.outcome.seconds.total_cmp(&b.outcome.seconds));
    let (name, seconds) = slowest.map_or(("", 0.0), |trial| (trial.name.as_str(), trial.outcome.seconds));
    let samples: u64 = trials.iter().map(|trial| trial.outcome.samples).sum();
    let invalid: u64 = trials.iter().map(|trial| trial.outcome.invalid).sum();
    let energy = trials.iter().filter_map(|trial| trial.outcome.energy).reduce(f64::max);
    let energy = energy.map_or(String::new(), |error| format!(" energy exact to {error:.0e};"));
    let off = largest(trials.iter().map(|trial| trial.outcome.surfaces.worst));
    format!(
        "{} scenes, {} samples, {invalid} invalid;{energy} x_M within {off:.1} εS; slowest {name}, {seconds:.1} s.",
        trials.len(),
        count(samples)
    )
}

/// Large numbers as one would say them.
pub(super) fn count(n: u64) -> String {
    match n {
        0..10_000 => n.to_string(),
        10_000..1_000_000 => format!("{} thousand", n / 1000),
        _ => format!("{:.1} million", n as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::{super::families::random, *};
    use crate::validate::stress::{
        draft::{Draft, Expected},
        surfaces::Comparison,
        trial::Outcome,
    };

    #[test]
    fn the_worst_of_all_scenes_counts_and_is_named() {
        let trial = |name: &str, worst: f64| Trial {
            family: &random::FAMILIES[0],
            name: name.to_owned(),
            text: String::new(),
            draft: Draft::of(String::new(), Expected::Valid),
            outcome: Outcome {
                surfaces: Comparison { rays: 3, worst, ..Comparison::default() },
                z: Some(-worst),
                ..Outcome::default()
            },
        };
        let all = [trial("good", 1.0), trial("bad", 1e9), trial("fair", 5.0)];
        let all: Vec<&Trial> = all.iter().collect();
        let of_rays = rays(&all);
        let of_means = means(&all).expect("they have means");
        for worst in [&of_rays[1], &of_means] {
            assert!(worst.measured == 1e9 && worst.what.contains("(bad)") && !worst.holds, "{worst:?}");
        }
        assert!(of_rays[0].what.contains("9 rays") && of_rays[0].holds);
    }
}
