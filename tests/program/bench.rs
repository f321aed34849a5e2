//! `noisefall bench`: where the time of a render goes.
use serde_json::Value;

use super::{
    command_line::{Shell, scene, text},
    json_schema::fits_part,
};

#[test]
fn bench_tells_time_and_rays_by_stage_and_bounce() {
    let shell = Shell::new();
    let triangles = scene("million_triangles").replace('\\', "/");
    let small = std::fs::read_to_string(&triangles).expect("it is shipped").replace("triangles = 1300000", "triangles = 2000");
    std::fs::write(shell.path("knot.toml"), small).expect("it is written");
    let options = ["bench", "knot.toml", "--size", "40x30", "--spp", "2"];
    let done = shell.run(&[&options[..], &["-o", "where.svg"]].concat());
    let said = text(&done.stdout);
    assert!(done.status.success() && said.contains("2400 samples (2 per pixel"), "{said}{}", text(&done.stderr));
    for line in ["rays", "surfaces", "shading", "shadow rays", "film", "all", "15 +", "a ray of a path visits"] {
        assert!(said.lines().any(|found| found.starts_with(line)), "{line}: {said}");
    }
    let plot = std::fs::read_to_string(shell.path("where.svg")).expect("a plot");
    assert!(plot.starts_with("<svg") && plot.contains("shadow rays"), "{plot}");
    let line = text(&shell.run(&[&options[..], &["--json"]].concat()).stdout);
    let figures: Value = serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line}"));
    let schema = serde_json::from_str(include_str!("../../docs/figures.schema.json")).expect("the schema is JSON");
    assert!(fits_part(&figures, "bench", &schema), "{line}");
    let rays = |stage: &Value| stage["rays"].as_u64().expect("a number");
    let bounces = figures["bounces"].as_array().expect("bounces");
    let sum: u64 = bounces.iter().map(|bounce| rays(&bounce["stages"]["rays"])).sum();
    assert_eq!((rays(&figures["stages"]["rays"]), rays(&bounces[0]["stages"]["rays"])), (sum, 2400));
    let wrong = shell.run(&["bench", "knot.toml", "-o", "where.png"]);
    assert!(wrong.status.code() == Some(2) && text(&wrong.stderr).contains("must end in .svg"), "{}", text(&wrong.stderr));
    let caustic = scene("glass_ball_caustic");
    let done = shell.run(&["bench", &caustic, "--size", "16x12", "--spp", "1", "--json"]);
    assert!(text(&done.stderr).contains("bench cannot measure `bidirectional`; measuring `mis`"), "{}", text(&done.stderr));
    let figures: Value = serde_json::from_str(&text(&done.stdout)).expect("a line of JSON");
    assert!(fits_part(&figures, "bench", &schema) && figures["estimator"] == "mis", "{figures}");
}
