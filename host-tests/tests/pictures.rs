//! Pictures have the figures of their pages.

/// The cycles that each effect adds to the engine's inverse dynamics of a UR5e, on the page: they
/// are the last text of the effect's row in the picture.
#[test]
fn the_picture_of_effects_has_the_cycles_of_its_table() {
    let page = include_str!("../../docs/effects.md");
    let picture = include_str!("../../docs/effects.svg");
    let texts: Vec<[&str; 2]> = picture
        .split("<text ")
        .filter_map(|text| {
            let (attributes, rest) = text.split_once(">\n")?;
            let (_, y) = attributes.split_once("y=\"")?;
            Some([y.split('"').next()?, rest.lines().next()?])
        })
        .collect();
    let mut compared = 0;
    for row in page.lines().filter(|row| row.starts_with("| ")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let (Some(effect), Ok(cycles)) = (cells[1].strip_suffix(" ur5e"), cells[3].parse::<u32>())
        else {
            continue;
        };
        let title = effect.replace('_', " ");
        let [y, _] = texts.iter().find(|[_, text]| *text == title).expect(effect);
        let shown =
            texts.iter().rfind(|[row, text]| row == y && !text.is_empty()).expect(effect)[1];
        assert_eq!(shown, cycles.to_string(), "{effect}");
        compared += 1;
    }
    assert!(compared > 15, "{compared} effects");
}
