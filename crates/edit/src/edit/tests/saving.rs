//! Saving writes only what changed, in the style of the file.
use super::*;
use crate::edit::Recovery;
use noisefall_base::{declare::Textured, file::faults::lose_nothing};
use noisefall_scene::{scene::describe, shape::Transform};

/// The lines that only one of two texts has, with a sign each; empty lines do not count.
fn difference(before: &str, after: &str) -> Vec<String> {
    let only = |text: &str, other: &str, sign: &str| {
        let mut others: Vec<&str> = other.lines().collect();
        let is_own = |line: &&str| match others.iter().position(|other| other == line) {
            Some(place) => {
                others.swap_remove(place);
                false
            }
            None => !line.is_empty(),
        };
        text.lines().filter(is_own).map(|line| format!("{sign} {line}")).collect::<Vec<_>>()
    };
    [only(before, after, "-"), only(after, before, "+")].concat()
}

/// The lines that edits change of a text, which then reads as what was edited.
#[track_caller]
fn changed_of(before: &str, edits: &[Edit]) -> Vec<String> {
    let mut document = Document::open("room.toml", before).unwrap_or_else(|error| panic!("{}", error.report()));
    edits.iter().for_each(|edit| drop(does(&mut document, edit)));
    let after = document.text();
    let read = describe("room.toml", after.clone()).unwrap_or_else(|error| panic!("{}\n{after}", error.report()));
    assert!(bits(&read).is_identical(&bits(document.description())), "{after}");
    difference(before, &after)
}

#[track_caller]
fn changed(edits: &[Edit]) -> Vec<String> {
    changed_of(ROOM, edits)
}

fn albedo(of: &str, albedo: Textured) -> Edit {
    Edit::set(path("materials").key(of).key("lambertian").key("albedo"), OwnedValue::Textured(albedo))
}

#[test]
fn values_change_where_they_stand() {
    assert_eq!(changed(&[number("camera.fov", 41.0)]), ["- fov = 40", "+ fov = 41"]);
    assert_eq!(changed(&[number("camera.fov", 41.5)]), ["- fov = 40", "+ fov = 41.5"]);
    let eye = Edit::set(path("camera.eye"), OwnedValue::Vector(DVec3::new(0.0, 1.25, 4.0)));
    assert_eq!(changed(&[eye]), ["- eye = [0.0, 1.0, 4.0] # at the door", "+ eye = [0.0, 1.25, 4.0] # at the door"]);
    // The 0 that has no point stays so, and the others keep theirs.
    let look = Edit::set(path("camera.look_at"), OwnedValue::Vector(DVec3::new(0.1, 1.0, 2.0)));
    assert_eq!(changed(&[look]), ["- look_at = [0.0, 1.0, 0]", "+ look_at = [0.1, 1.0, 2]"]);
    // An integer has no sign at 0.
    let behind = Edit::set(path("camera.look_at"), OwnedValue::Vector(DVec3::new(0.0, 1.0, -0.0)));
    assert_eq!(changed(&[behind]), ["- look_at = [0.0, 1.0, 0]", "+ look_at = [0.0, 1.0, -0.0]"]);
    let metal = Edit::set(path("materials.gold.conductor.roughness"), OwnedValue::TexturedNumber(Textured::Constant(1e-7)));
    assert_eq!(
        changed(&[metal]),
        [
            "- conductor = { f0 = [1.0, 0.78, 0.34], roughness = 0.30 } # worn",
            "+ conductor = { f0 = [1.0, 0.78, 0.34], roughness = 1e-7 } # worn"
        ]
    );
    assert_eq!(changed(&[text("objects.1.name", "a \"ball\"")]), ["- name = \"ball\"", "+ name = 'a \"ball\"'"]);
}

#[test]
fn colours_keep_their_form() {
    let white = "lambertian = { albedo = [0.73, 0.73, 0.730] }";
    assert_eq!(
        changed(&[albedo("white", [0.5, 0.73, 0.73].into())]),
        [format!("- {white}"), "+ lambertian = { albedo = [0.5, 0.73, 0.730] }".to_owned()]
    );
    assert_eq!(
        changed(&[albedo("white", Textured::grey(0.5))]),
        [format!("- {white}"), "+ lambertian = { albedo = [0.5, 0.5, 0.5] }".to_owned()]
    );
    let even = |colour: Textured| Edit::set(path("textures.tiles.checker.even"), OwnedValue::Textured(colour));
    let tiles = "- checker = { even = 0.8, odd = 0.1, scale = 8.0 }";
    assert_eq!(changed(&[even(Textured::grey(0.9))]), [tiles, "+ checker = { even = 0.9, odd = 0.1, scale = 8.0 }"]);
    assert_eq!(
        changed(&[even([0.9, 0.8, 0.7].into())]),
        [tiles, "+ checker = { even = [0.9, 0.8, 0.7], odd = 0.1, scale = 8.0 }"]
    );
    assert_eq!(
        changed(&[albedo("floor", Textured::grey(0.5))]),
        ["- lambertian = { albedo = { texture = \"tiles\" } }", "+ lambertian = { albedo = 0.5 }"]
    );
}

#[test]
fn new_parts_stand_where_a_person_looks_for_them() {
    let lens = number("camera.lens.radius", 0.1);
    assert_eq!(changed(std::slice::from_ref(&lens)), ["+ lens = { radius = 0.1, focus = 4.0 }"]);
    let mut document = room();
    does(&mut document, &lens);
    does(&mut document, &Edit::insert(path("objects.1.emission")));
    does(&mut document, &Edit::insert(path("environment")));
    does(&mut document, &text("notes", "Two\nlines."));
    let after = document.text();
    assert!(after.contains("resolution = [640, 480]\nlens = {"), "{after}");
    assert!(after.contains("material = \"gold\"\nemission = { radiance = 1.0 }\n"), "{after}");
    assert!(after.contains("\n\n[environment]\nradiance = 1.0\n\n[textures.tiles]"), "{after}");
    assert!(after.contains("title = \"Room\"\nnotes = \"\"\"\nTwo\nlines.\"\"\"\n"), "{after}");
    assert_eq!(changed(&[Edit::insert(path("textures.fine")), Edit::remove(path("textures.fine"))]), Vec::<String>::new());
}

#[test]
fn new_materials_and_objects_are_written_as_the_others_are() {
    let made =
        changed(&[Edit::insert(path("materials.clay")), Edit::insert(path("objects.3")), text("objects.3.material", "clay")]);
    assert_eq!(
        made,
        [
            "+ [materials.clay]",
            "+ lambertian = { albedo = 0.8 }",
            "+ [[objects]]",
            "+ shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 } }",
            "+ material = \"clay\""
        ]
    );
    let mut document = room();
    does(&mut document, &Edit::insert(path("materials.clay")));
    assert!(document.text().contains("{ texture = \"tiles\" } }\n[materials.clay]\n"), "{}", document.text());
    let (copy, _) = document.duplicate(&path("objects.1")).expect("there is an object");
    does(&mut document, &copy);
    let copied = "material = \"gold\"\n\n[[objects]]\nname = \"ball 2\"\nshape = { sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 } }\n\
                  material = \"gold\"\n\n# Above.\n[[objects]]";
    assert!(document.text().contains(copied), "{}", document.text());
}

#[test]
fn comments_go_with_their_objects() {
    let mut document = room();
    does(&mut document, &Edit::Move { path: path("objects.2"), to: 0 });
    let after = document.text();
    let order =
        ["# Above.\n[[objects]]\nname = \"light\"", "# The shell.\n\n# Below.\n[[objects]]\nname = \"floor\"", "name = \"ball\""];
    let places = order.map(|part| after.find(part).unwrap_or_else(|| panic!("{part}:\n{after}")));
    assert!(places.is_sorted(), "{after}");
    assert_eq!(difference(ROOM, &after), Vec::<String>::new());

    let mut document = room();
    does(&mut document, &Edit::remove(path("objects.0")));
    let after = document.text();
    // A comment that an empty line separates from an object is about more than this one.
    assert!(after.contains("# The shell.\n\n[[objects]]\nname = \"ball\"") && !after.contains("# Below."), "{after}");
}

#[test]
fn a_renamed_part_keeps_its_place() {
    let renamed = changed(&[Edit::Rename { path: path("materials.white"), to: "plaster wall".to_owned() }]);
    assert_eq!(renamed, ["- [materials.white]", "+ [materials.\"plaster wall\"]"]);
    let mut document = room();
    does(&mut document, &Edit::Rename { path: path("materials.white"), to: "zinc".to_owned() });
    assert!(document.text().contains("# What things are made of.\n[materials.zinc]\nlambertian"), "{}", document.text());
}

#[test]
fn another_kind_takes_the_place_of_the_former() {
    assert_eq!(
        changed(&[Edit::choose(path("objects.2.shape"), "shape", "sphere")]),
        [
            "- shape = { disk = { center = [0.0, 2.5, 0.0], normal = [0.0, -1.0, 0.0], radius = 0.4 } }",
            "+ shape = { sphere = { center = [0.0, 2.5, 0.0], radius = 0.4 } }"
        ]
    );
    let filter = |kind: &str| Edit::choose(path("camera.filter"), "filter", kind);
    assert_eq!(changed(&[filter("tent")]), ["+ filter = { tent = { radius = 1.0 } }"]);
    let gaussian = ROOM.replace("fov = 40\n", "fov = 40\nfilter = { gaussian = { sigma = 0.7 } } # soft\n");
    let former = "- filter = { gaussian = { sigma = 0.7 } } # soft";
    assert_eq!(changed_of(&gaussian, &[filter("tent")]), [former, "+ filter = { tent = { radius = 1.0 } } # soft"]);
    assert_eq!(changed_of(&gaussian, &[filter("box")]), [former, "+ filter = \"box\" # soft"]);
    let wide = number("camera.filter.gaussian.sigma", 0.75);
    assert_eq!(changed_of(&gaussian, &[wide]), [former, "+ filter = { gaussian = { sigma = 0.75 } } # soft"]);
}

#[test]
fn lists_grow_and_shrink() {
    let turned = ROOM.replace(
        "material = \"gold\"\n",
        "material = \"gold\"\ntransform = [{ scale = 2.0 }, { translate = [0.0, 1.0, 0.0] }]\n",
    );
    let line = "- transform = [{ scale = 2.0 }, { translate = [0.0, 1.0, 0.0] }]";
    let lift = Edit::insert_tree(path("objects.1.transform.2"), Tree::of(&mut Transform::Translate(DVec3::X)));
    assert_eq!(
        changed_of(&turned, &[lift]),
        [line, "+ transform = [{ scale = 2.0 }, { translate = [0.0, 1.0, 0.0] }, { translate = [1.0, 0.0, 0.0] }]"]
    );
    let drop_first = Edit::remove(path("objects.1.transform.0"));
    assert_eq!(changed_of(&turned, std::slice::from_ref(&drop_first)), [line, "+ transform = [{ translate = [0.0, 1.0, 0.0] }]"]);
    assert_eq!(changed_of(&turned, &[drop_first.clone(), drop_first]), [line]);
    let lines = turned.replace("[{ scale = 2.0 }, {", "[\n  { scale = 2.0 }, # twice\n  {");
    let lift = Edit::insert(path("objects.1.transform.2"));
    let made = changed_of(&lines, &[lift]);
    assert!(made.contains(&"+   { translate = [0.0, 0.0, 0.0] },".to_owned()), "{made:?}");
    assert!(!made.iter().any(|line| line.contains("# twice")), "{made:?}");
}

/// One scene in several styles of TOML.
const STYLES: [&str; 3] = [
    "format = 1\ncamera = { eye = [0, 1, 4], look_at = [0, 1, 0], fov = 40, resolution = [64, 48] }\n\
     materials.gold.conductor = { f0 = 0.9, roughness = 0.3 }\nmaterials.white = { lambertian.albedo = 0.7 }\n\
     objects = [\n    { name = 'a', shape.sphere = { center = [0, 0, 0], radius = 1 }, material = 'gold' }, # first\n    \
     { name = 'b', shape.sphere = { center = [2, 0, 0], radius = 1 }, material = 'gold' },\n]\n",
    "format = 1\n[materials]\ngold = { conductor = { f0 = 0.9, roughness = 0.3 } }\nwhite = { lambertian = { albedo = 0.7 } }\n\
     [[objects]]\nname = 'a'\n[objects.shape.sphere]\ncenter = [0, 0, 0]\nradius = 1\n[camera]\neye = [0, 1, 4]\nlook_at = [0, 1, 0]\n\
     fov = 40\nresolution = [64, 48]\n[[objects]]\nname = 'b'\nmaterial = 'gold'\n[objects.shape.sphere]\ncenter = [2, 0, 0]\nradius = 1\n",
    "format = 1\n[camera]\neye = [0, 1, 4]\nlook_at = [0, 1, 0]\nfov = 40\nresolution = [64, 48]\n\
     [materials.gold.conductor]\nf0 = 0.9\nroughness = 0.3\n[materials.white.lambertian.albedo]\ntexture = 't'\n\
     [textures.t.checker]\neven = 0.8\nodd = 0.1\nscale = 4\n[[objects]]\nname = 'a'\nshape.sphere.center = [0, 0, 0]\nshape.sphere.radius = 1\n\
     [[objects.transform]]\nscale = 2\n[[objects.transform]]\ntranslate = [0, 1, 0]\n[[objects]]\nname = 'b'\n\
     shape = { sphere = { center = [2, 0, 0], radius = 1 } }\nmaterial = 'gold'\n",
];

#[test]
fn every_style_of_tables_is_kept() {
    for text_before in STYLES {
        let edits = [
            number("objects.0.shape.sphere.radius", 1.5),
            text("objects.1.material", "white"),
            Edit::Rename { path: path("materials.gold"), to: "brass".to_owned() },
            Edit::choose(path("objects.1.shape"), "shape", "cuboid"),
            Edit::insert(path("objects.2")),
            text("objects.2.material", "brass"),
            Edit::insert(path("materials.new")),
            Edit::insert(path("objects.0.transform.0")),
            Edit::Move { path: path("objects.2"), to: 0 },
            Edit::remove(path("objects.2")),
            albedo("white", [0.1, 0.2, 0.3].into()),
            Edit::insert(path("objects.1.emission")),
        ];
        for count in 1..=edits.len() {
            let made = changed_of(text_before, &edits[..count]);
            assert!(!made.is_empty(), "{count}");
        }
        let one = changed_of(text_before, &edits[..1]);
        assert_eq!(one.len(), 2, "{one:?}");
    }
}

#[test]
fn line_ends_and_the_byte_order_mark_are_kept() {
    let windows = format!("\u{feff}{}", ROOM.replace('\n', "\r\n"));
    let mut document = Document::open("room.toml", &windows).unwrap_or_else(|error| panic!("{}", error.report()));
    let inverse = does(&mut document, &number("camera.fov", 41.0));
    assert_eq!(document.text(), windows.replace("fov = 40", "fov = 41"));
    does(&mut document, &inverse);
    assert_eq!(document.text(), windows);
}

#[test]
fn a_disk_that_fails_at_any_moment_leaves_the_scene_and_its_recovery_file_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let [scene, recovery] = ["room.toml", "room.recovery"].map(|name| folder.path().join(name));
    for path in [&scene, &recovery] {
        std::fs::write(path, "old").expect("it is written");
    }
    let mut document = Document::open(&scene, ROOM).unwrap_or_else(|error| panic!("{}", error.report()));
    lose_nothing(&recovery, &mut || Recovery::of(&document, None).write(&recovery).map_err(|error| error.to_string()));
    lose_nothing(&scene, &mut || document.save(&scene).map_err(|error| error.to_string()));
}
