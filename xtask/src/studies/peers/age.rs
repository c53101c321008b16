//! The age of the page: whether the code that it measured is today's.

use std::path::Path;
use std::process::ExitCode;

use crate::kit::docs::cells;
use crate::kit::error::{Error, Result, bail};
use crate::kit::output;
use crate::kit::sources::code;
use crate::kit::table::Table;
use crate::kit::workspace::{self, Workspace};
use crate::studies::peers::PAGE;

/// What is measured, and what measures it.
const MEASURED: [&str; 5] = [
    "dynamics-core/src",
    "lab/peers",
    "lab/target/src/bin/peers.rs",
    "xtask/src/studies/peers",
    ".cargo/config.toml",
];

/// Fails, with the places whose code has changed, unless the page is of today's.
pub fn check(workspace: &Workspace) -> Result<ExitCode> {
    let page = workspace::read(&workspace.root.join(PAGE))?;
    let changed = changed(&page, &workspace.root)?;
    if !changed.is_empty() {
        let of = changed.join(", ");
        bail!("{PAGE} is older than {of}: `cargo xtask peers` measures it anew");
    }
    output::line(&format!("{PAGE} is of this code"))?;
    Ok(ExitCode::SUCCESS)
}

/// The places whose code is not what the page says that it measured.
fn changed(page: &str, root: &Path) -> Result<Vec<&'static str>> {
    let recorded: Vec<_> = page.lines().filter_map(cells).collect();
    let mut changed = Vec::new();
    for place in MEASURED {
        let now = hash(&root.join(place))?;
        if !recorded.iter().any(|row| row[0] == place && row[1..] == [&*now]) {
            changed.push(place);
        }
    }
    Ok(changed)
}

/// The table by which a later run knows the code that was measured.
pub fn of_code(root: &Path) -> Result<String> {
    let mut table = Table::new(&["code", "FNV-1a of its lines"]);
    for place in MEASURED {
        table.row([place.to_owned(), hash(&root.join(place))?]);
    }
    Ok(table.markdown())
}

/// A hash (FNV-1a, 64 bits) of a file, or of a folder's files by name; of Rust the lines of code alone, so that a
/// comment changes nothing.
fn hash(path: &Path) -> Result<String> {
    let mut files = Vec::new();
    collect(path, &mut files)?;
    files.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |text: &str| {
        for byte in text.bytes().chain([b'\n']) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for file in files {
        let (name, text) = (file.strip_prefix(path).unwrap_or(&file), workspace::read(&file)?);
        add(&name.to_string_lossy().replace('\\', "/"));
        match file.extension().is_some_and(|end| end == "rs") {
            true => code(&text).for_each(|(_, line)| add(line)),
            false => text.lines().for_each(&mut add),
        }
    }
    Ok(format!("{hash:016x}"))
}

fn collect(path: &Path, files: &mut Vec<std::path::PathBuf>) -> Result<()> {
    if path.is_file() {
        files.push(path.to_owned());
        return Ok(());
    }
    for entry in std::fs::read_dir(path).map_err(Error::file("read", path))? {
        collect(&entry.map_err(Error::file("read", path))?.path(), files)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{MEASURED, changed, of_code};

    #[test]
    fn a_changed_line_of_code_makes_the_page_old() {
        let folder = tempfile::tempdir().expect("a folder");
        let put = |place: &str, text: &str| {
            let file = match place.contains('.') && !place.ends_with("src") {
                true => folder.path().join(place),
                false => folder.path().join(place).join("one.rs"),
            };
            std::fs::create_dir_all(file.parent().expect("a folder")).expect("made");
            std::fs::write(file, text).expect("written");
        };
        MEASURED.iter().for_each(|place| put(place, "fn f() {}\n"));
        let page = of_code(folder.path()).expect("hashed");
        let old = || changed(&page, folder.path()).expect("hashed");
        assert!(old().is_empty());
        put(MEASURED[0], "// A comment.\nfn f() {}\n");
        assert!(old().is_empty());
        for place in MEASURED {
            put(place, "fn f() { g() }\n");
            assert_eq!(old(), [place]);
            put(place, "fn f() {}\n");
        }
        assert_eq!(changed("", folder.path()).expect("hashed"), MEASURED);
    }
}
