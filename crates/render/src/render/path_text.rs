//! A path as text: the settings, the nested sum, the reason of its end, and every vertex.
use super::{
    path_formula, path_strategies,
    path_words::{number, place, three},
};
use noisefall_kernel::integrator::{EmitterHit, LightOutcome, Reflection, Replay, SampledLight, Surface, Vertex};
use noisefall_scene::scene::{Camera, RenderSettings, Scene, Setting};

/// The path and its settings.
#[derive(Clone, Copy)]
pub struct PathId<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The camera of the path.
    pub camera: &'a Camera,
    /// The settings of the path.
    pub settings: &'a RenderSettings,
    /// Column and row from the top left.
    pub pixel: [u32; 2],
    /// Index of the sample within the pixel.
    pub sample: u32,
}

/// The whole report as text.
pub fn text(id: &PathId, replay: &Replay) -> String {
    let mut text = format!("{}\n\n{}\n", heading(id, replay), path_formula::text(replay));
    for vertex in &replay.vertices {
        text += &format!("{}\n", block(id.scene, vertex));
    }
    text += &format!("\nThe path {}.", replay.end.name());
    if let Some(bidirectional) = &replay.bidirectional {
        text += &path_strategies::text(id.scene, bidirectional);
    } else if let Some(alone) = replay.alone {
        let reason = if id.scene.merges(id.settings) {
            "vertices are merged with those of other pixels' paths (--merging off lists all strategies)"
        } else {
            "pixels share light with their neighbours (--reuse off stops that)"
        };
        text += &format!("\nThis path alone would have made it {}: {reason}.", three(alone));
    }
    text
}

/// The nested sum for a document, with the settings as comments.
pub fn latex(id: &PathId, replay: &Replay) -> String {
    let heading = heading(id, replay);
    let comments: String = heading.lines().map(|line| format!("% {line}\n")).collect();
    let shared = match (&replay.bidirectional, replay.alone) {
        (Some(_), _) => "% There are light paths, too: the sum is that of the camera path as MIS weights it.\n",
        (None, Some(_)) => "% Pixels share light with their neighbours: the sum is that of this path alone.\n",
        (None, None) => "",
    };
    format!("{comments}% The path {}.\n{shared}{}", replay.end.name(), path_formula::latex(replay))
}

fn heading(PathId { scene, camera, settings, pixel: [x, y], sample }: &PathId, replay: &Replay) -> String {
    let [width, height] = camera.resolution;
    let value = |setting: Setting| match setting.value(settings) {
        // The sum is that of the camera path.
        estimator if setting == RenderSettings::ESTIMATOR && scene.traces_light_paths(settings) => {
            format!("mis ({estimator} traces light paths, too)")
        }
        value => value,
    };
    let words = RenderSettings::TABLE.map(|setting| format!("{} {}", setting.key(), value(setting)));
    let lines: Vec<String> = words.chunks(4).map(|words| words.join(", ")).collect();
    let settings = lines.join(&format!(",\n  {:15} ", ""));
    let title = if scene.title.is_empty() { String::new() } else { format!("\n  scene           {}", scene.title) };
    format!(
        "pixel {x},{y}, sample {sample}: radiance {}{title}\n  settings        {settings}\n  {:15} {width} × {height} pixels",
        three(replay.radiance),
        "",
    )
}

/// The text of a vertex: a title, and at least one line per term.
fn block(scene: &Scene, vertex: &Vertex) -> String {
    let mut text = title(scene, vertex);
    let mut term = |name: &str, value: &str| text += &format!("\n  {name:<15} {value}");
    term("throughput", &three(vertex.throughput));
    if vertex.transmittance != [1.0; 3] {
        term("transmittance", &three(vertex.transmittance));
    }
    if let Some(Surface { position, wo, shading_normal, .. }) = &vertex.surface {
        term("position", &place(*position));
        term("to the viewer", &place(*wo));
        shading_normal.iter().for_each(|n| term("normal", &place(*n)));
    }
    if let Some(EmitterHit { radiance, weight, contribution, .. }) = &vertex.emission {
        term("emission", &format!("Le {}, weight {}", three(*radiance), number(*weight)));
        term("", &format!("adds {}", three(*contribution)));
    }
    vertex.light.iter().for_each(|light| light_sample(scene, light, &mut term));
    vertex.reflection.iter().for_each(|reflection| next(reflection, &mut term));
    term("radiance so far", &three(vertex.radiance));
    text
}

fn title(scene: &Scene, vertex: &Vertex) -> String {
    let (Some(id), Some(distance), Some(surface)) = (vertex.object, vertex.distance, &vertex.surface) else {
        return format!("\nvertex {}: leaves the scene", vertex.bounce);
    };
    let (material, side) = (surface.material.unwrap_or("black"), if surface.front { "front" } else { "back" });
    format!("\nvertex {}: {}, {material}, {side}, {} m away", vertex.bounce, name(scene, id), number(distance))
}

fn light_sample(scene: &Scene, light: &SampledLight, term: &mut impl FnMut(&str, &str)) {
    let aim = light.object.map_or("the environment", |id| name(scene, id));
    let aim = light.punctual_light.as_deref().unwrap_or(aim);
    term("light sample", &format!("{aim}, p {}", number(light.pdf)));
    term("", &format!("ω {}", place(light.direction)));
    term("", &format!("Le {}, weight {}", three(light.radiance), number(light.weight)));
    term("", &format!("f cos {}", three(light.f_cos)));
    if light.outcome == LightOutcome::Seen && light.passed != [1.0; 3] {
        term("", &format!("× {} by media and texture", three(light.passed)));
    }
    term(
        "",
        &match light.outcome {
            LightOutcome::Seen => format!("is visible, adds {}", three(light.contribution)),
            LightOutcome::Hidden => "is occluded".to_owned(),
            LightOutcome::Void => "adds nothing: density, BSDF or radiance is 0".to_owned(),
        },
    );
}

fn next(reflection: &Reflection, term: &mut impl FnMut(&str, &str)) {
    term("next direction", &format!("ω {}", place(reflection.direction)));
    let side = if reflection.refracted { "refracted" } else { "reflected" };
    let chosen = reflection.lobe.probability;
    let chance = if chosen < 1.0 { format!(", chosen with probability {}", number(chosen)) } else { String::new() };
    term("", &format!("{side}: {}{chance}", reflection.lobe.name));
    match (reflection.f, reflection.pdf) {
        (Some(f), Some(pdf)) => {
            term("", &format!("f {}, p {}", three(f), number(pdf)));
            term("", &format!("cos θ {}, f cos/p {}", number(reflection.cos), three(reflection.weight)));
        }
        _ => term("", &format!("delta lobe, weight {}", three(reflection.weight))),
    }
    let played = if reflection.survival < 1.0 { format!("survival {}, ", number(reflection.survival)) } else { String::new() };
    let end = match reflection {
        Reflection { goes_on: true, throughput, .. } => format!("continues with {}", three(*throughput)),
        Reflection { survives: false, survival, .. } if *survival < 1.0 => "ended by roulette".to_owned(),
        _ => "ends: no light can follow".to_owned(),
    };
    term("", &format!("{played}{end}"));
}

fn name(scene: &Scene, object: u32) -> &str {
    match scene.objects[object as usize].name.as_str() {
        "" => "(unnamed)",
        name => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::{Reuse, Roulette, built_in};

    /// The first path through the middle of the built-in scene that has a light sample, and its vertex.
    fn lit(scene: &Scene, settings: &RenderSettings) -> Vertex {
        let rays = scene.rays(&scene.camera);
        let middle = scene.camera.resolution.map(|side| side / 2);
        let paths = (0..100).map(|sample| noisefall_kernel::integrator::replay(scene, &rays, settings, middle, sample));
        paths
            .flat_map(|path| path.vertices)
            .find(|vertex| vertex.light.is_some() && vertex.reflection.is_some())
            .expect("a light sample")
    }

    #[test]
    fn a_vertex_says_its_side_its_light_sample_and_how_the_path_goes_on() {
        let scene = built_in();
        let mut vertex = lit(&scene, &RenderSettings { reuse: Reuse::Off, ..scene.settings });
        let mut told = |front, outcome, [goes_on, survives]: [bool; 2]| {
            let (Some(surface), Some(light), Some(next)) = (&mut vertex.surface, &mut vertex.light, &mut vertex.reflection)
            else {
                panic!("it has all of them")
            };
            (surface.front, light.outcome, light.radiance, light.contribution) = (front, outcome, [7.0; 3], [0.5, 2.0, 3.0]);
            (next.goes_on, next.survives, next.survival, next.throughput) = (goes_on, survives, 0.25, [0.75; 3]);
            block(&scene, &vertex)
        };
        for (front, outcome, [goes_on, survives], parts) in [
            (
                true,
                LightOutcome::Seen,
                [true, true],
                [", front, ", "is visible, adds 0.50000 2.00000 3.00000", "continues with 0.75000 "],
            ),
            (false, LightOutcome::Hidden, [false, false], [", back, ", "is occluded", "survival 0.25000, ended by roulette"]),
            (
                true,
                LightOutcome::Void,
                [false, true],
                [", front, ", "adds nothing: density, BSDF or radiance is 0", "ends: no light can follow"],
            ),
        ] {
            let told = told(front, outcome, [goes_on, survives]);
            parts.iter().for_each(|part| assert!(told.contains(part), "{part}: {told}"));
        }
    }

    #[test]
    fn the_radiance_of_a_path_alone_stands_beside_the_shared_radiance() {
        let scene = built_in();
        let settings = RenderSettings { roulette: Roulette::by_throughput_from(3), ..scene.settings };
        let id = PathId { scene: &scene, camera: &scene.camera, settings: &settings, pixel: [5, 6], sample: 7 };
        let replay = Replay { radiance: [1.0, 2.0, 3.0], alone: Some([4.0, 5.0, 6.0]), ..Replay::default() };
        let said = text(&id, &replay);
        assert!(said.starts_with("pixel 5,6, sample 7: radiance 1.00000 2.00000 3.00000\n"), "{said}");
        assert!(said.contains("This path alone would have made it 4.00000 5.00000 6.00000: pixels share"), "{said}");
        assert!(said.contains("max_bounces none, count_crossings off, roulette throughput:3"), "{said}");
    }
}
