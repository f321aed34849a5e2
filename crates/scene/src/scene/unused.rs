//! Settings that a render does not use, and why.
use super::{CameraRays, PathReuse, RenderSettings, Reuse, Scene};

impl Scene {
    /// Says which settings have no effect in this scene, and why. `resolved` are the same settings where it is decided what pixels share and
    /// which estimator renders.
    pub fn unused_settings(&self, rays: &CameraRays, asked: &RenderSettings, resolved: &RenderSettings) -> Vec<String> {
        let path_reuse = self.path_reuse(rays, resolved);
        let has_light_paths = self.traces_light_paths(resolved);
        let why = [
            self.why_not_adaptive(asked, path_reuse, has_light_paths),
            why_not_shared(asked, path_reuse, has_light_paths),
            why_not_merged(asked, resolved),
        ];
        let named = ["adaptive", "reuse", "merging"].into_iter().zip(why);
        named.filter_map(|(name, why)| Some(format!("`{name}` is not used: {}", why?))).collect()
    }

    fn why_not_adaptive(&self, asked: &RenderSettings, path_reuse: PathReuse, has_light_paths: bool) -> Option<String> {
        let obstacle = match path_reuse {
            PathReuse::Off => has_light_paths.then(|| "light paths reach any pixel".to_owned()),
            PathReuse::Merged => Some("light-path vertices are merged".to_owned()),
            shared => Some(format!("path reuse is on ({}); --reuse off turns it off", shared.words())),
        };
        obstacle.filter(|_| asked.adaptive)
    }
}

fn why_not_shared(asked: &RenderSettings, path_reuse: PathReuse, has_light_paths: bool) -> Option<String> {
    if matches!(asked.reuse, Reuse::Auto | Reuse::Off) || path_reuse == PathReuse::asked(asked.reuse) {
        return None;
    }
    Some(match path_reuse {
        PathReuse::Merged => "light-path vertices are merged".to_owned(),
        PathReuse::Off if has_light_paths => "all pixels share the light paths already".to_owned(),
        PathReuse::Off => "this scene and these settings do not allow path reuse".to_owned(),
        other => format!("this scene and these settings allow only {}", other.words()),
    })
}

/// Obstacles of the scene have notes of their own.
fn why_not_merged(asked: &RenderSettings, resolved: &RenderSettings) -> Option<String> {
    let other = format!("it belongs to the estimator `bidirectional`, not to `{}`", resolved.estimator.name());
    (asked.merging && !resolved.estimator.connects()).then_some(other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Estimator, built_in, parse};

    const GLASS: &str = "format = 1\ncamera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [16, 16] }\n\
         materials.glass.dielectric = { ior = 1.5 }\nmaterials.sheer = { lambertian.albedo = 0.5, opacity = 0.5 }\n\
         [[objects]]\nshape.sphere = { center = [0, 0, 0], radius = 1 }\nmaterial = 'sheer'\n\
         [[objects]]\nshape.sphere = { center = [0, 3, 0], radius = 1 }\nemission.radiance = 1\n";

    fn said(scene: &Scene, asked: RenderSettings) -> String {
        let rays = scene.rays(&scene.camera);
        // Nothing is undecided here but what `auto` shares.
        scene.unused_settings(&rays, &asked, &RenderSettings { merging: scene.merges(&asked), ..asked }).join("\n")
    }

    #[test]
    fn each_setting_that_has_no_effect_is_named_with_the_reason() {
        let (open, sheer) = (built_in(), parse("sheer", GLASS.to_owned()).expect("it is a scene"));
        let base = RenderSettings { estimator: Estimator::Mis, reuse: Reuse::Off, ..RenderSettings::default() };
        let light = RenderSettings { estimator: Estimator::Bidirectional, ..base };
        for (scene, asked, expected) in [
            (&open, base, ""),
            (&open, RenderSettings { adaptive: true, ..base }, ""),
            (&open, RenderSettings { reuse: Reuse::Suffixes, ..base }, ""),
            (&open, RenderSettings { reuse: Reuse::Both, ..base }, ""),
            (&open, RenderSettings { merging: true, ..light }, ""),
            (
                &open,
                RenderSettings { adaptive: true, reuse: Reuse::Suffixes, ..base },
                "`adaptive` is not used: path reuse is on (reused suffixes)",
            ),
            (
                &open,
                RenderSettings { adaptive: true, reuse: Reuse::Outliers, ..base },
                "`adaptive` is not used: path reuse is on (reused outliers)",
            ),
            (&open, RenderSettings { adaptive: true, ..light }, "`adaptive` is not used: light paths reach"),
            (
                &open,
                RenderSettings { adaptive: true, merging: true, ..light },
                "`adaptive` is not used: light-path vertices are merged",
            ),
            (&open, RenderSettings { reuse: Reuse::Suffixes, ..light }, "`reuse` is not used: all pixels share the light paths"),
            (
                &open,
                RenderSettings { reuse: Reuse::Suffixes, max_bounces: Some(1), ..base },
                "`reuse` is not used: this scene and these settings do not allow",
            ),
            (
                &sheer,
                RenderSettings { reuse: Reuse::Suffixes, ..base },
                "`reuse` is not used: this scene and these settings do not allow",
            ),
            (
                &sheer,
                RenderSettings { reuse: Reuse::Both, ..base },
                "`reuse` is not used: this scene and these settings allow only reused outliers",
            ),
            (
                &open,
                RenderSettings { merging: true, ..base },
                "`merging` is not used: it belongs to the estimator `bidirectional`",
            ),
        ] {
            let said = said(scene, asked);
            assert!(said.starts_with(expected) && said.is_empty() == expected.is_empty(), "{asked:?}: {said}");
            assert!(said.lines().count() <= 1, "{said}");
        }
    }
}
