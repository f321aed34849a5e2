//! The estimator against exact solutions of the light transport equation.
//!
//! Every statement is a z-test at 4σ over seeded samples, or exact if the answer is exact. σ comes from a closed form if there is
//! one, otherwise from the samples.
//!
//! There are about 1,310 single comparisons and 315 families of them. A single one exceeds 4σ with probability 6.3 · 10⁻⁵, and so does
//! the largest of a family its limit. With fresh seeds, all together would fail with a probability of at most 10.3 % (the union bound).
//! Seeds are fixed: a test that passes once passes always.
#![allow(clippy::print_stdout, reason = "figures are printed for those who ask for them")]
mod adaptive;
mod bidirectional;
mod black;
mod combinations;
mod determinism;
mod enclosures;
mod estimators;
mod features;
mod furnace;
mod glass;
mod inside_outside;
mod lens;
mod limits;
mod mirror_images;
mod mirrors;
mod noise;
mod opacity;
mod path_reuse;
mod picture;
mod pictures;
mod plate;
mod punctual_light;
mod references;
mod sealed_rooms;
mod shading_normals;
mod shape_lights;
mod shutter;
mod space;
mod statistics;
mod textured_sphere;
mod tinted_glass;
mod tiny_lights;
mod vertex_colors;
mod vertices;
