//! The drawing of the film: the arm before its reference, the tip enlarged, and the error below.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};

use crate::keyframes::{Animated, Length, STROKE, Stroke, keyframes, short, strokes, thinned};
use crate::simulation::{Motion, PARTS, Skeleton, Tick};

/// Of the film, s.
const SECONDS: f64 = 10.0;
/// Samples of the motion are this many ticks apart.
const STEP: usize = 20;
/// px: what may be lost between two keyframes.
const TOLERANCE: f64 = 0.35;
/// The same of an arm whose parts move as one.
const OF_AN_ARM: f64 = 1.2;

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 540.0;
/// Where the base stands, px; px of a metre; the azimuth and the elevation of the eye, rad.
const BASE: DVec2 = DVec2::new(240.0, 292.0);
const SCALE: f64 = 365.0;
const AZIMUTH: f64 = -1.05;
const ELEVATION: f64 = 0.36;
/// The radius of the floor, m.
const FLOOR: f64 = 0.64;

/// The tip, enlarged: its centre, radius and px of a metre.
const LENS: DVec2 = DVec2::new(544.0, 226.0);
const RADIUS: f64 = 76.0;
const LENS_SCALE: f64 = 2300.0;

/// The plot of the error: its left, upper, right and lower end, px, and the error at its upper end, mm.
const PLOT: [f64; 4] = [52.0, 410.0, 622.0, 526.0];
const MOST: f64 = 40.0;

/// Half the width of each stroke of the skeleton, px.
const WIDTHS: [f64; 9] = [17.0, 17.0, 13.0, 14.0, 10.5, 10.0, 10.0, 9.0, 3.5];

/// Colours of the pictures of this folder by class, light and dark.
const COLOURS: [(&str, &str, &str); 6] = [
    ("paper", "#FFFFFF", "#0D1117"),
    ("ink", "#2D323A", "#E6EDF3"),
    ("faint", "#E4E7EB", "#2A313C"),
    ("muted", "#68717D", "#8B949E"),
    ("arm", "#1B50A2", "#4F93FF"),
    ("wanted", "#E69100", "#F0A020"),
];

/// A point as the eye sees it, px right and down from the base's.
fn seen(point: DVec3) -> DVec2 {
    let (sin, cos) = AZIMUTH.sin_cos();
    let right = point.x * cos + point.y * sin;
    let away = point.y * cos - point.x * sin;
    let up = point.z * ELEVATION.cos() + away * ELEVATION.sin();
    SCALE * DVec2::new(right, -up)
}

fn place(point: DVec3) -> DVec2 {
    BASE + seen(point)
}

fn points(of: impl Iterator<Item = DVec2>) -> String {
    let each = of.map(|at| format!("{},{}", short(at.x), short(at.y)));
    each.collect::<Vec<_>>().join(" ")
}

/// What grows while the film is drawn: its style and its shapes.
struct Film<'a> {
    motion: &'a Motion,
    /// Every [`STEP`]th tick, the last included.
    samples: Vec<Tick>,
    /// The tick that is shown where nothing moves.
    still: usize,
    moves: String,
    shapes: String,
}

/// The whole file.
pub fn film(motion: &Motion) -> String {
    let mut samples: Vec<Tick> = motion.ticks.iter().copied().step_by(STEP).collect();
    // The film ends as it begins.
    samples.push(motion.ticks[motion.ticks.len() - 1]);
    let worst = samples.iter().map(Tick::error).enumerate();
    let still = worst
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(k, _)| k);
    let mut film = Film {
        motion,
        samples,
        still,
        moves: String::new(),
        shapes: String::new(),
    };
    film.floor();
    // The reference is the same in each part.
    film.arm(["wanted", "r"], motion.part / STEP + 1, |tick| {
        tick.reference
    });
    film.arm(["arm", "a"], film.samples.len(), |tick| tick.actual);
    film.words();
    film.switch();
    film.lens();
    film.plot();
    film.file()
}

impl Film<'_> {
    fn draw(&mut self, shape: &str) {
        self.shapes += shape;
        self.shapes.push('\n');
    }

    fn text(&mut self, class: &str, size: u32, anchor: &str, at: DVec2, words: &str) {
        let (x, y) = (short(at.x), short(at.y));
        self.draw(&format!(
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\">{words}</text>"
        ));
    }

    /// Adds an animation for a class of this name, through these of the samples.
    fn animate<T: Animated>(&mut self, name: &str, samples: &[T], kept: &[usize]) {
        self.moves += &keyframes(name, samples, kept);
        let seconds = SECONDS * (samples.len() - 1) as f64 / (self.samples.len() - 1) as f64;
        self.moves +=
            &format!(".{name}{{transform:none;animation:{name} {seconds}s linear infinite}}\n");
    }

    /// Adds an animation of one property, as its keyframes are written.
    fn keyed(&mut self, name: &str, keys: &str) {
        self.moves += &format!(
            "@keyframes {name}{{{keys}}}\n.{name}{{animation:{name} {SECONDS}s linear infinite}}\n"
        );
    }

    fn floor(&mut self) {
        let mut lines = String::new();
        for k in -3..=3_i32 {
            let at = 0.2 * f64::from(k);
            let half = (FLOOR * FLOOR - at * at).sqrt();
            let [along, across] = [DVec3::new(half, at, 0.0), DVec3::new(at, half, 0.0)];
            for [from, to] in [
                [along, DVec3::new(-half, at, 0.0)],
                [across, DVec3::new(at, -half, 0.0)],
            ] {
                let [from, to] = [from, to].map(|end| points([place(end)].into_iter()));
                write!(lines, "M{from}L{to}").expect("a string");
            }
        }
        self.draw(&format!("<path class=\"line faint-line\" d=\"{lines}\"/>"));
        // The way of the tip, the same in each part.
        let part = self.motion.part / STEP;
        let way: Vec<DVec2> = self.samples[..=part]
            .iter()
            .map(|tick| place(tick.reference[9]))
            .collect();
        let kept = thinned(&way, TOLERANCE);
        let way = points(kept.into_iter().map(|k| way[k]));
        self.draw(&format!(
            "<polyline class=\"line muted-line dashed\" points=\"{way}\"/>"
        ));
    }

    /// The arm along a skeleton, in the first samples, again and again; names of animations begin with `prefix`.
    fn arm(&mut self, [class, prefix]: [&str; 2], samples: usize, of: fn(&Tick) -> Skeleton) {
        let skeletons: Vec<[DVec2; 10]> = self.samples[..samples]
            .iter()
            .map(|tick| of(tick).map(place))
            .collect();
        let [foot, shoulder, ..] = skeletons[0];
        let half = WIDTHS[0];
        self.draw(&format!("<g class=\"{class}\">"));
        self.draw(&format!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"6\"/>",
            short(foot.x - half),
            short(shoulder.y),
            short(2.0 * half),
            short(foot.y - shoulder.y + 8.0)
        ));
        let moving: [Vec<Stroke>; 8] = std::array::from_fn(|k| {
            strokes(
                skeletons
                    .iter()
                    .map(|points| [points[k + 1], points[k + 2]]),
            )
        });
        let together: Vec<[Stroke; 8]> = (0..samples)
            .map(|at| moving.each_ref().map(|strokes| strokes[at]))
            .collect();
        let kept = thinned(&together, OF_AN_ARM);
        let still = self.still % (samples - 1);
        for (k, strokes) in (1..).zip(moving) {
            let (half, larger) = (WIDTHS[k], f64::max(WIDTHS[k], WIDTHS[k - 1]));
            let lengths: Vec<Length> = strokes.iter().map(|stroke| Length(stroke.length)).collect();
            let [place, scale] = [format!("{prefix}{k}"), format!("{prefix}{k}l")];
            self.animate(&place, &strokes, &kept);
            self.animate(&scale, &lengths, &thinned(&lengths, TOLERANCE));
            self.draw(&format!(
                "<g class=\"{place}\" transform=\"{}\"><rect class=\"{scale}\" y=\"-{half}\" width=\"{STROKE}\" \
                 height=\"{}\" transform=\"{}\"/><circle r=\"{larger}\"/><circle class=\"paper\" r=\"{}\"/></g>",
                strokes[still].attribute(),
                2.0 * half,
                lengths[still].attribute(),
                short(larger / 3.0)
            ));
        }
        self.draw("</g>");
    }

    fn words(&mut self) {
        let speed = self.motion.ticks.len() as f64 / 1000.0 / SECONDS;
        self.text(
            "ink bold",
            20,
            "start",
            DVec2::new(20.0, 32.0),
            "UR5e, pick and place",
        );
        let how = format!("simulated, at {} times its speed", short(speed));
        self.text("muted", 15, "start", DVec2::new(20.0, 54.0), &how);
        for (class, words, x) in [("arm", "arm", 20.0), ("wanted", "reference", 84.0)] {
            self.draw(&format!(
                "<rect class=\"{class}\" x=\"{x}\" y=\"70\" width=\"14\" height=\"14\" rx=\"3\"/>"
            ));
            self.text("ink", 16, "start", DVec2::new(x + 20.0, 83.0), words);
        }
    }

    /// The share of the film at which each part begins, %.
    fn begins(&self) -> [f64; PARTS.len()] {
        let whole = self.motion.ticks.len() as f64;
        std::array::from_fn(|k| 100.0 * (k * self.motion.part) as f64 / whole)
    }

    fn switch(&mut self) {
        const MIDDLE: DVec2 = DVec2::new(LENS.x, 78.0);
        self.text(
            "ink bold",
            18,
            "middle",
            DVec2::new(LENS.x, 54.0),
            "feed-forward",
        );
        let [_, off, on] = self.begins();
        let keys = |is_on: &str, is_off: &str| {
            format!(
                "0%,{:.1}%{{{is_on}}}{off:.1}%,{:.1}%{{{is_off}}}{on:.1}%,100%{{{is_on}}}",
                off - 1.0,
                on - 1.0
            )
        };
        let (right, left) = (
            "transform:translate(22px,0px)",
            "transform:translate(0px,0px)",
        );
        self.keyed("knob", &keys(right, left));
        self.keyed("lit", &keys("opacity:1", "opacity:0"));
        self.keyed("dim", &keys("opacity:.45", "opacity:1"));
        self.keyed("bright", &keys("opacity:1", "opacity:.45"));
        let (x, y) = (MIDDLE.x - 24.0, MIDDLE.y - 13.0);
        let pill = format!("x=\"{x}\" y=\"{y}\" width=\"48\" height=\"26\" rx=\"13\"");
        self.draw(&format!("<rect class=\"muted\" {pill}/>"));
        self.draw(&format!("<rect class=\"arm lit\" opacity=\"0\" {pill}/>"));
        let (x, y) = (MIDDLE.x - 11.0, MIDDLE.y);
        self.draw(&format!(
            "<circle class=\"paper knob\" cx=\"{x}\" cy=\"{y}\" r=\"10\"/>"
        ));
        let side = DVec2::new(34.0, 6.0);
        self.text(
            "ink bold dim",
            18,
            "end",
            MIDDLE + DVec2::new(-side.x, side.y),
            "off",
        );
        self.text("ink bold bright", 18, "start", MIDDLE + side, "on");
    }

    fn lens(&mut self) {
        let [x, y] = LENS.to_array();
        self.draw(&format!(
            "<circle class=\"paper faint-line\" cx=\"{x}\" cy=\"{y}\" r=\"{RADIUS}\"/>"
        ));
        let cross = format!(
            "M{},{y}H{}M{x},{}V{}",
            x - RADIUS,
            x + RADIUS,
            y - RADIUS,
            y + RADIUS
        );
        self.draw(&format!("<path class=\"line faint-line\" d=\"{cross}\"/>"));
        let off = |tick: &Tick| LENS_SCALE / SCALE * seen(tick.actual[9] - tick.reference[9]);
        let dots: Vec<DVec2> = self.samples.iter().map(|tick| LENS + off(tick)).collect();
        self.animate("dot", &dots, &thinned(&dots, TOLERANCE));
        let dot = dots[self.still].attribute();
        self.draw(&format!(
            "<circle class=\"ring\" cx=\"{x}\" cy=\"{y}\" r=\"9\"/>"
        ));
        self.draw(&format!(
            "<g class=\"dot\" transform=\"{dot}\"><circle class=\"arm\" r=\"6\"/></g>"
        ));
        let bar = LENS_SCALE / 100.0;
        let left = x - 38.0;
        let below = y + RADIUS + 24.0;
        self.draw(&format!(
            "<path class=\"line ink-line\" d=\"M{left},{}v8m0,-4h{bar}m0,-4v8\"/>",
            short(below - 9.0)
        ));
        let words = DVec2::new(left + bar + 8.0, below);
        self.text("ink", 16, "start", words, "10 mm");
        let above = LENS - DVec2::new(0.0, RADIUS + 10.0);
        self.text("muted", 16, "middle", above, "the tip, enlarged");
    }

    /// A share of the film and an error in mm, px.
    fn plotted(share: f64, error: f64) -> DVec2 {
        let [left, top, right, bottom] = PLOT;
        DVec2::new(
            left + share * (right - left),
            bottom - error / MOST * (bottom - top),
        )
    }

    fn plot(&mut self) {
        let [left, top, right, bottom] = PLOT;
        let title = "distance of the tip from its reference, mm";
        self.text("muted", 16, "start", DVec2::new(20.0, 396.0), title);
        let begins = self.begins().map(|percent| percent / 100.0);
        let whole = (self.samples.len() - 1) as f64;
        let curve = self.samples.iter().enumerate();
        let curve: Vec<DVec2> = curve
            .map(|(k, tick)| Self::plotted(k as f64 / whole, 1e3 * tick.error()))
            .collect();
        let kept = thinned(&curve, 0.25);
        let line = points(kept.iter().map(|&k| curve[k]));
        self.draw(&format!("<polyline class=\"curve\" points=\"{line}\"/>"));
        // What is to come is veiled; nothing is where nothing moves.
        let (wide, high) = (right - left + 4.0, bottom - top + 8.0);
        self.draw(&format!(
            "<svg x=\"{}\" y=\"{}\" width=\"{wide}\" height=\"{high}\"><rect class=\"paper veil\" width=\"{wide}\" height=\"{high}\"/></svg>",
            left - 2.0,
            top - 4.0
        ));
        self.keyed(
            "veil",
            &format!("0%{{transform:translateX(2px)}}100%{{transform:translateX({wide}px)}}"),
        );
        for error in [0.0, 20.0, 40.0] {
            let y = Self::plotted(0.0, error).y;
            // At 0 it would be drawn over the curve.
            if error > 0.0 {
                self.draw(&format!(
                    "<path class=\"line faint-line\" d=\"M{left},{y}H{right}\"/>"
                ));
            }
            self.text(
                "muted",
                15,
                "end",
                DVec2::new(left - 8.0, y + 5.0),
                &format!("{error}"),
            );
        }
        for begin in &begins[1..] {
            let x = short(Self::plotted(*begin, 0.0).x);
            self.draw(&format!(
                "<path class=\"line muted-line dashed\" d=\"M{x},{top}V{bottom}\"/>"
            ));
        }
        self.animate("now", &curve, &kept);
        let still = curve[self.still].attribute();
        self.draw(&format!(
            "<g class=\"now\" transform=\"{still}\"><circle class=\"arm\" r=\"5\"/></g>"
        ));
        let labels = self.labels();
        for (begin, label) in begins.into_iter().zip(labels) {
            let at = Self::plotted(begin + 0.5 / PARTS.len() as f64, MOST);
            self.text("ink", 16, "middle", at + DVec2::new(0.0, 20.0), &label);
        }
    }

    /// The largest error of each part; of the last from where it has become as small as in the first.
    fn labels(&self) -> [String; PARTS.len()] {
        let errors: Vec<f64> = self
            .motion
            .ticks
            .iter()
            .map(|tick| 1e3 * tick.error())
            .collect();
        let parts: Vec<&[f64]> = errors.chunks(self.motion.part).collect();
        let most = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
        let [first, second] = [parts[0], parts[1]].map(most);
        let settled = parts[2]
            .iter()
            .rposition(|&error| error > first)
            .map_or(0, |k| k + 1);
        let last = most(&parts[2][settled..]);
        [
            format!("on: at most {first:.2} mm"),
            format!("off: at most {second:.0} mm"),
            format!("on: {last:.2} mm again"),
        ]
    }

    fn file(self) -> String {
        let mut style = String::new();
        for (name, light, dark) in COLOURS {
            writeln!(
                style,
                ".{name}{{fill:{light}}}.{name}-line{{stroke:{light}}}\
                 @media (prefers-color-scheme: dark){{.{name}{{fill:{dark}}}.{name}-line{{stroke:{dark}}}}}"
            )
            .expect("a string");
            if matches!(name, "paper" | "arm" | "wanted") {
                let of = match name {
                    "paper" => ".arm rect,.arm circle,.wanted rect,.wanted circle",
                    "arm" => ".curve",
                    _ => ".ring",
                };
                writeln!(style, "{of}{{stroke:{light}}}@media (prefers-color-scheme: dark){{{of}{{stroke:{dark}}}}}").expect("a string");
            }
        }
        let [first, second, last] = self.labels();
        format!(
            "<svg width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" xmlns=\"http://www.w3.org/2000/svg\" \
             role=\"img\" aria-labelledby=\"title desc\" font-family=\"system-ui, Helvetica, Arial, sans-serif\">\n\
             <title id=\"title\">A UR5e follows its path with feed-forward and loses it without</title>\n\
             <desc id=\"desc\">Three times the same pick and place, simulated. Distance of the tip from its reference: {first}; {second}; {last}. \
             Without feed-forward, feedback alone holds the arm.</desc>\n\
             <style>\n{style}\
             .bold{{font-weight:600}}.bright{{opacity:.45}}.line{{fill:none}}.dashed{{stroke-dasharray:2 4}}\
             .curve{{fill:none;stroke-width:2;stroke-linejoin:round}}.ring{{fill:none;stroke-width:3}}.veil{{display:none}}\n\
             @media (prefers-reduced-motion: no-preference){{\n.veil{{display:inline;opacity:.75}}\n{}}}\n</style>\n\
             <rect class=\"paper\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>\n{}</svg>\n",
            self.moves, self.shapes
        )
    }
}
