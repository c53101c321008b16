//! `cargo xtask meter ELF` on firmwares of a few instructions.

use std::process::Command;

use crate::support::{Dir, EXIT, FOR_EVER, firmware, outcome, three_passages, xtask};

/// Runs `cargo xtask meter` on a file.
fn metered(contents: &[u8], arguments: &[&str]) -> (Option<i32>, String, String) {
    let dir = Dir::new();
    let file = dir.file("firmware", contents);
    outcome(xtask(&["meter"]).arg(file).args(arguments))
}

fn assert_refused(contents: &[u8], with: &str) {
    let (code, _, said) = metered(contents, &[]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains(with), "{said}");
}

#[test]
fn what_cannot_be_measured_is_refused_with_what_to_do() {
    assert_refused(b"", "no ELF file");
    assert_refused(b":10010000214601360121470136007EFE09D2190140", "no ELF file");
    assert_refused(b"\x7fELF and then nothing", "firmware: ");
    assert_refused(&firmware(EXIT, 62), "build it with --target thumbv7em-none-eabihf");
    assert_refused(&firmware(EXIT, 40), "it has no markers");
    let (code, _, said) = outcome(&mut xtask(&["meter", "not/there"]));
    assert_eq!(code, Some(1));
    assert!(said.contains("cannot read not/there"), "{said}");
}

fn has_qemu() -> bool {
    let there = Command::new("qemu-system-arm").arg("--version").output().is_ok();
    if !there {
        eprintln!("skipped: there is no qemu-system-arm");
    }
    there
}

#[test]
fn a_firmware_is_measured_between_its_markers() {
    if !has_qemu() {
        return;
    }
    let (code, json, said) = metered(&three_passages(EXIT), &["--json"]);
    assert_eq!(code, Some(0), "{said}");
    let found: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let two = serde_json::json!({"min": 2, "median": 2, "max": 2});
    let none = serde_json::json!({"min": 0, "median": 0, "max": 0});
    // The first passage reads a line of the flash, and of the G474's, which are shorter, another
    // one, of which two cycles are not hidden.
    let first = |cycles| serde_json::json!({"min": 2, "median": 2, "max": 2 + cycles});
    let region = serde_json::json!({
        "region": 0, "calls": 3, "instructions": two, "cycles": two,
        "in_flash": [first(4 + 2), first(5)], "flops": none
    });
    assert_eq!(found["regions"], serde_json::json!([region]));
    assert_eq!(found["ended"], true);
}

#[test]
fn the_figures_of_an_endless_firmware_are_printed() {
    if !has_qemu() {
        return;
    }
    let (code, text, said) = metered(&three_passages(FOR_EVER), &["--seconds", "1"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(text.contains("stopped after 1 s"), "{text}");
    let row: Vec<&str> = text.lines().last().unwrap_or_default().split_whitespace().collect();
    assert_eq!(row, ["0", "3", "2", "2", "2", "2", "2", "2", "2", "8", "2", "7", "0"], "{text}");
}

// A Cortex-M4F lacks the instruction.
#[test]
fn a_foreign_instruction_is_named_with_its_function() {
    if !has_qemu() {
        return;
    }
    // It follows the exit, so that it is never executed: vseleq.f32 s0, s0, s0.
    let foreign = [EXIT, &[0xfe00, 0x0a00]].concat();
    let (code, text, said) = metered(&three_passages(&foreign), &[]);
    assert_eq!(code, Some(1), "{said}");
    assert!(text.contains("not of a Cortex-M4F: 0x800005e in `tick`"), "{text}");
    assert!(said.contains("none of a Cortex-M4F"), "{said}");
}

#[test]
fn markers_that_are_never_reached_are_distinguished_from_none() {
    if !has_qemu() {
        return;
    }
    let skipped = [EXIT, &[0xf3af, 0x80f0, 0xf3af, 0x80f1]].concat();
    let (code, _, said) = metered(&firmware(&skipped, 40), &[]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("closed no region before it ended"), "{said}");
}
