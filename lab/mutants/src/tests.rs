//! Each operator on a small source, and what is left alone.

use std::path::Path;
use std::process::Command;

use crate::find::sites;
use crate::outcome::Verdict;
use crate::rooms::{ROOMS, drawn, room_of};
use crate::site::{Site, rewritten};

/// The changes of a source, in its order.
fn changes(source: &str) -> Vec<String> {
    let sites = sites("a.rs", source).expect("valid Rust");
    sites.into_iter().map(|site| site.change).collect()
}

/// The changes of an expression in a function that returns a type without a constant.
fn of(expression: &str) -> Vec<String> {
    changes(&format!("fn f() -> T {{ {expression} }}"))
}

/// What the only switch of a source makes of it.
fn switched(source: &str) -> String {
    let sites = sites("a.rs", source).expect("valid Rust");
    let all: Vec<&Site> = sites.iter().collect();
    rewritten(source, &all).0
}

#[test]
fn operators_become_others_of_the_same_types() {
    assert_eq!(of("a + b"), ["`a + b` → `-`"]);
    assert_eq!(of("a * b"), ["`a * b` → `/`", "`a * b` → `+`"]);
    assert_eq!(of("a < b"), ["`a < b` → `<=`", "`a < b` → `>=`"]);
    assert_eq!(of("a == b"), ["`a == b` → `!=`"]);
    assert_eq!(of("a && b"), ["`a && b` → `||`"]);
    assert_eq!(of("a | b"), ["`a | b` → `&`"]);
    assert_eq!(of("-a"), ["`-a` → `a`"]);
    assert_eq!(of("!a"), ["`!a` → `a`"]);
    assert_eq!(of("a.min(b)"), ["`a.min(b)` → `max`"]);
    assert_eq!(of("Some(a)"), ["`Some(a)` → `None`"]);
}

#[test]
fn numbers_become_others() {
    let other = |literal: &str| {
        let changed: Vec<String> = sites("a.rs", &format!("fn f() -> T {{ {literal} }}"))
            .expect("valid Rust")
            .into_iter()
            .map(|site| site.changed)
            .collect();
        changed.join(", ")
    };
    assert_eq!(other("0"), "1");
    assert_eq!(other("1_u8"), "0u8");
    assert_eq!(other("1_000"), "1001");
    assert_eq!(other("0x1f"), "(0x1f + 1)");
    assert_eq!(other("0.0"), "1.0");
    assert_eq!(other("2.5_f32"), "(2.5_f32 * 1.1)");
    assert_eq!(other("true"), "false");
    assert_eq!(other("\"1\""), "");
}

#[test]
fn statements_are_left_out_and_conditions_negated() {
    let source = "fn f(x: &mut T) -> T { x.push(a); y += z; g(x)?; if c { return x; } x }";
    let expected = [
        "without `x.push(a);`",
        "without `y += z;`",
        "`y += z` → `-=`",
        "without `g(x)?;`",
        "`if c` → `if !(c)`",
    ];
    assert_eq!(changes(source), expected);
    // A declaration is needed by what follows, and the negation of a comparison is one of its own changes.
    assert_eq!(
        changes("fn f() -> T { let x = y; if x == z { w } else { x } }"),
        ["`x == z` → `!=`"]
    );
    assert_eq!(of("if let Some(x) = y && z { x } else { w }"), [""; 0]);
}

#[test]
fn functions_return_at_once() {
    assert_eq!(
        changes("fn f() { g(); }"),
        ["`f` does nothing", "without `g();`"]
    );
    assert_eq!(
        changes("fn f() -> bool { g() }"),
        ["`f` returns `true`", "`f` returns `false`"]
    );
    assert_eq!(
        changes("fn f() -> Option<T> { g() }"),
        ["`f` returns `None`"]
    );
    assert_eq!(
        changes("fn f() -> Result<(), E> { g() }"),
        ["`f` returns `Ok(())`"]
    );
    assert_eq!(changes("fn f() -> Result<T, E> { g() }"), [""; 0]);
    assert_eq!(
        switched("fn f() { g }"),
        "fn f() { if ::mutant_switch::on(0) { return ; }  g }"
    );
}

#[test]
fn what_the_compiler_evaluates_has_no_switch() {
    for source in [
        "const fn f() -> T { a + b }",
        "const A: T = a + 1;",
        "static A: T = a + 1;",
        "enum E { A = 1 + 2 }",
        "fn f() -> T { const { a + 1 } }",
        "fn f() -> T { const A: T = a + 1; A }",
        "fn f() -> T { g::<{ a + 1 }>() }",
        "fn f() -> T { g::<1>() }",
        "fn f() -> T { let x: [T; 1 + 2] = y; x }",
        "fn f() -> T { match x { 0..=1 => y, _ => z } }",
        "struct S<const N: usize = 1>;",
        "macro_rules! m { () => { 1 + 2 } }",
    ] {
        assert_eq!(changes(source), [""; 0], "{source}");
    }
    // Of a repetition, the value is evaluated when the function runs, and the length is not.
    assert_eq!(of("[-a; 2 + 3]"), ["`-a` → `a`"]);
}

#[test]
fn tests_and_configured_items_have_no_switch() {
    for source in [
        "#[test] fn f() -> T { a + b }",
        "#[cfg(test)] mod tests { fn f() -> T { a + b } }",
        "#[cfg(feature = \"a\")] fn f() -> T { a + b }",
        "#[cfg(target_arch = \"arm\")] impl T { fn f() -> T { a + b } }",
        "fn f() -> T { assert!(a + b == c) }",
    ] {
        assert_eq!(changes(source), [""; 0], "{source}");
    }
    assert!(
        room_of("xtask/src/kit/docs/tests.rs").is_none()
            && room_of("xtask/src/kit/docs/tests/pages.rs").is_none()
    );
    assert_eq!(
        room_of("xtask/src/kit/docs/columns.rs")
            .expect("a room")
            .name,
        "document checks"
    );
}

#[test]
fn arguments_of_macros_are_changed_like_those_of_functions() {
    assert_eq!(
        of("refuse_if!(a > b, \"{a}\")"),
        ["`a > b` → `>=`", "`a > b` → `<=`"]
    );
    assert_eq!(of("each!(J, { a + b })"), ["`a + b` → `-`"]);
}

#[test]
fn a_change_within_another_stays_in_the_text_that_is_not_changed() {
    let text = switched("fn f() -> T { a + b * c }");
    let inner = "(if ::mutant_switch::on(1) { (b) / (c) } else { (if ::mutant_switch::on(2) { (b) + (c) } else { b * c }) })";
    assert_eq!(
        text,
        format!(
            "fn f() -> T {{ (if ::mutant_switch::on(0) {{ (a) - (b * c) }} else {{ a + {inner} }}) }}"
        )
    );
}

#[test]
fn each_site_has_its_bytes_in_the_new_text() {
    let source = "fn f() { g(-a); }";
    let sites = sites("a.rs", source).expect("valid Rust");
    let (text, places) = rewritten(source, &sites.iter().collect::<Vec<_>>());
    assert_eq!(places.len(), sites.len());
    for (number, bytes) in places {
        assert!(
            text[bytes]
                .trim()
                .contains(&format!("mutant_switch::on({number})"))
        );
    }
}

#[test]
fn the_draw_is_the_same_each_time_and_of_no_other_rooms() {
    let many: String = (0..400)
        .map(|k| format!("fn f{k}() -> T {{ if a{k} < b {{ -c{k} }} else {{ d && e }} }}\n"))
        .collect();
    let of_file = |file: &str| sites(file, &many).expect("valid Rust");
    let all = || {
        [
            of_file("dynamics-core/src/sim/a.rs"),
            of_file("dynamics-core/src/robots/a.rs"),
        ]
        .concat()
    };
    let keys = |seed| drawn(all(), seed).iter().map(Site::key).collect::<Vec<_>>();
    assert_eq!(keys(1), keys(1));
    assert_ne!(keys(1), keys(2));
    assert!(
        keys(1)
            .iter()
            .all(|key| key.starts_with("dynamics-core/src/sim/"))
    );
    let numbers: Vec<u32> = drawn(all(), 1).iter().map(|site| site.number).collect();
    assert_eq!(numbers, (0..numbers.len() as u32).collect::<Vec<_>>());
    // A change elsewhere leaves the draw as it is.
    let more = many.replace("fn f0()", "fn other() -> T { x }\nfn f0()");
    let moved = sites("dynamics-core/src/sim/a.rs", &more).expect("valid Rust");
    assert_eq!(
        drawn(moved, 1).iter().map(Site::key).collect::<Vec<_>>(),
        keys(1)
    );
    assert!(ROOMS.len() > 10);
}

/// Two functions of which a test checks one, and a third that no test calls.
const SMALL: &str = "
pub fn held(a: i32) -> i32 { a - 7 }
pub fn loose(a: i32) -> i32 { a + 7 }
pub fn alone(a: i32) -> bool { a > 7 }
/// A change that does not compile: a text has no difference.
pub fn text(a: String) -> String { a + \"x\" }
#[test]
fn it_is() { assert_eq!(held(9), 2); loose(1); text(String::new()); }
";

#[test]
fn a_small_workspace_has_killed_surviving_unreached_and_refused_changes() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().join("workspace");
    let write = |file: &str, text: &str| {
        let path = root.join(file);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(path, text).expect("written");
    };
    write(
        "Cargo.toml",
        "[workspace]\nresolver = \"3\"\nmembers = [\"dynamics-core\"]\n",
    );
    let lib = "[lib]\npath = \"src/sim/lib.rs\"\n[dependencies]\n";
    write(
        "dynamics-core/Cargo.toml",
        &format!("[package]\nname = \"small\"\nedition = \"2024\"\n{lib}"),
    );
    write("dynamics-core/src/sim/lib.rs", SMALL);
    let git = Command::new("git")
        .arg("init")
        .arg("--quiet")
        .arg(&root)
        .status();
    assert!(git.expect("git").success());
    let dir = folder.path().join("mutants");
    let arguments = [
        Path::new("mutants"),
        Path::new("--root"),
        &root,
        Path::new("--dir"),
        &dir,
    ];
    let arguments = <crate::Args as clap::Parser>::parse_from(arguments);
    let results = crate::run(&arguments).expect("it runs");
    let of = |function: &str, change: &str| {
        let mut found = results
            .outcomes
            .iter()
            .filter(|outcome| outcome.function == function);
        found
            .find(|outcome| outcome.change.contains(change))
            .map(|outcome| outcome.verdict.clone())
    };
    let killed = Some(Verdict::Killed("dynamics-core/small: it_is".to_owned()));
    assert_eq!(of("held", "→ `+`"), killed);
    assert_eq!(of("loose", "→ `-`"), Some(Verdict::Survived));
    assert_eq!(of("alone", "→ `>=`"), Some(Verdict::Unreached));
    assert_eq!(of("text", "→ `-`"), None);
    assert_eq!(results.tests, 1);
}
