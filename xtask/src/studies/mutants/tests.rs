use super::{MOST, NO_REASON, Outcome, PAGE, REASONS, Reason, Reasons, Results, Verdict};
use crate::kit::docs::repository::{root, rows_of};

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

fn results(killed: usize, others: Vec<Outcome>) -> Results {
    let killed = (0..killed).map(|_| outcome("core", "x", Verdict::Killed("t".to_owned())));
    Results {
        seed: 1,
        tests: 9,
        unusable: Vec::new(),
        outcomes: killed.chain(others).collect(),
    }
}

fn reasons(change: &str) -> Reasons {
    let (file, function) = ("a.rs".to_owned(), "f".to_owned());
    let reason = Reason {
        file,
        function,
        change: change.to_owned(),
        because: "It is the same.".to_owned(),
    };
    Reasons {
        reason: vec![reason],
    }
}

#[test]
fn a_survivor_is_counted_and_listed() {
    let others = vec![
        outcome("tools", "y", Verdict::Survived),
        outcome("core", "z", Verdict::Unreached),
    ];
    let text = results(2, others).text(&reasons("y"), "2026-01-02");
    let rows = rows_of(&text);
    assert_eq!(rows[0], ["core", "3", "2", "1", "1", "33.3"]);
    assert_eq!(rows[1], ["tools", "1", "0", "1", "0", "100.0"]);
    assert_eq!(rows[2], ["all", "4", "2", "2", "1", "50.0"]);
    assert!(
        text.contains("- a.rs:7, `f`: y. It is the same.\n")
            || text.ends_with("y. It is the same.")
    );
    assert!(text.contains(&format!("- a.rs:7, `f`, unreached: z. {NO_REASON}\n")));
}

#[test]
fn one_survivor_too_many_misses_the_bar() {
    let survivors = |count| {
        (0..count)
            .map(|_| outcome("core", "y", Verdict::Survived))
            .collect()
    };
    let text = |killed, survived| results(killed, survivors(survived)).text(&reasons("y"), "today");
    assert!(text(92, 8).contains("At most 8 % may survive: met."));
    assert!(text(91, 9).contains("At most 8 % may survive: missed."));
}

#[test]
fn a_reason_for_what_is_noticed_is_idle() {
    let idle = |change: &str, others| results(1, others).idle(&reasons(change)).len();
    assert_eq!(idle("x", Vec::new()), 1);
    assert_eq!(idle("y", vec![outcome("core", "y", Verdict::Survived)]), 0);
}

/// The text of a page without a finished run.
const NO_RESULT: &str = "There is no result yet";

/// The error of a result: counts that do not add up, too few changes, too many survivors, or one without a reason.
fn complaint(text: &str) -> Option<String> {
    let rows = rows_of(text);
    let Some((all, rooms)) = rows.split_last() else {
        return Some("no table".to_owned());
    };
    let count = |row: &[&str], cell: usize| row[cell].parse::<usize>().expect("a count");
    let adds_up =
        |cell| rooms.iter().map(|row| count(row, cell)).sum::<usize>() == count(all, cell);
    let [changes, killed, survived] = [1, 2, 3].map(|cell| count(all, cell));
    let listed = text.lines().filter(|line| line.starts_with("- ")).count();
    let says_met = text.contains("may survive: met.");
    let wrong = [
        (
            !(1..5).all(adds_up) || changes != killed + survived,
            "counts do not add up",
        ),
        (changes < 300, "too few changes"),
        (
            survived as f64 > MOST * changes as f64 || !says_met,
            "too many survive",
        ),
        (
            listed != survived,
            "survivors are not those that are counted",
        ),
        (text.contains(NO_REASON), "a survivor has no reason"),
    ];
    let found = wrong.into_iter().find(|(is_wrong, _)| *is_wrong)?;
    Some(found.1.to_owned())
}

#[test]
fn a_result_that_does_not_hold_is_refused() {
    let survivors = |count: usize, change: &str| {
        let one = || outcome("core", change, Verdict::Survived);
        (0..count).map(|_| one()).collect::<Vec<_>>()
    };
    let text = |killed, others| results(killed, others).text(&reasons("y"), "today");
    // Survivors of one place and change are one line.
    let good = text(299, survivors(1, "y"));
    assert_eq!(complaint(&good), None, "{good}");
    let wrong = [
        ("", "no table"),
        (&good.replace("299", "298"), "counts do not add up"),
        (&text(298, survivors(1, "y")), "too few changes"),
        (&text(299, survivors(30, "y")), "too many survive"),
        (
            &text(299, survivors(2, "y")),
            "survivors are not those that are counted",
        ),
        (&text(299, survivors(1, "z")), "a survivor has no reason"),
    ];
    for (text, why) in wrong {
        assert_eq!(complaint(text).as_deref(), Some(why), "{text}");
    }
}

#[test]
fn the_page_has_a_result_that_holds_or_none() {
    let page = std::fs::read_to_string(root().join(PAGE.file)).expect("a page");
    let text = PAGE.written(&page).expect("markers");
    if text.trim_start().starts_with(NO_RESULT) {
        assert_eq!(rows_of(text), Vec::<Vec<&str>>::new());
    } else {
        assert_eq!(complaint(text), None);
    }
}

#[test]
fn every_reason_says_of_which_change_it_is() {
    let text = std::fs::read_to_string(root().join(REASONS)).expect("reasons");
    let reasons: Reasons = toml_edit::de::from_str(&text).expect("TOML");
    for Reason {
        file,
        function,
        change,
        because,
    } in reasons.reason
    {
        let source = std::fs::read_to_string(root().join(&file)).expect("a source");
        assert!(
            source.contains(&format!("fn {function}")),
            "{file} has no `{function}`"
        );
        assert!(
            !change.is_empty() && because.ends_with('.'),
            "{file}: {change}"
        );
    }
}
