//! The files of the templates. The suffix `.liquid`, which `cargo generate` removes, keeps Cargo
//! from reading manifests with placeholders. A file that is compiled elsewhere in the repository is a
//! symbolic link there: the package of the program has its text.

/// A file of a template.
#[derive(Debug)]
pub(super) struct File {
    /// Its path in the project.
    pub path: &'static str,
    /// The text of the file, with placeholders.
    pub text: &'static str,
}

macro_rules! file {
    ($folder:literal / $path:literal $($suffix:literal)?) => {
        File {
            path: $path,
            text: include_str!(concat!("../../template/", $folder, "/", $path, $($suffix)?)),
        }
    };
}

macro_rules! files {
    ($folder:literal: $($path:literal $($suffix:literal)?),* $(,)?) => {
        &[$($crate::project::templates::file!($folder / $path $($suffix)?)),*]
    };
}

pub(super) use {file, files};

/// The files of firmware in Rust.
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
    "src/excitation.rs",
    "src/watch.rs",
    "src/bin/watch.rs" ".liquid",
    "tests/tracking.rs" ".liquid",
];

/// A static library with a C header.
pub(super) const C: &[File] = &[
    file!("c" / "Cargo.toml" ".liquid"),
    file!("c" / "README.md" ".liquid"),
    file!("c" / "Makefile" ".liquid"),
    file!("c" / "rust-toolchain.toml"),
    file!("c" / ".gitignore"),
    file!("c" / ".cargo/config.toml"),
    file!("c" / "isolate.sh"),
    file!("c" / "{{crate_name}}Config.cmake" ".liquid"),
    file!("c" / "CMakeLists.txt" ".liquid"),
    file!("c" / "src/lib.rs" ".liquid"),
    file!("c" / "src/scene.rs" ".liquid"),
    file!("c" / "example/main.c" ".liquid"),
    file!("c" / "example/board.c"),
    file!("c" / "example/board.h"),
    file!("c" / "example/host.c"),
    file!("c" / "example/arm.cmake"),
    file!("c" / "example/link.ld"),
    file!("c" / "include/{{crate_name}}.h" ".liquid"),
];

/// The files that all projects for boards have, some of them from the simulated project.
pub(super) const COMMON: &[File] = &[
    file!("rust" / "build.rs"),
    file!("rust" / ".gitignore"),
    file!("rust" / "src/scene.rs" ".liquid"),
    file!("rust" / "src/control.rs"),
    file!("board/common" / "README.md" ".liquid"),
    file!("board/common" / "rust-toolchain.toml" ".liquid"),
    file!("board/common" / "src/lib.rs"),
    file!("board/common" / "src/log.rs"),
    file!("board/common" / "src/say.rs"),
    file!("board/common" / "src/main.rs" ".liquid"),
];

/// Firmware for a board's chip under RTIC.
pub(super) const RTIC: &[File] = &[
    file!("board/rtic" / "Cargo.toml" ".liquid"),
    file!("board/rtic" / ".cargo/config.toml" ".liquid"),
    file!("board/rtic" / "src/firmware.rs"),
];

/// The constants of C that templates define or use, without the prefix that the project's name is
/// to them.
pub(super) fn constants(templates: &[File]) -> Vec<&'static str> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let of = |text: &'static str| {
        let after = text.split("{{crate_name | upcase}}_").skip(1);
        after.filter_map(move |rest| rest.split(|c| !is_part(c)).next())
    };
    templates.iter().flat_map(|file| of(file.text)).collect()
}
