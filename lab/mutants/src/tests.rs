//! Each operator on a small source, and what is left alone.

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

/// The source with its switches.
fn switched(source: &str) -> String {
    let sites = sites("a.rs", source).expect("valid Rust");
    let all: Vec<&Site> = sites.iter().collect();
    rewritten(source, &all).0
}

#[test]
fn each_change_is_another_one_of_the_same_type() {
    let cases = [
        ("a + b", "`a + b` → `-`"),
        ("a * b", "`a * b` → `/`, `a * b` → `+`"),
        ("a < b", "`a < b` → `<=`, `a < b` → `>=`"),
        ("a == b", "`a == b` → `!=`"),
        ("a && b", "`a && b` → `||`"),
        ("a | b", "`a | b` → `&`"),
        ("-a", "`-a` → `a`"),
        ("!a", "`!a` → `a`"),
        ("a.min(b)", "`a.min(b)` → `max`"),
        ("Some(a)", "`Some(a)` → `None`"),
        ("x.push(a); x", "without `x.push(a);`"),
        ("y += z; x", "without `y += z;`, `y += z` → `-=`"),
        ("g(x)?; x", "without `g(x)?;`"),
        ("if c { x } else { w }", "`if c` → `if !(c)`"),
        // A declaration is needed by what follows, and the negation of a comparison is one of its own changes.
        ("let x = y; if x == z { w } else { x }", "`x == z` → `!=`"),
        ("if let Some(x) = y && z { x } else { w }", ""),
        // The value of a repetition is evaluated when the function runs, and its length is not.
        ("[-a; 2 + 3]", "`-a` → `a`"),
        // Arguments of macros are changed like those of functions.
        (
            "refuse_if!(a > b, \"{a}\")",
            "`a > b` → `>=`, `a > b` → `<=`",
        ),
        ("each!(J, { a + b })", "`a + b` → `-`"),
    ];
    for (expression, expected) in cases {
        let source = format!("fn f() -> T {{ {expression} }}");
        assert_eq!(changes(&source).join(", "), expected);
    }
    let cases = [
        ("fn f() { g(); }", "`f` does nothing, without `g();`"),
        (
            "fn f() -> bool { g() }",
            "`f` returns `true`, `f` returns `false`",
        ),
        ("fn f() -> Option<T> { g() }", "`f` returns `None`"),
        ("fn f() -> Result<(), E> { g() }", "`f` returns `Ok(())`"),
        ("fn f() -> Result<T, E> { g() }", ""),
    ];
    for (source, expected) in cases {
        assert_eq!(changes(source).join(", "), expected);
    }
    let returned = "fn f() { if ::mutant_switch::on(0) { return ; }  g }";
    assert_eq!(switched("fn f() { g }"), returned);
}

/// A room of which every change is taken.
const WHOLE: &str = "motion-control/src/safety/a.rs";

#[test]
fn every_statement_of_a_whole_room_is_left_out() {
    let body = "if a { return; } match b { C => g(x), D => {} } (x.y, z) = w; h(x)";
    let source = format!("fn f() {{ {body} }}");
    let all = sites(WHOLE, &source).expect("valid Rust");
    let of_kind = all.iter().filter(|site| site.operator == "statement");
    let changes: Vec<&str> = of_kind.map(|site| &*site.change).collect();
    let without = "without `h(x)`, without `match b { C => g(x), D => {} }`, without `g(x)`, \
                   without `if a { return; }`, without `return;`, without `(x.y, z) = w;`";
    let kept = ["x.y", "z"].map(|one| format!("`{one}` keeps its value in `(x.y, z) = w`"));
    assert_eq!(changes.join(", "), [without, &kept[0], &kept[1]].join(", "));
    // The same words at two places are two changes, which a sample has once.
    let twice = "fn f() { g(x); g(x); }";
    let drawn = |file| drawn(sites(file, twice).expect("valid Rust")).len();
    assert_eq!((drawn(WHOLE), drawn("motion-control/src/law/a.rs")), (3, 2));
    // What has the body of the change already is none.
    assert_eq!(self::changes("fn f() -> Result<(), E> { Ok(()) }"), [""; 0]);
}

#[test]
fn literals_become_other_literals() {
    for (literal, other) in [
        ("0", "1"),
        ("1_u8", "0u8"),
        ("1_000", "1001"),
        ("0x1f", "(0x1f + 1)"),
        ("0.0", "1.0"),
        ("2.5_f32", "(2.5_f32 * 1.1)"),
        ("true", "false"),
        ("\"1\"", ""),
    ] {
        let sites = sites("a.rs", &format!("fn f() -> T {{ {literal} }}")).expect("valid Rust");
        let changed: Vec<String> = sites.into_iter().map(|site| site.changed).collect();
        assert_eq!(changed.join(", "), other);
    }
}

#[test]
fn constants_tests_and_configured_items_have_no_switch() {
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
        "#[test] fn f() -> T { a + b }",
        "#[cfg(test)] mod tests { fn f() -> T { a + b } }",
        "#[cfg(feature = \"a\")] fn f() -> T { a + b }",
        "#[cfg(target_arch = \"arm\")] impl T { fn f() -> T { a + b } }",
        "fn f() -> T { assert!(a + b == c) }",
    ] {
        assert_eq!(changes(source), [""; 0], "{source}");
    }
    let room = |file| room_of(file).map(|room| room.name);
    assert_eq!(room("xtask/src/kit/docs/tests.rs"), None);
    assert_eq!(room("xtask/src/kit/docs/tests/pages.rs"), None);
    assert_eq!(room("xtask/src/kit/docs.rs"), Some("document checks"));
}

#[test]
fn a_nested_change_is_in_the_unchanged_branch() {
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

// The listed modules are `ROOMS`.
#[test]
fn the_draw_is_repeatable_and_of_listed_modules_only() {
    let one = |k| format!("fn f{k}() -> T {{ if a{k} < b {{ -c{k} }} else {{ d && e }} }}\n");
    let many: String = (0..400).map(one).collect();
    let of_file = |file, source: &str| sites(file, source).expect("valid Rust");
    let here = "dynamics-core/src/sim/a.rs";
    let others = of_file("dynamics-core/src/robots/a.rs", &many);
    let all = drawn([of_file(here, &many), others].concat());
    let keys = |sites: &[Site]| sites.iter().map(Site::key).collect::<Vec<_>>();
    assert!(all.iter().all(|site| site.file == here));
    let numbers: Vec<u32> = all.iter().map(|site| site.number).collect();
    assert_eq!(numbers, (0..all.len() as u32).collect::<Vec<_>>());
    // A change elsewhere leaves the draw as it is.
    let more = many.replace("fn f0()", "fn other() -> T { x }\nfn f0()");
    assert_eq!(keys(&drawn(of_file(here, &more))), keys(&all));
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
    let mut git = Command::new("git");
    let git = git.args(["init", "--quiet"]).arg(&root).status();
    assert!(git.expect("git").success());
    let args = crate::Args {
        root,
        dir: folder.path().join("mutants"),
        only: None,
        survivors: false,
        rooms: false,
    };
    let results = crate::run(&args).expect("it runs");
    let of = |function: &str, change: &str| {
        let mut all = results.outcomes.iter();
        let found = all.find(|one| one.function == function && one.change.contains(change));
        found.map(|outcome| outcome.verdict.clone())
    };
    let killed = Some(Verdict::Killed("dynamics-core/small: it_is".to_owned()));
    assert_eq!(of("held", "→ `+`"), killed);
    assert_eq!(of("loose", "→ `-`"), Some(Verdict::Survived));
    assert_eq!(of("alone", "→ `>=`"), Some(Verdict::Unreached));
    assert_eq!(of("text", "→ `-`"), None);
    assert_eq!(results.tests, 1);
}
