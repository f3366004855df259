//! Tests of the library alone. They are one program, because linking a program takes longer than most
//! of the tests.

#[path = "../kept/mod.rs"]
mod kept;

mod client;
mod connection;
mod defects;
mod discovery;
mod edition;
mod explain_laws;
mod large;
mod lenient;
mod order;
mod walks;
