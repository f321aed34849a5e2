//! Thousands of random events: no panic, no stale frame, no leaked memory.
use noisefall_render::render::view::DisplaySettings;
use rand::{Rng, SeedableRng, rngs::SmallRng, seq::IndexedRandom};

use super::*;

const EVENTS: usize = 6_000;
/// By then everything has been opened, and tables and textures have their sizes.
const WARM: usize = 3_500;
const KEYS: [Key; 30] = [
    Key::Space,
    Key::Period,
    Key::R,
    Key::P,
    Key::C,
    Key::G,
    Key::I,
    Key::V,
    Key::F,
    Key::Num1,
    Key::OpenBracket,
    Key::CloseBracket,
    Key::Home,
    Key::W,
    Key::A,
    Key::S,
    Key::D,
    Key::Q,
    Key::E,
    Key::ArrowLeft,
    Key::ArrowUp,
    Key::Tab,
    Key::Enter,
    Key::F2,
    Key::F3,
    Key::F4,
    Key::F5,
    Key::F6,
    Key::F12,
    Key::Escape,
];

/// Counts what is allocated, whatever the system makes of it.
#[global_allocator]
static MEMORY: cap::Cap<std::alloc::System> = cap::Cap::new(std::alloc::System, usize::MAX);

/// Something a user might do.
fn event(window: &mut Window, random: &mut SmallRng, at: &mut Pos2) {
    let button =
        *[PointerButton::Primary, PointerButton::Primary, PointerButton::Secondary].choose(random).expect("one of three");
    let press = |pressed, pos| egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
    match random.random_range(0..10) {
        0..4 => {
            *at = Pos2::new(random.random_range(0.0..SIZE.x), random.random_range(0.0..SIZE.y));
            window.hover_at(*at);
        }
        4..6 => {
            window.event(press(true, *at));
            window.event(press(false, *at));
        }
        6 => {
            window.event(press(true, *at));
            *at += vec2(random.random_range(-80.0..80.0), random.random_range(-80.0..80.0));
            window.hover_at(*at);
            window.step();
            window.event(press(false, *at));
        }
        7 => window.event(egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            source: egui::MouseWheelSource::Wheel,
            delta: vec2(0.0, random.random_range(-60.0..60.0)),
            phase: egui::TouchPhase::Move,
            modifiers: Modifiers::NONE,
        }),
        8 => window.event(egui::Event::Text(random.random_range(0..100).to_string())),
        _ => window.key_press(*KEYS.choose(random).expect("there are keys")),
    }
    window.step();
}

/// Takes back what no machine could stand, or what a test must not do: huge images, slow scenes, dialogs of the system.
fn tame(window: &mut Window) {
    let app = window.state_mut();
    for side in &mut app.camera_mut().resolution {
        *side = (*side).min(160);
    }
    (app.dialogs.save, app.dialogs.open, app.background.adviser) = (None, None, None);
    // No scene that is shipped is written to.
    (app.dialogs.file, app.dialogs.unsaved, app.window.leaving) = (None, None, None);
    app.session.threads = app.session.threads.min(2);
}

/// Says to the test below that it is the program of its own.
const ALONE: &str = "NOISEFALL_SOAK_ALONE";

/// In a program of its own: other tests take memory too.
#[test]
fn thousands_of_random_events_do_no_harm() {
    if std::env::var_os(ALONE).is_some() {
        return soak();
    }
    let program = std::env::current_exe().expect("this test has a program");
    let only = ["--exact", "viewer::tests::soak::thousands_of_random_events_do_no_harm", "--nocapture"];
    let output = std::process::Command::new(program).args(only).env(ALONE, "1").output().expect("it runs");
    let [said, complained] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success() && said.contains("1 passed"), "{said}\n{complained}");
    println!("{said}");
}

fn soak() {
    let mut window = window("cornell_spheres");
    let mut random = SmallRng::seed_from_u64(7);
    let (mut at, mut warm) = (Pos2::ZERO, 0);
    // The images of the gallery are read once.
    window.state_mut().dialogs.gallery.open = true;
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("assets").join("gallery");
    let has_picture = |scene: &PathBuf| scene.file_stem().is_some_and(|name| folder.join(name).with_extension("png").is_file());
    wait(&mut window, "the gallery", |app| {
        app.dialogs.gallery.count() == app.catalogue.iter().filter(|entry| has_picture(&entry.path)).count()
    });
    for number in 0..EVENTS {
        event(&mut window, &mut random, &mut at);
        tame(&mut window);
        if number % 500 == 499 {
            // The scene may have become another one.
            window.state_mut().loader_mut().open(Some(shipped("cornell_spheres")));
            wait(&mut window, "the scene", |app| !app.loader().is_busy());
            window.state_mut().camera_mut().resolution = [96, 64];
        }
        if number % 1000 == 700 {
            // Whatever the controls say by now, the window comes to show it.
            window.event(egui::Event::PointerGone);
            wait(&mut window, "the image of what was asked for last", |app| {
                let asked = app
                    .background
                    .worker
                    .request()
                    .is_some_and(|request| request.settings == app.settings() && request.camera == app.camera());
                let fits = asked || app.camera().check().is_err();
                fits && app.shown_frame().as_ref().is_some_and(|frame| frame.generation == app.worker().generation())
            });
        }
        if number == WARM {
            warm = settled_memory(&mut window, 0);
        }
    }
    let end = settled_memory(&mut window, warm);
    println!("memory: {} kB after {WARM} events, {} kB after {EVENTS}", warm / 1000, end / 1000);
    assert!(end < warm + warm / 20, "memory grew from {warm} to {end} bytes");
    let app = window.state();
    let shown = app.shown_frame().as_ref().expect("there is an image");
    assert_eq!(shown.generation, app.worker().generation(), "a stale frame is shown");
}

/// The fewest bytes in use, besides the texture of letters, while the image of the scene as it opens is at rest: until there are as few as this,
/// or for some seconds. Threads that were given up let go of what they looked at when they notice.
fn settled_memory(window: &mut Window, enough: usize) -> usize {
    const PATIENCE: Duration = Duration::from_secs(5);
    window.event(egui::Event::PointerGone);
    // First hits of camera rays are kept for as long as the scene is.
    *window.state_mut().look_mut() = DisplaySettings::default();
    window.state_mut().loader_mut().open(Some(shipped("cornell_spheres")));
    wait(window, "the scene", |app| !app.loader().is_busy());
    // Threads have buffers that are as large as they were needed once: new threads, new buffers.
    for threads in [2, 1] {
        window.state_mut().session.threads = threads;
        wait(window, "threads", |app| app.worker().threads() == threads);
    }
    let app = window.state_mut();
    // At rest there is one frame, and not one more for each that is on its way.
    let budget = noisefall_render::render::Budget { max_spp: Some(8), ..Default::default() };
    (app.session.budget, app.window.tab, app.session.comparison) = (budget, None, None);
    wait(window, "the image", |app| {
        app.shown_frame().as_ref().is_some_and(|frame| frame.generation == app.worker().generation() && frame.spp == 8)
    });
    let (start, mut least) = (Instant::now(), usize::MAX);
    while start.elapsed() < PATIENCE && least > enough {
        window.step();
        std::thread::sleep(Duration::from_millis(10));
        let letters = window.ctx.fonts(|fonts| fonts.font_image_size().iter().product::<usize>());
        least = least.min(MEMORY.allocated() - letters * size_of::<egui::Color32>());
    }
    least
}
