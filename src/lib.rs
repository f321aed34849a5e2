//! Noisefall is a progressive path tracer: it solves the light transport equation by Monte Carlo integration.
//!
//! | task | items |
//! |---|---|
//! | read a scene file of any format | [`load`], [`parse`], [`SceneError`] |
//! | read one with options, and list what was not imported exactly | [`open`], [`ImportOptions`], [`Remarks`] |
//! | build a scene in code | [`description`] |
//! | change a scene file, and undo the change | [`edit`] |
//! | choose settings | [`RenderSettings`], [`Camera`] |
//! | render a number of samples | [`Threads::pass`] into a [`Film`] |
//! | render progressively, with cancellation | [`Renderer`], which publishes [`Frame`]s |
//! | render a scene again after a change | [`rebuild`](description::SceneDescription::rebuild), [`Renderer::edit`] |
//! | show or save an image | [`to_srgb`], [`image_file::save`] |
//! | measure an error | [`Reference`], [`compare`], [`exact`] |
//! | compare the renderer with exact solutions | `validate`, with the feature `reports` |
//!
//! The folder `examples/` has programs for these tasks. Changes of scenes have their examples at the items, and the last task is
//! the command `noisefall validate`.
//!
//! ```
//! use noisefall::{Film, Frame, PassJob, SimdLevel, Threads, parse};
//!
//! // Inside a closed sphere that emits 1 and reflects half, the radiance is 2.
//! let scene = parse("furnace.toml", include_str!("../scenes/furnace.toml").to_owned())?;
//! let camera = noisefall::Camera { resolution: [16, 16], ..scene.camera };
//! let mut film = Film::new(camera.resolution);
//! let job = PassJob { scene: &scene, rays: &scene.rays(&camera), settings: &scene.settings };
//! Threads::new(1, SimdLevel::best())?.pass(job, &mut film, 64, &|| false);
//!
//! let frame = Frame::of_film(&film, 0, camera.resolution, camera.resolution);
//! let mean = frame.radiance.iter().map(|rgb| rgb[0]).sum::<f32>() / frame.radiance.len() as f32;
//! assert!((mean - 2.0).abs() < 0.05);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! This page lists what programs may rely on. The binary, the benches and the integration tests of this package also use the modules
//! behind it. Those are `pub` for that reason alone, hidden in this documentation, and change without notice.
#![warn(missing_docs)]

#[doc(hidden)]
pub mod declare;
pub mod edit;
#[doc(hidden)]
pub mod export;
#[doc(hidden)]
pub mod file;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod image;
#[doc(hidden)]
pub mod import;
#[doc(hidden)]
pub mod integrator;
#[doc(hidden)]
pub mod light;
#[doc(hidden)]
pub mod material;
#[doc(hidden)]
pub mod math;
#[doc(hidden)]
pub mod measure;
#[doc(hidden)]
pub mod memory;
#[doc(hidden)]
pub mod model;
mod parallel;
pub mod progress;
#[doc(hidden)]
pub mod quote;
#[doc(hidden)]
pub mod render;
#[doc(hidden)]
pub mod render_file;
#[cfg(feature = "reports")]
#[doc(hidden)]
pub mod report;
#[doc(hidden)]
pub mod sampling;
#[doc(hidden)]
pub mod scene;
#[doc(hidden)]
pub mod shape;
#[cfg(feature = "reports")]
#[doc(hidden)]
pub mod study;
#[doc(hidden)]
pub mod texture;
#[cfg(feature = "reports")]
pub mod validate;

#[doc(inline)]
pub use self::{
    declare::{Assets, PartReport, Precision},
    import::{ImportOptions, Opened, Remark, Remarks, load, open},
    math::SimdLevel,
    measure::{Bias, Comparison, Evidence, Floor, compare, exact},
    memory::set_limit as set_memory_limit,
    render::{
        Budget, Display, EditResult, Frame, Publish, Published, Region, RenderRequest, RenderTask, Renderer, SampleCounts,
        SceneEdit, State, Status, Target, ToneMap, WhiteBalance,
        film::Film,
        image_file,
        pass::{Failure, PassCount, SampleId},
        threads::{PassJob, Threads},
        tone::to_srgb,
        truth::Reference,
    },
    sampling::{Directions, Filter, Sampler},
    scene::{
        Camera, CameraError, CameraRays, CompileReport, Estimator, Lens, RenderSettings, Reuse, Roulette, Scene, SceneError,
        Shutter, built_in, parse,
    },
};

/// Scenes built in code.
///
/// [`SceneDescription::build`](description::SceneDescription::build) checks a description as the reader of scene files does, and
/// compiles it:
///
/// ```
/// use std::path::Path;
///
/// use noisefall::description::{EmissionDescription, SceneDescription, materials::Lambertian, shapes::{Rectangle, Sphere}};
///
/// let mut scene = SceneDescription::default();
/// scene.add_material("white", Lambertian { albedo: [0.7, 0.7, 0.6].into() });
/// scene.add_object("floor", Rectangle::default()).material = Some("white".to_owned());
/// scene.add_object("lamp", Sphere::default()).emission = Some(EmissionDescription::radiance([3.0; 3]));
/// assert_eq!(scene.build(Path::new("."))?.objects.len(), 2);
///
/// scene.camera.look_at = scene.camera.eye;
/// let error = scene.build(Path::new(".")).err().expect("the camera has no direction");
/// assert!(error.to_string().contains("`eye` and `look_at` are the same point"));
/// # Ok::<(), noisefall::SceneError>(())
/// ```
pub mod description {
    #[doc(inline)]
    pub use crate::scene::description::{
        BackgroundDescription, CameraDescription, DVec3, EmissionDescription, EmissionSource, ObjectDescription, Projection,
        RenderDescription, SceneDescription, TruthDescription,
    };

    /// Materials and their parameters.
    pub mod materials {
        #[doc(inline)]
        pub use crate::{
            declare::Textured,
            material::{Material, Reflectance, Roughness, kinds::*},
            scene::description::{Bump, MaterialDescription},
        };
    }

    /// Shapes and their transforms.
    pub mod shapes {
        #[doc(inline)]
        pub use crate::shape::{
            Bounds, Rotation, ShapeKind, Transform,
            kinds::*,
            mesh::{Heightfield, Knot, MeshSource},
        };
    }

    /// Textures.
    pub mod textures {
        #[doc(inline)]
        pub use crate::texture::{
            TextureKind,
            image::{Channel, TexelFilter, Wrap},
            kinds::*,
            ramp::Stop,
        };
    }
}
