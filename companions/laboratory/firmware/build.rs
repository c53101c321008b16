//! The linker finds the project's `memory.x` in its root; without C of peers the bin `peers` is
//! compiled with none.

use std::path::PathBuf;

fn main() -> std::io::Result<()> {
    println!("cargo::rustc-link-search={}/../../..", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rerun-if-env-changed=PEERS_TABLE");
    if std::env::var_os("PEERS_TABLE").is_none() {
        let out = std::env::var_os("OUT_DIR").unwrap_or_default();
        let none = PathBuf::from(out).join("none.rs");
        std::fs::write(&none, "fn run() {}\n")?;
        println!("cargo::rustc-env=PEERS_TABLE={}", none.display());
    }
    Ok(())
}
