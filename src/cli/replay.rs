//! `noisefall render --pixel X,Y --sample N`: one path, vertex by vertex.
use noisefall::{
    integrator::{MetLight, Outcome, Reflection, SampledLight, Surface, Vertex, replay},
    render::sharing::resolved,
    scene::{Camera, RenderSettings, Scene},
};

use super::{Failure, print};

pub fn run(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    pixel: [u32; 2],
    sample: u32,
    json: bool,
) -> Result<(), Failure> {
    let [width, height] = camera.resolution;
    if pixel[0] >= width || pixel[1] >= height {
        return Err(format!("pixel {},{} lies outside the picture of {width} × {height}", pixel[0], pixel[1]));
    }
    let rays = scene.rays(camera);
    let settings = resolved(scene, &rays, settings);
    let replay = replay(scene, &rays, &settings, pixel, sample);
    if json {
        return print(&serde_json::json!(replay).to_string());
    }
    print(&format!("pixel {},{}, sample {sample}: radiance {}", pixel[0], pixel[1], three(replay.radiance)))?;
    for vertex in &replay.vertices {
        print(&block(scene, vertex))?;
    }
    if let Some(alone) = replay.alone {
        print(&format!(
            "This path alone would have made it {}: pixels share what their paths find (--reuse off: none does).",
            three(alone)
        ))?;
    }
    Ok(())
}

/// What is printed of a vertex: a title, and a line or more a term.
fn block(scene: &Scene, vertex: &Vertex) -> String {
    let mut text = title(scene, vertex);
    let mut term = |name: &str, value: &str| text += &format!("\n  {name:<15} {value}");
    term("throughput", &three(vertex.throughput));
    if vertex.transmittance != [1.0; 3] {
        term("media let pass", &three(vertex.transmittance));
    }
    if let Some(Surface { position, wo, shading_normal, .. }) = &vertex.surface {
        term("position", &place(*position));
        term("to the viewer", &place(*wo));
        shading_normal.iter().for_each(|n| term("normal", &place(*n)));
    }
    if let Some(MetLight { radiance, weight, contribution }) = &vertex.emission {
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
    let aim = light.object.map_or("the background", |id| name(scene, id));
    term("light sample", &format!("{aim}, p {}", number(light.pdf)));
    term("", &format!("ω {}", place(light.direction)));
    term("", &format!("Le {}, weight {}", three(light.radiance), number(light.weight)));
    term("", &format!("f cos {}", three(light.f_cos)));
    if light.outcome == Outcome::Seen && light.passed != [1.0; 3] {
        term("", &format!("× {} by media and texture", three(light.passed)));
    }
    term(
        "",
        &match light.outcome {
            Outcome::Seen => format!("is seen, adds {}", three(light.contribution)),
            Outcome::Hidden => "is hidden".to_owned(),
            Outcome::Void => "cannot be reflected or is dark".to_owned(),
        },
    );
}

fn next(reflection: &Reflection, term: &mut impl FnMut(&str, &str)) {
    term("next direction", &format!("ω {}", place(reflection.direction)));
    match (reflection.f, reflection.pdf) {
        (Some(f), Some(pdf)) => {
            term("", &format!("f {}, p {}", three(f), number(pdf)));
            term("", &format!("cos θ {}, f cos/p {}", number(reflection.cos), three(reflection.weight)));
        }
        _ => term("", &format!("delta lobe, weight {}", three(reflection.weight))),
    }
    let played = if reflection.survival < 1.0 { format!("survival {}, ", number(reflection.survival)) } else { String::new() };
    let end = match reflection {
        Reflection { goes_on: true, throughput, .. } => format!("goes on with {}", three(*throughput)),
        Reflection { survives: false, survival, .. } if *survival < 1.0 => "ended by roulette".to_owned(),
        _ => "ends: nothing would come of it".to_owned(),
    };
    term("", &format!("{played}{end}"));
}

fn name(scene: &Scene, object: u32) -> &str {
    match scene.objects[object as usize].name.as_str() {
        "" => "(unnamed)",
        name => name,
    }
}

fn three(values: [f32; 3]) -> String {
    values.map(number).join(" ")
}

/// A point or a direction.
fn place([x, y, z]: [f32; 3]) -> String {
    format!("{x:.5} {y:.5} {z:.5}")
}

/// Five decimals, or as many digits where these would be few or the number long.
fn number(x: f32) -> String {
    if x == 0.0 || (1e-3..1e4).contains(&x.abs()) { format!("{x:.5}") } else { format!("{x:.4e}") }
}
