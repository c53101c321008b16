//! Recordings that are wrong are refused, with the place.

use std::path::Path;

use identification::files::recorded::Recorded;
use identification::files::robot::Robot;
use identification::files::run;

use crate::arm::*;

fn good() -> String {
    record(|t| swing(t, [0.9, 1.1], [1.7, 2.6]), 40)
}

/// The error of the record with one field of its line 10 changed; field 0 is `number`.
fn changed(field: usize, to: &str) -> String {
    let text = good();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut fields: Vec<&str> = lines[9].split(',').collect();
    fields[field] = to;
    lines[9] = fields.join(",");
    read(&lines.join("\n")).expect_err(to).to_string()
}

#[test]
fn a_wrong_field_is_named_with_line_and_column() {
    for (field, to, why) in [
        (1, "-3.5", "line 10: column `tick`: `-3.5` is not a whole number"),
        (8, "fast", "line 10: column `estimate_0`: `fast` is not a number with a decimal point"),
        (12, "inf", "line 10: column `torque_1`: `inf` is not"),
        (12, "1e300", "line 10: column `torque_1`: `1e300` is not"),
        (12, "1,2", "line 10: 15 columns in place of 14"),
        (8, "\u{1b}[2J", "line 10: column `estimate_0`: `\\u{1b}[2J` is not"),
    ] {
        let error = changed(field, to);
        assert!(error.starts_with(&format!("run.csv, {why}")), "{error}");
    }
}

#[test]
fn a_file_that_is_no_record_is_refused() {
    let titles = good().lines().next().expect("titles").to_owned();
    let without = |name: &str| good().replacen(name, "other", 1);
    let long = format!("{titles}\n{}\n", "9".repeat(100_000));
    // Every second row has the time of the row before it.
    let back = good().replace("\n2", "\n2,2,full,,false,0,0.000100,0,0,0,0,0,0,0\n2");
    for (text, why) in [
        (String::new(), "it has no titles"),
        ("a,b\n1,2\n".to_owned(), "no layout that is known has these columns: give --columns"),
        (without("time_s"), "it lacks `time_s` (did you mean `tick`?); it has number, tick"),
        (without("estimate_1"), "it lacks `estimate_1` (did you mean `estimate_0`?)"),
        (good().replacen("reference_0", "tick", 1), "it lacks `tick`, which is there twice"),
        (
            titles.clone() + ",torque_2\n",
            "it has the column `torque_2`, but the robot has the joints",
        ),
        (titles.clone(), "it has no two rows with a time"),
        (good().replace("full", "hold"), "no row has `mode` = `full`"),
        (long, "line 2: the line has more than"),
        (back, "times go back"),
    ] {
        let error = read(&text).expect_err(why).to_string();
        assert!(error.contains(why), "{why}: {error}");
    }
    let bytes = [titles.as_bytes(), b"\n\xff\xfe,\n"].concat();
    let names = described().joints();
    let error =
        Recorded::from(Path::new("run.csv"), &bytes[..], &names, None).expect_err("no text");
    assert!(error.to_string().contains("line 2: 2 columns in place of 14"), "{error}");
}

#[test]
fn gaps_holds_and_restarts_part_the_recording() {
    let text = good().replace("\n20,20,full", "\n20,20,hold").replace("\n31,31,", "\n31,0,");
    let recorded = read(&text).expect("ticks");
    let lengths: Vec<usize> = recorded.stretches.iter().map(Vec::len).collect();
    // The tick after a restart follows no other; the one after that follows neither.
    assert_eq!(lengths, [20, 10, 1, 8]);
    assert_eq!((recorded.sampling.left_out, recorded.sampling.gaps), (1, 3));
    assert!((recorded.tick - TICK).abs() < 1e-9 && !recorded.sampling.is_resampled);
}

#[test]
fn a_recording_of_another_robot_is_refused() {
    let recorded = read(&record(|t| swing(t, [0.9, 1.1], [1.7, 2.6]), 3000)).expect("ticks");
    let refused = |robot: &Robot| {
        let record = (Path::new("run.csv"), &recorded);
        let outcome = run::identify(robot, record, None, &OPTIONS());
        outcome.expect_err("another robot").to_string()
    };
    let mut narrow = described();
    narrow.imported.tree.bodies[1].limits.position = Some([1.0, 2.0]);
    assert!(refused(&narrow).contains("joint 1 (`elbow`) was at"), "{}", refused(&narrow));
    let short = read(&good()).expect("ticks");
    let outcome = run::identify(&off(), (Path::new("run.csv"), &short), None, &OPTIONS());
    let error = outcome.expect_err("too short").to_string();
    assert!(error.contains("too few to identify"), "{error}");
}

#[test]
fn no_output_replaces_the_recording_or_another() {
    let folder = std::env::temp_dir().join(format!("identify-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let at = |name: &str| folder.join(name);
    std::fs::write(at("r.csv"), "recorded").expect("a file");
    std::fs::write(at("r.urdf"), "<robot name='r'/>").expect("a file");
    for (out, picture, words) in [
        ("r.csv", "p.svg", "which is read and would be lost"),
        ("r.urdf", "p.svg", "which is read and would be lost"),
        ("x.rs", "r.csv", "which is read and would be lost"),
        ("x", "./x", "which is written, too"),
    ] {
        let ended = std::process::Command::new(env!("CARGO_BIN_EXE_identify"))
            .arg(at("r.csv"))
            .arg("--robot")
            .arg(at("r.urdf"))
            .arg("--out")
            .arg(at(out))
            .arg("--picture")
            .arg(at(picture))
            .output()
            .expect("it starts");
        let error = String::from_utf8_lossy(&ended.stderr);
        assert!(!ended.status.success() && error.contains(words), "{error}");
    }
    let left = std::fs::read_to_string(at("r.csv")).expect("a file");
    std::fs::remove_dir_all(&folder).expect("a folder");
    assert_eq!(left, "recorded");
}
