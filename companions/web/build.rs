//! The stack of the module: files are read by recursion, at most as deep as on the host.

fn main() {
    println!("cargo:rustc-link-arg-cdylib=-zstack-size=16777216");
    println!("cargo:rustc-link-arg-examples=-zstack-size=16777216");
    println!("cargo:rerun-if-changed=build.rs");
}
