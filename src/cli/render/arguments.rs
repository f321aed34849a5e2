//! The arguments of `noisefall render`.
use std::{ops::Range, path::PathBuf, time::Duration};

use clap::ArgGroup;
use noisefall_render::render::{image_file::Format, layers::Layer, tev::DEFAULT_ADDRESS};

use crate::cli::{
    checkpointing::KeepOptions,
    headings,
    layers::{Layers, parse as layers_of},
    live,
    options::{self as parse, DisplayOptions},
    replay::Which,
    scene_file::SceneOptions,
    sequence::SequenceOptions,
    settings::SettingOptions,
};

#[derive(clap::Args)]
#[command(
    group = ArgGroup::new("target"),
    allow_negative_numbers = true,
    override_usage = "noisefall render [OPTIONS] <SCENE> -o <OUTPUT>\n       noisefall render [OPTIONS] --resume <FILE> -o <OUTPUT>\n       \
                      noisefall render [OPTIONS] <SCENE> --pixel <X,Y>"
)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    #[arg(required_unless_present = "resume")]
    pub scene: Option<PathBuf>,
    /// Image to write: .png (sRGB, as displayed) or .exr (linear radiance); - for standard output
    #[arg(help_heading = headings::OUTPUT, short, long, required_unless_present = "pixel")]
    pub output: Option<PathBuf>,
    /// Format of an image on standard output: png or exr. Files get the format of their extension
    #[arg(help_heading = headings::OUTPUT, long, value_name = "FORMAT", value_parser = parse::format, requires = "output", conflicts_with = "pixel")]
    pub format: Option<Format>,
    /// Stop after N samples per pixel [default: the scene's number, or 256]. If several of --spp, --time and --noise are given,
    /// the last one counts
    #[arg(help_heading = headings::STOP, long, value_name = "N", value_parser = parse::samples, overrides_with_all = ["time", "noise"])]
    pub spp: Option<u32>,
    /// Render samples A to B - 1 of each pixel. -o FILE.nf writes them for `noisefall merge`; -o FILE.exr or .png writes their image
    #[arg(help_heading = headings::KEEP, long, value_name = "A..B", value_parser = parse::sample_range, requires = "output", conflicts_with = "spp")]
    pub samples: Option<Range<u32>>,
    /// Stop after this rendering time
    #[arg(help_heading = headings::STOP, long, value_name = "SECONDS", value_parser = parse::seconds, overrides_with_all = ["spp", "noise"])]
    pub time: Option<Duration>,
    /// Stop at an estimated relative noise, such as 0.01 for 1 %: the root of relMSE, the mean of (x − r)²/(r² + 0.01 · mean r²).
    /// Such a stop depends on the samples: it adds a bias below 2.5 % of the target in tests
    #[arg(help_heading = headings::STOP, long, value_name = "RELATIVE", value_parser = parse::noise, overrides_with_all = ["spp", "time"])]
    pub noise: Option<f64>,
    #[command(flatten)]
    pub settings: SettingOptions,
    /// Number of threads; 0 for one per core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse::threads)]
    pub threads: u16,
    /// Resolution in pixels
    #[arg(help_heading = headings::IMAGE, long, value_name = "WxH", value_parser = parse::resolution, allow_hyphen_values = true)]
    pub size: Option<[u32; 2]>,
    #[command(flatten)]
    pub options: SceneOptions,
    #[command(flatten)]
    pub display: DisplayOptions,
    #[arg(help_heading = headings::IMAGE, long, value_name = "LIST", help = format!("Layers of an EXR: all, or a list of {}", parse::one_of::<Layer>()),
          value_parser = layers_of, requires = "output")]
    pub layers: Option<Layers>,
    /// Denoise the image, which biases it: non-local means over two halves of the samples. The file says so
    #[arg(help_heading = headings::IMAGE, long, requires = "output")]
    pub denoise: bool,
    #[command(flatten)]
    pub sequence: SequenceOptions,
    #[command(flatten)]
    pub keep: KeepOptions,
    /// Show the image in the viewer tev while it is rendered: linear radiance, at most once a second
    #[arg(help_heading = headings::OUTPUT, long, value_name = "HOST:PORT", num_args = 0..=1, default_missing_value = DEFAULT_ADDRESS, value_parser = live::address,
          conflicts_with = "pixel")]
    pub tev: Option<String>,
    /// Replay one path through this pixel instead of rendering
    #[arg(help_heading = headings::PATHS, long, value_name = "X,Y", value_parser = parse::pixel, allow_hyphen_values = true, conflicts_with = "output")]
    pub pixel: Option<[u32; 2]>,
    /// Sample to replay: a number, `lit` for the first that finds light, or with --csv a range such as 0-9999 [default: 0]
    #[arg(help_heading = headings::PATHS, long, value_name = "N", value_parser = parse::which, requires = "pixel", conflicts_with = "output")]
    pub sample: Option<Which>,
    /// Print the path as LaTeX: the nested sum with its numbers
    #[arg(help_heading = headings::PATHS, long, requires = "pixel", conflicts_with_all = ["json", "csv"])]
    pub latex: bool,
    /// Table of samples of the pixel to write, with running mean and variance; - for standard output
    #[arg(help_heading = headings::PATHS, long, value_name = "FILE", requires = "pixel", conflicts_with = "json")]
    pub csv: Option<PathBuf>,
    /// Print one line of JSON at the end; on standard error if the image goes to standard output
    #[arg(help_heading = headings::OUTPUT, long)]
    pub json: bool,
}
