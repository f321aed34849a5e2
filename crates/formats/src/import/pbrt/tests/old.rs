//! Scenes of pbrt-v3.
use super::{error, imported, remarks, world};
use crate::import::Imported;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::{emission::EmissionSource, environment::EnvironmentDescription, punctual_light::PunctualLightKind},
    material::Roughness,
    model::Model,
    sampling::Filter,
    scene::{
        Estimator,
        description::{Material, ShapeKind, TextureKind},
    },
    shape::mesh::MeshSource,
};

/// The material of the first object.
fn kind(found: &Imported) -> &Material {
    let name = found.description.objects[0].material.as_ref().expect("it has a material");
    &found.description.materials[name].kind
}

fn material(text: &str) -> Imported {
    world(&format!("Material {text}\nShape \"sphere\"\nWorldEnd"))
}

fn grey(value: f64) -> Textured {
    Textured::Constant([value; 3])
}

#[test]
fn a_small_scene_is_read_with_one_remark() {
    let found = imported(
        "LookAt 0 0 4 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" [45]\nSampler \"02sequence\" \"integer pixelsamples\" 8\n\
         PixelFilter \"gaussian\" \"float xwidth\" [1.5] \"float ywidth\" [1.5] \"float alpha\" [2]\n\
         Film \"image\" \"string filename\" \"a.exr\" \"float scale\" [0.5]\nWorldBegin\n\
         LightSource \"infinite\" \"color L\" [1 1 1] \"color scale\" [2 2 4]\nMaterial \"matte\" \"color Kd\" [.5 .25 .125]\n\
         Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]\nWorldEnd\n",
    );
    assert_eq!((found.description.camera.resolution, found.description.render.spp), ([640, 480], Some(8)));
    assert_eq!(imported("Film \"image\"\nWorldBegin\nWorldEnd").description.camera.filter, Filter::Box);
    assert!(matches!(found.description.camera.filter, Filter::Gaussian(gaussian) if gaussian.sigma == 0.5));
    let Some(EnvironmentDescription::Constant(sky)) = &found.description.environment else { panic!("a sky") };
    assert_eq!(sky.radiance, [1.0, 1.0, 2.0]);
    assert!(matches!(kind(&found), Material::Lambertian(matte) if matte.albedo == Textured::Constant([0.5, 0.25, 0.125])));
    let lines = remarks(&found);
    assert!(lines.len() == 1 && lines[0].contains("pbrt-v3"), "{lines:?}");
}

#[test]
fn materials_have_their_counterparts() {
    let of = |text: &str| kind(&material(text)).clone();
    assert!(matches!(of("\"matte\""), Material::Lambertian(matte) if matte.albedo == grey(0.5)));
    assert!(matches!(of("\"mirror\""), Material::Mirror(mirror) if mirror.reflectance == grey(0.9)));
    let glass = of("\"glass\" \"float index\" 1.25 \"rgb Kt\" [.5 .5 .5]");
    let Material::Dielectric(glass) = glass else { panic!("glass") };
    assert_eq!((glass.ior, glass.specular_reflectance, glass.specular_transmittance), (1.25, grey(1.0), grey(0.5)));
    assert_eq!(glass.roughness, Roughness::SMOOTH);
    let Material::Conductor(metal) = of("\"metal\" \"float roughness\" 1") else { panic!("metal") };
    assert!(matches!(metal.roughness, Roughness::Alpha(Textured::Constant(1.0))), "{:?}", metal.roughness);
    let Material::Plastic(plastic) = of("\"plastic\" \"rgb Kd\" [.1 .1 .1] \"rgb Ks\" [1 1 1]") else { panic!("plastic") };
    assert!((plastic.ior - 1.5).abs() < 1e-6 && plastic.albedo == grey(0.1), "{plastic:?}");
    assert!(matches!(of("\"plastic\" \"rgb Ks\" [0 0 0]"), Material::Lambertian(matte) if matte.albedo == grey(0.25)));
    let Material::DiffuseTransmission(leaf) = of("\"translucent\" \"rgb Kd\" [.5 .5 .5]") else { panic!("a leaf") };
    assert_eq!((leaf.reflectance, leaf.transmittance), (grey(0.25), grey(0.25)));
    let Material::Disney(disney) = of("\"disney\" \"float metallic\" .75 \"rgb color\" [.5 .5 .5]") else { panic!("disney") };
    assert_eq!((disney.metallic, disney.clearcoat_gloss), (Textured::Constant(0.75), Textured::Constant(1.0)));
    for other in ["substrate", "uber", "kdsubsurface"] {
        assert!(matches!(of(&format!("\"{other}\"")), Material::Plastic(_)), "{other}");
    }
    assert!(matches!(of("\"fourier\" \"string bsdffile\" \"a.bsdf\""), Material::Lambertian(_)));
    assert!(matches!(of("\"uber\" \"rgb Kt\" [1 1 1]"), Material::Dielectric(_)));
}

#[test]
fn the_amount_of_a_mix_is_that_of_the_first() {
    let found = world(
        "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"rgb Kd\" [1 0 0]\n\
         MakeNamedMaterial \"b\" \"string type\" \"matte\"\n\
         Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" \"color amount\" [.25 .25 .25]\n\
         Shape \"sphere\"",
    );
    let Material::Blend(blend) = kind(&found) else { panic!("a blend") };
    assert_eq!((blend.first.as_str(), blend.second.as_str(), &blend.weight), ("b", "a", &Textured::Constant(0.25)));
}

#[test]
fn opacity_and_bumps_are_those_of_the_material() {
    let found = material("\"uber\" \"rgb opacity\" [.5 .5 .5]");
    let name = found.description.objects[0].material.as_ref().expect("it has a material");
    assert_eq!(found.description.materials[name].opacity, Some(Textured::Constant(0.5)));
    let found = world(
        "Texture \"t\" \"float\" \"checkerboard\"\nMaterial \"matte\" \"texture bumpmap\" \"t\"\nShape \"sphere\"\nWorldEnd",
    );
    let name = found.description.objects[0].material.as_ref().expect("it has a material");
    assert!(found.description.materials[name].bump.is_some());
}

#[test]
fn textures_and_lights_have_their_old_names() {
    let found = world(
        "Texture \"a\" \"color\" \"checkerboard\"\n\
         Texture \"b\" \"color\" \"scale\" \"texture tex1\" \"a\" \"color tex2\" [.5 .5 .5]\n\
         Material \"matte\" \"texture Kd\" \"b\"\nAreaLightSource \"area\" \"color L\" [3 3 3] \"integer nsamples\" 4\nShape \"sphere\"\n\
         LightSource \"point\" \"color I\" [1 1 1] \"color scale\" [2 3 4] \"point from\" [0 1 0]\nWorldEnd",
    );
    let Material::Lambertian(matte) = kind(&found) else { panic!("matte") };
    let Textured::Texture(name) = &matte.albedo else { panic!("a texture") };
    assert!(matches!(found.description.textures[name], TextureKind::Product(_)));
    let emission = found.description.objects[0].emission.as_ref().expect("it emits");
    assert!(matches!(&emission.source, EmissionSource::Radiance(constant) if constant.radiance == [3.0; 3]));
    assert!(
        matches!(&found.description.punctual_lights[0].kind, PunctualLightKind::Point(point) if point.intensity == [2.0, 3.0, 4.0])
    );
    assert_eq!(remarks(&found).len(), 1, "{:?}", remarks(&found));
}

#[test]
fn shapes_are_meshes() {
    let model = |text: &str| {
        let found = world(&format!("Shape {text}"));
        let ShapeKind::Mesh(mesh) = &found.description.objects[0].shape else { panic!("a mesh") };
        let MeshSource::File(path) = &mesh.source else { panic!("a file") };
        Model::clone(&found.assets.get::<Model>(path).expect("it is among the assets"))
    };
    let near = |found: f32, expected: f32| (found - expected).abs() < 1e-5;
    let cone = model("\"cone\" \"float radius\" 2 \"float height\" 3");
    assert!(cone.vertices.iter().all(|[x, y, z]| near(x.hypot(*y), 2.0 * (1.0 - z / 3.0))));
    let bowl = model("\"paraboloid\" \"float radius\" 2 \"float zmax\" 4");
    assert!(bowl.vertices.iter().all(|[x, y, z]| near(x * x + y * y, *z)));
    let waist = model("\"hyperboloid\" \"point p1\" [1 0 0] \"point p2\" [1 1 1]");
    assert!(waist.vertices.iter().all(|[x, y, z]| near(x * x + y * y, 1.0 + z * z)));
    for surface in [cone, bowl, waist] {
        let normals = surface.normals.as_ref().expect("normals");
        // Normals are right angles to the triangles, within their size.
        let is_right = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| glam::Vec3::from(surface.vertices[i as usize]));
            let normal = (b - a).cross(c - a).normalize_or_zero();
            normal == glam::Vec3::ZERO || normal.dot(glam::Vec3::from(normals[triangle[1] as usize])) > 0.99
        };
        assert!(surface.triangles.iter().filter(|triangle| !is_right(triangle)).count() < 300);
    }
    let hills = model("\"heightfield\" \"integer nu\" 3 \"integer nv\" 2 \"float Pz\" [0 1 2 3 4 5]");
    assert_eq!((hills.triangles.len(), hills.vertices[4]), (4, [0.5, 1.0, 4.0]));
    assert!(error("WorldBegin\nShape \"heightfield\" \"integer nu\" 3").contains("has 0 values"));
    let square = model("\"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0] \"float st\" [0 0 1 0 0 1]");
    assert_eq!(square.uvs.map(|uvs| uvs[1]), Some([1.0, 0.0]));
}

#[test]
fn integrators_have_the_nearest_estimator() {
    let settings = |kind: &str| imported(&format!("Integrator \"{kind}\"\nWorldBegin\nWorldEnd")).description.render.settings;
    for kind in ["whitted", "directlighting"] {
        assert_eq!(settings(kind), settings("path"), "{kind}");
    }
    assert_eq!((settings("bdpt").estimator, settings("bdpt").merging), (Estimator::Bidirectional, false));
    assert_eq!((settings("sppm").estimator, settings("sppm").merging), (Estimator::Bidirectional, true));
}

#[test]
fn constructs_of_neither_version_are_refused() {
    assert!(error("WorldBegin\nSurface \"x\"").contains("not a directive of pbrt-v4 or pbrt-v3"));
    assert!(error("WorldBegin\nMaterial \"clay\"\nShape \"sphere\"").contains("not a material of pbrt-v4 or pbrt-v3"));
}

#[test]
fn the_last_of_equal_parameters_counts() {
    let found = world(
        "Material \"diffuse\" \"rgb reflectance\" [1 0 0] \"rgb reflectance\" [0 1 0]\nShape \"sphere\" \"float radius\" 1 \"float radius\" 2\n\
         LightSource \"point\" \"rgb I\" [1 1 1] \"blackbody I\" 5000 \"rgb I\" [2 2 2]",
    );
    assert!(matches!(kind(&found), Material::Lambertian(green) if green.albedo == Textured::Constant([0.0, 1.0, 0.0])));
    assert!(matches!(&found.description.punctual_lights[0].kind, PunctualLightKind::Point(point) if point.intensity == [2.0; 3]));
    let lines = remarks(&found).join("\n");
    assert!(lines.contains("`reflectance` twice") && lines.contains("`radius` twice") && lines.contains("`I` twice"), "{lines}");
}
