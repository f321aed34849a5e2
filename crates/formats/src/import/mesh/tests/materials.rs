//! Materials of MTL files.
use super::{
    super::{
        map::Map,
        mtl::{self, Mtl},
    },
    SQUARE, scene,
};
use crate::import::{Imported, Remarks};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    material::{Conductor, Dielectric, Lambertian, Material, Plastic, Reflectance, Roughness},
    scene::description::{EmissionSource, MaterialDescription},
    texture::{
        TextureKind,
        image::{Channel, Image, Wrap},
    },
};

fn with(mtl: &str, others: &[(&str, &[u8])]) -> Imported {
    let obj = format!("mtllib my lib.mtl\n{SQUARE}usemtl a b\nf 1/1 2/2 3/3\n");
    let library = format!("# by hand\nnewmtl a b\n{mtl}");
    let mut files = others.to_vec();
    files.push(("my lib.mtl", library.as_bytes()));
    scene(&obj, &files)
}

fn material(mtl: &str) -> MaterialDescription {
    with(mtl, &[]).description.materials["a b"].clone()
}

#[test]
fn classic_materials_are_told_by_their_illumination_and_colors() {
    let grey = |x| Textured::Constant([x; 3]);
    assert_eq!(material("Kd 0.5 0.5 0.5\nKs 1 1 1\nillum 1\n").kind, Lambertian { albedo: grey(0.5) }.into());
    assert_eq!(material("Kd 0.5\nKs 0 0 0\nNs 10\n").kind, Lambertian { albedo: grey(0.5) }.into());
    let plastic = Plastic { albedo: grey(0.5), ior: 1.25, roughness: Roughness::alpha(0.5) };
    assert_eq!(material("Kd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 6\nNi 1.25\nillum 2\n").kind, plastic.into());
    let metal = Conductor {
        fresnel: Reflectance::Schlick(Textured::Constant([1.0, 0.75, 0.25])),
        roughness: Roughness::alpha(0.0),
        ..Conductor::default()
    };
    assert_eq!(material("Kd 0 0 0\nKs 1 0.75 0.25\nNs 1e6\nillum 5\n").kind, metal.into());
    let glass: Material = Dielectric { ior: 1.25, ..Dielectric::default() }.into();
    assert_eq!(material("Kd 0 0 0\nNi 1.25\nTf 1 1 1\nillum 7\n").kind, glass);
    let thin = material("Kd 1 1 1\nNi 1.25\nd 0.1\nillum 9\n");
    assert_eq!((thin.kind, thin.opacity), (glass, None));
}

#[test]
fn opacity_is_d_or_one_minus_tr() {
    assert_eq!(material("Kd 1\nd 0.25\n").opacity, Some(Textured::Constant(0.25)));
    assert_eq!(material("Kd 1\nTr 0.25\n").opacity, Some(Textured::Constant(0.75)));
    assert_eq!(material("Kd 1\nd -halo 1\nTr 1\n").opacity, None);
    assert_eq!(material("Kd 1\nd 0\n").opacity, Some(Textured::Constant(0.0)));
}

#[test]
fn a_transparency_of_1_alone_is_the_opacity_of_mesh_lab() {
    let scene = with("Kd 1\nTr 1.0\n", &[]);
    assert_eq!(scene.description.materials["a b"].opacity, None);
    assert!(scene.remarks.lines(9).join("\n").contains("`Tr 1` without `d` → an opaque surface"), "{:?}", scene.remarks.lines(9));
    assert_eq!(material("Kd 1\nTr 1\nd 0.5\n").opacity, Some(Textured::Constant(0.5)));
}

#[test]
fn parts_above_1_are_cut_with_a_remark() {
    for (text, key) in [("d 2", "d"), ("Pm 7", "Pm"), ("Pr 1.5", "Pr")] {
        let scene = with(&format!("Kd 1\n{text}\n"), &[]);
        let lines = scene.remarks.lines(9).join("\n");
        assert!(lines.contains(&format!("`{key}` above 1 → 1")), "{lines}");
        assert_eq!(scene.description.materials["a b"].opacity, None);
    }
}

#[test]
fn maps_above_1_are_cut_with_a_remark() {
    let pfm = [b"Pf\n1 1\n-1\n".to_vec(), 3.0f32.to_le_bytes().to_vec()].concat();
    let scene = with("Kd 1\nmap_d -mm 0 2 a.pfm\n", &[("a.pfm", &pfm)]);
    let Some(Textured::Texture(opacity)) = &scene.description.materials["a b"].opacity else { panic!("a texture") };
    let TextureKind::Ramp(ramp) = &scene.description.textures[opacity] else { panic!("a ramp") };
    assert!((ramp.stops[1].at - 1.0 / 6.0).abs() < 1e-12 && ramp.stops[1].color == [1.0; 3]);
    assert!(scene.remarks.lines(9).join("\n").contains("above 1 → 1"), "{:?}", scene.remarks.lines(9));
}

#[test]
fn images_are_found_in_every_spelling() {
    let file = [("Red #1.png", &b"not looked at"[..])];
    let names = ["Red #1.png", "\"Red #1.png\"", "red #1.PNG", "Red #1.png # a comment", "Red #1.png #a #b", "C:\\x\\Red #1.png"];
    for name in names {
        let scene = with(&format!("map_Kd {name}\n"), &file);
        let image = scene.description.textures.values().next();
        let found = matches!(image, Some(TextureKind::Image(image)) if image.path == "Red #1.png");
        assert!(found, "{name}: {:?}", scene.remarks.lines(9));
    }
}

#[test]
fn physical_keys_make_a_principled_material() {
    let Material::Principled(found) = material("Kd 0.5 0.25 0.125\nPm 0.75\nPr 0.5\nPc 0.25\nanisor 0.25\n").kind else {
        panic!("it is principled")
    };
    assert_eq!(found.base_color, Textured::Constant([0.5, 0.25, 0.125]));
    let numbers = [&found.base_metalness, &found.specular_roughness, &found.coat_weight];
    assert_eq!(numbers.map(Clone::clone), [0.75, 0.5, 0.25].map(Textured::Constant));
    assert_eq!(found.tangent_rotation, 90.0);
}

#[test]
fn emission_is_a_radiance() {
    let scene = with("Kd 0\nKe 1 2 3\n", &[]);
    let emission = scene.description.objects[0].emission.as_ref().expect("it emits");
    let EmissionSource::Radiance(radiance) = &emission.source else { panic!("a constant") };
    assert_eq!((radiance.radiance, emission.two_sided), ([1.0, 2.0, 3.0], true));
    assert!(with("Ke 0 0 0\n", &[]).description.objects[0].emission.is_none());
    let pfm = |pixel: f32| [b"Pf\n1 1\n-1\n".to_vec(), pixel.to_le_bytes().to_vec()].concat();
    let shown = |text: &str, pixel: f32| with(text, &[("a.pfm", &pfm(pixel))]);
    for text in ["Ke 1 1 1\nmap_Ke a.pfm\n", "map_Ke a.pfm\n"] {
        let dark = shown(text, 0.0);
        assert!(dark.description.objects[0].emission.is_none());
        assert!(dark.remarks.lines(9).join("").contains("a black image of `Ke` → no emission"), "{:?}", dark.remarks.lines(9));
        assert!(shown(text, 1.0).description.objects[0].emission.is_some());
    }
}

#[test]
fn textures_have_options_and_names_with_spaces() {
    let map = Map::read("-s 2 3 1 -o 0.5 -clamp on -bm 0.5 -mm 0 2 -imfchan g -texres 512 my wood.png ").expect("a name");
    assert_eq!((map.path.as_str(), map.scale, map.offset), ("my wood.png", [2.0, 3.0], [0.5, 0.0]));
    assert_eq!((map.clamps, map.bump, map.range, map.channel), (true, 0.5, [0.0, 2.0], Some(Channel::Green)));
    assert!(map.unknown.is_empty());
    assert_eq!(Map::read("-s 2 7.png").map(|map| map.path), Some("7.png".to_owned()));
    assert_eq!(Map::read("-s 1 1 1 7").map(|map| map.path), Some("7".to_owned()));
    assert_eq!((Map::read(""), Map::read("-clamp on")), (None, None));
}

#[test]
fn v_of_textures_points_upwards() {
    let scene = with("map_Kd -s 2 3 -o 0.5 0.25 C:\\textures\\wood.png\n", &[("wood.png", b"not looked at")]);
    let Some(TextureKind::Image(image)) = scene.description.textures.get("wood") else { panic!("an image") };
    let expected =
        Image { path: "wood.png".to_owned(), scale: [2.0, 3.0], offset: [0.5, -2.25], wrap_u: Wrap::Repeat, ..Image::default() };
    assert_eq!(*image, expected);
    // A point at v upwards lies at 1 − v; its image at 1 − (3 v + 0.25).
    let v: f64 = 0.3;
    assert!((image.scale[1] * (1.0 - v) + image.offset[1] - (1.0 - (3.0 * v + 0.25))).abs() < 1e-12);
}

#[test]
fn missing_libraries_and_textures_are_remarks_with_grey_and_constants() {
    let lost = scene(&format!("mtllib lost.mtl\n{SQUARE}usemtl a\nf 1 2 3\n"), &[]);
    let lines = lost.remarks.lines(9).join("\n");
    assert!(lines.contains("`lost.mtl`: there is no such file") && lines.contains("material \"a\""), "{lines}");
    assert_eq!(lost.description.materials["a"].kind, Lambertian { albedo: Textured::grey(0.5) }.into());
    let bare = with("Kd 0.5 0.5 0.5\nmap_Kd lost.png\nmap_d a.dds\ndisp a.png\n", &[]);
    let lines = bare.remarks.lines(9).join("\n");
    for part in ["`lost.png`: there is no such file", "`a.dds` is not of a supported format", "`disp a.png`"] {
        assert!(lines.contains(part), "{part} is not in {lines}");
    }
    assert_eq!(bare.description.materials["a b"].kind, Lambertian { albedo: Textured::grey(0.5) }.into());
}

#[test]
fn files_elsewhere_are_refused() {
    let scene = scene(&format!("mtllib ../b.mtl /etc/passwd\n{SQUARE}usemtl a\nf 1 2 3\n"), &[]);
    assert!(scene.remarks.lines(9).join("").contains("library"));
}

#[test]
fn statements_are_read_in_any_notation() {
    let mut remarks = Remarks::default();
    let text = "Kd 1\r\nnewmtl a\r\n\tkd .5 1e-1 0\r\nKS xyz 0.9505 1 1.089\r\nNs 3.1+e2\r\nbump -bm 2 a.png\r\nKa 1 1 1\r\nnewmtl b\r\n";
    let found = mtl::read(text, "a.mtl", &mut remarks);
    assert_eq!((found.len(), found[1].clone(), remarks.len()), (2, ("b".to_owned(), Mtl::default()), 0));
    let material = &found[0].1;
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3);
    assert!(near(material.colour("Kd").expect("a colour"), [0.5, 0.1, 0.0]));
    assert!(near(material.colour("Ks").expect("a colour"), [1.0; 3]), "{:?}", material.colour("Ks"));
    assert!((material.number("Ns").expect("a number") - 3.1).abs() < 1e-6 && material.map("bump").is_some());
}

#[test]
fn reflectances_above_1_are_cut_in_their_image() {
    let pfm = [b"PF\n1 1\n-1\n".to_vec(), [3.0f32, 0.5, 2.0].map(f32::to_le_bytes).concat()].concat();
    let scene = with("map_Kd -mm 0 0.5 a.pfm\nmap_Ke a.pfm\n", &[("a.pfm", &pfm)]);
    let images = scene.description.textures.values().filter_map(|texture| match texture {
        TextureKind::Image(image) => Some(image.path.as_str()),
        _ => None,
    });
    assert!(images.eq(["a.pfm", "textures/a cut.exr"]), "{:?}", scene.description.textures);
    assert!(scene.remarks.lines(9).join("\n").contains("above 1 → 1"), "{:?}", scene.remarks.lines(9));
}
