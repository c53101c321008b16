//! Names and strings of the languages that a project is written in.

use super::ProjectError;

/// Names that Cargo, Rust or the templates use.
const RESERVED: &str = "abstract alloc as async await become box break build const continue core crate deps do dyn \
                     else enum examples extern false final fn for gen if impl in incremental let loop macro match mod \
                     move mut override priv proc_macro pub ref return self static std struct super test trait true try \
                     type typeof unsafe unsized use virtual where while yield cortex_m cortex_m_rt \
                     cortex_m_semihosting dynamics_core embedded_hal";

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
    if RESERVED
        .split_whitespace()
        .any(|reserved| reserved == snake_case(name))
    {
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

/// The lines of a C enumeration of the joints: names in upper case, those that are equal then with their number.
pub(super) fn enumerators(prefix: &str, joints: &[String]) -> String {
    let plain: Vec<String> = joints.iter().map(|joint| constant(joint)).collect();
    let lines = plain.iter().enumerate().map(|(number, name)| {
        let is_unique = plain.iter().filter(|other| *other == name).count() == 1;
        let suffix = if is_unique {
            String::new()
        } else {
            format!("_{number}")
        };
        format!("    {prefix}_JOINT_{name}{suffix} = {number},")
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn constant(name: &str) -> String {
    let upper = name.chars().map(|c| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_uppercase()
        } else {
            '_'
        }
    });
    upper.collect()
}
