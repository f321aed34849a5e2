//! Single edits: what they change, their inverses, and what is refused.
use super::*;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::{
        emission::{radiance::Radiance, texture::Texture},
        environment::constant::Constant,
    },
    material::Material,
    scene::description::EmissionSource,
    shape::{ShapeKind, Transform},
};

#[test]
fn values_are_set_by_their_paths() {
    there_and_back(&number("camera.fov", 30.0), |scene| assert_eq!(scene.camera.fov, Some(30.0)));
    there_and_back(&number("objects.1.shape.sphere.radius", 0.25), |scene| {
        assert!(matches!(&scene.objects[1].shape, ShapeKind::Sphere(sphere) if sphere.radius == 0.25));
    });
    there_and_back(&text("objects.1.name", "marble"), |scene| assert_eq!(scene.objects[1].name, "marble"));
    there_and_back(&Edit::set(path("render.estimator"), OwnedValue::Word("path")), |scene| {
        assert_eq!(scene.render.settings.estimator.name(), "path");
    });
    let albedo =
        Edit::set(path("materials.white.lambertian.albedo"), OwnedValue::Textured(Textured::Texture("tiles".to_owned())));
    there_and_back(&albedo, |scene| {
        assert!(
            matches!(&scene.materials["white"].kind, Material::Lambertian(l) if l.albedo == Textured::Texture("tiles".to_owned()))
        );
    });
}

#[test]
fn absent_tables_on_a_path_appear_and_go_again() {
    there_and_back(&number("camera.lens.radius", 0.1), |scene| assert_eq!(scene.camera.lens.map(|lens| lens.radius), Some(0.1)));
    there_and_back(&Edit::set(path("render.max_bounces"), OwnedValue::Count(5)), |scene| {
        assert_eq!(scene.render.settings.max_bounces, Some(5));
    });
    there_and_back(&Edit::set(path("environment.radiance"), OwnedValue::Colour([0.5; 3])), |scene| {
        assert_eq!(scene.environment, Some(Constant { radiance: [0.5; 3] }.into()));
    });
    there_and_back(&Edit::insert(path("objects.1.emission")), |scene| {
        assert_eq!(
            scene.objects[1].emission.as_ref().map(|emission| &emission.source),
            Some(&EmissionSource::from(Radiance { radiance: [1.0; 3] }))
        );
    });
    there_and_back(&Edit::remove(path("objects.2.emission")), |scene| assert_eq!(scene.objects[2].emission, None));
}

#[test]
fn objects_and_transforms_come_go_and_move() {
    there_and_back(&Edit::insert(path("objects.1")), |scene| {
        assert_eq!((scene.objects.len(), &*scene.objects[2].name), (4, "ball"));
    });
    there_and_back(&Edit::remove(path("objects.1")), |scene| {
        assert_eq!(scene.objects.iter().map(|object| &*object.name).collect::<Vec<_>>(), ["floor", "light"]);
    });
    there_and_back(&Edit::Move { path: path("objects.0"), to: 2 }, |scene| {
        assert_eq!(scene.objects.iter().map(|object| &*object.name).collect::<Vec<_>>(), ["ball", "light", "floor"]);
    });
    there_and_back(&Edit::insert(path("objects.1.transform.0")), |scene| {
        assert_eq!(scene.objects[1].transform, [Transform::default()]);
    });
    let (copy, at) = room().duplicate(&path("objects.1")).expect("there is an object");
    assert_eq!(at, path("objects.2"));
    there_and_back(&copy, |scene| {
        assert_eq!((&*scene.objects[2].name, &scene.objects[2].shape), ("ball 2", &scene.objects[1].shape));
    });
}

#[test]
fn materials_come_go_and_are_renamed_with_their_references() {
    there_and_back(&Edit::insert(path("materials.new")), |scene| assert!(scene.materials.contains_key("new")));
    there_and_back(&Edit::remove(path("materials.white")), |scene| assert!(!scene.materials.contains_key("white")));
    there_and_back(&Edit::Rename { path: path("materials.gold"), to: "brass".to_owned() }, |scene| {
        assert_eq!(scene.objects[1].material.as_deref(), Some("brass"));
        assert!(scene.materials.contains_key("brass") && !scene.materials.contains_key("gold"));
    });
    there_and_back(&Edit::Rename { path: path("textures.tiles"), to: "squares".to_owned() }, |scene| {
        assert!(
            matches!(&scene.materials["floor"].kind, Material::Lambertian(l) if l.albedo == Textured::Texture("squares".to_owned()))
        );
    });
    let (copy, at) = room().duplicate(&path("materials.gold")).expect("there is a material");
    assert_eq!(at, path("materials").key("gold 2"));
    there_and_back(&copy, |scene| assert_eq!(scene.materials["gold 2"], scene.materials["gold"]));
    there_and_back(&room().assign(&[0, 1, 2], Some("white")), |scene| {
        assert!(scene.objects.iter().all(|object| object.material.as_deref() == Some("white")));
    });
    there_and_back(&room().assign(&[0, 1, 2], None), |scene| {
        assert!(scene.objects.iter().all(|object| object.material.is_none()));
    });
}

#[test]
fn blends_follow_the_names_of_their_parts() {
    let mut document = room();
    let blend = document.change_kind(&path("materials.gold"), "material", "blend");
    does(&mut document, &blend);
    does(&mut document, &Edit::Rename { path: path("materials.white"), to: "paper".to_owned() });
    let Material::Blend(blend) = &document.description().materials["gold"].kind else { panic!("it is a blend") };
    assert_eq!([&blend.first, &blend.second], ["gold 2", "floor"]);
    does(&mut document, &text("materials.gold.blend.second", "paper"));
    let problem = refuses(&mut document, &Edit::remove(path("materials.paper")));
    assert_eq!(problem.message, "the material `paper` is in use");
    assert_eq!(problem.help, "use another material for `gold` first");
}

#[test]
fn an_inserted_part_has_the_texture_that_it_needs() {
    let insert = room().insert(&path("materials.white.bump"));
    there_and_back(&insert, |scene| {
        assert_eq!(scene.materials["white"].bump.as_ref().map(|bump| bump.texture.as_str()), Some("tiles"));
    });
    let mut document = room();
    does(&mut document, &Edit::set(path("materials.floor.lambertian.albedo"), OwnedValue::Textured(Textured::grey(0.5))));
    does(&mut document, &Edit::remove(path("textures.tiles")));
    let insert = document.insert(&path("materials.white.bump"));
    does(&mut document, &insert);
    assert_eq!(document.description().materials["white"].bump.as_ref().map(|bump| bump.texture.as_str()), Some("noise"));
    assert_eq!(room().insert(&path("objects.1.emission")), Edit::insert(path("objects.1.emission")));
}

#[test]
fn an_edit_that_leaves_a_file_without_a_name_is_noticed() {
    let mut document = room();
    let (map, mesh) = (path("materials.white.normal_map"), path("objects.1.shape"));
    assert_eq!(document.missing_file(&document.insert(&map), &map), Some(map.clone()));
    let choose = document.change_kind(&mesh, "shape", "mesh");
    assert_eq!(document.missing_file(&choose, &mesh), None, "a new mesh is made by a formula");
    does(&mut document, &choose);
    let from_file = Edit::choose(mesh.key("mesh"), "mesh", "path");
    assert_eq!(document.missing_file(&from_file, &mesh), Some(mesh.key("mesh").key("path")));
    assert_eq!(document.missing_file(&document.insert(&path("objects.1.emission")), &path("objects.1.emission")), None);
}

#[test]
fn several_edits_are_all_done_or_none_is() {
    let made = [Edit::insert(path("materials.clay")), text("objects.0.material", "clay"), number("camera.fov", 50.0)];
    there_and_back(&Edit::All(made.to_vec()), |scene| assert_eq!(scene.objects[0].material.as_deref(), Some("clay")));
    let mut half = made.to_vec();
    half.push(Edit::remove(path("objects.7")));
    refuses(&mut room(), &Edit::All(half));
    // The choice alone would name no texture.
    let choose = Edit::choose(path("objects.2.emission"), "emission", "texture");
    assert_eq!(refuses(&mut room(), &choose).message, "there is no texture ``");
    let both = Edit::All(vec![choose, text("objects.2.emission.texture", "tiles")]);
    there_and_back(&both, |scene| {
        let emission = scene.objects[2].emission.as_ref().expect("it emits");
        assert_eq!(emission.source, Texture { name: "tiles".to_owned() }.into());
    });
}

/// Returns the reader's error about the room with a part replaced.
#[track_caller]
fn reader_says(from: &str, to: &str) -> String {
    assert!(ROOM.contains(from));
    let error = noisefall_scene::scene::parse("room.toml", ROOM.replace(from, to)).err().expect("it is refused");
    error.to_string()
}

#[test]
fn an_edit_that_the_reader_refuses_is_refused_with_its_message() {
    let cases = [
        (number("camera.fov", 200.0), ("fov = 40", "fov = 200")),
        (number("camera.fov", f64::NAN), ("fov = 40", "fov = nan")),
        (number("objects.1.shape.sphere.radius", -1.0), ("radius = 0.5", "radius = -1.0")),
        (text("objects.1.material", "glod"), ("material = \"gold\"", "material = \"glod\"")),
        (
            Edit::set(path("materials.white.lambertian.albedo"), OwnedValue::Textured(Textured::grey(1.5))),
            ("[0.73, 0.73, 0.730]", "1.5"),
        ),
        (Edit::set(path("camera.look_at"), OwnedValue::Vector(DVec3::new(0.0, 1.0, 4.0))), ("[0.0, 1.0, 0]", "[0.0, 1.0, 4.0]")),
        (Edit::remove(path("camera.fov")), ("fov = 40\n", "")),
        (
            Edit::set(path("objects.0.shape.rectangle.edge_v"), OwnedValue::Vector(DVec3::X)),
            ("edge_v = [0.0, 0.0, -4.0]", "edge_v = [1.0, 0.0, 0.0]"),
        ),
    ];
    for (edit, (from, to)) in cases {
        let problem = refuses(&mut room(), &edit);
        assert_eq!(problem.message, reader_says(from, to), "{edit:?}");
        assert!(edit.paths()[0].holds(&problem.path) || problem.path.holds(edit.paths()[0]), "{edit:?}: {}", problem.path);
    }
}

#[test]
fn impossible_edits_are_refused() {
    let says = |edit: Edit, words: &str| {
        let problem = refuses(&mut room(), &edit);
        assert!(problem.message.contains(words), "{edit:?}: {}", problem.message);
    };
    says(Edit::remove(path("materials.gold")), "`gold` is in use");
    says(Edit::remove(path("textures.tiles")), "`tiles` is in use");
    says(Edit::remove(path("materials.silver")), "there is no `materials.silver`");
    says(Edit::remove(path("camera")), "there is no");
    says(Edit::insert(path("materials.gold")), "already");
    says(Edit::insert(path("objects.9")), "there is no");
    says(Edit::Rename { path: path("materials.gold"), to: "white".to_owned() }, "already");
    says(Edit::Rename { path: path("materials.gold"), to: String::new() }, "empty");
    says(Edit::Move { path: path("objects.0"), to: 3 }, "there is no");
    says(number("camera.zoom", 1.0), "there is no `camera.zoom`");
    says(number("materials.gold.plastic.ior", 1.4), "there is no");
    says(text("camera.fov", "wide"), "another type");
    // The lens was absent, and is afterwards.
    says(text("camera.lens.radius", "wide"), "another type");
    says(Edit::choose(path("materials.gold"), "material", "velvet"), "velvet");
    says(Edit::choose(path("materials.gold"), "shape", "sphere"), "there is no");
    let wrong = Tree(vec![crate::edit::tree::Answer::Items(3)]);
    says(Edit::Replace { path: path("camera"), tree: wrong.clone() }, "cannot hold this value");
    says(Edit::Replace { path: path("objects"), tree: wrong }, "there is no");
}

#[test]
fn references_that_are_not_defined_are_not_opened() {
    let error =
        Document::open("room.toml", &ROOM.replace("material = \"gold\"", "material = \"gild\"")).expect_err("it is refused");
    assert!(error.to_string().contains("there is no material `gild`"), "{error}");
}

#[test]
fn titles_name_an_edit_and_its_target() {
    let scene = room().description().clone();
    for (edit, title) in [
        (number("camera.fov", 1.0), "change of fov of the camera"),
        (number("materials.gold.conductor.roughness", 0.5), "change of roughness of gold"),
        (text("objects.1.name", "globe"), "renaming of ball to globe"),
        (Edit::remove(path("objects.1")), "removal of ball"),
        (Edit::remove(path("camera.lens")), "removal of lens from the camera"),
        (Edit::insert_tree(path("objects.3"), Tree::of(&mut scene.objects[1].clone())), "addition of ball"),
        (Edit::insert(path("objects.1.transform.0")), "addition of transform 1 to ball"),
        (Edit::choose(path("objects.1.shape"), "shape", "sphere_field"), "change of ball to sphere field"),
        (Edit::choose(path("materials.gold"), "material", "mirror"), "change of gold to mirror"),
        (Edit::Rename { path: path("materials.gold"), to: "brass".to_owned() }, "renaming of gold to brass"),
    ] {
        assert_eq!(edit.title(&scene), title);
    }
    let bump = Edit::All(vec![Edit::insert(path("textures.noise")), Edit::insert(path("materials.gold.bump"))]);
    assert_eq!(bump.title(&scene), "addition of bump to gold", "the texture serves the bump");
}
