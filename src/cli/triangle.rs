//! The triangle of bidirectional path tracing: an image of every strategy (s, t).
use noisefall_lab::report::sheet::Cell;
use noisefall_scene::scene::{RenderSettings, Scene, Strategy};

use super::messages::Failure;

/// Parses a number of bounces. The strategies of the largest one still fit on a sheet.
pub fn strategy_bounces(text: &str) -> Result<u32, String> {
    let bounces = text.parse().ok().filter(|bounces| (1..=12).contains(bounces));
    bounces.ok_or_else(|| "expected a whole number of bounces from 1 to 12".to_owned())
}

/// Settings of every strategy of paths with up to `bounces` bounces, row by row.
pub fn strategies(scene: &Scene, base: RenderSettings, bounces: u32, weighted: bool) -> Result<Vec<RenderSettings>, Failure> {
    let all = (0..=bounces).flat_map(|bounces| Strategy::of_bounces(bounces, weighted));
    let all: Vec<_> = all.map(|strategy| base.of_strategy(strategy)).collect();
    match all.first().and_then(|first| scene.lacks_light_paths(first)) {
        Some(reason) => Err(format!("there are no strategies to show: {reason}")),
        None => Ok(all),
    }
}

/// Names an image by its strategy.
pub fn label(settings: &RenderSettings) -> Option<String> {
    settings.strategy.map(|Strategy { s, t, .. }| format!("s = {s}, t = {t}"))
}

/// The images with empty cells at the ends of shorter rows.
pub fn padded(cells: Vec<Cell>, settings: &[RenderSettings]) -> Vec<Cell> {
    let bounces = |settings: &RenderSettings| settings.strategy.map_or(0, Strategy::bounces);
    let most = settings.iter().map(bounces).max().unwrap_or(0);
    let mut padded = Vec::new();
    for (cell, settings) in cells.into_iter().zip(settings) {
        padded.push(cell);
        let missing = match settings.strategy {
            Some(Strategy { s: 0, t: 2, .. }) => most + 1,
            Some(Strategy { t: 1, .. }) => most - bounces(settings),
            _ => 0,
        };
        padded.extend((0..missing).map(|_| Cell { lines: Vec::new(), pixels: Vec::new() }));
    }
    padded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_as_long_as_the_last_one() {
        let scene = noisefall_scene::scene::built_in();
        let settings = strategies(&scene, RenderSettings::default(), 2, true).expect("lights and diffuse surfaces");
        let names: Vec<_> = settings.iter().filter_map(label).collect();
        assert_eq!(names[..3], ["s = 0, t = 2", "s = 0, t = 3", "s = 1, t = 2"]);
        assert_eq!((names.len(), names[7].as_str()), (8, "s = 3, t = 1"));
        let cell = |name: &String| Cell { lines: vec![name.clone()], pixels: Vec::new() };
        let cells = padded(names.iter().map(cell).collect(), &settings);
        let rows: Vec<usize> = cells.chunks(4).map(|row| row.iter().filter(|cell| !cell.lines.is_empty()).count()).collect();
        assert_eq!(rows, [1, 3, 4]);
    }

    #[test]
    fn a_scene_without_light_paths_says_why() {
        let text = "format = 1\n[camera]\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\nfov = 40\nresolution = [8, 8]\n";
        let scene = noisefall_scene::scene::parse("dark.toml", text.to_owned()).expect("a scene without light");
        let error = strategies(&scene, RenderSettings::default(), 2, true).expect_err("no light");
        assert!(error.contains("no strategies") && error.contains("light"), "{error}");
    }
}
