//! Sections of the report from the outcomes of scenes.
use super::{
    Trial,
    families::{Family, FamilyGroup},
    figures::figures,
    surfaces::LIMIT,
    trial::ENERGY,
};
use crate::validate::{SIGMAS, Section, Statement, check::largest};

/// Limit of |z| for some hundred means, one of which may exceed 4 standard errors by chance.
const SIGMAS_OF_MANY: f64 = SIGMAS + 0.5;

/// Why a scene breaks an invariant.
pub fn breaks(trial: &Trial) -> Option<String> {
    let outcome = &trial.outcome;
    let surfaces = &outcome.surfaces;
    let energy = outcome.energy.filter(|error| error.is_nan() || *error > ENERGY);
    let first = outcome.first_off.as_deref().unwrap_or_default();
    let energy = energy.map(|error| format!("energy off by up to {error:.1e} in {} samples, first {first}", outcome.off));
    let loss = trial.loss().filter(|(lost, most)| lost.is_nan() || lost > most);
    let loss = loss.map(|(lost, most)| format!("{lost:.1e} of the light is lost; the limit is {most:.1e}"));
    let z = outcome.z.filter(|z| z.is_nan() || z.abs() > SIGMAS_OF_MANY).map(|z| format!("mean off by {z:+.1} standard errors"));
    let invalid = (outcome.invalid > 0).then(|| format!("{} invalid samples", outcome.invalid));
    outcome.trouble.clone().or(invalid).or(energy).or(loss).or(z).or_else(|| surfaces.first.clone())
}

pub fn section(group: &FamilyGroup, trials: &[Trial]) -> Section {
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

/// The names of some bad scenes, and the problem of the first one.
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
        what += &format!("{refused} of them rejected with a message, ");
    }
    what += &format!("{} samples: scenes with invalid samples, a panic or a time-out{}", count(samples), named(trials, is_bad));
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
    Some(Statement::below(format!("— largest loss of light, relative to its limit ({name})"), part, 1.0))
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
                "— {} rays: missed surfaces, self-hits, escapes from a closed room{}",
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

/// Formats large numbers, as in "1.5 million".
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
        surfaces::Comparison,
        trial::TrialOutcome,
        trial_scene::{Expected, TrialScene},
    };

    #[test]
    fn the_worst_of_all_scenes_counts_and_is_named() {
        let trial = |name: &str, worst: f64| Trial {
            family: &random::FAMILIES[0],
            name: name.to_owned(),
            text: String::new(),
            trial_scene: TrialScene::of(String::new(), Expected::Valid),
            outcome: TrialOutcome {
                surfaces: Comparison { rays: 3, worst, ..Comparison::default() },
                z: Some(-worst),
                ..TrialOutcome::default()
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

    fn trial(expected: Expected, outcome: TrialOutcome) -> Trial {
        let (family, name) = (&random::FAMILIES[0], "it".to_owned());
        Trial { family, name, text: String::new(), trial_scene: TrialScene::of(String::new(), expected), outcome }
    }

    #[test]
    fn every_invariant_is_broken_beyond_its_limit_and_kept_below() {
        let said =
            |outcome: TrialOutcome| breaks(&trial(Expected::Within { radiance: 1.0, loss: 0.25 }, outcome)).unwrap_or_default();
        let energy = |energy| {
            said(TrialOutcome { energy: Some(energy), off: 7, first_off: Some("here".to_owned()), ..TrialOutcome::default() })
        };
        assert_eq!([energy(0.9e-4), energy(1.1e-4)], ["", "energy off by up to 1.1e-4 in 7 samples, first here"]);
        let lost = |lost| said(TrialOutcome { lost: Some(lost), ..TrialOutcome::default() });
        assert_eq!([lost(0.24), lost(0.26)], ["", "2.6e-1 of the light is lost; the limit is 2.5e-1"]);
        let z = |z| said(TrialOutcome { z: Some(z), ..TrialOutcome::default() });
        assert_eq!([z(4.4), z(-4.4), z(-4.6)], ["", "", "mean off by -4.6 standard errors"]);
        assert!([energy(f64::NAN), lost(f64::NAN), z(f64::NAN)].iter().all(|said| !said.is_empty()), "NaN fails");
        assert_eq!(said(TrialOutcome { invalid: 3, ..TrialOutcome::default() }), "3 invalid samples");
        assert_eq!(said(TrialOutcome { trouble: Some("panics".to_owned()), invalid: 3, ..TrialOutcome::default() }), "panics");
        let missed = Comparison { first: Some("a surface is missed".to_owned()), ..Comparison::default() };
        assert_eq!(said(TrialOutcome { surfaces: missed, ..TrialOutcome::default() }), "a surface is missed");
        // Only rooms with a limit have a statement about lost light.
        assert_eq!(breaks(&trial(Expected::Valid, TrialOutcome { lost: Some(1.0), ..TrialOutcome::default() })), None);
    }

    #[test]
    fn rows_fail_with_the_scenes_that_break_them() {
        let within = Expected::Within { radiance: 1.0, loss: 0.25 };
        let good = trial(within, TrialOutcome { energy: Some(1e-5), lost: Some(0.125), samples: 100, ..TrialOutcome::default() });
        let bad = trial(
            within,
            TrialOutcome { energy: Some(1.0), lost: Some(0.5), invalid: 1, samples: 23, ..TrialOutcome::default() },
        );
        let escaped = Comparison { rays: 5, escaped: 1, missed: 2, self_hits: 4, ..Comparison::default() };
        let out = trial(
            within,
            TrialOutcome { surfaces: escaped, refused: true, trouble: Some("no end".to_owned()), ..TrialOutcome::default() },
        );
        let row = |statement: Option<Statement>| statement.map(|row| (row.measured, row.holds)).expect("a row");
        assert_eq!([energy(&[&good]), losses(&[&good])].map(row), [(1e-5, true), (0.5, true)]);
        assert_eq!([energy(&[&good, &bad]), losses(&[&good, &bad])].map(row), [(1.0, false), (2.0, false)]);
        let of_samples = samples(good.family, &[&good, &bad, &out]);
        assert!((of_samples.measured, of_samples.holds) == (2.0, false), "{of_samples:?}");
        assert!(of_samples.what.contains("3 scenes, 1 of them rejected with a message, 123 samples"), "{}", of_samples.what);
        assert_eq!(row(Some(samples(good.family, &[&good]))), (0.0, true));
        assert_eq!(row(rays(&[&good, &out]).into_iter().next()), (7.0, false));
        assert!(rays(&[&good]).is_empty(), "no ray was tested");
    }
}
