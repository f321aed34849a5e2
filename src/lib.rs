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
//! This page lists what programs may rely on. The crates below it, `noisefall-base` to `noisefall-lab`, are parts of the program: they
//! change without notice.
#![warn(missing_docs)]

#[doc(inline)]
pub use noisefall_base::{
    declare::{Assets, PartReport, Precision},
    math::SimdLevel,
    memory::set_limit as set_memory_limit,
    progress,
};
/// An edit, a drag, and their undoing:
///
/// ```
/// use noisefall::{
///     description::materials::Textured,
///     edit::{Document, Edit, History, OwnedValue, Path},
/// };
///
/// let text = "format = 1
/// camera = { eye = [0.0, 1.0, 4.0], look_at = [0.0, 1.0, 0.0], fov = 40, resolution = [640, 480] }
/// [materials.gold]
/// conductor = { f0 = [1.0, 0.78, 0.34], roughness = 0.30 } # worn
/// ";
/// let mut document = Document::open("room.toml", text)?;
/// let mut history = History::default();
///
/// // One value. A drag applies many such edits with the same gesture; they are undone together.
/// let roughness = Path::of("materials.gold.conductor.roughness");
/// let value = OwnedValue::TexturedNumber(Textured::Constant(0.4));
/// let drag = history.gesture();
/// history.drag(&mut document, &Edit::set(roughness, value), drag)?;
/// assert!(document.text().contains("roughness = 0.4 } # worn"));
///
/// // A value out of its range is refused, and nothing changes.
/// let wrong = Edit::set(Path::of("camera.fov"), OwnedValue::Number(200.0));
/// assert_eq!(history.apply(&mut document, &wrong).unwrap_err().message, "`fov` is out of range: 200");
///
/// history.undo(&mut document);
/// assert_eq!(document.text(), text);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(inline)]
pub use noisefall_edit::edit;
#[doc(inline)]
pub use noisefall_formats::import::{ImportOptions, Opened, Remark, Remarks, load, open};
#[doc(inline)]
pub use noisefall_kernel::measure::{Bias, Comparison, Evidence, Floor, compare, exact};
#[cfg(feature = "reports")]
#[doc(inline)]
pub use noisefall_lab::validate;
#[doc(inline)]
pub use noisefall_render::render::{
    Budget, Display, EditResult, Frame, Publish, Published, Region, RenderRequest, RenderTask, Renderer, SampleCounts, SceneEdit,
    State, Status, Target, ToneMap, WhiteBalance,
    film::Film,
    image_file,
    pass::{Failure, PassCount, SampleId},
    reference::Reference,
    threads::{PassJob, Threads},
    tone::to_srgb,
};
#[doc(inline)]
pub use noisefall_scene::{
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
/// scene.add_object("light", Sphere::default()).emission = Some(EmissionDescription::radiance([3.0; 3]));
/// assert_eq!(scene.build(Path::new("."))?.objects.len(), 2);
///
/// scene.camera.look_at = scene.camera.eye;
/// let error = scene.build(Path::new(".")).err().expect("the camera has no direction");
/// assert!(error.to_string().contains("`eye` and `look_at` are the same point"));
/// # Ok::<(), noisefall::SceneError>(())
/// ```
pub mod description {
    #[doc(inline)]
    pub use noisefall_scene::scene::description::{
        CameraDescription, DVec3, EmissionDescription, EmissionSource, EnvironmentDescription, ObjectDescription, Projection,
        ReferenceDescription, RenderDescription, SceneDescription,
    };

    /// Materials and their parameters.
    pub mod materials {
        #[doc(inline)]
        pub use noisefall_base::declare::Textured;
        #[doc(inline)]
        pub use noisefall_scene::{
            material::{Material, Reflectance, Roughness, kinds::*},
            scene::description::{Bump, MaterialDescription},
        };
    }

    /// Shapes and their transforms.
    pub mod shapes {
        #[doc(inline)]
        pub use noisefall_scene::shape::{
            Bounds, Rotation, ShapeKind, Transform,
            kinds::*,
            mesh::{Heightfield, Knot, MeshSource},
        };
    }

    /// Textures.
    pub mod textures {
        #[doc(inline)]
        pub use noisefall_scene::texture::{
            TextureKind,
            image::{Channel, TexelFilter, Wrap},
            kinds::*,
            ramp::Stop,
        };
    }
}
