use super::{
    MOST, NO_REASON, Outcome, PAGE, REASONS, Reason, Reasons, Results, Verdict, WHOLE_PAGE,
};
use crate::kit::docs::repository::{read, rows_of};

fn outcome(room: &str, change: &str, verdict: Verdict) -> Outcome {
    Outcome {
        room: room.to_owned(),
        file: "a.rs".to_owned(),
        function: "f".to_owned(),
        line: 7,
        change: change.to_owned(),
        operator: "logic".to_owned(),
        verdict,
    }
}

/// Results of so many changes that are noticed and these others, and the reason for the change `y`.
fn results(killed: usize, others: Vec<Outcome>) -> (Results, Reasons) {
    let killed = (0..killed).map(|_| outcome("core", "x", Verdict::Killed("t".to_owned())));
    let reason = Reason {
        file: "a.rs".to_owned(),
        function: "f".to_owned(),
        change: "y".to_owned(),
        because: "It is the same.".to_owned(),
    };
    let results = Results {
        tests: 9,
        unusable: Vec::new(),
        outcomes: killed.chain(others).collect(),
    };
    let reason = vec![reason];
    (results, Reasons { reason })
}

fn text(killed: usize, others: Vec<Outcome>) -> String {
    let (results, reasons) = results(killed, others);
    results.text(false, &reasons, "2026-01-02")
}

fn survivors(count: usize, change: &str) -> Vec<Outcome> {
    vec![outcome("core", change, Verdict::Survived); count]
}

#[test]
fn a_survivor_is_counted_and_listed() {
    let others = vec![
        outcome("tools", "y", Verdict::Survived),
        outcome("core", "z", Verdict::Unreached),
    ];
    let text = text(2, others);
    let rows = rows_of(&text);
    assert_eq!(rows[0], ["core", "3", "2", "1", "1", "33.3"]);
    assert_eq!(rows[1], ["tools", "1", "0", "1", "0", "100.0"]);
    assert_eq!(rows[2], ["all", "4", "2", "2", "1", "50.0"]);
    assert!(text.ends_with("- a.rs:7, `f`: y. It is the same."));
    assert!(text.contains(&format!("- a.rs:7, `f`, unreached: z. {NO_REASON}\n")));
}

#[test]
fn a_reason_for_what_is_noticed_is_idle() {
    let idle = |change: &str, verdict| {
        let (results, reasons) = results(0, vec![outcome("core", change, verdict)]);
        results.idle(&reasons).len()
    };
    assert_eq!(idle("y", Verdict::Killed("t".to_owned())), 1);
    assert_eq!(idle("y", Verdict::Survived), 0);
}

/// The error of a result: counts that do not add up, too few changes, too many survivors, or one without a reason.
fn complaint(text: &str) -> Option<&'static str> {
    let rows = rows_of(text);
    let Some((all, rooms)) = rows.split_last() else {
        return Some("no table");
    };
    let count = |row: &[&str], cell: usize| row[cell].parse::<usize>().expect("a count");
    let adds_up =
        |cell| rooms.iter().map(|row| count(row, cell)).sum::<usize>() == count(all, cell);
    let [changes, killed, survived] = [1, 2, 3].map(|cell| count(all, cell));
    let listed = text.lines().filter(|line| line.starts_with("- ")).count();
    let is_met = text.contains("may survive: met.") && survived as f64 <= MOST * changes as f64;
    let wrong = [
        (!(1..5).all(adds_up) || changes != killed + survived, "sums"),
        (changes < 300, "too few changes"),
        (!is_met, "too many survive"),
        (listed != survived, "another list"),
        (text.contains(NO_REASON), "no reason"),
    ];
    wrong.into_iter().find_map(|(is, what)| is.then_some(what))
}

#[test]
fn a_result_that_does_not_hold_is_refused() {
    // Survivors of one place and change are one line.
    let good = text(299, survivors(1, "y"));
    let wrong = [
        (good.clone(), None),
        (String::new(), Some("no table")),
        (good.replace("299", "298"), Some("sums")),
        (text(298, survivors(1, "y")), Some("too few changes")),
        (text(299, survivors(30, "y")), Some("too many survive")),
        (text(299, survivors(2, "y")), Some("another list")),
        (text(299, survivors(1, "z")), Some("no reason")),
    ];
    for (text, why) in wrong {
        assert_eq!(complaint(&text), why, "{text}");
    }
}

#[test]
fn the_page_has_a_result_that_holds() {
    let page = read(PAGE.file);
    assert_eq!(complaint(PAGE.written(&page).expect("markers")), None);
}

#[test]
fn every_survivor_of_three_rooms_has_a_reason() {
    let (results, reasons) = results(2, vec![outcome("motion", "z", Verdict::Survived)]);
    let text = results.text(true, &reasons, "2026-01-02");
    let expected = ["motion, logic", "1", "0", "1", "0", "100.0"];
    assert_eq!(rows_of(&text)[0], expected);
    assert!(text.contains(NO_REASON));
    let page = read(PAGE.file);
    let written = WHOLE_PAGE.written(&page).expect("markers");
    let all = rows_of(written).pop().expect("a table");
    let listed = written
        .lines()
        .filter(|line| line.starts_with("- "))
        .count();
    assert_eq!(all[3].parse(), Ok(listed));
    assert!(all[1].parse().is_ok_and(|count: usize| count > 2000));
    assert!(!written.contains(NO_REASON));
}

#[test]
fn every_reason_says_of_which_change_it_is() {
    let reasons: Reasons = toml_edit::de::from_str(&read(REASONS)).expect("TOML");
    for reason in reasons.reason {
        let (file, function) = (&reason.file, &reason.function);
        let is_there = read(file).contains(&format!("fn {function}"));
        assert!(is_there, "{file} has no `{function}`");
        assert!(
            !reason.change.is_empty() && reason.because.ends_with('.'),
            "{file}"
        );
    }
}
