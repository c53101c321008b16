//! Claims about external torques by the observer of the momentum, on a simulated UR5e with
//! friction.

use dynamics_core::algorithms::MomentumAndCoriolis;
use dynamics_core::effects::BodyWrench;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, LoadFriction, Viscous, Width,
};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::runge_kutta;
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use glam::DVec3;
use motion_control::estimate::{
    ContactDetector, DetectedContact, MomentumObserver, ObserverConfig,
};

const TICK: f64 = 1e-3;
/// K, rad/s.
const BANDWIDTH: f64 = 50.0;
const CONFIG: ObserverConfig<f64> = ObserverConfig { bandwidth: BANDWIDTH, tick: TICK };
type Friction = (Gravity, Viscous<f64, 6>, Coulomb<f64, 6>);
const ROTORS: Armature<f64, 6> = Armature([2.0, 2.0, 2.0, 0.2, 0.2, 0.2]);

fn friction() -> Friction {
    let coulomb = Coulomb { torque: [8.0, 8.0, 5.0, 2.0, 2.0, 2.0], width: Width::new(0.05) };
    (Gravity::EARTH, Viscous([6.0, 6.0, 4.0, 1.0, 1.0, 1.0]), coulomb)
}

/// A quarter of a tick under the torques of the drives and further effects.
fn advance(at: &mut State<f64, 6, 6>, tau: &[f64; 6], more: impl Effect<f64, 6, 6> + Copy) {
    let effects = (friction(), (Inertia, Coriolis, ROTORS), more);
    runge_kutta(&Ur5e::MODEL, at, tau, &effects, TICK / 4.0).expect("an arm with mass");
}

/// The parts of the model that an observer knows.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    All,
    WithoutCoriolis,
    /// All but friction in proportion to the load.
    WithoutGears,
}

/// The model of a state for an observer: p and β.
fn model(at: &State<f64, 6, 6>, known: Known) -> [[f64; 6]; 2] {
    let MomentumAndCoriolis { p, ct_qd } = Core::<Ur5e>::momentum_and_coriolis(at, &ROTORS);
    let load = Core::<Ur5e>::rnea(at, &friction());
    let share = if known == Known::WithoutCoriolis { 0.0 } else { 1.0 };
    [p, core::array::from_fn(|i| share * ct_qd[i] - load[i])]
}

/// Whether a tick has a measurement, and the external torques until the next one.
struct Tick {
    measured: bool,
    external: [f64; 6],
}

/// The external torques of an observer in each tick of a fast motion.
fn run<const ORDER: usize>(
    ticks: usize,
    known: Known,
    more: impl Effect<f64, 6, 6> + Copy,
    tick: impl Fn(usize) -> Tick,
) -> Vec<[f64; 6]> {
    let mut observer = MomentumObserver::<f64, 6, ORDER>::try_new(CONFIG).expect("a good one");
    let mut at = State::at([0.0, -1.2, 1.3, -0.4, 0.5, 0.1]);
    let mut residuals = Vec::new();
    for k in 0..ticks {
        let Tick { measured, external } = tick(k);
        if measured {
            let [p, beta] = model(&at, known);
            observer.update(&p, &beta).expect("finite");
        }
        residuals.push(*observer.external_torque());
        // Gravity and friction are held, and torques at several frequencies move the arm.
        let mut tau = Core::<Ur5e>::rnea(&State { qdd: [0.0; 6], ..at }, &friction());
        for (i, tau) in tau.iter_mut().enumerate() {
            let size = [20.0, 20.0, 15.0, 3.0, 3.0, 3.0][i];
            *tau += size * (0.012 * k as f64 * (1.0 + 0.3 * i as f64)).cos();
        }
        observer.drive(&match known {
            Known::WithoutGears => tau,
            _ => Engine::<Ur5e>::transmitted_torque(&at, &tau, &more),
        });
        let with_external = core::array::from_fn(|i| tau[i] + external[i]);
        for _ in 0..4 {
            advance(&mut at, &with_external, more);
        }
    }
    assert!(at.qd.iter().any(|qd| qd.abs() > 0.4), "{:?}", at.qd);
    residuals
}

const FREE: Tick = Tick { measured: true, external: [0.0; 6] };
const PUSHED: [f64; 6] = [0.0, 10.0, 0.0, -2.0, 0.0, 0.0];

fn pushed(measured: bool) -> Tick {
    Tick { measured, external: PUSHED }
}

/// The largest difference from external torques times a share.
fn off(residual: &[f64; 6], share: f64) -> f64 {
    let pairs = residual.iter().zip(PUSHED);
    pairs.fold(0.0, |worst, (r, pushed)| f64::max(worst, (r - share * pushed).abs()))
}

fn worst(residuals: &[[f64; 6]]) -> f64 {
    residuals.iter().map(|r| off(r, 0.0)).fold(0.0, f64::max)
}

#[test]
fn a_motion_without_contact_has_no_external_torque() {
    let free = worst(&run::<1>(1000, Known::All, (), |_| FREE));
    // N·m: the trapezoidal rule where friction changes its sign within a few ticks.
    assert!(free < 0.01, "{free}");
    // It is the transposed Coriolis product that makes it so.
    let without = worst(&run::<1>(1000, Known::WithoutCoriolis, (), |_| FREE));
    assert!(without > 0.2, "{without}");
}

// It appears at its own joint.
#[test]
fn an_external_torque_appears_with_the_stated_delay() {
    for (k, residual) in run::<1>(300, Known::All, (), |_| pushed(true)).iter().enumerate() {
        let share = 1.0 - (-BANDWIDTH * TICK * k as f64).exp();
        let off = off(residual, share);
        assert!(off < 0.01, "{k}: {off}");
    }
}

#[test]
fn two_poles_respond_as_a_critically_damped_filter() {
    for (k, residual) in run::<2>(300, Known::All, (), |_| pushed(true)).iter().enumerate() {
        // The second pole filters what the first has at the end of the tick, half a tick early.
        let x = BANDWIDTH * TICK * (k as f64 + 0.5);
        let share = 1.0 - (1.0 + x) * (-x).exp();
        assert!(off(residual, share) < 0.03, "{k}: {}", off(residual, share));
    }
}

#[test]
fn lost_measurements_delay_the_external_torque_and_change_nothing_else() {
    let kept = |k: usize| k.is_multiple_of(7) && !(100..112).contains(&k);
    let lost = run::<1>(300, Known::All, (), |k| pushed(kept(k)));
    for (k, residual) in lost.iter().enumerate().filter(|(k, _)| kept(*k)) {
        let share = 1.0 - (-BANDWIDTH * TICK * k as f64).exp();
        // N·m: the trapezoidal rule over several ticks is less accurate.
        assert!(off(residual, share) < 0.3, "{k}: {}", off(residual, share));
    }
    // Between them it stays.
    assert_eq!(lost[101], lost[111]);
}

#[test]
fn friction_that_grows_with_the_load_is_no_contact() {
    let gears = LoadFriction { driving: [0.15; 6], backdriving: [0.1; 6], width: Width::new(0.05) };
    let free = worst(&run::<1>(1000, Known::All, gears, |_| FREE));
    let without = worst(&run::<1>(1000, Known::WithoutGears, gears, |_| FREE));
    // N·m: the friction of a tick is that of its first velocity, also where the sign changes within
    // it.
    assert!(free < 0.3, "{free}");
    assert!(without > 5.0, "{without}");
    // A contact loads the gears of all joints that carry it, and the friction that it adds is no
    // contact further out.
    let wrench = Force::new(DVec3::ZERO, DVec3::new(20.0, -30.0, 40.0));
    let contact = BodyWrench { body: 2, wrench };
    let residuals = run::<1>(300, Known::All, (gears, contact), |_| FREE);
    let last = residuals.last().expect("a tick");
    assert!(last[1].abs() > 3.0, "{last:?}");
    assert!(last[3..].iter().all(|r| r.abs() < 0.1), "{last:?}");
}

#[test]
fn a_link_force_loads_no_joint_further_out() {
    let wrench = Force::new(DVec3::new(2.0, 3.0, 4.0), DVec3::new(20.0, -30.0, 10.0));
    let contact = BodyWrench { body: 3, wrench };
    let mut observer = MomentumObserver::<f64, 6>::try_new(CONFIG).expect("a good one");
    let residuals = run::<1>(300, Known::All, contact, |_| FREE);
    let last = residuals.last().expect("a tick");
    assert!(last[3].abs() > 0.5 && last[4].abs().max(last[5].abs()) < 0.01, "{last:?}");
    // Isolation reads the same from the observer.
    assert_eq!(observer.outermost(&[0.1; 6]), None);
    observer.update(&[0.0; 6], &[0.0; 6]).expect("finite");
    observer.drive(&[0.0; 6]);
    observer.update(&last.map(|r| TICK * r), &[0.0; 6]).expect("finite");
    assert_eq!(observer.outermost(&[0.02; 6]), Some(3));
}

#[test]
fn finite_numbers_with_an_infinite_sum_are_accepted() {
    let mut observer = MomentumObserver::<f64, 2>::try_new(CONFIG).expect("a good one");
    let (p, tau) = (0.6 * f64::MAX, 0.9 * f64::MAX);
    assert!(!(p + p).is_finite() && !(tau + tau).is_finite());
    observer.update(&[p; 2], &[0.0; 2]).expect("finite");
    observer.drive(&[tau; 2]);
    observer.update(&[p + TICK * tau; 2], &[0.0; 2]).expect("finite");
    assert_eq!(observer.external_torque(), &[0.0; 2]);
}

/// Shares of the torques: errors of a model, or bounds of them.
struct Wrong {
    bodies: f64,
    friction: f64,
}

/// The contacts that a detector finds, with the model's torques off by shares up to the stated
/// ones. The arm is pushed from a tick on.
fn contacts(
    stated: Wrong,
    wrong: Wrong,
    pushed: Option<usize>,
) -> Vec<(usize, DetectedContact<f64>)> {
    let mut detector = ContactDetector::<f64, 6>::try_new(CONFIG, [0.2; 6]).expect("a good one");
    let mut at = State::at([0.0, -1.2, 1.3, -0.4, 0.5, 0.1]);
    let (mut found, mut qdd) = (Vec::new(), [0.0; 6]);
    let (gravity, viscous, coulomb) = friction();
    for k in 0..600 {
        let MomentumAndCoriolis { p, ct_qd } = Core::<Ur5e>::momentum_and_coriolis(&at, &ROTORS);
        let weight = Core::<Ur5e>::rnea(&State { qdd: [0.0; 6], ..at }, &gravity);
        let resistance = Core::<Ur5e>::rnea(&State { qdd: [0.0; 6], ..at }, &(viscous, coulomb));
        let effects = (gravity, Inertia, Coriolis, ROTORS);
        let bodies = Core::<Ur5e>::rnea(&State { qdd, ..at }, &effects);
        let share = |x: f64| 1.0 + x;
        let p = p.map(|p| share(wrong.bodies) * p);
        let beta = core::array::from_fn(|i| {
            share(wrong.bodies) * (ct_qd[i] - weight[i]) - share(wrong.friction) * resistance[i]
        });
        let errors = core::array::from_fn(|i| {
            stated.bodies * bodies[i].abs() + stated.friction * resistance[i].abs()
        });
        let contact = detector.update(&p, &beta, &errors).expect("finite");
        found.extend(contact.map(|contact| (k, contact)));
        let mut tau: [f64; 6] = core::array::from_fn(|i| weight[i] + resistance[i]);
        for (i, tau) in tau.iter_mut().enumerate() {
            let size = [20.0, 20.0, 15.0, 3.0, 3.0, 3.0][i];
            *tau += size * (0.012 * k as f64 * (1.0 + 0.3 * i as f64)).cos();
        }
        detector.drive(&tau);
        if pushed.is_some_and(|from| k >= from) {
            tau[4] += 2.0;
        }
        let before = at.qd;
        for _ in 0..4 {
            advance(&mut at, &tau, ());
        }
        qdd = core::array::from_fn(|i| (at.qd[i] - before[i]) / TICK);
    }
    found
}

const STATED: Wrong = Wrong { bodies: 0.03, friction: 0.1 };

#[test]
fn a_model_within_its_stated_error_shows_no_contact() {
    for (bodies, friction) in [(0.03, 0.1), (-0.03, -0.1), (0.03, -0.1), (-0.03, 0.1)] {
        let found = contacts(STATED, Wrong { bodies, friction }, None);
        assert_eq!(found, []);
    }
    // One that is worse does.
    let worse = Wrong { bodies: 0.0, friction: 0.4 };
    assert!(!contacts(STATED, worse, None).is_empty());
}

// It acts at the wrist.
#[test]
fn a_2_newton_metre_push_is_found_within_40_ticks() {
    for from in [100, 250, 400] {
        for (bodies, friction) in [(0.03, 0.1), (-0.03, -0.1)] {
            let found = contacts(STATED, Wrong { bodies, friction }, Some(from));
            let (tick, contact) = found.first().expect("a contact");
            assert_eq!(contact.joint, 4);
            assert!((from..from + 40).contains(tick), "{from}: {tick}");
        }
    }
}
