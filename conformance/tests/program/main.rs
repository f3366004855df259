//! The NC programs of the simulated CNC: streamed programs, and programs that send requests to services.

mod decoder;
mod interfaces;
mod interleavings;
#[path = "../kept/mod.rs"]
mod kept;
mod machines;
mod script;
mod sender;
mod service;
#[path = "../common/square_root.rs"]
mod square_root;
mod world;
