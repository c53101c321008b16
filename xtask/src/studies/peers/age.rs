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

/// The measured code, and the code that measures it.
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
    let changed = changed(&page, &workspace.root)?.join(", ");
    if !changed.is_empty() {
        bail!("{PAGE} is older than {changed}: `cargo xtask peers` measures it anew");
    }
    output::line(&format!("{PAGE} is of this code"))?;
    Ok(ExitCode::SUCCESS)
}

/// The places whose code is not what the page says that it measured.
fn changed(page: &str, root: &Path) -> Result<Vec<&'static str>> {
    let today = of_code(root)?.markdown();
    let today = today.lines().filter_map(cells);
    let pairs = MEASURED.into_iter().zip(today.skip(2));
    let is_old = |row: &Vec<&str>| {
        !page
            .lines()
            .filter_map(cells)
            .any(|recorded| recorded == *row)
    };
    Ok(pairs
        .filter(|(_, row)| is_old(row))
        .map(|(place, _)| place)
        .collect())
}

/// The table by which a later run knows the code that was measured.
pub fn of_code(root: &Path) -> Result<Table> {
    let mut table = Table::new(&["code", "FNV-1a of its lines"]);
    for place in MEASURED {
        let mut hash = 0xcbf2_9ce4_8422_2325;
        add(&mut hash, &root.join(place))?;
        table.row([place.to_owned(), format!("{hash:016x}")]);
    }
    Ok(table)
}

/// Adds a file, or a folder's files by name, to a hash (FNV-1a, 64 bits); of Rust the lines of code
/// alone, so that a comment changes nothing.
fn add(hash: &mut u64, path: &Path) -> Result<()> {
    let mut add_line = |line: &str| {
        for byte in line.bytes().chain([b'\n']) {
            *hash = (*hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    add_line(&path.file_name().unwrap_or_default().to_string_lossy());
    if path.is_dir() {
        let entries = std::fs::read_dir(path).map_err(Error::file("read", path))?;
        let paths = entries.flatten().map(|entry| entry.path());
        let mut paths: Vec<_> = paths.filter(|path| !path.ends_with("tests.rs")).collect();
        paths.sort();
        return paths.iter().try_for_each(|path| add(hash, path));
    }
    let text = workspace::read(path)?;
    match path.extension().is_some_and(|end| end == "rs") {
        true => code(&text).for_each(|(_, line)| add_line(line)),
        false => text.lines().for_each(add_line),
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
            // Two of the places are files.
            let file = folder.path().join(place);
            let file = match file.extension() {
                Some(_) => file,
                None => file.join("one.rs"),
            };
            std::fs::create_dir_all(file.parent().expect("a folder")).expect("made");
            std::fs::write(file, text).expect("written");
        };
        MEASURED.iter().for_each(|place| put(place, "fn f() {}\n"));
        let page = of_code(folder.path()).expect("hashed").markdown();
        let old = |page| changed(page, folder.path()).expect("hashed");
        put(MEASURED[0], "// A comment.\nfn f() {}\n");
        std::fs::write(folder.path().join("lab/peers/tests.rs"), "fn t() {}").expect("written");
        assert!(old(&page).is_empty());
        for place in MEASURED {
            put(place, "fn f() { g() }\n");
            assert_eq!(old(&page), [place]);
            put(place, "fn f() {}\n");
        }
        assert_eq!(old(""), MEASURED);
    }
}
