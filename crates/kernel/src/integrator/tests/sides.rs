//! Blends that show a material on each side.
use crate::integrator::{Batch, Work, trace};
use noisefall_base::math::SimdLevel;
use noisefall_scene::scene::parse;

/// Seen from its front and from its back, also where the object turns its normal round.
#[test]
fn a_blend_by_side_shows_each_side_its_material() {
    let radiance = |z: f64, flip: bool| {
        let text = format!(
            "format = 1\nenvironment.radiance = 1\n\
             camera = {{ eye = [0, 0, {z}], look_at = [0, 0, 0], fov = 5, resolution = [8, 8] }}\n\
             materials.dark.lambertian.albedo = 0.25\nmaterials.gold.conductor.reflectance = 0.75\n\
             materials.top.blend = {{ first = 'dark', second = 'gold', by_side = true }}\n\
             [[objects]]\nshape.rectangle = {{ origin = [-1, -1, 0], edge_u = [2, 0, 0], edge_v = [0, 2, 0] }}\n\
             material = 'top'\nflip = {flip}"
        );
        let scene = parse("sides.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
        let (rays, mut batch) = (scene.rays(&scene.camera), Batch::default());
        let work = Work::tile(&scene, &rays, &scene.settings, [0, 0], [8, 8], 0);
        trace(SimdLevel::best(), &work, &mut batch, &|| false).expect("nothing interrupts");
        batch.radiance().iter().map(|[r, ..]| r).sum::<f32>() / 64.0
    };
    for (z, flip, expected) in [(3.0, false, 0.25), (-3.0, false, 0.75), (3.0, true, 0.75), (-3.0, true, 0.25)] {
        let found = radiance(z, flip);
        assert!((found - expected).abs() < 0.01, "{z} {flip}: {found} {expected}");
    }
}
