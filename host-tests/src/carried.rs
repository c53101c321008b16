//! Motions under which carried sines and cosines ([`IncrementalTrig`]) are rounded in one
//! direction, tick after tick.

use dynamics_core::state::IncrementalTrig;

/// The next angle of a motion from the tick's number and the angle before.
type Motion = Box<dyn FnMut(u64, f32) -> f32>;

/// An angle this many representable numbers above this one, or below it.
fn moved(q: f32, ulps: i32) -> f32 {
    let next = |q: f32| if ulps > 0 { q.next_up() } else { q.next_down() };
    (0..ulps.abs()).fold(q, |q, _| next(q))
}

/// Motions by name, each from its first angle.
pub fn motions() -> Vec<(String, f32, Motion)> {
    let mut all: Vec<(String, f32, Motion)> = Vec::new();
    for (q, ulps) in [(0.51, 1), (0.78, 1), (0.51, 3), (-1.3, -2)] {
        let creep = move |_, q| moved(q, ulps);
        all.push((format!("creeps by {ulps} ulp a tick from {q}"), q, Box::new(creep)));
    }
    for (ups, angles) in
        [(2, &[0.3_f32, 0.6, 0.7, 0.75, 0.9, 1.2, 2.0, 3.0, -0.75][..]), (3, &[0.6, 0.75])]
    {
        for &at in angles {
            let rest =
                move |k: u64, q| moved(q, if k % (ups + 1) < ups { 1 } else { -(ups as i32) });
            all.push((
                format!("rests at {at}, up by an ulp {ups} times and back"),
                at,
                Box::new(rest),
            ));
        }
    }
    for bits in [14, 17, 20] {
        let count = std::f64::consts::TAU / f64::from(1 << bits);
        let middle = (0.7 / count).floor();
        let flicker = move |k: u64, _| ((middle + (k % 3) as f64) * count) as f32;
        all.push((
            format!("an encoder of 2^{bits} that flickers over 3 counts"),
            (middle * count) as f32,
            Box::new(flicker),
        ));
    }
    // The way back is within the domain of a tick.
    for (rate, period) in [(1e-7, 10_000), (1e-6, 10_000), (1e-7, 100_000)] {
        let saw = move |k: u64, _| (0.6 + rate * (k % period) as f64) as f32;
        all.push((
            format!("creeps by {rate} rad a tick for {period} ticks and returns"),
            0.6,
            Box::new(saw),
        ));
    }
    let mut seed = 1_u32;
    let noise = move |_, _| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        0.7 + 1e-6 * (seed as i32 as f32 / 2.0_f32.powi(31))
    };
    all.push(("noise of 1e-6 rad".into(), 0.7, Box::new(noise)));
    let swing = |k: u64, _| (3.0 * (k as f64 * 1e-3).sin()) as f32;
    all.push(("swings by 3 rad".into(), 0.0, Box::new(swing)));
    all
}

/// The largest error of N joints' sines and cosines that follow a motion for this many ticks: of
/// the sine, the cosine and the length of the pair, against f64.
pub fn worst_error<const N: usize>(ticks: u64, first: f32, motion: &mut Motion) -> f64 {
    let (mut carried, mut q, mut worst) = (IncrementalTrig::at([first; N]), first, 0.0_f64);
    for tick in 0..ticks {
        q = motion(tick, q);
        let (sin, cos) = f64::from(q).sin_cos();
        for turn in carried.follow(&[q; N]).coordinates {
            let (s, c) = (f64::from(turn.sin), f64::from(turn.cos));
            worst = worst.max((s - sin).abs()).max((c - cos).abs());
        }
    }
    worst
}
