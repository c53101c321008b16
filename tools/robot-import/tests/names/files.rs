//! Files whose names once gave code that did not compile or ran, as they are imported.

use std::fs;
use std::path::Path;

use robot_import::import::{Args, Imported, Options, import};
use robot_import::text::visible;

use super::compiled::{Batch, c_headers};
use super::project;
use robot_import::project::files;

/// Every file of the folder.
fn imported() -> Vec<Imported> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/names/files");
    let entries = fs::read_dir(folder).expect("the folder");
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    assert!(paths.len() > 30);
    let of = |file: &std::path::PathBuf| {
        let args = Args { file: file.clone(), options: Options::default(), ..Args::default() };
        import(&args, "2026-11-23").unwrap_or_else(|error| panic!("{}: {error}", file.display()))
    };
    paths.iter().map(of).collect()
}

#[test]
fn files_of_hostile_names_compile_and_run_nothing() {
    let (mut batch, mut headers, mut names) = (Batch::new(), Vec::new(), String::new());
    for (k, imported) in imported().iter().enumerate() {
        batch.file(&imported.source);
        names += &format!("m{k}: {:?}\n", imported.name);
        let library = project(&format!("p{k}x"), imported.robot_file(), true);
        let files = files(&library).expect("a legal name").into_iter();
        headers
            .extend(files.filter(|(path, _)| path.starts_with("include/")).map(|(_, text)| text));
        let text = imported.report.text();
        assert!(text.lines().all(|line| visible(line) == line), "{text:?}");
    }
    let all = |error: String| panic!("{names}{error}");
    batch.check().unwrap_or_else(all);
    assert_eq!(batch.doctests(), [""; 0]);
    batch.document().unwrap_or_else(all);
    c_headers(&headers).map(drop).unwrap_or_else(all);
}

#[test]
fn a_changed_name_of_a_type_is_said() {
    let imported = imported();
    let said = |name: &str| {
        let one = imported.iter().find(|one| one.name == name).expect(name);
        let text = one.report.text();
        (text.contains("is called"), one.report.type_name.clone())
    };
    assert_eq!(said("robot"), (true, "MyRobot".to_owned()));
    assert_eq!(said("self"), (true, "MySelf".to_owned()));
    assert_eq!(said("6axis"), (true, "Robot6axis".to_owned()));
    assert_eq!(said("arm6"), (false, "Arm6".to_owned()));
}

#[test]
fn what_cannot_be_a_project_is_refused_in_words() {
    let imported = imported().swap_remove(0);
    let names = "fn self type std core test alloc f32 u8 str bool deps build examples incremental dynamics-core embedded_hal \
                 cortex-m-rt Arm 1arm _arm -arm ärm a.b";
    for name in names.split_whitespace().chain(["", "a b", "a/b"]) {
        let error = files(&project(name, imported.robot_file(), false)).expect_err(name);
        assert!(error.to_string().contains("cannot be the name"), "{error}");
    }
}

/// A file as the importer wrote it before names were escaped, which each check has to refuse.
fn old(name: &str, type_name: &str) -> String {
    format!(
        "//! {name}.\n//!\n//! # Source\n\nuse dynamics_core::model::{{ArmModel, BASE, Body, Joint, Model, Robot}};\n\n/// It.\npub struct {type_name};\n\
         impl Robot<1, 1, 1> for {type_name} {{\nconst MODEL: ArmModel<f64, 1> = Model::new(\"x\", [\
         Body::new(\"a\", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0)]);\n}}\n"
    )
}

#[test]
fn each_check_of_names_refuses_what_was_once_written() {
    let of = |name: &str, type_name: &str| {
        let mut batch = Batch::new();
        batch.file(&old(name, type_name));
        batch
    };
    let error = of("x", "Robot").check().expect_err("two of one name");
    assert!(error.contains("E0255"), "{error}");
    let error = of("x\u{202e}", "Arm").check().expect_err("another direction of text");
    assert!(error.contains("text_direction_codepoint"), "{error}");
    assert_eq!(of("     let x = 1;", "Arm").doctests().len(), 1);
    let error = of("[Missing]", "Arm").document().expect_err("a link");
    assert!(error.contains("unresolved link"), "{error}");
    let error = of("[x](http://x.y)", "Arm").document().expect_err("a link");
    assert!(error.contains("<a "), "{error}");
    let error = of("```text\n//! x", "Arm").document().expect_err("a block of code");
    assert!(error.contains("<pre"), "{error}");
    let header = |text: &str| c_headers(&[format!("#ifndef H\n#define H\n{text}\n#endif\n")]);
    match header("enum joint { A_B_0, A_B_1 };") {
        Ok(0) => eprintln!("skipped: there is no compiler for C"),
        Ok(_) => {
            assert!(header("enum joint { A_B_0, A_B_0 };").is_err());
            assert!(header("/* x */ */").is_err() && header("/* /* */").is_err());
        }
        Err(error) => panic!("{error}"),
    }
}
