//! rustc's warnings about target features that it does not know and forwards to LLVM. Those of
//! `.cargo/config.toml` cause some at every crate; every other warning is the user's to see.

use std::collections::BTreeSet;

/// The warnings of cargo, sorted.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Sifted {
    /// The target features that rustc warned of.
    pub features: BTreeSet<String>,
    /// Every other warning, each with its lines.
    pub others: Vec<String>,
}

impl Sifted {
    /// The sentence that replaces the warnings about target features, if there were any.
    pub fn sentence(&self) -> Option<String> {
        if self.features.is_empty() {
            return None;
        }
        let names: Vec<&str> = self.features.iter().map(String::as_str).collect();
        Some(format!(
            "note: rustc does not know these target features and forwards them to LLVM, which does \
             ({}); docs/decisions/0001-cpu-flags.md says what those of .cargo/config.toml are for",
            names.join(", ")
        ))
    }
}

/// Sifts what cargo printed on stderr. Its progress and its sums of warnings are left out.
pub fn sifted(stderr: &str) -> Sifted {
    let mut sifted = Sifted::default();
    let mut open = false;
    for line in stderr.lines() {
        if line.starts_with("warning") {
            let feature = feature(line);
            open = feature.is_none() && !is_sum(line);
            sifted.features.extend(feature);
            if open {
                sifted.others.push(line.to_owned());
            }
        } else if line.is_empty() || is_progress(line) {
            open = false;
        } else if let Some(warning) = sifted.others.last_mut().filter(|_| open) {
            warning.push('\n');
            warning.push_str(line);
        }
    }
    sifted
}

/// The feature that a warning's first line names, if it is such a warning.
fn feature(line: &str) -> Option<String> {
    let (what, name) = line.split_once(" feature specified for `-Ctarget-feature`: `")?;
    let mut words = what.strip_prefix("warning: ")?.split(" and ");
    let is_unknown = words.all(|word| matches!(word, "unknown" | "unstable"));
    is_unknown.then(|| name.trim_end_matches('`').to_owned())
}

/// ``warning: `dynamics-core` (lib) generated 10 warnings``
fn is_sum(line: &str) -> bool {
    line.starts_with("warning: `") && line.contains(" generated ") && line.contains(" warning")
}

/// `   Compiling dynamics-core v0.1.0`: a verb that ends in column 12.
fn is_progress(line: &str) -> bool {
    let verb = line.trim_start().split(' ').next().unwrap_or_default();
    let starts = verb.starts_with(|first: char| first.is_ascii_uppercase());
    starts && line.len() - line.trim_start().len() + verb.len() == 12
}

#[cfg(test)]
mod tests {
    use super::sifted;

    const CARGO_SAYS: &str = "   Compiling dynamics-core v0.1.0 (/robot/dynamics-core)
warning: unknown and unstable feature specified for `-Ctarget-feature`: `mve.fp`
  |
  = help: consider filing a feature request

warning: unstable feature specified for `-Ctarget-feature`: `lob`
  |
  = note: this feature is not stably supported; its behavior can change in the future

warning: unused variable: `torque`
 --> dynamics-core/src/lib.rs:7:9
  |
  = note: `#[warn(unused_variables)]` (part of `#[warn(unused)]`) on by default

warning: `dynamics-core` (lib) generated 3 warnings
warning: firmware-demo@0.1.0: the linker script is missing
    Finished `release` profile [optimized] target(s) in 1.00s
warning: the following packages contain code that will be rejected: old v0.1.0
";

    #[test]
    fn only_warnings_about_target_features_become_a_sentence() {
        let warnings = sifted(CARGO_SAYS);
        expect_test::expect![[r#"
            [
                "warning: unused variable: `torque`\n --> dynamics-core/src/lib.rs:7:9\n  |\n  = note: `#[warn(unused_variables)]` (part of `#[warn(unused)]`) on by default",
                "warning: firmware-demo@0.1.0: the linker script is missing",
                "warning: the following packages contain code that will be rejected: old v0.1.0",
            ]
        "#]].assert_debug_eq(&warnings.others);
        assert!(warnings.sentence().expect("one").contains("(lob, mve.fp)"));
    }

    #[test]
    fn a_warning_that_mentions_a_feature_is_shown() {
        let text = "warning: dead feature specified for `-Ctarget-feature`: `x`\n\nwarning: unused \
            import: `unknown and unstable feature specified`\n";
        let warnings = sifted(text);
        assert_eq!((warnings.others.len(), warnings.sentence()), (2, None));
    }
}
