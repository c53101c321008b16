//! The Rust sources of a folder.

use std::path::{Path, PathBuf};

use crate::kit::error::{Error, Result};

/// Every Rust source below a folder, without what cargo builds and git keeps.
pub fn sources(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(Error::file("read", folder))? {
        let path = entry.map_err(Error::file("read", folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        // Cargo tags what it builds; a folder of sources may be called `target` too.
        let is_built = path.join("CACHEDIR.TAG").is_file();
        if path.is_dir() && !is_built && !name.starts_with('.') {
            found.extend(sources(&path)?);
        } else if name.ends_with(".rs") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::sources;

    #[test]
    fn sources_in_a_folder_called_target_count() {
        let folder = tempfile::tempdir().expect("a folder");
        let put = |file: &str| {
            let path = folder.path().join(file);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            std::fs::write(path, "").expect("written");
        };
        put("lab/firmware/lib.rs");
        put("target/CACHEDIR.TAG");
        put("target/generated.rs");
        let found = sources(folder.path()).expect("read");
        assert_eq!(found, [folder.path().join("lab/firmware/lib.rs")]);
    }
}
