//! Tests of the library alone. They are one program, because linking takes longer than most of them.

#[path = "../kept/mod.rs"]
mod kept;

mod client;
mod defects;
mod discovery;
mod edition;
mod explain_laws;
mod large;
mod lenient;
mod walks;
