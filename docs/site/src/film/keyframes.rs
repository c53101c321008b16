//! Animation by keyframes of CSS, with as few of them as the eye notices.

use std::fmt::Write as _;

use glam::DVec2;

/// What an animation sets, linearly from one keyframe to the next.
pub trait Animated: Copy {
    fn between(self, other: Self, share: f64) -> Self;

    /// px
    fn distance(self, other: Self) -> f64;

    /// As an attribute `transform`.
    fn attribute(self) -> String;

    /// As properties of CSS, which are shorter than its functions.
    fn properties(self) -> String;
}

impl Animated for DVec2 {
    fn between(self, other: Self, share: f64) -> Self {
        self.lerp(other, share)
    }

    fn distance(self, other: Self) -> f64 {
        DVec2::distance(self, other)
    }

    fn attribute(self) -> String {
        format!("translate({},{})", short(self.x), short(self.y))
    }

    fn properties(self) -> String {
        format!("translate:{}px {}px", short(self.x), short(self.y))
    }
}

/// A stroke from a point: its direction in rad, and its length, px.
#[derive(Clone, Copy)]
pub struct Stroke {
    pub start: DVec2,
    pub angle: f64,
    pub length: f64,
}

impl Stroke {
    fn end(self) -> DVec2 {
        self.start + self.length * DVec2::from_angle(self.angle)
    }
}

impl Animated for Stroke {
    fn between(self, other: Self, share: f64) -> Self {
        let scalar = |a: f64, b: f64| a + share * (b - a);
        Self {
            start: self.start.lerp(other.start, share),
            angle: scalar(self.angle, other.angle),
            length: scalar(self.length, other.length),
        }
    }

    fn distance(self, other: Self) -> f64 {
        let start = self.start.distance(other.start);
        start.max(self.end().distance(other.end()))
    }

    // Without its length: a scale would distort what is drawn at its start.
    fn attribute(self) -> String {
        let degrees = short(self.angle.to_degrees());
        format!("{}rotate({degrees})", self.start.attribute())
    }

    fn properties(self) -> String {
        let degrees = short(self.angle.to_degrees());
        format!("{};rotate:{degrees}deg", self.start.properties())
    }
}

/// px: the length of a shape that a [`Length`] scales.
pub const STROKE: f64 = 100.0;

/// The length of a stroke, px.
#[derive(Clone, Copy)]
pub struct Length(pub f64);

impl Animated for Length {
    fn between(self, other: Self, share: f64) -> Self {
        Self(self.0 + share * (other.0 - self.0))
    }

    fn distance(self, other: Self) -> f64 {
        (self.0 - other.0).abs()
    }

    fn attribute(self) -> String {
        format!("scale({:.3},1)", self.0 / STROKE)
    }

    fn properties(self) -> String {
        format!("scale:{:.3} 1", self.0 / STROKE)
    }
}

/// All strokes of an arm at a time, which share their keyframes: between two of them they move as one.
impl<const N: usize> Animated for [Stroke; N] {
    fn between(self, other: Self, share: f64) -> Self {
        std::array::from_fn(|k| self[k].between(other[k], share))
    }

    fn distance(self, other: Self) -> f64 {
        let each = std::iter::zip(self, other).map(|(a, b)| a.distance(b));
        each.fold(0.0, f64::max)
    }

    fn attribute(self) -> String {
        self.map(Animated::attribute).concat()
    }

    fn properties(self) -> String {
        self.map(Animated::properties).join(";")
    }
}

/// The strokes between two points, with angles that do not jump by a turn.
pub fn strokes(ends: impl Iterator<Item = [DVec2; 2]>) -> Vec<Stroke> {
    let mut last = 0.0_f64;
    ends.map(|[start, end]| {
        let angle = (end - start).to_angle();
        last += (angle - last + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
            - std::f64::consts::PI;
        Stroke {
            start,
            angle: last,
            length: start.distance(end),
        }
    })
    .collect()
}

/// A number with as few characters as a tenth of a pixel needs.
pub fn short(number: f64) -> String {
    let text = format!("{number:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0" } else { text }.to_owned()
}

/// The numbers of the samples between which a straight line is nowhere further than `tolerance` from a sample, px.
pub fn thinned<T: Animated>(samples: &[T], tolerance: f64) -> Vec<usize> {
    fn split<T: Animated>(
        samples: &[T],
        [first, last]: [usize; 2],
        tolerance: f64,
        kept: &mut Vec<usize>,
    ) {
        let off = |k: usize| {
            let share = (k - first) as f64 / (last - first) as f64;
            samples[k].distance(samples[first].between(samples[last], share))
        };
        let inner = (first + 1..last).map(|k| (k, off(k)));
        let worst = inner.max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((k, _)) = worst.filter(|&(_, off)| off > tolerance) {
            split(samples, [first, k], tolerance, kept);
            split(samples, [k, last], tolerance, kept);
        } else {
            kept.push(last);
        }
    }
    let mut kept = vec![0];
    split(samples, [0, samples.len() - 1], tolerance, &mut kept);
    kept
}

/// The `@keyframes` of an animation through these of the samples, which are evenly spaced in time.
pub fn keyframes<T: Animated>(name: &str, samples: &[T], kept: &[usize]) -> String {
    let mut css = format!("@keyframes {name}{{");
    let percent = 100.0 / (samples.len() - 1) as f64;
    for &k in kept {
        let at = format!("{:.2}", k as f64 * percent);
        let at = at.trim_end_matches('0').trim_end_matches('.');
        write!(css, "{at}%{{{}}}", samples[k].properties()).expect("a string");
    }
    css + "}\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_lies_near_the_line() {
        let bend = |k: usize| DVec2::new(k as f64, (k as f64 - 50.0).abs());
        let samples: Vec<DVec2> = (0..=100).map(bend).collect();
        assert_eq!(thinned(&samples, 0.1), [0, 50, 100]);
        assert_eq!(thinned(&samples, 60.0), [0, 100]);
        let css = keyframes("k", &samples, &thinned(&samples, 0.1));
        assert!(css.contains("50%{translate:50px 0px}"), "{css}");
    }

    #[test]
    fn a_stroke_that_turns_past_half_a_turn_goes_on() {
        let ends = (0..40).map(|k| [DVec2::ZERO, DVec2::from_angle(0.3 * f64::from(k))]);
        let all = strokes(ends);
        assert!(
            all.windows(2)
                .all(|two| (two[1].angle - two[0].angle - 0.3).abs() < 1e-9)
        );
    }
}
