//! The reserved memory is the memory that is allocated. This is a separate test program, so nothing else allocates in its
//! processes.
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
    sync::Arc,
};

use crossbeam_channel::unbounded;
use image::{ExtendedColorType, ImageFormat};
use noisefall_base::{math::SimdLevel, memory::set_limit};
use noisefall_kernel::integrator::{Features, features};
use noisefall_render::render::{
    Budget, Frame, Publish, RenderRequest, RenderTask, Renderer, State, Target,
    film::Film,
    threads::{PassJob, Threads},
};
use noisefall_scene::{
    image::{Encoding, read},
    scene::{Camera, built_in, load},
};

/// Counts allocated bytes.
#[global_allocator]
static MEMORY: cap::Cap<std::alloc::System> = cap::Cap::new(std::alloc::System, usize::MAX);

/// The file to read, and the memory limit.
const FILE: &str = "NOISEFALL_TEST_FILE";
const ALLOWED: &str = "NOISEFALL_TEST_ALLOWED";

/// Not a test of its own: the other tests start it as a process that reads a scene or an image, or renders a large image of it.
#[test]
fn probe() {
    let Ok(file) = std::env::var(FILE).map(PathBuf::from) else { return };
    if let Some(allowed) = std::env::var(ALLOWED).ok().and_then(|text| text.parse().ok()) {
        set_limit(allowed);
    }
    let before = MEMORY.allocated();
    let is_foreign = noisefall_formats::import::is_foreign(&file);
    let refused = if is_foreign {
        // An image carries the text of the scene.
        noisefall_formats::import::load(&file).map(|scene| assert!(scene.source.len() > 100)).map_err(|error| error.report())
    } else if file.extension().is_some_and(|extension| extension == "toml") {
        load(&file).map_err(|error| error.report()).and_then(|scene| {
            let resolution = scene.camera.resolution;
            if resolution[0] < 1000 {
                return Ok(());
            }
            let _room = Film::reserve(resolution).map_err(|error| error.to_string())?;
            let threads = Threads::new(2, SimdLevel::best()).expect("threads");
            let mut film = Film::new(resolution);
            let job = PassJob { scene: &scene, rays: &scene.rays(&scene.camera), settings: &scene.settings };
            threads.pass(job, &mut film, 1, &|| false);
            let frames = [0, 1].map(|generation| Frame::of_film(&film, generation, resolution, resolution));
            let _more_room = Features::reserve(resolution).map_err(|error| error.to_string())?;
            let seen =
                threads.install(|| features(SimdLevel::best(), &scene, &scene.camera, &|| false)).expect("nobody interrupts");
            assert!(frames.iter().all(|frame| frame.radiance.len() == seen.depth.len()));
            Ok(())
        })
    } else {
        read(&file, Encoding::Srgb).map(drop).map_err(|error| error.to_string())
    };
    println!("PEAK {}", MEMORY.max_allocated() - before);
    if let Err(message) = refused {
        println!("REFUSED {message}");
    }
}

/// The output of a process that reads this file.
fn probed(file: &Path, allowed: u64) -> String {
    let program = std::env::current_exe().expect("this program");
    let arguments = ["--exact", "probe", "--nocapture", "--test-threads=1"];
    let Output { stdout, stderr, .. } =
        Command::new(program).args(arguments).env(FILE, file).env(ALLOWED, allowed.to_string()).output().expect("it runs");
    format!("{}{}", String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr))
}

/// Reading this file allocates at most the reserved memory, and not much less.
fn assert_counted(what: &str, file: &Path) {
    /// Memory that is not reserved: an empty scene, batches of two threads.
    const UNCOUNTED: u64 = 12_000_000;
    let said = probed(file, u64::MAX / 2);
    let figure = |name: &str| said.split(name).nth(1).and_then(|rest| rest.split_whitespace().next()?.parse::<u64>().ok());
    let peak = figure("PEAK ").unwrap_or_else(|| panic!("{what}: {said}"));
    assert!(peak > 3 * UNCOUNTED, "{what}: a peak of {peak} bytes tells nothing");
    let is_refused = |allowed| probed(file, allowed).contains("--memory");
    assert!(is_refused(peak - UNCOUNTED), "{what}: of a peak of {peak} bytes {UNCOUNTED} or more are not counted");
    assert!(!is_refused(4 * peak), "{what}: of a peak of {peak} bytes four times as many are counted");
}

fn scene(resolution: u32, objects: &str) -> String {
    format!(
        "format = 1\n[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\nfov = 40\nresolution = [{resolution}, {resolution}]\n\
         [materials.white]\nlambertian = {{ albedo = 0.5 }}\n{objects}\n[[objects]]\n\
         shape = {{ sphere = {{ center = [0, 0, 0], radius = 1 }} }}\nemission = {{ radiance = 1 }}\n"
    )
}

fn object(shape: &str) -> String {
    scene(16, &format!("[[objects]]\nshape = {{ {shape} }}\nmaterial = \"white\"\n"))
}

/// A PNG of a single value, which is tiny as a file.
fn png(path: &Path, side: u32) {
    let mut encoder = png::Encoder::new(fs::File::create(path).expect("a file"), side, side);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&vec![200; (3 * side * side) as usize]).expect("its pixels");
}

#[test]
fn allocated_memory_is_counted() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("it is written");
        folder.path().join(name)
    };
    png(&folder.path().join("large.png"), 2500);
    assert_counted("PNG", &folder.path().join("large.png"));
    let pixels = vec![200; 3 * 2500 * 2500];
    for format in [ImageFormat::Jpeg, ImageFormat::Tga, ImageFormat::WebP] {
        let path = folder.path().join(format!("large.{}", format.extensions_str()[0]));
        image::save_buffer_with_format(&path, &pixels, 2500, 2500, ExtendedColorType::Rgb8, format).expect("it is written");
        assert_counted(&format!("{format:?}"), &path);
    }
    let textured = "[textures.t]\nimage = { path = 'large.png' }\n";
    assert_counted("texture", &file("texture.toml", &scene(16, textured)));
    assert_counted("sky", &file("sky.toml", &scene(16, "[environment]\nimage = 'large.png'\n")));

    assert_counted("knot", &file("knot.toml", &object("mesh = { knot = { triangles = 400000 } }")));
    assert_counted("hills", &file("hills.toml", &object("mesh = { heightfield = { quads = 450 } }")));
    let field = "sphere_field = { count = 50000, bounds = { min = [-1, -1, -1], max = [1, 1, 1] } }";
    assert_counted("spheres", &file("spheres.toml", &object(field)));
    let lights = format!("[[objects]]\nshape = {{ {field} }}\nemission = {{ radiance = 1 }}\n");
    assert_counted("lights", &file("lamps.toml", &scene(16, &lights)));
    let light = "[[objects]]\nshape = { mesh = { knot = { triangles = 60000 } } }\nemission = { radiance = 1 }\n";
    assert_counted("emitting triangles", &file("light.toml", &scene(16, light)));

    let rows: String = (0..60_000).map(|i| format!("[{},{},{}],", i % 7, i % 11, i % 13)).collect();
    let triangles: String = (0..60_000).map(|i| format!("[{},{},{}],", i % 997, i % 1009, i % 1013)).collect();
    let lists = format!("mesh = {{ smooth = true, vertices = [{rows}], triangles = [{triangles}] }}");
    assert_counted("lists", &file("lists.toml", &object(&lists)));
    assert_counted("many numbers", &file("numbers.toml", &format!("x = [{}1]", "1,".repeat(1 << 20))));
    assert_counted("many tables", &file("tables.toml", &"[[o]]\n".repeat(150_000)));

    let vertices: String = (0..500_000).map(|i| format!("v {} {} {}\n", i % 7, i % 11, i % 13)).collect();
    let faces: String = (1..=499_998).map(|i| format!("f {i} {} {}\n", i + 1, i + 2)).collect();
    file("large.obj", &(vertices + &faces));
    assert_counted("OBJ", &file("obj.toml", &object("mesh = { path = 'large.obj' }")));
    let vertices: String = (0..500_000).map(|i| format!("{} {} {}\n", i % 7, i % 11, i % 13)).collect();
    let faces: String = (0..499_998).map(|i| format!("3 {i} {} {}\n", i + 1, i + 2)).collect();
    let header = "ply\nformat ascii 1.0\nelement vertex 500000\nproperty float x\nproperty float y\nproperty float z\n\
        element face 499998\nproperty list uchar int vertex_indices\nend_header\n";
    file("large.ply", &format!("{header}{vertices}{faces}"));
    assert_counted("PLY", &file("ply.toml", &object("mesh = { path = 'large.ply' }")));

    assert_counted("image", &file("picture.toml", &scene(1200, "")));
}

#[test]
fn many_small_things_of_other_programs_take_little_memory_each() {
    const COUNT: usize = 20_000;
    let folder = tempfile::tempdir().expect("a folder");
    png(&folder.path().join("a.png"), 1);
    let many = |one: &str| one.repeat(COUNT);
    let xml =
        |one: &str| format!("<scene version=\"3.0.0\"><emitter type=\"constant\"/><shape type=\"sphere\"/>{}</scene>", many(one));
    let materials: String = (0..COUNT).map(|number| format!("newmtl m{number}\nmap_Kd a{number}.png\n")).collect();
    fs::write(folder.path().join("many.mtl"), materials).expect("it is written");
    // Bytes for each: of the objects some are in the tree, and some on their way into the text.
    for (name, text, most) in [
        ("rectangles.xml", xml("<shape type=\"rectangle\"/>"), 3000),
        ("points.xml", xml("<emitter type=\"point\"/>"), 3000),
        ("disks.pbrt", format!("WorldBegin\nLightSource \"infinite\"\n{}", many("Shape \"disk\"\n")), 3000),
        ("points.pbrt", format!("WorldBegin\nShape \"sphere\"\n{}", many("LightSource \"point\"\n")), 3000),
        ("textures.obj", "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m1\nf 1 2 3\n".to_owned(), 1500),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("it is written");
        let said = probed(&path, u64::MAX / 2);
        let peak = said.split("PEAK ").nth(1).and_then(|rest| rest.split_whitespace().next()?.parse::<usize>().ok());
        let each = peak.unwrap_or_else(|| panic!("{name}: {said}")).saturating_sub(12_000_000) / COUNT;
        assert!(!said.contains("REFUSED") && each < most, "{name}: {each} bytes each");
    }
}

#[test]
fn files_that_do_not_fit_are_refused_by_their_size() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("it is written");
        folder.path().join(name)
    };
    let refused = |file: &Path, what: &str| {
        let said = probed(file, 30_000_000);
        let plain = said.replace(['\n', '│'], " ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(plain.contains(what) && plain.contains("of the 30.0 MB allowed are left (--memory changes that)"), "{said}");
    };
    png(&folder.path().join("a.png"), 2000);
    refused(&folder.path().join("a.png"), "a.png: 2000 × 2000 pixels need 48.0 MB; 30.0 MB");
    refused(&file("a.toml", &scene(16, "[environment]\nimage = 'a.png'\n")), "a.png: 2000 × 2000 pixels need 64.0 MB");
    refused(&file("b.toml", &object("mesh = { knot = { triangles = 50000000 } }")), "50000000 triangles need");
    refused(&file("c.toml", &object("mesh = { heightfield = { quads = 5000 } }")), "50000000 triangles need");
    let field = "sphere_field = { count = 1000000, bounds = { min = [-1, -1, -1], max = [1, 1, 1] } }";
    refused(&file("d.toml", &object(field)), "1000000 spheres need");
    refused(&file("e.toml", &format!("x = [{}1]", "1,".repeat(1 << 20))), "2.1 MB of text need");
    refused(&file("f.toml", &scene(1200, "")), "images of 1200 × 1200 pixels need");
    fs::write(folder.path().join("g.obj"), "v 0 0 0\n".repeat(2_000_000)).expect("it is written");
    refused(&file("g.toml", &object("mesh = { path = 'g.obj' }")), "g.obj: line");
}

#[test]
fn every_command_takes_the_option() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("large.toml");
    fs::write(&file, scene(1500, "")).expect("it is written");
    let [file, output] = [file, folder.path().join("a.png")].map(|path| path.display().to_string());
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_noisefall")).args(arguments).output().expect("it runs");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).replace("\n", " "))
    };
    let (status, said) = run(&["render", &file, "-o", &output, "--spp", "1", "--memory", "90M"]);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("images of 1500 × 1500 pixels need") && said.contains("of the 90.0 MB allowed"), "{said}");
    assert!(!Path::new(&output).exists());
    // Of each pixel 140 bytes for an image, 56 for half images and 82 for denoising, or 288 for bounces.
    let exr = folder.path().join("a.exr").display().to_string();
    for (option, memory, what) in [
        (&["--denoise"][..], "400M", "half images"),
        (&["--denoise"], "500M", "denoised images"),
        (&["--layers", "bounces"], "400M", "images"),
        (&["--layers", "bounces"], "900M", "bounces"),
        (&["--layers", "bounces"], "1.5G", "layers"),
        (&["--layers", "normal"], "450M", "features"),
    ] {
        let (status, said) = run(&[&["render", &file, "-o", &exr, "--spp", "2", "--memory", memory], option].concat());
        assert!(status == Some(1) && said.starts_with(&format!("{what} of 1500 × 1500 pixels need")), "{memory}: {said}");
        assert!(!Path::new(&exr).exists(), "it is refused before it is rendered");
    }
    let (status, said) = run(&["render", &file, "-o", &output, "--spp", "1", "--memory", "900M"]);
    assert_eq!(status, Some(0), "{said}");
    let (status, said) = run(&["check", &file, "--memory", "10k"]);
    assert!(status == Some(1) && said.contains("of text need"), "{said}");
    assert!(run(&["check", &file, "--memory", "90M"]).0 == Some(0));
    let (status, said) = run(&["check", &file, "--memory", "lots"]);
    assert!(status == Some(2) && said.contains("expected a size, such as 4G or 500M"), "{said}");
    let (status, said) = run(&["compare", &output, &output, "--memory", "1M"]);
    assert!(status == Some(1) && said.contains("1500 × 1500 pixels need"), "{said}");
    let (status, said) = run(&["compare", &output, &output, "--memory", "100M"]);
    assert!(status == Some(1) && said.contains("2 images of 1500 × 1500 pixels and their difference need"), "{said}");
    let of_size = |command: &str, side: u32, memory: &str| {
        let [folder, size] = [folder.path().join(command).display().to_string(), format!("{side}x{side}")];
        run(&[command, &file, "-o", &folder, "--size", &size, "--memory", memory])
    };
    for (command, side, memory, what) in [
        ("study", 2000, "90M", "images of 2000 × 2000"),
        // A film of 128 bytes per pixel, three images of 12, and for the chapter 12 of 10 and another film.
        ("study", 1000, "150M", "references of 1000 × 1000"),
        ("evidence", 1000, "110M", "12 images of 1000 × 1000"),
        ("evidence", 1000, "360M", "images of 1000 × 1000"),
    ] {
        let (status, said) = of_size(command, side, memory);
        assert!(status == Some(1) && said.contains(&format!("{what} pixels need")), "{command} in {memory}: {said}");
    }
}

#[test]
fn a_picture_that_does_not_fit_fails_in_words() {
    set_limit(10_000_000);
    let scene = Arc::new(built_in());
    let (woken, wait) = unbounded();
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread");
    let renderer = Renderer::new(threads, Publish::Live, move || {
        let _ = woken.send(());
    });
    let request = |side: u32| {
        let camera = Camera { resolution: [side; 2], ..scene.camera };
        RenderRequest { scene: scene.clone(), camera, settings: scene.settings }
    };
    renderer.set_budget(Budget { max_spp: Some(1), ..Budget::default() });
    renderer.submit(2000, request(2000));
    let state = |generation: u64| loop {
        wait.recv().expect("the worker is there");
        let both = [renderer.latest(), renderer.latest_second()].map(|published| published.status);
        if let Some(status) = both.into_iter().find(|of| of.generation == generation && of.state != State::Running) {
            return status.state;
        }
    };
    let State::Failed(failure) = state(2000) else { panic!("it is rendered") };
    assert!(failure.message.starts_with("images of 2000 × 2000 pixels need") && !failure.replays, "{}", failure.message);
    // An image that did not fit is not counted, and a small one fits.
    renderer.submit(64, request(64));
    assert_eq!(state(64), State::Done(Target::Samples(1)));
    // Of each of eight terms, 12 bytes a pixel in the film and in two frames.
    renderer.submit_second(160, RenderTask::Series(request(160)));
    let State::Failed(failure) = state(160) else { panic!("it is rendered") };
    assert!(failure.message.starts_with("bounces of 160 × 160 pixels need 7.4 MB;"), "{}", failure.message);
}
