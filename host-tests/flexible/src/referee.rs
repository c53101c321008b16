//! The quantities that the tests and the report compare with the recording.

use dynamics_core::effects::{Elasticity, RIGID_BODY};
use dynamics_core::flexible::{
    Beam, FlexibleLink, JointsAndModes, ModalFeedforward, Modes, Shape, crba, modal_dynamics, rnea,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;

use crate::recording::{Dynamics, Forced, Static};

/// The largest difference over the largest number.
pub fn error<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    let (worst, scale) = pairs.fold((0.0, 0.0), |(worst, scale), (a, b)| {
        (f64::max(worst, (a - b).abs()), f64::max(scale, b.abs()))
    });
    worst / scale
}

/// Torques of the joints and forces on the modes at every recorded state, by a function that
/// computes inverse dynamics.
///
/// # Panics
/// If the recording is of another robot.
pub fn inverse<R: Real, const M: usize>(
    recorded: &Dynamics,
    rnea: impl Fn(&State<R, 2, 2>, &State<R, M, M>) -> JointsAndModes<R, 2, M>,
) -> [Vec<f64>; 2] {
    let [mut tau, mut of_modes] = [(); 2].map(|()| Vec::new());
    for (state, bent) in states(recorded) {
        let found = rnea(&state, &bent);
        tau.extend(found.joints.map(R::to_f64));
        of_modes.extend(found.modes.map(R::to_f64));
    }
    [tau, of_modes]
}

/// Kinetic energy at every recorded state.
///
/// # Panics
/// If the recording is of another robot.
pub fn kinetic<R: Real, const M: usize>(
    recorded: &Dynamics,
    model: &ArmModel<R, 2>,
    modes: &Modes<R, M>,
) -> Vec<f64> {
    let energy = |(state, bent): (State<R, 2, 2>, State<R, M, M>)| {
        let inertia = crba(model, modes, &state.q, &bent.q, &RIGID_BODY);
        inertia.kinetic_energy(&state.qd, &bent.qd).to_f64()
    };
    states(recorded).map(energy).collect()
}

/// The recorded states of joints and modes.
fn states<R: Real, const M: usize>(
    recorded: &Dynamics,
) -> impl Iterator<Item = (State<R, 2, 2>, State<R, M, M>)> {
    (0..recorded.q.len()).map(|k| {
        (
            recorded_state([&recorded.q, &recorded.qd, &recorded.qdd], k),
            recorded_state([&recorded.eta, &recorded.etad, &recorded.etadd], k),
        )
    })
}

fn recorded_state<R: Real, const N: usize>(rows: [&[Vec<f64>]; 3], k: usize) -> State<R, N, N> {
    let [q, qd, qdd] = rows.map(|rows| {
        let row = <[f64; N]>::try_from(&rows[k][..]).expect("the robot's coordinates");
        row.map(R::from_f64)
    });
    State { q, qd, qdd }
}

/// ω and modal mass of mode k.
pub fn vibration(link: &FlexibleLink, k: usize) -> [f64; 2] {
    let [[xx, _, _], [_, yy, _], [_, _, zz]] = link.products[k][k];
    let mass = xx + yy + zz;
    [(link.stiffness[k][k] / mass).sqrt(), mass]
}

/// A link on one joint about y.
struct One(ArmModel<f64, 1>);

impl One {
    fn new(beam: &Beam) -> Self {
        Self(ArmModel::new(
            "one",
            [Body::new("link", BASE, Joint::revolute([0.0, 1.0, 0.0]))
                .mass(beam.mass())
                .com(beam.com())
                .inertia(beam.inertia())],
        ))
    }

    fn modes<const M: usize>(&self, beam: &Beam) -> Modes<f64, M> {
        let shapes: [Shape; M] = core::array::from_fn(|k| Shape::BendZ(k + 1));
        let link = beam.link(0, &shapes).expect("a beam");
        Modes::try_new(&self.0, &[link]).expect("modes of a beam")
    }
}

/// The tip's deflection at rest over that of as many recorded modes, less one, and the relative
/// difference from the whole beam's.
///
/// # Panics
/// If the beam has no such modes.
pub fn sag<const M: usize>(beam: &Beam, recorded: &Static) -> [f64; 2] {
    let one = One::new(beam);
    let modes = one.modes::<M>(beam);
    let rest = ModalFeedforward::at_rest(&one.0, &modes, &[0.0], &(RIGID_BODY, Elasticity));
    let tip: f64 = rest.expect("stiffness").bent.q.iter().sum();
    let whole = recorded.x_deflection_slope[3][1];
    [tip / recorded.tip_of_modes[M - 1] - 1.0, (tip / whole - 1.0).abs()]
}

/// Tip and torque at the recorded times, of M modes.
///
/// # Panics
/// If the beam has no such modes.
pub fn forced<const M: usize>(beam: &Beam, recorded: &Forced) -> Vec<[f64; 2]> {
    let (one, scene) = (One::new(beam), (RIGID_BODY, Elasticity));
    let modes = one.modes::<M>(beam);
    let at = |t: f64| {
        let (u, d) = ((t / recorded.duration).min(1.0), recorded.duration);
        let [q, qd, qdd] = [
            u.powi(3) * (10.0 + u * (-15.0 + 6.0 * u)),
            30.0 * (u * (1.0 - u)).powi(2) / d,
            60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (d * d),
        ]
        .map(|x| [recorded.angle * x]);
        State { q, qd, qdd }
    };
    let accelerate = |t: f64, bent: &State<f64, M, M>| {
        modal_dynamics(&one.0, &modes, &at(t), bent, &scene).expect("positive definite")
    };
    let rest = ModalFeedforward::at_rest(&one.0, &modes, &[0.0], &scene);
    let (mut bent, mut t) = (rest.expect("stiffness").bent, 0.0);
    let mut rows = Vec::new();
    for &until in &recorded.t {
        // Runge-Kutta 4, 1500 steps a period of the highest mode.
        let omega = vibration(&beam.link(0, &[Shape::BendZ(M)]).expect("a beam"), 0)[0];
        let steps = ((until - t) * omega * 240.0).ceil().max(1.0);
        let h = (until - t) / steps;
        for _ in 0..steps as usize {
            bent = runge_kutta(&bent, t, h, accelerate);
            t += h;
        }
        t = until;
        bent.qdd = accelerate(t, &bent);
        let tau = rnea(&one.0, &modes, &at(t), &bent, &scene).joints[0];
        rows.push([bent.q.iter().sum(), tau]);
    }
    rows
}

fn runge_kutta<const M: usize>(
    x: &State<f64, M, M>,
    t: f64,
    h: f64,
    accelerate: impl Fn(f64, &State<f64, M, M>) -> [f64; M],
) -> State<f64, M, M> {
    let ahead = |rate: &[f64; M], acceleration: &[f64; M], h: f64| State {
        q: core::array::from_fn(|k| x.q[k] + h * rate[k]),
        qd: core::array::from_fn(|k| x.qd[k] + h * acceleration[k]),
        qdd: [0.0; M],
    };
    let a1 = accelerate(t, x);
    let x2 = ahead(&x.qd, &a1, 0.5 * h);
    let a2 = accelerate(t + 0.5 * h, &x2);
    let x3 = ahead(&x2.qd, &a2, 0.5 * h);
    let a3 = accelerate(t + 0.5 * h, &x3);
    let x4 = ahead(&x3.qd, &a3, h);
    let a4 = accelerate(t + h, &x4);
    let mean = |k: usize, [a, b, c, d]: [&[f64; M]; 4]| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0;
    State {
        q: core::array::from_fn(|k| x.q[k] + h * mean(k, [&x.qd, &x2.qd, &x3.qd, &x4.qd])),
        qd: core::array::from_fn(|k| x.qd[k] + h * mean(k, [&a1, &a2, &a3, &a4])),
        qdd: [0.0; M],
    }
}
