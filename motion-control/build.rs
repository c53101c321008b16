//! Sets the cfg `optimised`, by which functions are inlined, unless this crate is compiled at
//! opt-level 0.
//!
//! The engine folds known zeros and ones only in functions that are inlined. At opt-level 0 nothing
//! folds, and inlining makes megabytes of code. Debug assertions do not matter: a dev profile with
//! an opt-level computes as fast as a release profile.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(optimised)");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level != "0") {
        println!("cargo::rustc-cfg=optimised");
    }
}
