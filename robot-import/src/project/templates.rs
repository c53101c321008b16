//! The files of the templates. The suffix `.liquid`, which `cargo generate` removes, keeps Cargo from reading manifests
//! with placeholders.

/// A file of a template.
pub(super) struct File {
    /// Its path in the project.
    pub path: &'static str,
    /// Its text, with placeholders.
    pub text: &'static str,
}

macro_rules! files {
    ($folder:literal: $($path:literal $($suffix:literal)?),* $(,)?) => {
        &[$(File {
            path: $path,
            text: include_str!(concat!("../../template/", $folder, "/", $path, $($suffix)?)),
        }),*]
    };
}

/// Firmware in Rust.
pub(super) const RUST: &[File] = files!["rust":
    "Cargo.toml" ".liquid",
    "README.md" ".liquid",
    "memory.x",
    "build.rs",
    "rust-toolchain.toml",
    ".gitignore",
    ".cargo/config.toml",
    "src/lib.rs",
    "src/main.rs" ".liquid",
    "src/scene.rs" ".liquid",
    "src/control.rs",
    "src/board.rs",
    "src/simulation.rs",
    "src/report.rs",
    "src/marker.rs",
    "tests/tracking.rs" ".liquid",
];

/// A static library with a C header.
pub(super) const C: &[File] = files!["c":
    "Cargo.toml" ".liquid",
    "README.md" ".liquid",
    "Makefile" ".liquid",
    "rust-toolchain.toml",
    ".gitignore",
    ".cargo/config.toml",
    "src/lib.rs" ".liquid",
    "src/scene.rs" ".liquid",
    "include/{{crate_name}}.h" ".liquid",
    "example/main.c" ".liquid",
    "example/board.c",
    "example/board.h",
    "example/link.ld",
    "tests/calls.rs" ".liquid",
];
