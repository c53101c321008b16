//! The linker finds the project's `memory.x` in its root.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-link-search={}/../../..", env!("CARGO_MANIFEST_DIR"));
}
