//! Lets the linker find memory.x, and cortex-m-rt's script where there is no operating system.
//! Warns of a profile whose firmware is too slow.

fn main() {
    println!("cargo:rerun-if-changed=memory.x");
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        let folder = std::env::var("CARGO_MANIFEST_DIR").expect("set by cargo");
        println!("cargo:rustc-link-search={folder}");
        println!("cargo:rustc-link-arg-bins=-Tlink.x");
        if std::env::var("OPT_LEVEL").as_deref() == Ok("0") {
            println!(
                "cargo:warning=at opt-level 0 of this package a tick takes milliseconds, longer than its period: \
                 let Cargo.toml have opt-level 1 or more in this profile"
            );
        }
    }
}
