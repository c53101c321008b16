//! Runs xtask with programs that stand in for others.

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// A directory of its own, gone with the value.
pub struct Dir(TempDir);

impl Dir {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary directory"))
    }

    pub fn join(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A program of these lines of shell in it.
    pub fn program(&self, name: &str, lines: &str) -> PathBuf {
        let path = self.join(name);
        std::fs::write(&path, format!("#!/bin/sh\n{lines}\n")).expect("a script");
        let mode = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(&path, mode).expect("made executable");
        path
    }

    pub fn file(&self, name: &str, contents: &[u8]) -> PathBuf {
        let path = self.join(name);
        std::fs::write(&path, contents).expect("a file");
        path
    }
}

/// The cargo that runs the tests.
pub fn cargo() -> PathBuf {
    std::env::var_os("CARGO").expect("cargo runs the tests").into()
}

/// xtask in the workspace, with nobody to ask, not on CI.
pub fn xtask(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command
        .args(arguments)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .env("CARGO", cargo())
        .env_remove("CI")
        .stdin(Stdio::null());
    command
}

/// The code that it ended with, and what it said on stdout and stderr.
pub fn outcome(command: &mut Command) -> (Option<i32>, String, String) {
    let out = command.output().expect("xtask runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (out.status.code(), text(&out.stdout), text(&out.stderr))
}

/// The offset of the code in [`firmware`].
const CODE: u32 = 0x40;
const FLASH: u32 = 0x0800_0000;

/// A firmware of one function, `tick`, that passes region 0 three times with two instructions in
/// it.
pub fn three_passages(end: &[u16]) -> Vec<u8> {
    let passages = [
        0x2403, // movs r4, #3
        0xf3af, 0x80f0, // again: dbg #0
        0xbf00, // nop
        0x3001, // adds r0, #1
        0xf3af, 0x80f1, // dbg #1
        0x3c01, // subs r4, #1
        0xd1f7, // bne again
    ];
    firmware(&[&passages, end].concat(), 40)
}

/// Leaves the emulator: `SYS_EXIT` with `ADP_Stopped_ApplicationExit`.
pub const EXIT: &[u16] = &[0x2018, 0xf240, 0x0126, 0xf2c0, 0x0102, 0xbeab];
pub const FOR_EVER: &[u16] = &[0xe7fe];

/// An ELF for a processor of this number (40 is ARM), whose one function has this code.
pub fn firmware(code: &[u16], processor: u16) -> Vec<u8> {
    let mut text = vec![0; CODE as usize];
    text[..4].copy_from_slice(&0x2000_1000_u32.to_le_bytes());
    text[4..8].copy_from_slice(&(FLASH + CODE + 1).to_le_bytes());
    text.extend(code.iter().flat_map(|half| half.to_le_bytes()));
    while !text.len().is_multiple_of(4) {
        text.push(0);
    }
    let words = |words: &[u32]| -> Vec<u8> { words.iter().flat_map(|w| w.to_le_bytes()).collect() };
    // The null symbol, then `tick`: a global function in section 1.
    let size = 2 * code.len() as u32;
    let symbols = words(&[0, 0, 0, 0, 1, FLASH + CODE + 1, size, 0x0001_0012]);
    let names = b"\0tick\0\0\0";
    let sections = b"\0.text\0.symtab\0.strtab\0\0";
    let text_at = 52 + 32;
    let symbols_at = text_at + text.len() as u32;
    let symbols_length = symbols.len() as u32;
    let names_at = symbols_at + symbols_length;
    let sections_at = names_at + names.len() as u32;
    let table_at = sections_at + sections.len() as u32;
    let length = text.len() as u32;

    let halves =
        |halves: &[u16]| -> Vec<u8> { halves.iter().flat_map(|h| h.to_le_bytes()).collect() };
    [
        b"\x7fELF\x01\x01\x01\0\0\0\0\0\0\0\0\0".to_vec(),
        halves(&[2, processor]),
        words(&[1, FLASH + CODE + 1, 52, table_at, 0x0500_0200]),
        halves(&[52, 32, 1, 40, 5, 4]),
        words(&[1, text_at, FLASH, FLASH, length, length, 5, 4]),
        text,
        symbols,
        names.to_vec(),
        sections.to_vec(),
        vec![0; 40],
        words(&[1, 1, 6, FLASH, text_at, length, 0, 0, 4, 0]),
        words(&[7, 2, 0, 0, symbols_at, symbols_length, 3, 1, 4, 16]),
        words(&[15, 3, 0, 0, names_at, names.len() as u32, 0, 0, 1, 0]),
        words(&[15, 3, 0, 0, sections_at, sections.len() as u32, 0, 0, 1, 0]),
    ]
    .concat()
}
