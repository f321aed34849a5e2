//! Film, pixel filter, sampler and integrator.
use super::{import::Import, options::Options, parameters::Entity};
use noisefall_scene::{
    sampling::{
        Filter,
        filter::{gaussian::Gaussian, tent::Tent},
    },
    scene::{Camera, Estimator, SceneError},
};

/// pbrt's defaults.
const RESOLUTION: [i64; 2] = [1280, 720];
/// The default of pbrt-v3.
const OLD_RESOLUTION: [i64; 2] = [640, 480];
const SAMPLES: u32 = 16;
const BOUNCES: u32 = 5;
const SIGMA: f32 = 0.5;

/// Translates what stands before the world, except for the camera.
pub fn settings(import: &mut Import, options: &Options) -> Result<(), SceneError> {
    import.description.camera.resolution = RESOLUTION.map(|side| side as u32);
    import.description.camera.filter = gaussian(f64::from(SIGMA));
    import.description.render.spp = Some(SAMPLES);
    import.description.render.settings.max_bounces = Some(BOUNCES);
    if let Some(entity) = &options.film {
        film(import, entity)?;
        if is_old(entity) {
            import.description.camera.filter = Filter::Box;
        }
    }
    if let Some(entity) = &options.filter {
        filter(import, entity)?;
    }
    if let Some(entity) = &options.sampler {
        sampler(import, entity)?;
    }
    if let Some(entity) = &options.integrator {
        integrator(import, entity)?;
    }
    for entity in [&options.film, &options.filter, &options.sampler, &options.integrator].into_iter().flatten() {
        import.remark_unused(entity);
    }
    Ok(())
}

/// Whether a film is that of pbrt-v3.
fn is_old(film: &Entity) -> bool {
    film.kind == "image"
}

fn film(import: &mut Import, entity: &Entity) -> Result<(), SceneError> {
    let [columns, rows] = if is_old(entity) {
        import.remark_old(&entity.place, &entity.shown());
        OLD_RESOLUTION
    } else {
        RESOLUTION
    };
    entity.ignore(&["filename", "diagonal", "savefp16", "coordinatesystem", "nbuckets", "lambdamin", "lambdamax"]);
    let side = |name: &str, default: i64| {
        let side = entity.integer(name, default)?;
        let most = i64::from(Camera::MOST_SIDE);
        match u32::try_from(side) {
            Ok(pixels) if (1..=most).contains(&side) => Ok(pixels),
            _ => Err(entity.error(format!("`{name}` is {side}"), format!("expected 1 to {most} pixels"))),
        }
    };
    import.description.camera.resolution = [side("xresolution", columns)?, side("yresolution", rows)?];
    for crop in ["cropwindow", "pixelbounds"] {
        import.remark_parameter(entity, crop, "the whole image", "the image is larger");
    }
    for limit in ["maxcomponentvalue", "maxsampleluminance"] {
        import.remark_parameter(entity, limit, "no limit", "outliers are not clamped");
    }
    import.remark_parameter(entity, "whitebalance", "no white balance", "colours differ as a whole");
    let sensor = entity.text("sensor").unwrap_or("cie1931").to_owned();
    if sensor != "cie1931" {
        import.remark(entity, &format!("the CIE observer for the sensor `{sensor}`"), "colours differ slightly");
    }
    // The sensor multiplies radiance by exposure time times ISO over 100.
    import.gain = entity.float("exposuretime", 1.0)? * entity.float("iso", 100.0)? / 100.0 * entity.float("scale", 1.0)?;
    if import.gain <= 0.0 {
        return Err(entity.error("the exposure of the film is not positive", "`iso`, `exposuretime` and `scale` must be"));
    }
    Ok(())
}

fn filter(import: &mut Import, entity: &Entity) -> Result<(), SceneError> {
    let kind = entity.kind.as_str();
    let default = match kind {
        "box" => 0.5,
        "gaussian" => 1.5,
        "sinc" => 4.0,
        _ => 2.0,
    };
    // pbrt-v3 calls the radius a width.
    let [x, y] = [["xradius", "xwidth"], ["yradius", "ywidth"]].map(|names| entity.float(entity.named(&names), default));
    let [x, y] = [x?, y?];
    if x != y {
        import.remark(entity, "the same radius in x and y", "the image is blurred differently along y");
    }
    let radius = x.clamp(0.01, 16.0);
    let near = "edges are a little sharper or softer";
    import.description.camera.filter = match kind {
        "box" if radius == 0.5 => Filter::Box,
        "box" => {
            import.remark(entity, "a box of a pixel", near);
            Filter::Box
        }
        "triangle" => Filter::Tent(Tent { radius: radius as f32 }),
        "gaussian" => {
            // pbrt-v3 states exp(−αx²).
            let of_alpha = entity.optional_float("alpha")?.map(|alpha| (0.5 / alpha.max(1e-9)).sqrt());
            let sigma = entity.float("sigma", of_alpha.unwrap_or(f64::from(SIGMA)))?;
            if (radius - 3.0 * sigma).abs() > 0.5 * sigma {
                import.remark(entity, "a Gaussian that ends at 3σ", near);
            }
            gaussian(sigma)
        }
        "mitchell" => {
            entity.ignore(&["B", "C"]);
            import.remark(entity, "a Gaussian", near);
            gaussian(0.3 * radius)
        }
        "sinc" => {
            entity.ignore(&["tau"]);
            import.remark(entity, "a box of a pixel", near);
            Filter::Box
        }
        other => return Err(entity.error(format!("`{other}` is not a filter of pbrt-v4"), "such as gaussian or box")),
    };
    Ok(())
}

fn gaussian(sigma: f64) -> Filter {
    Filter::Gaussian(Gaussian { sigma: sigma.clamp(0.01, 16.0) as f32 })
}

fn sampler(import: &mut Import, entity: &Entity) -> Result<(), SceneError> {
    entity.ignore(&["seed", "randomization", "jitter"]);
    let samples = match entity.kind.as_str() {
        "stratified" => entity.integer("xsamples", 4)?.saturating_mul(entity.integer("ysamples", 4)?),
        _ => entity.integer("pixelsamples", i64::from(SAMPLES))?,
    };
    import.description.render.spp = Some(u32::try_from(samples.max(1)).unwrap_or(u32::MAX));
    Ok(())
}

fn integrator(import: &mut Import, entity: &Entity) -> Result<(), SceneError> {
    let depth = entity.integer("maxdepth", i64::from(BOUNCES))?.max(0);
    import.description.render.settings.max_bounces = Some(u32::try_from(depth).unwrap_or(u32::MAX));
    entity.ignore(&[
        "lightsampler",
        "visualizestrategies",
        "visualizeweights",
        "bootstrapsamples",
        "chains",
        "mutationsperpixel",
        "sigma",
        "largestepprobability",
        "photonsperiteration",
        "radius",
        "seed",
        "samplelights",
        "samplebsdf",
        "samplephasefunction",
        "rrthreshold",
        "lightsamplestrategy",
        "strategy",
        "numiterations",
        "iterations",
        "imagewritefrequency",
        "nsamples",
    ]);
    if entity.flag("regularize", false)? {
        import.remark(entity, "no regularization", "caustics are brighter, and noisier");
    }
    match entity.kind.as_str() {
        "bdpt" => import.description.render.settings.estimator = Estimator::Bidirectional,
        "path" | "volpath" | "mlt" | "simplepath" | "simplevolpath" | "lightpath" | "randomwalk" => {}
        "sppm" => {
            import.description.render.settings.estimator = Estimator::Bidirectional;
            import.description.render.settings.merging = true;
        }
        "directlighting" | "whitted" => {
            import.remark_old(&entity.place, &entity.shown());
            let effect = "light that diffuse surfaces reflect onto others is there, too: the image is brighter";
            import.remark(entity, "path tracing", effect);
        }
        "ambientocclusion" | "function" => {
            entity.ignore(&["cossample", "maxdistance", "function", "filename", "skipbad", "imagefilename"]);
            import.remark(entity, "path tracing", "the image shows radiance instead");
        }
        other => return Err(entity.error(format!("`{other}` is not an integrator of pbrt-v4"), "such as path or volpath")),
    }
    Ok(())
}
