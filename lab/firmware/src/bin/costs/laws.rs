//! Control laws and the regressor on the UR5e.

use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::algorithms::jacobian_rows;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{OnBody, Static};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::{ArmState, State};
use dynamics_core::trig::sin_cos;
use dynamics_core::{Core, Engine};
use motion_control::{estimate::*, law::*, limits::*, reference::*};

use super::row::Row;
use super::{Ask, STATES};

const TIP: usize = 5;

/// The row of a law under all effects, with sines and cosines inside or outside.
fn row(algorithm: &'static str, form: &'static str, trig: bool) -> Row<'static> {
    Row::of::<Ur5e, 6, 6>(algorithm, form, "full", trig)
}

#[inline(never)]
fn slotine_li(gains: &PassivityGains<f32, 6>, at: &ArmState<f32, 6>) -> [f32; 6] {
    let estimate = Estimate { q: at.q, qd: at.qdd };
    passivity_based_torque(&Static::<Ur5e>::NEW, gains, at, &estimate, &RIGID_BODY)
}

#[inline(never)]
fn guided(law: &HandGuiding<f32, 6>, at: &ArmState<f32, 6>) -> [f32; 6] {
    law.torque(&Estimate { q: at.q, qd: at.qd }, &at.qdd, &at.qd)
}

#[inline(never)]
fn shaped(law: &InertiaShaping<f32, 6>, at: &ArmState<f32, 6>) -> [f32; 6] {
    law.torque(&at.qdd, &at.qd)
}

#[inline(never)]
fn detected(detector: &mut ContactDetector<f32, 6>, at: &ArmState<f32, 6>) -> bool {
    let contact = detector.update(&at.qd, &at.qdd, &at.q.map(f32::abs));
    detector.drive(&at.qdd);
    contact.is_ok()
}

/// All of a Cartesian impedance: inverse dynamics, Jacobian, M with its factors and the law.
#[inline(never)]
fn impedance(law: &mut CartesianImpedance<f32, 6>, ask: &Ask<6>) -> [f32; 6] {
    let columns = Engine::<Ur5e>::jacobian(&ask.trig, OnBody::<TIP>, LocalWorldAligned);
    let rows = jacobian_rows(&columns);
    let m = Engine::<Ur5e>::crba(&ask.trig, &RIGID_BODY);
    let Ok(factors) = Engine::<Ur5e>::ltdl(&m) else {
        return [0.0; 6];
    };
    let solve = |tau: &_| Engine::<Ur5e>::solve(&factors, tau);
    let bias = Engine::<Ur5e>::rnea(ask.trig.with(&ask.state), &RIGID_BODY);
    let deviation = TaskDeviation { position: ask.state.qd, velocity: ask.state.qdd };
    let torque = law.torque(&rows, solve, &deviation, &bias, &[0.0; 6]);
    torque.map_or([0.0; 6], |torque| torque.tau)
}

/// Ticks of 1 ms around a circle in the space of joints, at 3 rad/s.
fn around(start: &ArmState<f32, 6>) -> [Ask<6>; STATES] {
    core::array::from_fn(|k| {
        let (sin, cos) = sin_cos(core::f32::consts::TAU * k as f32 / STATES as f32);
        let q = core::array::from_fn(|i| start.q[i] + 0.015 * [sin, cos][i % 2]);
        let (state, trig) = (State { q, ..*start }, Core::<Ur5e>::joint_trig(&q));
        Ask { state, trig }
    })
}

fn laws(asks: &[Ask<6>; STATES]) -> Result<(), ConfigError> {
    let gains = PassivityGains { lambda: [10.0; 6], kd: [60.0, 60.0, 30.0, 5.0, 5.0, 5.0] };
    row("slotine_li", "core", true)
        .measure(slotine_li as *const () as usize, asks, |ask| slotine_li(&gains, &ask.state));
    let mut law = CartesianImpedance::try_new(ImpedanceConfig {
        stiffness: [30.0, 30.0, 30.0, 600.0, 600.0, 600.0],
        zeta: 0.7,
        slowest: 2.0,
    })?;
    // Those that jump are the way in: from one posture to any other.
    for (inputs, asks) in [("full", &around(&asks[0].state)), ("jumps", asks)] {
        let row = Row::of::<Ur5e, 6, 6>("impedance", "engine", inputs, false);
        row.measure(impedance as *const () as usize, asks, |ask| impedance(&mut law, ask));
    }
    let spring = LimitedSpring { stiffness: [300.0; 6], damping: [20.0; 6], torque: [40.0; 6] };
    let law = HandGuiding::try_new(HandGuidingConfig {
        error: 0.1,
        share: 0.85,
        rest_speed: [0.004; 6],
        compensation: [10.0; 6],
        damping: [2.0; 6],
        brake: SpeedBrake { speed: [1.5; 6], damping: [20.0; 6], torque: [10.0; 6] },
        lower: [-3.0; 6],
        upper: [3.0; 6],
        wall: spring,
        lock: spring,
    })?;
    row("hand_guiding", "law", false)
        .measure(guided as *const () as usize, asks, |ask| guided(&law, &ask.state));
    let law = InertiaShaping::try_new(InertiaShapingConfig {
        amplification: 1.0,
        dead_band: [1.0; 6],
        damping: [5.0; 6],
        torque: [30.0; 6],
    })?;
    row("inertia_shaping", "law", false)
        .measure(shaped as *const () as usize, asks, |ask| shaped(&law, &ask.state));
    let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    let mut detector = ContactDetector::try_new(config, [5.0; 6])?;
    row("contact_detector", "law", false)
        .measure(detected as *const () as usize, asks, |ask| detected(&mut detector, &ask.state));
    Ok(())
}

#[inline(never)]
fn regressor(at: &ArmState<f32, 6>) -> [[[f32; 10]; 6]; 6] {
    Core::<Ur5e>::regressor(at, &RIGID_BODY)
}

#[inline(never)]
fn regressor_columns(at: &ArmState<f32, 6>) -> [[f32; 10]; 6] {
    Core::<Ur5e>::regressor_columns(at, &RIGID_BODY, TIP)
}

#[inline(never)]
fn regressor_row(at: &ArmState<f32, 6>) -> [[f32; 10]; 6] {
    Core::<Ur5e>::regressor_row(at, &RIGID_BODY, 0)
}

fn regressors(asks: &[Ask<6>; STATES]) {
    row("regressor", "core", true)
        .measure(regressor as *const () as usize, asks, |ask| regressor(&ask.state));
    row("regressor_columns", "core", true).measure(
        regressor_columns as *const () as usize,
        asks,
        |ask| regressor_columns(&ask.state),
    );
    row("regressor_row", "core", true)
        .measure(regressor_row as *const () as usize, asks, |ask| regressor_row(&ask.state));
}

/// A point of a motion along a path, in a grid of 201 points.
#[inline(never)]
fn timed_path(
    motion: &TimedPath<'_, f32, PathSpline<f32, 6, 4>, 201>,
    tick: u32,
) -> ArmState<f32, 6> {
    motion.at(tick)
}

#[inline(never)]
fn taught_path(path: &mut TaughtPath<f32, 6, 40>, q: &[f32; 6]) -> Recorded {
    path.record(q)
}

/// A goal that is moved, and the reference there.
#[inline(never)]
fn moving_goal(goal: &mut MovingGoal<f32, 6>, tick: u32, q: &[f32; 6]) -> ArmState<f32, 6> {
    let _arrival = goal.set(tick, q);
    goal.at(tick)
}

/// A tick of changes that are spread over ticks.
#[inline(never)]
fn spread(
    (goal, change): &mut (MovingGoal<f32, 6>, Option<GoalChange<f32, 6>>),
    tick: u32,
    q: &[f32; 6],
) -> ArmState<f32, 6> {
    if change.is_none() {
        *change = goal.begin_within(tick + 6, q, &[f32::INFINITY; 6]).ok();
    }
    if let Some(begun) = change {
        let found = begun.step(|_| [0.0; 6]);
        if found.is_err() || goal.take(tick, begun) != Ok(None) {
            *change = None;
        }
    }
    goal.at(tick)
}

#[inline(never)]
fn on_the_way(goal: &MovingGoal<f32, 6>, tick: u32) -> ArmState<f32, 6> {
    goal.at(tick)
}

fn goals(asks: &[Ask<6>; STATES]) {
    let limits = [JerkLimits { velocity: 2.0, acceleration: 10.0, jerk: 100.0 }; 6];
    let Ok(mut goal) = MovingGoal::try_new(&asks[0].state.q, limits, 1e-3) else {
        return;
    };
    row("moving_goal", "law", false).measure(moving_goal as *const () as usize, asks, |ask| {
        let tick = goal.ticks() / 3 * 2;
        moving_goal(&mut goal, tick, &ask.state.q)
    });
    let ticks: [u32; STATES] = core::array::from_fn(|k| goal.ticks() / STATES as u32 * k as u32);
    // All joints brake towards goals that are a little farther in each tick.
    let started = goal.set_from(0, &State::at([0.0; 6]), &[1.5; 6]);
    let (mut tick, mut spreading) = (started.unwrap_or(0) - 250, (goal, None));
    let farther = |tick: u32| core::array::from_fn(|j| 1.5 + 1e-5 * (tick * (j as u32 + 1)) as f32);
    Row::of::<Ur5e, 6, 6>("moving_goal", "law", "longest", false).measure(
        moving_goal as *const () as usize,
        &[(goal, farther(tick))],
        |(goal, to)| moving_goal(&mut goal.clone(), tick, to),
    );
    Row::of::<Ur5e, 6, 6>("moving_goal", "law", "spread", false).measure(
        spread as *const () as usize,
        &[(); STATES],
        |()| {
            tick += 1;
            spread(&mut spreading, tick, &farther(tick))
        },
    );
    row("moving_goal_at", "law", false)
        .measure(on_the_way as *const () as usize, &ticks, |tick| on_the_way(&goal, *tick));
}

fn paths(asks: &[Ask<6>; STATES]) {
    let mut path = PathSpline::<f32, 6, 4>::EMPTY;
    let points = [[0.0; 6], [0.4; 6], [0.6; 6], [0.4; 6]];
    let limits = PathLimits {
        torque: [140.0, 140.0, 140.0, 25.0, 25.0, 25.0],
        motion: [MotionLimits { velocity: 3.0, acceleration: 20.0 }; 6],
        friction: [JointFriction::NONE; 6],
    };
    let fitted = path.fit(&points, &[0.1; 6], &[0.0; 6]).is_ok();
    let inverse = |state: &ArmState<f32, 6>| Core::<Ur5e>::rnea(state, &RIGID_BODY);
    let Ok(motion) = TimedPath::new(&path, 1e-3, &limits, inverse) else {
        return;
    };
    let Ok(mut taught) = TaughtPath::try_new([0.05; 6]) else {
        return;
    };
    if !fitted {
        return;
    }
    let ticks: [u32; STATES] = core::array::from_fn(|k| motion.ticks() * k as u32 / STATES as u32);
    row("timed_path", "law", false)
        .measure(timed_path as *const () as usize, &ticks, |tick| timed_path(&motion, *tick));
    row("taught_path", "law", false).measure(taught_path as *const () as usize, asks, |ask| {
        taught_path(&mut taught, &ask.state.q)
    });
}

pub fn rows(asks: &[Ask<6>; STATES]) {
    if laws(asks).is_ok() {
        regressors(asks);
        paths(asks);
        goals(asks);
    }
}
