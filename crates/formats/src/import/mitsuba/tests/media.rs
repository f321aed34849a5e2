//! Participating media.
use super::{SENSOR, refused, remarks, scene};
use crate::import::Imported;
use noisefall_scene::material::Material;

const VOLPATH: &str = "<integrator type=\"volpath\"/>";

fn glass(medium: &str) -> String {
    format!("{VOLPATH}{SENSOR}<shape type=\"sphere\"><bsdf type=\"dielectric\" id=\"glass\"/>{medium}</shape>")
}

/// The transmittance of the glass of each object.
fn transmittances(imported: &Imported) -> Vec<[f64; 3]> {
    let of = |name: &String| match &imported.description.materials[name].kind {
        Material::Dielectric(glass) => glass.transmittance,
        other => panic!("{other:?}"),
    };
    imported.description.objects.iter().filter_map(|object| object.material.as_ref()).map(of).collect()
}

#[test]
fn media_that_only_absorb_fill_glass() {
    let medium = |values: &str| format!("<medium name=\"interior\" type=\"homogeneous\">{values}</medium>");
    let expected = [0.5, 1.0, 0.0].map(|absorbed: f64| (-2.0 * absorbed).exp());
    for values in [
        "<rgb name=\"sigma_t\" value=\"0.5 1 0\"/><float name=\"albedo\" value=\"0\"/><float name=\"scale\" value=\"2\"/>",
        "<rgb name=\"sigma_a\" value=\"1 2 0\"/><phase type=\"isotropic\"/>",
        "<rgb name=\"sigma_a\" value=\"1 2 0\"/><rgb name=\"sigma_s\" value=\"0\"/>",
        "<volume name=\"sigma_t\" type=\"constvolume\"><rgb name=\"value\" value=\"1 2 0\"/></volume><rgb name=\"albedo\" value=\"0\"/>",
    ] {
        let imported = scene(&glass(&medium(values)));
        assert_eq!(transmittances(&imported), [expected], "{values}");
        assert!(imported.remarks.is_empty(), "{:?}", remarks(&imported));
    }
    for scattering in ["", "<float name=\"albedo\" value=\"0.1\"/>", "<rgb name=\"sigma_s\" value=\"1\"/>"] {
        assert!(refused(&glass(&medium(scattering))).contains("participating medium"));
    }
    let varying = "<medium name=\"interior\" type=\"heterogeneous\"><volume name=\"sigma_t\" type=\"gridvolume\"/>\
        <rgb name=\"albedo\" value=\"0\"/></medium>";
    assert!(refused(&glass(varying)).contains("participating medium"));
}

#[test]
fn one_bsdf_can_hold_several_media() {
    let absorbing = |id: &str, sigma: f64| {
        format!(
            "<medium type=\"homogeneous\" id=\"{id}\"><float name=\"sigma_t\" value=\"{sigma}\"/><float name=\"albedo\" value=\"0\"/></medium>"
        )
    };
    let ball = |media: &str| format!("<shape type=\"sphere\"><ref id=\"glass\"/>{media}</shape>");
    let [a, b] = ["<ref name=\"interior\" id=\"a\"/>", "<ref name=\"interior\" id=\"b\"/>"];
    let definitions = format!("{}{}<bsdf type=\"dielectric\" id=\"glass\"/>", absorbing("a", 1.0), absorbing("b", 3.0));
    let bubble = "<ref name=\"exterior\" id=\"a\"/>";
    let text = format!("{VOLPATH}{SENSOR}{definitions}{}{}{}{}{}", ball(a), ball(b), ball(a), ball(""), ball(bubble));
    let imported = scene(&text);
    let [one, three] = [1.0_f64, 3.0].map(|sigma| [(-sigma).exp(); 3]);
    assert_eq!(transmittances(&imported), [one, three, one, [1.0; 3], [1.0; 3]]);
    assert_eq!((imported.description.materials.len(), imported.remarks.len()), (3, 0));
    // Without a ball of it around, the medium outside is reported.
    let lone = scene(&format!("{VOLPATH}{SENSOR}{definitions}{}", ball(bubble)));
    assert!(remarks(&lone)[0].contains("empty space outside"), "{:?}", remarks(&lone));
}

#[test]
fn integrators_of_surfaces_see_no_media() {
    let text = glass("<medium name=\"interior\" type=\"homogeneous\"/>");
    let imported = scene(&text.replace("volpath", "path"));
    assert_eq!(transmittances(&imported), [[1.0; 3]]);
    assert_eq!(remarks(&imported), ["`<medium name=\"interior\" type=\"homogeneous\">` → empty space"]);
}

#[test]
fn boundaries_without_a_surface_become_interfaces() {
    let absorbing = "<medium name=\"interior\" type=\"homogeneous\"><float name=\"albedo\" value=\"0\"/></medium>";
    let imported = scene(&glass(absorbing).replace("dielectric", "null"));
    assert_eq!((transmittances(&imported), imported.remarks.len()), (vec![[(-1.0_f64).exp(); 3]], 1));
    let camera = format!("{VOLPATH}{}", SENSOR.replace("<film", &format!("{absorbing}<film")));
    assert!(refused(&camera).contains("around the camera"));
}
