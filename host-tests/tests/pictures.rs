//! Pictures have the figures of their pages.

/// The cycles that each effect adds to the engine's inverse dynamics of a UR5e, on the page and in
/// the picture: the last text of the effect's row.
fn cycles(page: &str, picture: &str) -> Vec<[String; 2]> {
    let text = |text: &str| {
        let (attributes, rest) = text.split_once(">\n")?;
        let (_, y) = attributes.split_once("y=\"")?;
        Some([y, rest].map(|part| part.split(['"', '\n']).next().unwrap_or_default().to_owned()))
    };
    let texts: Vec<[String; 2]> = picture.split("<text ").filter_map(text).collect();
    let rows = page.lines().filter_map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let &[_, effect, _, cycles, ..] = &cells[..] else { return None };
        let title = effect.strip_suffix(" ur5e").filter(|_| cycles != "–")?.replace('_', " ");
        let [y, _] = texts.iter().find(|[_, text]| *text == title)?;
        let [_, shown] = texts.iter().rfind(|[row, text]| row == y && !text.is_empty())?;
        Some([cycles.to_owned(), shown.clone()])
    });
    rows.collect()
}

#[test]
fn the_picture_of_effects_has_the_cycles_of_its_table() {
    let page = include_str!("../../docs/effects.md");
    let picture = include_str!("../../docs/effects.svg");
    let wrong = |page: &str| {
        let all = cycles(page, picture);
        assert!(all.len() > 15, "{} effects", all.len());
        all.into_iter().filter(|[there, shown]| there != shown).collect::<Vec<_>>()
    };
    assert_eq!(wrong(page), [[""; 2]; 0]);
    assert_eq!(wrong(&page.replace("|     17 |", "|     18 |")), [["18", "17"]]);
}
