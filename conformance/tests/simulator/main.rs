//! The simulated CNC, with its inside: what its programs execute, what its variables contain, and
//! what an operator changes. Each check also finds the defects that no request from outside shows.

mod addresses;
mod changes;
mod checks;
mod contents;
mod defects;
mod device;
mod player;
mod sequences;
mod services;
#[path = "../common/square_root.rs"]
mod square_root;
mod streams;
mod target;
mod variables;
