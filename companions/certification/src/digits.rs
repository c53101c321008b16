//! Numbers in three digits, with their power of ten written out: as the pages have them.

/// A number in three digits, its power of ten written out.
pub(crate) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{x:.2e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    let power: String = power
        .chars()
        .map(|digit| {
            if digit == '-' {
                '⁻'
            } else {
                SUPERSCRIPTS[digit.to_digit(10).unwrap_or(0) as usize]
            }
        })
        .collect();
    format!("{digits} · 10{power}")
}

/// A number of the page: as [`short`] writes it, or plain.
pub(crate) fn number(text: &str) -> Option<f64> {
    let Some((digits, power)) = text.split_once(" · 10") else {
        return text.parse().ok();
    };
    let digit = |sign: char| match SUPERSCRIPTS.iter().position(|one| *one == sign) {
        Some(digit) => char::from_digit(digit as u32, 10),
        None => (sign == '⁻').then_some('-'),
    };
    let power: Option<String> = power.chars().map(digit).collect();
    format!("{digits}e{}", power?).parse().ok()
}

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
