//! The settings a scene opens with, and what its picture must converge to.
use std::sync::Arc;

use toml::Spanned;

use crate::{
    image::{Encoding, read},
    scene::{
        RenderSettings, Roulette, Truth,
        check::{Checker, short},
        desc::{RenderDesc, TruthDesc},
        diagnostic::SceneError,
    },
};

pub fn settings(check: &Checker, desc: &RenderDesc) -> Result<(RenderSettings, Option<u32>), SceneError> {
    let roulette = desc.roulette.as_ref().map_or(Roulette::default(), |r| r.as_ref().0);
    if let (Roulette::Fixed(p), Some(r)) = (roulette, &desc.roulette)
        && !(Roulette::LEAST..=1.0).contains(&p)
    {
        return Err(check.0.error(
            r.span(),
            format!("a survival probability of {}", short(p.into())),
            "expected a number from 0.01 to 1",
        ));
    }
    if let Some(spp) = desc.spp.as_ref().filter(|spp| *spp.as_ref() == 0) {
        return Err(check.0.error(spp.span(), "`spp` is 0", "expected at least 1 sample per pixel"));
    }
    let settings = RenderSettings {
        estimator: desc.estimator.unwrap_or_default(),
        sampler: desc.sampler.unwrap_or_default(),
        directions: desc.directions.unwrap_or_default(),
        roulette,
        max_bounces: desc.max_bounces,
        reuse: desc.reuse.unwrap_or_default(),
        adaptive: desc.adaptive.unwrap_or_default(),
        seed: desc.seed.unwrap_or(0),
        #[cfg(test)]
        fault: None,
    };
    Ok((settings, desc.spp.as_ref().map(|spp| *spp.as_ref())))
}

pub fn truth(check: &Checker, desc: &Spanned<TruthDesc>) -> Result<Truth, SceneError> {
    match (&desc.as_ref().radiance, &desc.as_ref().image) {
        (Some(radiance), None) => Ok(Truth::Radiance(check.radiance(radiance)?)),
        (None, Some(image)) => {
            let path = check.path(image);
            let picture = read(&path, Encoding::Srgb)
                .map_err(|error| check.0.error(image.span(), error.to_string(), "this picture cannot be used"))?;
            Ok(Truth::Image(path, Arc::new(picture)))
        }
        _ => Err(check.0.error(
            desc.span(),
            "`truth` must say either `radiance` or `image`",
            "exactly one of them must be given here",
        )),
    }
}
