//! The program as its users meet it: scene files, command line, worker, and the structure of the source.
mod beside;
mod closed_streams;
mod command_line;
mod command_notes;
mod compare;
mod interruption;
mod layers;
mod output;
mod pictures;
mod scene_files;
mod scene_messages;
mod shapes;
mod study;
mod textures;
mod validate;
mod worker;
