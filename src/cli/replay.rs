//! `noisefall render --pixel X,Y --sample N`: one path, vertex by vertex.
use noisefall::{
    integrator::replay,
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
    print(&format!("pixel {},{}, sample {sample}: radiance {}", pixel[0], pixel[1], colour(replay.radiance)))?;
    print("bounce  throughput before        radiance after           distance  object")?;
    for vertex in &replay.vertices {
        let object = vertex.object.map_or("(leaves the scene)", |id| match scene.objects[id as usize].name.as_str() {
            "" => "(unnamed)",
            name => name,
        });
        let distance = vertex.distance.map_or_else(String::new, |t| format!("{t:.5}"));
        let (throughput, radiance) = (colour(vertex.throughput), colour(vertex.radiance));
        print(&format!("{:>6}  {throughput:<23}  {radiance:<23}  {distance:>8}  {object}", vertex.bounce))?;
    }
    if let Some(alone) = replay.alone {
        print(&format!(
            "This path alone would have made it {}: pixels share what their paths find (--reuse off: none does).",
            colour(alone)
        ))?;
    }
    Ok(())
}

fn colour([r, g, b]: [f32; 3]) -> String {
    format!("{r:.5} {g:.5} {b:.5}")
}
