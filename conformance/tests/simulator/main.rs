//! The simulated CNC, with its inside: what its programs execute, what its variables contain, and
//! what an operator changes. Each check also finds the defects that no request from outside shows.

mod checks;
mod player;
mod sequences;
mod services;
#[path = "../common/square_root.rs"]
mod square_root;
mod streams;
mod target;
