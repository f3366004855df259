//! The tests of `codec/tests/main.rs` in a program that ends at the first panic of a test. The
//! first pass of the script `run` skips tests that generate many cases; the second pass runs them
//! on the survivors.

#[path = "../tests/main.rs"]
mod tests;

/// Ends the program at the first failure, because one failure detects the mutant: no case is
/// shrunk, and no other test needs to run to its end.
#[test]
fn a_failure_ends_the_run() {
    let shown = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        shown(info);
        std::process::exit(101);
    }));
}
