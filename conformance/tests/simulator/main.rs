//! Tests of the simulated CNC, including its internal state: the executed lines of programs, the
//! values of variables, and changes by an operator. They detect the defects that no case of the
//! suite detects.

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
