use super::*;
use std::format;
use std::vec::Vec as List;

const TICK: f64 = 0.01;

fn sway(omega: f64, damping_ratio: f64) -> Vibration<f64> {
    Vibration { link: "boom", mode: 2, omega, damping_ratio }
}

/// Half a period of this many ticks.
fn half_of(ticks: f64) -> Vibration<f64> {
    sway(core::f64::consts::PI / (ticks * TICK), 0.0)
}

fn impulses<const N: usize>(shaper: &Shaper<f64, N>) -> List<(u32, f64)> {
    let pairs = shaper.impulses.iter();
    pairs.map(|one| (one.ticks, one.amplitude)).collect()
}

fn same(got: &[(u32, f64)], want: &[(u32, f64)]) {
    assert_eq!(got.len(), want.len(), "{got:?}");
    for (got, want) in got.iter().zip(want) {
        let apart = (got.1 - want.1).abs();
        assert!(got.0 == want.0 && apart < 1e-9, "{got:?}, not {want:?}");
    }
}

#[test]
fn a_delay_between_two_ticks_is_divided_by_its_fraction() {
    // Half a period of 10.25 ticks: a quarter of the second impulse is at the later tick.
    let zv = Shaper::<f64, 3>::zv(&[half_of(10.25)], TICK).expect("a shaper");
    same(&impulses(&zv), &[(0, 0.5), (10, 0.375), (11, 0.125)]);
    assert_eq!(zv.delay(), 11);
    let zvd = Shaper::<f64, 5>::zvd(&[half_of(10.25)], TICK).expect("a shaper");
    let want = [(0, 0.25), (10, 0.375), (11, 0.125), (20, 0.125), (21, 0.125)];
    same(&impulses(&zvd), &want);
    assert_eq!(zvd.delay(), 21);
}

#[test]
fn damping_makes_later_impulses_smaller_and_later() {
    // ζ = 0.6 and √(1 − ζ²) = 0.8: K = exp(−0.75 π), and half a period is π/(0.8 ω).
    let omega = core::f64::consts::PI / (0.8 * 20.25 * TICK);
    let k = (-0.75 * core::f64::consts::PI).exp();
    let zv = Shaper::<f64, 3>::zv(&[sway(omega, 0.6)], TICK).expect("a shaper");
    let late = k / (1.0 + k);
    let want = [(0, 1.0 / (1.0 + k)), (20, 0.75 * late), (21, 0.25 * late)];
    same(&impulses(&zv), &want);
    let zvd = Shaper::<f64, 5>::zvd(&[sway(omega, 0.6)], TICK).expect("a shaper");
    let all = (1.0 + k) * (1.0 + k);
    let [first, middle, last] = [1.0, 2.0 * k, k * k].map(|part| part / all);
    let want =
        [(0, first), (20, 0.75 * middle), (21, 0.25 * middle), (40, 0.5 * last), (41, 0.5 * last)];
    same(&impulses(&zvd), &want);
}

#[test]
fn several_vibrations_multiply_and_equal_ticks_are_one_impulse() {
    let both = [half_of(10.25), half_of(4.5)];
    let zv = Shaper::<f64, 9>::zv(&both, TICK).expect("a shaper");
    let one = [(0, 0.5), (10, 0.375), (11, 0.125)];
    let other = [(0, 0.5), (4, 0.25), (5, 0.25)];
    // 10 + 5 and 11 + 4 are the same tick.
    let mut want = List::<(u32, f64)>::new();
    for (at, share) in one {
        for (later, part) in other {
            match want.iter_mut().find(|(ticks, _)| *ticks == at + later) {
                Some((_, amplitude)) => *amplitude += share * part,
                None => want.push((at + later, share * part)),
            }
        }
    }
    assert_eq!(want.len(), 8);
    same(&impulses(&zv), &want);
    assert_eq!(zv.delay(), 16);
}

/// Each number of its state tells the tick.
struct Ramp;

impl Reference<f64, 2> for Ramp {
    fn at(&self, tick: u32) -> State<f64, 2, 2> {
        let t = f64::from(tick);
        State { q: [t, -2.0 * t], qd: [3.0 + t, 4.0 * t], qdd: [5.0 - t, 6.0 * t] }
    }
    fn ticks(&self) -> u32 {
        100
    }
}

#[test]
fn a_shaped_state_is_the_sum_of_its_delayed_states() {
    let shaper = Shaper::<f64, 3>::zv(&[half_of(10.25)], TICK).expect("a shaper");
    let shaped = Shaped { reference: Ramp, shaper };
    assert_eq!(shaped.ticks(), 111);
    // Before its delay an impulse is of the first state.
    for (tick, earlier) in [(0, [0, 0, 0]), (7, [7, 0, 0]), (40, [40, 30, 29])] {
        let at = shaped.at(tick);
        let parts = earlier.map(|tick| Ramp.at(tick));
        let sum = |of: fn(&State<f64, 2, 2>) -> [f64; 2]| {
            let [a, b, c] = [0, 1, 2].map(|n| of(&parts[n]));
            [0, 1].map(|k| 0.5 * a[k] + 0.375 * b[k] + 0.125 * c[k])
        };
        let want = [sum(|s| s.q), sum(|s| s.qd), sum(|s| s.qdd)];
        for (got, want) in [at.q, at.qd, at.qdd].as_flattened().iter().zip(want.as_flattened()) {
            assert!((got - want).abs() < 1e-7, "{tick}: {at:?}, not {want:?}");
        }
    }
}

#[test]
fn without_a_vibration_the_reference_is_as_it_was() {
    let shaper = Shaper::<f64, 1>::zv(&[], TICK).expect("a shaper");
    assert_eq!((impulses(&shaper), shaper.delay()), (vec![(0, 1.0)], 0));
    let shaped = Shaped { reference: Ramp, shaper };
    assert_eq!((shaped.at(7), shaped.ticks()), (Ramp.at(7), 100));
}

#[test]
#[rustfmt::skip]
fn a_vibration_without_a_shaper_is_named_with_its_problem() {
    use ShaperProblem::{Damping, Delay, Frequency, Impulses};
    let fine = sway(10.0, 0.1);
    for (vibration, tick, problem, text) in [
        (sway(0.0, 0.1), TICK, Frequency, "the frequency is not positive"),
        (sway(-1.0, 0.1), TICK, Frequency, "the frequency is not positive"),
        (sway(f64::NAN, 0.1), TICK, Frequency, "the frequency is not positive"),
        (sway(f64::INFINITY, 0.1), TICK, Frequency, "the frequency is not positive"),
        (sway(10.0, -0.1), TICK, Damping, "the damping ratio is not within 0 and 1"),
        (sway(10.0, 1.0), TICK, Damping, "the damping ratio is not within 0 and 1"),
        (sway(10.0, f64::NAN), TICK, Damping, "the damping ratio is not within 0 and 1"),
        (fine, 0.0, Delay, "half a period has no number of ticks below a million"),
        (fine, -TICK, Delay, "half a period has no number of ticks below a million"),
        (fine, f64::NAN, Delay, "half a period has no number of ticks below a million"),
        (half_of(1.01e6), TICK, Delay, "half a period has no number of ticks below a million"),
    ] {
        let error = Shaper::<f64, 5>::zvd(&[fine, vibration], tick);
        let error = match tick == TICK {
            // The first one has its shaper.
            true => Shaper::<f64, 25>::zvd(&[fine, vibration], tick).unwrap_err(),
            false => error.unwrap_err(),
        };
        let (link, mode) = ("boom", 2);
        assert_eq!(error, ShaperError { link, mode, problem });
        assert_eq!(format!("{error}"), format!("link `boom`, mode 2: {text}"));
    }
    let error = Shaper::<f64, 2>::zv(&[half_of(10.25)], TICK).unwrap_err();
    assert_eq!(error.problem, Impulses);
    // Half a period of half a tick is divided between none and one.
    let fast = Shaper::<f64, 2>::zv(&[half_of(0.5)], TICK).expect("a shaper");
    same(&impulses(&fast), &[(0, 0.75), (1, 0.25)]);
    assert!(Shaper::<f64, 3>::zv(&[half_of(0.99e6)], TICK).is_ok());
    assert!(Shaper::<f64, 3>::zv(&[sway(10.0, 0.0)], TICK).is_ok());
}
