//! Emulators from Debian's packages that are unpacked below `target/`, for which nobody needs root.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::kit::error::{Error, Result, bail};
use crate::kit::progress::Spinner;
use crate::kit::qemu::{self, Qemu};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{output, shell, system};

/// The packages that can be unpacked, and the program of each.
const EMULATORS: [(&str, &str); 2] =
    [(system::QEMU, qemu::PROGRAM), ("qemu-system-misc", "qemu-system-riscv32")];

/// The program of a package, if that can be unpacked.
pub fn program_of(package: &str) -> Option<&'static str> {
    EMULATORS.iter().find(|row| row.0 == package).map(|row| row.1)
}

/// The folders with the programs that are there.
fn folders(target: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let all = EMULATORS.map(|(package, _)| target.join("unpacked").join(package).join("bin"));
    all.into_iter().filter(|bin| bin.is_dir())
}

/// The PATH for programs that look for an emulator: the folder of the one that the user chose is
/// before it, those with what is unpacked are behind it.
pub fn path(target: &Path) -> Option<OsString> {
    let path = std::env::var_os("PATH")?;
    let chosen = qemu::chosen().map(PathBuf::from);
    let chosen = chosen.as_deref().and_then(Path::parent).filter(|folder| folder.is_absolute());
    let chosen = chosen.into_iter().map(Path::to_owned);
    let all = chosen.chain(std::env::split_paths(&path)).chain(folders(target));
    std::env::join_paths(all).ok()
}

/// The places of a program: all on the PATH, then the unpacked one.
pub fn places(program: &str) -> impl Iterator<Item = PathBuf> {
    let ours = std::iter::once_with(Workspace::find).flatten();
    let ours = ours.flat_map(|workspace| folders(&workspace.target));
    shell::all_of(program)
        .chain(ours.map(move |bin| bin.join(program)).filter(|file| file.is_file()))
}

/// What is about to happen, as a line among commands.
pub fn line(packages: &[&str], refusal: Option<&str>) -> Option<String> {
    let packages = packages.join(" ");
    let when = refusal.map_or("if apt-get refuses".into(), |why| format!("since {why}"));
    let what = format!("unpack {packages}, some 30 MB, into target/unpacked; this needs no root");
    (!packages.is_empty()).then(|| format!("# {when}: {what}"))
}

/// Unpacks an emulator's package with what it needs, unless there is an emulator by now. The folder
/// gets its name last, so that an interrupted run leaves none and the next one begins anew.
///
/// # Errors
/// The packages cannot be fetched, or the program does not start.
pub fn unpack(package: &str) -> Result<()> {
    let program = program_of(package).unwrap_or(package);
    let all = Workspace::find()?.target.join("unpacked");
    let (place, part) = (all.join(package), all.join(format!("{package}.part")));
    fs::create_dir_all(&all).map_err(Error::file("create", &all))?;
    // Held to the end: two processes would unpack into the same folder.
    let lock = File::create(all.join("lock")).and_then(|file| file.lock().map(|()| file));
    let _alone = lock.map_err(Error::file("lock", &all))?;
    let started = Path::new("bin").join(program);
    if Qemu::first(program).is_ok() || Qemu::at(place.join(&started)).is_ok() {
        return Ok(());
    }
    for old in [&place, &part].into_iter().filter(|old| old.exists()) {
        fs::remove_dir_all(old).map_err(Error::file("remove", old))?;
    }
    let spinner = Spinner::start(&format!("fetching {package}, without root"));
    let apt = part.join("apt");
    fetch(package, &apt, &spinner)?;
    spinner.say(format!("unpacking {package}"));
    let (archives, root) = (apt.join("cache/archives"), part.join("root"));
    let files = fs::read_dir(&archives).map_err(Error::file("read", &archives))?;
    for file in files.flatten().map(|entry| entry.path()) {
        if file.extension().is_some_and(|end| end == "deb") {
            shell::capture(Command::new("dpkg").arg("-x").args([&file, &root]))?;
        }
    }
    fs::remove_dir_all(&apt).map_err(Error::file("remove", &apt))?;
    let started = part.join(started);
    fs::create_dir_all(part.join("bin")).map_err(Error::file("create", &started))?;
    workspace::write(&started, starter(&root, program))?;
    #[cfg(unix)]
    fs::set_permissions(&started, std::os::unix::fs::PermissionsExt::from_mode(0o755))
        .map_err(Error::file("write", &started))?;
    Qemu::at(&started)?;
    fs::rename(&part, &place).map_err(Error::file("create", &place))?;
    drop(spinner);
    let bin = place.join("bin");
    output::note(&format!("unpacked `{program}`; your own shell has it in {}", bin.display()));
    Ok(())
}

/// Downloads a package and what it needs of other packages that are not installed.
fn fetch(package: &str, apt: &Path, spinner: &Spinner) -> Result<()> {
    for folder in ["state/lists/partial", "cache/archives/partial"] {
        let folder = apt.join(folder);
        fs::create_dir_all(&folder).map_err(Error::file("create", &folder))?;
    }
    let ours = ["State", "Cache"]
        .map(|name| format!("-oDir::{name}={}", apt.join(name.to_lowercase()).display()));
    let mut complaints = Vec::new();
    let mut run = |words: &str| {
        let mut command = Command::new("apt-get");
        command.args("-q -oDir::State::status=/var/lib/dpkg/status".split(' ')).args(&ours);
        command.args(["-oDebug::NoLocking=1", "-oAPT::Sandbox::User=root"]);
        command.args(["-oAcquire::Languages=none", "-oAcquire::http::Timeout=30"]);
        command.args(words.split(' ')).env("LC_ALL", "C");
        let done = shell::follow(&mut command, |line| match line.split_once(": ") {
            Some(("E" | "W", what)) => complaints.push(what.to_owned()),
            _ if line.starts_with("Get:") => spinner.say(format!("fetching {package}: {line}")),
            _ => {}
        });
        done.is_ok()
    };
    let install = format!("install --download-only --no-install-recommends --yes {package}");
    // The system's index is tried first. It may be stale or empty; then one of our own is fetched,
    // and whether that went well shows in what follows.
    let is_fetched = run(&format!("-oDir::State::lists=/var/lib/apt/lists {install}")) || {
        run("update");
        run("clean") && run(&install)
    };
    if !is_fetched {
        let of_network = complaints.iter().find(|what| what.starts_with("Failed to fetch"));
        let why = of_network.or(complaints.last()).map_or("apt-get failed", |why| why);
        bail!(
            "Debian's packages of `{package}` cannot be fetched: {why}\n  With a network, the same \
             command begins anew; without, {} names a QEMU that you have",
            qemu::VARIABLE
        );
    }
    Ok(())
}

/// The script that starts a program with the libraries and the data beside it.
fn starter(root: &Path, program: &str) -> String {
    let is_library = |path: &Path| path.to_string_lossy().contains(".so.");
    let mut libraries = BTreeSet::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() && !path.is_symlink() {
                folders.push(path);
            } else if is_library(&path) {
                libraries.insert(folder.strip_prefix(root).unwrap_or(&folder).to_owned());
            }
        }
    }
    let libraries = libraries.iter().map(|folder| format!("$root/{}", folder.display()));
    let libraries = libraries.collect::<Vec<_>>().join(":");
    format!(
        r#"#!/bin/sh
root=${{0%/*}}/../root
export LD_LIBRARY_PATH="{libraries}${{LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}}"
exec "$root/usr/bin/{program}" -L "$root/usr/share/qemu" -L "$root/usr/share/seabios" "$@"
"#
    )
}
