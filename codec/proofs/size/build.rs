//! Links the program without a C runtime, also on Linux.

fn main() {
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        for flag in ["-nostartfiles", "-nodefaultlibs", "-static", "-no-pie"] {
            println!("cargo:rustc-link-arg-bins={flag}");
        }
    }
}
