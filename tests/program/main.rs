//! The program as its users meet it: scene files, command line, worker, and the structure of the source.
mod command_line;
mod layers;
mod pictures;
mod scene_files;
mod shapes;
mod textures;
mod worker;
