//! Builds a scene in code: a row of metal balls, each rougher than the one before, between a floor and a light.
//!
//!     cargo run --release --example scene_in_code -- balls.png
//!
//! It prints the scene file with the same content to standard output.
#![allow(clippy::print_stdout, reason = "the text of the scene is printed for the reader")]
use std::{env::args_os, error::Error, path::Path};

use noisefall::{
    Display, Film, Frame, PassJob, SimdLevel, Threads,
    description::{
        DVec3, EmissionDescription, SceneDescription,
        materials::{Conductor, Lambertian, Reflectance},
        shapes::{Rectangle, Sphere},
    },
    image_file::save,
};

fn balls() -> SceneDescription {
    let mut scene = SceneDescription { title: "Balls".to_owned(), ..SceneDescription::default() };
    scene.camera.eye = DVec3::new(0.0, 2.0, 9.0);
    scene.camera.look_at = DVec3::new(0.0, 0.7, 0.0);
    scene.camera.resolution = [480, 240];

    scene.add_material("white", Lambertian { albedo: [0.7; 3].into() });
    let (origin, edge_u, edge_v) = (DVec3::new(-9.0, 0.0, 9.0), DVec3::Z * -18.0, DVec3::X * 18.0);
    scene.add_object("floor", Rectangle { origin, edge_u, edge_v }).material = Some("white".to_owned());
    for i in 0..5u8 {
        let (name, alpha) = (format!("ball {i}"), 0.1 * f32::from(i));
        scene.add_material(&name, Conductor::new(Reflectance::Schlick([1.0, 0.78, 0.34].into()), alpha, true));
        let center = DVec3::new(1.4 * f64::from(i) - 2.8, 0.6, 0.0);
        scene.add_object(&name, Sphere { center, radius: 0.6 }).material = Some(name.clone());
    }
    let light = Sphere { center: DVec3::new(-2.0, 6.0, 4.0), radius: 1.0 };
    scene.add_object("light", light).emission = Some(EmissionDescription::radiance([20.0; 3]));
    scene
}

fn main() -> Result<(), Box<dyn Error>> {
    let picture = args_os().nth(1).ok_or("name a PNG to write")?;
    // The folder that paths of textures and meshes are relative to. `build` checks the scene as `load` does.
    let scene = balls().build(Path::new("."))?;
    println!("{}", *scene.source);

    let resolution = scene.camera.resolution;
    let mut film = Film::new(resolution);
    let job = PassJob { scene: &scene, rays: &scene.rays(&scene.camera), settings: &scene.settings };
    Threads::new(0, SimdLevel::best())?.pass(job, &mut film, 64, &|| false);
    save(&Frame::of_film(&film, 0, resolution, resolution), Display::default(), "", Path::new(&picture))?;
    Ok(())
}
