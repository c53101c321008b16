//! The drawing of the film: the arm before its reference, and the error below.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};

use crate::simulation::{Motion, PARTS, Skeleton, Tick};

/// The length of the film, s.
const SECONDS: f64 = 10.0;
/// Samples of the motion are this many ticks apart.
const STEP: usize = 80;

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 540.0;
/// The place of the base, px; px of a metre; the azimuth and the elevation of the eye, rad.
const BASE: DVec2 = DVec2::new(300.0, 300.0);
const SCALE: f64 = 365.0;
const AZIMUTH: f64 = -1.05;
const ELEVATION: f64 = 0.36;
/// The radius of the floor, m.
const FLOOR: f64 = 0.64;
/// The strokes of the arm: from which point of the skeleton to which, and their width, px.
const STROKES: [([usize; 2], f64); 3] = [([0, 4], 26.0), ([4, 8], 19.0), ([8, 9], 7.0)];

/// The plot of the error: its left, upper, right and lower end, px, and the error at its upper end,
/// mm.
const PLOT: [f64; 4] = [52.0, 410.0, 622.0, 526.0];
const MOST: f64 = 40.0;

/// Colours by class, light and dark.
const COLOURS: [(&str, &str, &str); 6] = [
    ("paper", "#FFFFFF", "#0D1117"),
    ("ink", "#2D323A", "#E6EDF3"),
    ("faint", "#E4E7EB", "#2A313C"),
    ("muted", "#68717D", "#8B949E"),
    ("arm", "#1B50A2", "#4F93FF"),
    ("wanted", "#E69100", "#F0A020"),
];

/// A point as the eye sees it, px.
fn place(point: DVec3) -> DVec2 {
    let (sin, cos) = AZIMUTH.sin_cos();
    let right = point.x * cos + point.y * sin;
    let away = point.y * cos - point.x * sin;
    let up = point.z * ELEVATION.cos() + away * ELEVATION.sin();
    BASE + SCALE * DVec2::new(right, -up)
}

fn points(of: impl IntoIterator<Item = DVec2>) -> String {
    let each = of.into_iter().map(|at| format!("{:.1},{:.1}", at.x, at.y));
    each.collect::<Vec<_>>().join(" ")
}

/// An animation that sets an attribute to these values in turn, again and again.
fn animate(attribute: &str, seconds: f64, values: &[String]) -> String {
    format!(
        "<animate attributeName=\"{attribute}\" dur=\"{seconds}s\" repeatCount=\"indefinite\" \
         values=\"{}\"/>",
        values.join(";")
    )
}

/// A text whose style is its classes, its size and its anchor.
fn text(style: &str, [x, y]: [f64; 2], words: &str) -> String {
    let mut parts = style.rsplitn(3, ' ');
    let [anchor, size, class] = [(); 3].map(|()| parts.next().unwrap_or_default());
    format!(
        "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\" \
         text-anchor=\"{anchor}\">{words}</text>\n"
    )
}

/// The whole file.
pub fn film(motion: &Motion) -> String {
    let mut samples: Vec<Tick> = motion.ticks.iter().copied().step_by(STEP).collect();
    // The film ends as it begins.
    samples.push(motion.ticks[motion.ticks.len() - 1]);
    let errors: Vec<f64> = samples.iter().map(|tick| 1e3 * tick.error()).collect();
    let most = (0..errors.len()).max_by(|a, b| errors[*a].total_cmp(&errors[*b]));
    let still = most.unwrap_or_default();
    let labels = labels(motion);
    // The reference is the same in each part.
    let (part, seconds) = (motion.part / STEP, SECONDS / PARTS.len() as f64);
    let mut shapes = floor();
    shapes += &arm("wanted", &samples[..=part], still % part, seconds, |tick| tick.reference);
    shapes += &arm("arm", &samples, still, SECONDS, |tick| tick.actual);
    shapes += &words(motion);
    shapes += &plot(&errors, still, &labels);
    let [first, second, last] = &labels;
    format!(
        "<svg width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-labelledby=\"title desc\" \
         font-family=\"system-ui, Helvetica, Arial, sans-serif\">\n\
         <title id=\"title\">A UR5e follows its path with feed-forward and loses it \
         without</title>\n\
         <desc id=\"desc\">Three times the same pick and place, simulated. Distance of the tip \
         from its reference: {first}; {second}; {last}. Without feed-forward, feedback alone holds \
         the arm.</desc>\n<style>\n{}</style>\n\
         <rect class=\"paper\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>\n{shapes}</svg>\n",
        style()
    )
}

fn style() -> String {
    let mut style = String::new();
    for (class, light, dark) in COLOURS {
        let of = |colour| {
            format!(".{class}{{fill:{colour}}}.{class}-line{{fill:none;stroke:{colour}}}\n")
        };
        style += &of(light);
        style += &format!("@media (prefers-color-scheme: dark){{{}}}\n", of(dark));
    }
    style
        + ".bold{font-weight:600}.dashed{stroke-dasharray:2 4}polyline{stroke-linejoin:round;stroke-linecap:round}.still{display:none}\n\
           @media (prefers-reduced-motion: reduce){.moves{display:none}.still{display:inline}}\n"
}

fn floor() -> String {
    let mut lines = String::new();
    for k in -3..=3_i32 {
        let at = 0.2 * f64::from(k);
        let half = (FLOOR * FLOOR - at * at).sqrt();
        for [x, y] in [[half, at], [at, half]] {
            let to = if x == half { [-x, y] } else { [x, -y] };
            let [from, to] = [[x, y], to].map(|[x, y]| points([place(DVec3::new(x, y, 0.0))]));
            write!(lines, "M{from}L{to}").expect("a string");
        }
    }
    format!("<path class=\"faint-line\" d=\"{lines}\"/>\n")
}

/// An arm along the skeletons of the samples, again and again; where nothing moves, or is to move,
/// that of one sample.
fn arm(
    class: &str,
    samples: &[Tick],
    still: usize,
    seconds: f64,
    of: fn(&Tick) -> Skeleton,
) -> String {
    let mut shapes = String::new();
    for ([from, to], width) in STROKES {
        let at = |tick: &Tick| points(of(tick)[from..=to].iter().map(|point| place(*point)));
        // The first again at the end: a value then takes the same time of one part as of all.
        let all = samples.iter().chain(&samples[..1]);
        let places: Vec<String> = all.map(at).collect();
        let moves = animate("points", seconds, &places);
        let line = format!("polyline class=\"{class}-line");
        let still = at(&samples[still]);
        writeln!(
            shapes,
            "<{line} moves\" stroke-width=\"{width}\" points=\"{still}\">{moves}</polyline>\
             <{line} still\" stroke-width=\"{width}\" points=\"{still}\"/>"
        )
        .expect("a string");
    }
    shapes
}

fn words(motion: &Motion) -> String {
    let speed = motion.ticks.len() as f64 / 1000.0 / SECONDS;
    let how = format!("simulated, at {speed:.1} times its speed");
    let mut shapes = text("ink bold 20 start", [20.0, 32.0], "UR5e, pick and place");
    shapes += &text("muted 15 start", [20.0, 54.0], &how);
    for (class, words, x) in [("arm", "arm", 20.0), ("wanted", "reference", 84.0)] {
        shapes += &format!(
            "<rect class=\"{class}\" x=\"{x}\" y=\"70\" width=\"14\" height=\"14\" rx=\"3\"/>"
        );
        shapes += &text("ink 16 start", [x + 20.0, 83.0], words);
    }
    for is_on in [true, false] {
        let shown = PARTS.map(|on| u8::from(on == is_on).to_string());
        let animation = animate("opacity", SECONDS, &shown)
            .replace("<animate", "<animate calcMode=\"discrete\"");
        let (class, state) = [("wanted", "off"), ("arm", "on")][usize::from(is_on)];
        let (style, name) = (format!("{class} bold moves 20 end"), "feed-forward");
        let text = text(&style, [620.0, 32.0], &format!("{name} {state}{animation}"));
        // The sample that is shown where nothing moves is without.
        let opacity = format!("<text opacity=\"{}\"", u8::from(!is_on));
        shapes += &text.replace("<text", &opacity);
    }
    shapes + &text("wanted bold still 20 end", [620.0, 32.0], "feed-forward off")
}

/// A share of the film and an error in mm, px.
fn plotted(share: f64, error: f64) -> DVec2 {
    let [left, top, right, bottom] = PLOT;
    DVec2::new(left + share * (right - left), bottom - error / MOST * (bottom - top))
}

fn plot(errors: &[f64], still: usize, labels: &[String; PARTS.len()]) -> String {
    let [left, top, right, bottom] = PLOT;
    let title = "distance of the tip from its reference, mm";
    let mut shapes = text("muted 16 start", [20.0, 396.0], title);
    for error in [0.0, 20.0, 40.0] {
        let y = plotted(0.0, error).y;
        shapes += &format!("<path class=\"faint-line\" d=\"M{left},{y}H{right}\"/>");
        shapes += &text("muted 15 end", [left - 8.0, y + 5.0], &error.to_string());
    }
    for (k, label) in labels.iter().enumerate() {
        let share = |k: f64| k / PARTS.len() as f64;
        let x = plotted(share(k as f64), 0.0).x;
        if k > 0 {
            shapes += &format!("<path class=\"muted-line dashed\" d=\"M{x:.1},{top}V{bottom}\"/>");
        }
        let middle = plotted(share(k as f64 + 0.5), MOST);
        let at = [middle.x.round(), middle.y + 20.0];
        shapes += &text("ink 16 middle", at, label);
    }
    let whole = (errors.len() - 1) as f64;
    let curve = errors.iter().enumerate();
    let curve: Vec<DVec2> = curve.map(|(k, error)| plotted(k as f64 / whole, *error)).collect();
    shapes += &format!(
        "<polyline class=\"arm-line\" stroke-width=\"2\" points=\"{}\"/>\n",
        points(curve.iter().copied())
    );
    let [x, y] = [|at: &DVec2| at.x, |at: &DVec2| at.y].map(|of| {
        let all = curve.iter().chain(&curve[curve.len() - 1..]);
        all.map(|at| format!("{:.1}", of(at))).collect::<Vec<_>>()
    });
    let place = format!("cx=\"{:.1}\" cy=\"{:.1}\"", curve[still].x, curve[still].y);
    shapes
        + &format!(
            "<circle class=\"arm moves\" r=\"5\" {place}>{}{}</circle><circle class=\"arm still\" \
             r=\"5\" {place}/>\n",
            animate("cx", SECONDS, &x),
            animate("cy", SECONDS, &y)
        )
}

/// The largest error of each part; of the last from where it has become as small as in the first.
fn labels(motion: &Motion) -> [String; PARTS.len()] {
    let errors: Vec<f64> = motion.ticks.iter().map(|tick| 1e3 * tick.error()).collect();
    let parts: Vec<&[f64]> = errors.chunks(motion.part).collect();
    let most = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let [first, second] = [parts[0], parts[1]].map(most);
    let settled = parts[2].iter().rposition(|&error| error > first).map_or(0, |k| k + 1);
    let last = most(&parts[2][settled..]);
    [
        format!("on: at most {first:.2} mm"),
        format!("off: at most {second:.0} mm"),
        format!("on: {last:.2} mm again"),
    ]
}
