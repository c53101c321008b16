use super::{Image, List, PAGE, Routine, list, page::text};
use crate::kit::docs::repository::root;

fn image(overhead: f64, sequences: bool) -> Image {
    let mut image = list().expect("a list").image.remove(0);
    let routine = |per| Routine {
        name: "f".into(),
        kind: "k".into(),
        published: 100.0,
        per,
    };
    image.routine = vec![routine(1.0), routine(2.0)];
    (image.overhead, image.sequences) = (overhead, sequences);
    image
}

#[test]
fn each_call_is_a_routine_with_its_sources_overhead() {
    let cycles = |overhead, passages: &[(u8, u64)]| {
        let image = image(overhead, false);
        image.cycles(passages.iter().copied())
    };
    let plain = cycles(0.0, &[(0, 110), (0, 220)]).expect("two");
    assert_eq!(plain, [110.0, 110.0]);
    let less = cycles(-1.0, &[(1, 10), (0, 110), (0, 210)]).expect("two");
    assert_eq!(less, [100.0, 100.0]);
    assert!(cycles(0.0, &[(0, 110)]).is_err(), "too few");
    assert!(cycles(0.0, &[(1, 10), (0, 110), (0, 220)]).is_err());
    assert!(cycles(1.0, &[(0, 110), (0, 220)]).is_err(), "no overhead");
}

#[test]
fn the_summary_is_that_of_the_rows() {
    let list = List {
        image: vec![image(0.0, false), image(0.0, true)],
    };
    let whole = vec![[90.0, 103.0, 110.0], [100.0, 96.0, 104.0]];
    let sequences = vec![[100.0, 150.0, 150.0], [100.0, 100.0, 100.0]];
    let text = text(&list, &[whole, sequences]);
    let row = |reading: &str| {
        let row = text
            .lines()
            .find(|line| line.starts_with(&format!("| {reading}")));
        row.expect("a row").split_whitespace().collect::<String>()
    };
    assert_eq!(row("chosen"), "|chosen|-4.0|3.5|-0.5|+50.0|25.1|+12.2|");
    assert_eq!(row("least"), "|least|-10.0|7.1|-5.0|-10.0|5.0|-2.5|");
    assert!(
        text.contains("| 2 routines: RMS, % |") && text.contains("| 4 with sequences: RMS, % |")
    );
}

/// Whether a page has the routines of the list, and deviations that are those of its figures.
fn agrees(page: &str) -> bool {
    let (list, written) = (
        list().expect("a list"),
        PAGE.written(page).expect("markers"),
    );
    let cells = |row: &str| {
        let cells = row.trim_matches('|').split('|');
        cells
            .map(|cell| cell.trim().replace(',', ""))
            .collect::<Vec<_>>()
    };
    let rows = |text: &str| {
        text.lines()
            .map(cells)
            .filter(|row| row.len() > 5)
            .collect::<Vec<_>>()
    };
    let figures = rows(written)
        .into_iter()
        .filter(|row| row.len() == 10)
        .skip(2);
    let mut figures = figures.map(|row| [4, 5, 6].map(|i| row[i].parse().expect("cycles")));
    let of = |image: &Image| figures.by_ref().take(image.routine.len()).collect();
    let cycles: Vec<Vec<[f64; 3]>> = list.image.iter().map(of).collect();
    // The figures of the page are rounded, so a deviation made of them is off by that much.
    let is_same = |(there, again): (&String, &String)| {
        let figures = [there, again].map(|cell| {
            cell.parse::<f64>()
                .ok()
                .filter(|_| cell.starts_with(['+', '-']))
        });
        match figures {
            [Some(a), Some(b)] => (a - b).abs() < 0.11,
            _ => there == again,
        }
    };
    let (there, again) = (rows(written).concat(), rows(&text(&list, &cycles)).concat());
    there.len() == again.len() && there.iter().zip(&again).all(is_same)
}

#[test]
fn the_page_has_the_listed_routines_with_their_deviations() {
    let page = std::fs::read_to_string(root().join(PAGE.file)).expect("a page");
    assert!(agrees(&page), "{} is out of date", PAGE.file);
    let row = page.lines().find(|line| line.starts_with("| CRT"));
    let row = format!("{}\n", row.expect("a row"));
    assert!(!agrees(&page.replace(&row, "")), "a row less");
    for other in ["| RTC", "| CRT 2"] {
        assert!(!agrees(&page.replace("| CRT  ", other)), "{other}");
    }
    let digit = |column: usize| {
        let cell = row.split('|').nth(column).expect("a cell");
        let other = row.replace(cell, &cell.replacen(['2', '4', '5'], "7", 1));
        agrees(&page.replace(&row, &other))
    };
    // What was published, a reading, a deviation.
    assert!(!digit(4) && !digit(6) && !digit(9));
}
