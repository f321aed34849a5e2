//! The report for other programs: all statements as CSV and JSON, every figure as SVG.
use serde_json::{Value, json};

use super::{Effort, Noticed, Section, Suite};

impl Effort {
    /// The name of the suite in files.
    pub fn name(self) -> &'static str {
        match self {
            Effort::Quick => "quick",
            Effort::Full => "full",
        }
    }
}

/// The statements as CSV, one per line.
pub fn csv(sections: &[Section]) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "section",
        "title",
        "statement",
        "measured",
        "standard_error",
        "exact",
        "statistic",
        "z",
        "holds",
        "notices",
        "notices_as",
        "chance_to_fail",
        "shares_samples",
    ])?;
    for (number, section) in (1..).zip(sections) {
        for statement in &section.statements {
            let optional = |x: Option<f64>| x.map_or(String::new(), |x| x.to_string());
            let (notices, notices_as) = match statement.notices {
                Noticed::Relative(part) => (part, "part of exact"),
                Noticed::Absolute(bias) => (bias, "absolute"),
                Noticed::Each(part) => (part, "part of each"),
            };
            writer.write_record([
                i32::to_string(&number),
                section.title.to_owned(),
                statement.what.clone(),
                statement.measured.to_string(),
                statement.error.to_string(),
                optional(statement.exact),
                statement.statistic.clone(),
                optional(statement.z),
                statement.holds.to_string(),
                notices.to_string(),
                notices_as.to_owned(),
                statement.chance.to_string(),
                statement.shares_samples.to_string(),
            ])?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8(bytes).expect("text was written"))
}

/// The sections and their statements as JSON.
pub fn json(sections: &[Section], suite: Suite, effort: Effort, seed: u32) -> Value {
    let section = |(number, section): (i32, &Section)| {
        json!({
            "number": number,
            "title": section.title,
            "claim": section.claim,
            "remark": section.remark,
            "holds": section.holds(),
            "statements": section.statements,
        })
    };
    json!({
        "program": concat!("noisefall ", env!("CARGO_PKG_VERSION")),
        "suite": if suite == Suite::Exact { "exact" } else { "stress" },
        "effort": effort.name(),
        "seed": seed,
        "holds": sections.iter().all(Section::holds),
        "sections": (1..).zip(sections).map(section).collect::<Vec<_>>(),
    })
}

/// File names and contents of the figures as SVG. A name has the number of the section and of the figure in it.
pub fn drawings(sections: &[Section]) -> Vec<(String, String)> {
    let of = |(number, section): (usize, &Section)| {
        let drawn = section.figures.iter().filter_map(super::Figure::svg).collect::<Vec<_>>();
        (1..).zip(drawn).map(move |(i, svg): (usize, String)| (format!("section-{number:02}-{i}.svg"), svg)).collect::<Vec<_>>()
    };
    (1..).zip(sections).flat_map(of).collect()
}
