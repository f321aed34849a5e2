//! Changes of kind: what is kept, and what is refused.
use super::*;
use noisefall_base::declare::{OneOf, Textured};
use noisefall_scene::{
    light::emission::texture::Texture,
    material::Material,
    scene::describe,
    shape::{ShapeKind, Transform},
};

#[test]
fn another_kind_keeps_the_parameters_that_both_have() {
    there_and_back(&Edit::choose(path("materials.gold"), "material", "plastic"), |scene| {
        let Material::Plastic(plastic) = &scene.materials["gold"].kind else { panic!("it is plastic") };
        let conductor = describe("room", ROOM.to_owned()).expect("it is valid").materials["gold"].kind.clone();
        assert!(matches!(conductor, Material::Conductor(conductor) if conductor.roughness == plastic.roughness));
    });
    there_and_back(&Edit::choose(path("objects.2.shape"), "shape", "sphere"), |scene| {
        assert!(matches!(&scene.objects[2].shape, ShapeKind::Sphere(s) if s.radius == 0.4 && s.center.y == 2.5));
    });
    there_and_back(&Edit::choose(path("textures.tiles"), "texture", "noise"), |scene| {
        assert!(matches!(&scene.textures["tiles"], noisefall_scene::texture::TextureKind::Noise(noise) if noise.scale == 8.0));
    });
    there_and_back(&Edit::choose(path("render.roulette"), "roulette", "off"), |scene| {
        assert_eq!(scene.render.settings.roulette, noisefall_scene::scene::Roulette::Off);
    });
}

#[test]
fn values_under_other_keys_are_not_kept() {
    let mut document = room();
    does(&mut document, &Edit::insert(path("objects.1.transform.0")));
    does(&mut document, &Edit::set(path("objects.1.transform.0.translate"), OwnedValue::Vector(DVec3::Y)));
    does(&mut document, &Edit::choose(path("objects.1.transform.0"), "transform", "scale"));
    assert_eq!(document.description().objects[1].transform, [Transform::Scale(DVec3::ONE)]);
}

#[test]
fn a_change_of_kind_takes_dependent_values_along() {
    let change = |at: &str, choice: &str, name: &str| room().change_kind(&path(at), choice, name);
    there_and_back(&change("camera.projection", "projection", "orthographic"), |scene| assert_eq!(scene.camera.fov, None));
    let mut document = room();
    does(&mut document, &change("camera.projection", "projection", "orthographic"));
    let back = document.change_kind(&path("camera.projection"), "projection", "perspective");
    does(&mut document, &back);
    assert_eq!(document.description().camera.fov, Some(40.0));
    there_and_back(&change("objects.2.emission", "emission", "texture"), |scene| {
        let emission = scene.objects[2].emission.as_ref().expect("it emits");
        assert_eq!(emission.source, Texture { name: "tiles".to_owned() }.into());
    });
    there_and_back(&change("materials.gold", "material", "blend"), |scene| {
        let Material::Blend(blend) = &scene.materials["gold"].kind else { panic!("it is a blend") };
        assert_eq!([&blend.first, &blend.second], ["gold 2", "floor"]);
        let gold = describe("room", ROOM.to_owned()).expect("it is valid").materials["gold"].clone();
        assert_eq!(scene.materials["gold 2"], gold, "the material is its first part");
    });
    assert_eq!(change("objects.1.shape", "shape", "disk"), Edit::choose(path("objects.1.shape"), "shape", "disk"));
}

#[test]
fn a_material_keeps_its_colour_under_the_key_of_its_new_kind() {
    let mut document = room();
    let constant = |rgb| Some(OwnedValue::Textured(Textured::Constant(rgb)));
    for (kind, key) in [("mirror", "reflectance"), ("principled", "base_color"), ("lambertian", "albedo")] {
        let change = document.change_kind(&path("materials.white"), "material", kind);
        does(&mut document, &change);
        assert_eq!(document.value(&path("materials.white").key(kind).key(key)), constant([0.73; 3]), "{kind}");
    }
    let change = document.change_kind(&path("materials.floor"), "material", "mirror");
    does(&mut document, &change);
    let tiles = Some(OwnedValue::Textured(Textured::Texture("tiles".to_owned())));
    assert_eq!(document.value(&path("materials.floor.mirror.reflectance")), tiles);
    // A sheet also transmits.
    let bright = Edit::set(path("materials.white.lambertian.albedo"), OwnedValue::Textured(Textured::grey(0.9)));
    does(&mut document, &bright);
    let change = document.change_kind(&path("materials.white"), "material", "diffuse_transmission");
    does(&mut document, &change);
    assert_eq!(document.value(&path("materials.white.diffuse_transmission.reflectance")), constant([0.45; 3]));
    let change = document.change_kind(&path("materials.floor"), "material", "diffuse_transmission");
    does(&mut document, &change);
    assert_eq!(
        document.value(&path("materials.floor.diffuse_transmission.reflectance")),
        constant([0.5; 3]),
        "textures can be white"
    );
}

#[test]
fn a_value_has_the_default_of_its_kind() {
    let mut document = room();
    does(&mut document, &number("camera.fov", 77.0));
    let default = |at: &str| document.default_of(&path(at));
    assert_eq!(default("materials.gold.conductor.roughness"), Some(OwnedValue::TexturedNumber(Textured::Constant(0.0))));
    let albedo = noisefall_scene::material::Lambertian::default().albedo;
    assert_eq!(default("materials.white.lambertian.albedo"), Some(OwnedValue::Textured(albedo)));
    assert_eq!(
        default("objects.1.shape.sphere.radius"),
        Some(OwnedValue::Number(noisefall_scene::shape::Sphere::default().radius))
    );
    assert!(default("objects.1.shape.cuboid.max").is_none());
}

#[test]
fn impossible_materials_are_refused_at_once() {
    let mut document = room();
    does(&mut document, &Edit::choose(path("materials.white"), "material", "diffuse_transmission"));
    let bright = Edit::set(path("materials.white.diffuse_transmission.reflectance"), OwnedValue::Textured(Textured::grey(0.8)));
    assert!(refuses(&mut document, &bright).message.contains("add up to 1.05"));
    let blend = document.change_kind(&path("materials.white"), "material", "blend");
    does(&mut document, &blend);
    let circle = Edit::set(path("materials.white.blend.first"), OwnedValue::Text("white".to_owned()));
    assert!(refuses(&mut document, &circle).message.contains("blends in a circle"));
}

#[test]
fn a_material_keeps_its_roughness_and_its_index_under_the_keys_of_its_new_kind() {
    let mut document = room();
    let constant = |x| Some(OwnedValue::TexturedNumber(Textured::Constant(x)));
    let change = document.change_kind(&path("materials.gold"), "material", "principled");
    does(&mut document, &change);
    assert_eq!(document.value(&path("materials.gold.principled.specular_roughness")), constant(0.3));
    does(&mut document, &number("materials.gold.principled.specular_ior", 1.7));
    let change = document.change_kind(&path("materials.gold"), "material", "plastic");
    does(&mut document, &change);
    let plastic = document.description().materials["gold"].kind.clone();
    let Material::Plastic(plastic) = plastic else { panic!("it is plastic") };
    assert_eq!(plastic.ior, 1.7);
}

#[test]
fn a_shape_of_another_kind_keeps_place_and_size() {
    let ball = [DVec3::new(-0.5, 0.0, -0.5), DVec3::new(0.5, 1.0, 0.5)];
    let near = |a: [DVec3; 2], b: [DVec3; 2]| a[0].distance(b[0]) < 1e-9 && a[1].distance(b[1]) < 1e-9;
    for kind in ["cuboid", "cylinder", "sphere_field"] {
        let mut document = room();
        let change = document.change_kind(&path("objects.1.shape"), ShapeKind::WHAT, kind);
        let back = does(&mut document, &change);
        let found = extent(&document, "ball");
        assert!(
            near(found, ball) || kind == "sphere_field" && found[0].cmpge(ball[0]).all() && found[1].cmple(ball[1]).all(),
            "{kind} {found:?}"
        );
        does(&mut document, &back);
        assert_eq!(document.text(), ROOM);
    }
    let mut document = room();
    for kind in ["cuboid", "sphere", "rectangle", "cylinder", "triangle", "sphere", "disk", "cuboid"] {
        let change = document.change_kind(&path("objects.1.shape"), ShapeKind::WHAT, kind);
        does(&mut document, &change);
        let [min, max] = extent(&document, "ball");
        assert!(((min + max) / 2.0).distance(DVec3::new(0.0, 0.5, 0.0)) < 0.01, "{kind} {min} {max}");
        assert!(((max - min).max_element() - 1.0).abs() < 0.02, "{kind} {min} {max}");
    }
    // A light goes on facing down.
    let mut document = room();
    let change = document.change_kind(&path("objects.2.shape"), ShapeKind::WHAT, "rectangle");
    does(&mut document, &change);
    let ShapeKind::Rectangle(light) = &document.description().objects[2].shape else { panic!("it is a rectangle") };
    assert!(light.edge_u.cross(light.edge_v).distance(DVec3::NEG_Y * 0.64) < 1e-9, "{light:?}");
    // A shape that fills a cube is placed by transforms.
    let mut document = room();
    let change = document.change_kind(&path("objects.1.shape"), ShapeKind::WHAT, "isosurface");
    does(&mut document, &change);
    assert!(near(extent(&document, "ball"), ball), "{:?}", extent(&document, "ball"));
}
