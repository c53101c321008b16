//! Sets the cfg `optimised`, by which functions are inlined, unless this crate is compiled at opt-level 0.
//!
//! The engine folds known zeros and ones only in functions that are inlined. At opt-level 0 nothing folds, and inlining would make
//! megabytes of code.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(optimised)");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level != "0") {
        println!("cargo::rustc-cfg=optimised");
    }
}
