//! Finds the scenes that come with the program: at the top of the repository, or in the package, which has a copy. The link to them in this
//! folder is for the package; not every system has links.
use std::path::Path;

#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
fn main() {
    let folder = std::env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    let places = ["../../scenes", "scenes"].map(|place| Path::new(&folder).join(place));
    let scenes = places.iter().find(|place| place.join("cornell_spheres.toml").is_file()).unwrap_or(&places[0]);
    println!("cargo:rustc-env=NOISEFALL_SCENES={}", scenes.display());
    println!("cargo:rerun-if-changed={}", scenes.display());
}
