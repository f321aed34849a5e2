//! The chapter as an HTML page.
use maud::{Markup, html as markup};

use super::exhibits::Exhibits;
use crate::report::{self, Figure, picture::img, plot::Plot, table::Table};

const STYLE: &str = "
:root { --width: 60rem; }
td { white-space: nowrap; }
figure table { width: auto; }
";

/// The self-contained page.
pub fn html(exhibits: &Exhibits, tables: &[Table], plots: &[(String, String, Plot)]) -> String {
    let (study_scene, machine) = (exhibits.study_scene, exhibits.machine);
    let title = study_scene.title();
    let picture = |number: usize| {
        let picture = &exhibits.pictures[number];
        Figure { caption: picture.caption.clone(), element: img(&picture.png) }.markup()
    };
    let of = |prefix: &str| -> Markup {
        markup! {
            @for (_, caption, plot) in plots.iter().filter(|(name, ..)| name.starts_with(prefix)) {
                (Figure { caption: caption.clone(), element: plot.svg() }.markup())
            }
        }
    };
    let tables_of = |prefix: &str| -> Markup {
        markup! { @for table in tables.iter().filter(|table| table.name.starts_with(prefix)) { (table.markup()) } }
    };
    let content = markup! {
        h1 { "Evidence: " (title) }
        p.source { (study_scene.path.display()) ", " (exhibits.extent()) ". noisefall " (machine.version) ", commit " (machine.commit) ", "
            (machine.date) " UTC, " (machine.threads) " threads, " (machine.simd) ", " (machine.cpu) "." }
        p { "The same folder has every plot and every sheet of images as SVG and PNG, every table as CSV and as a LaTeX tabular, \
             and all measurements in study.csv." }
        h2 { "Error against the number of samples" }
        (picture(0)) (tables_of("convergence")) (of("error_by_sampler")) (of("variance"))
        h2 { "Bounces and the bias of caps" }
        (picture(1)) (tables_of("bias_of_caps"))
        h2 { "Roulette" }
        (tables_of("bias_of_roulette")) (of("error_by_roulette")) (tables_of("equal_time_roulette"))
        h2 { "Directions at equal time" }
        (tables_of("equal_time_directions")) (of("error_by_directions"))
        h2 { "Estimators at equal time" }
        (tables_of("equal_time_estimator")) (of("error_by_estimator"))
        h2 { "Samplers at equal time" }
        (tables_of("equal_time_sampler"))
        h2 { "Path reuse between neighbouring pixels at equal time" }
        p { "All other comparisons on this page are made without path reuse and without adaptive sampling." }
        (tables_of("equal_time_path_reuse"))
    };
    report::page(&format!("Evidence: {title}"), STYLE, &content)
}
