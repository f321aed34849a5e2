//! The command that replays one sample.
use std::path::Path;

use super::{pass::SampleId, settings_text::options};
use noisefall_scene::scene::{RenderSettings, Scene};

/// The shell command that replays one sample of an image. It supports only the camera of the scene.
pub fn replay_command(
    path: &Path,
    scene: &Scene,
    [width, height]: [u32; 2],
    settings: &RenderSettings,
    SampleId { pixel: [x, y], sample }: SampleId,
) -> String {
    let path = path.to_string_lossy();
    let path = shlex::try_quote(&path).unwrap_or_else(|_| path.clone());
    let differs = [width, height] != scene.camera.resolution;
    let size = if differs { format!(" --size {width}x{height}") } else { String::new() };
    let options = options(settings, &scene.settings);
    format!("noisefall render {path} --pixel {x},{y} --sample {sample}{size}{options}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::built_in;

    #[test]
    fn a_sample_is_replayed_with_all_that_it_depends_on() {
        let (scene, at) = (built_in(), SampleId { pixel: [5, 6], sample: 9 });
        let command = |path: &str, size, settings| replay_command(path.as_ref(), &scene, size, &settings, at);
        let settings = RenderSettings { seed: 7, ..scene.settings };
        let same = command("a.toml", scene.camera.resolution, scene.settings);
        assert_eq!(same, "noisefall render a.toml --pixel 5,6 --sample 9");
        let other = command("a room/it's.toml", [64, 32], settings);
        assert_eq!(other, "noisefall render \"a room/it's.toml\" --pixel 5,6 --sample 9 --size 64x32 --seed 7");
    }
}
