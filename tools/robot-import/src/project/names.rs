//! Names and strings of the languages that a project is written in.

use std::collections::BTreeSet;

use super::ProjectError;
use crate::text::{c_comment, string_literal};

/// Names that no crate with these dependencies can have: Rust's keywords, its libraries and its
/// primitive types, which a crate of their name would hide in programs and tests; Cargo's folders;
/// the dependencies; the program `watch`.
const RESERVED: &str = "
    abstract as async await become box break const continue crate do dyn else enum extern false final fn for gen if impl
    in let loop macro match mod move mut override priv pub ref return self static struct super trait true try type
    typeof unsafe unsized use virtual where while yield
    alloc core proc_macro std test
    bool char f128 f16 f32 f64 i128 i16 i32 i64 i8 isize str u128 u16 u32 u64 u8 usize
    build deps examples incremental
    cortex_m cortex_m_rt cortex_m_semihosting dynamics_c dynamics_core embedded_hal joint_drivers machine_link motion_control watch
    defmt defmt_rtt embassy_executor embassy_rp embassy_sync embassy_time embedded_hal_bus panic_halt rtic stm32f4xx_hal";

/// Fails unless the name can be that of a crate, and in lower case a prefix of C functions.
pub(super) fn check_name(name: &str) -> Result<(), ProjectError> {
    let wrong = |reason| {
        let name = name.to_owned();
        Err(ProjectError::Name { name, reason })
    };
    let is_part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    if !name.starts_with(|c: char| c.is_ascii_lowercase()) || !name.chars().all(is_part) {
        return wrong("use lower-case letters, digits, `-` and `_`, with a letter first");
    }
    if name.len() > 60 {
        return wrong("it is longer than 60 characters");
    }
    if RESERVED.split_whitespace().any(|reserved| reserved == snake_case(name)) {
        return wrong("Rust, Cargo or a dependency uses it; add `-arm` for example");
    }
    Ok(())
}

/// The name as an identifier.
pub(super) fn snake_case(name: &str) -> String {
    name.replace('-', "_")
}

/// A string of TOML, unless the text has control characters.
pub(super) fn toml_string(text: &str) -> Option<String> {
    if text.chars().any(char::is_control) {
        return None;
    }
    let escaped = text.replace('\\', "\\\\").replace('"', "\\\"");
    Some(format!("\"{escaped}\""))
}

/// The lines of a C enumeration of joints, or of other parts, each with another constant: `kind`
/// and the name in upper case, with the part's number where another one or the header, whose
/// constants are `taken`, has the same. A comment has the name where the constant does not tell it.
pub(super) fn enumerators(prefix: &str, kind: &str, parts: &[String], taken: &[&str]) -> String {
    let plain: Vec<String> = parts.iter().map(|part| constant(part)).collect();
    let is_single = |name: &String| {
        let same = plain.iter().filter(|other| *other == name);
        same.count() == 1 && !name.is_empty() && !taken.contains(&&*format!("{kind}_{name}"))
    };
    // Names that are unique as they are stay so, whatever the numbers make of others.
    let singles = plain.iter().filter(|name| is_single(name));
    let mut used: BTreeSet<String> = taken.iter().map(|&name| name.to_owned()).collect();
    used.extend(singles.map(|name| format!("{kind}_{name}")));
    let mut lines = Vec::new();
    for (number, (name, part)) in plain.iter().zip(parts).enumerate() {
        let mut full = format!("{kind}_{name}");
        if !is_single(name) {
            let end = if full.ends_with('_') { "" } else { "_" };
            full += &format!("{end}{number}");
            while !used.insert(full.clone()) {
                full += &format!("_{number}");
            }
        }
        let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let comment = match is_single(name) && part.chars().all(is_plain) {
            true => String::new(),
            false => format!(" /* {} */", c_comment(&string_literal(part))),
        };
        lines.push(format!("    {prefix}_{full} = {number},{comment}"));
    }
    lines.join("\n")
}

/// The name in upper case with an underscore for each other character; empty if there would be
/// nothing else.
fn constant(name: &str) -> String {
    if !name.contains(|c: char| c.is_ascii_alphanumeric()) {
        return String::new();
    }
    let upper = name.chars().map(|c| match c.is_ascii_alphanumeric() {
        true => c.to_ascii_uppercase(),
        false => '_',
    });
    upper.collect()
}
