//! Numbers that should not be where they are: NaN, infinities, huge and subnormal ones, in each
//! input in turn.

use dynamics_core::algorithms::{aba, crba, forward_dynamics, rnea};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::controller::{Bench, INPUTS, Input, Poison, TICK, apart};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use motion_control::limits::{Fault, Mode};

pub const CASES: &[Case] = &[Case {
    number: 37,
    name: "NaN, ±Inf, ±10³⁸ in each input",
    parameters: "UR5e; every component of q, q̇, q̈, τ of rnea, crba, aba, crba + ltdl; in motion, \
        position, reference and torque of every joint for one tick",
    source: "damaged frames, uninitialised references; drives that read NaN as \"no limit\"",
    oracle: "the bits without the injected value; the limits",
    reason: "dynamics and law have no state: the same bits at once. The ride-through covers a tick \
        with NaN or infinity. The rate of one tick limits a very large number, and the disturbance \
        decays with the poles of the loop: ω t e^(1 − ω t) is a tenth after 196 ticks",
    run: poisoned,
}];

fn values<R: Real>() -> [R; 6] {
    let subnormal = R::select(1e-310, 1e-40);
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e38, -1e38]
        .map(R::from_f64)
        .into_iter()
        .chain([subnormal])
        .collect::<Vec<_>>()
        .try_into()
        .expect("there are six")
}

fn poisoned() -> Vec<Row> {
    let mut rows = in_single_precision();
    functions::<f64>(&mut rows, "f64");
    controller::<f64>(&mut rows, "f64");
    rows
}

/// The half of the case that firmware computes.
pub fn in_single_precision() -> Vec<Row> {
    let mut rows = Vec::new();
    functions::<f32>(&mut rows, "f32");
    controller::<f32>(&mut rows, "f32");
    rows
}

/// The results of every function for an input, in bits.
fn outputs<R: Real>(state: &State<R, 6, 6>, tau: &[R; 6]) -> Vec<u64> {
    let model = dynamics_core::model::model::<R, Ur5e, 6, 6, 6>();
    let m = crba(model, &state.q, &RIGID_BODY);
    let refused = [R::from_f64(f64::INFINITY); 6];
    let mut all = rnea(model, state, &RIGID_BODY).to_vec();
    all.extend(aba(model, state, tau, &RIGID_BODY).unwrap_or(refused));
    all.extend(forward_dynamics(model, state, tau, &RIGID_BODY).unwrap_or(refused));
    all.extend((0..36).map(|k| m.get(k / 6, k % 6)));
    all.into_iter().map(|x| x.to_f64().to_bits()).collect()
}

/// The dynamics: nothing stays behind, a value that is no number never comes out as one, and
/// a subnormal is a zero.
fn functions<R: Real>(rows: &mut Vec<Row>, scalar: &'static str) {
    let clean = State {
        q: [0.3, -1.2, 1.5, 0.3, 0.5, 0.1].map(R::from_f64),
        qd: [0.5, -0.7, 0.9, -1.1, 1.3, 0.2].map(R::from_f64),
        qdd: [1.0, 2.0, -3.0, 4.0, -5.0, 6.0].map(R::from_f64),
    };
    let tau = [5.0, -40.0, 20.0, 3.0, -2.0, 1.0].map(R::from_f64);
    let before = outputs(&clean, &tau);
    let (mut same, mut reported, mut small) = (true, true, 0.0_f64);
    for value in values::<R>() {
        for input in 0..24 {
            let (mut state, mut torque) = (clean, tau);
            let arrays = [&mut state.q, &mut state.qd, &mut state.qdd, &mut torque];
            let place = &mut arrays.into_iter().nth(input / 6).expect("of four")[input % 6];
            *place = value;
            let zero = value.to_f64().abs() < 1e-30;
            let after = outputs(&state, &torque);
            if !value.is_finite() {
                reported &= after.iter().any(|&x| !f64::from_bits(x).is_finite());
            }
            if zero {
                let arrays = [&mut state.q, &mut state.qd, &mut state.qdd, &mut torque];
                arrays.into_iter().nth(input / 6).expect("of four")[input % 6] = R::ZERO;
                let want = outputs(&state, &torque);
                for (got, want) in after.iter().zip(want) {
                    small = larger(small, (f64::from_bits(*got) - f64::from_bits(want)).abs());
                }
            }
            same &= outputs(&clean, &tau) == before;
        }
    }
    rows.push(Row::claim("dynamics afterwards: the same bits", scalar, same));
    rows.push(Row::claim("dynamics: what is no number is never made one", scalar, reported));
    rows.push(Row::stated("dynamics: a subnormal against zero", scalar, small, 1e-30));
}

/// The controller: each command is within limits, that the fault is named, and how soon all
/// is as if nothing had been.
fn controller<R: Real>(rows: &mut Vec<Row>, scalar: &'static str) {
    const AT: u32 = 400;
    const AFTER: usize = 300;
    let mut start = Bench::<R>::new(0.8, 1000);
    let step = |bench: &mut Bench<R>, poison| {
        let command = bench.tick(poison);
        bench.advance(TICK);
        command
    };
    (0..AT).for_each(|_| {
        step(&mut start, None);
    });
    let mut twin = start;
    let whole: Vec<_> = (0..AFTER)
        .map(|_| {
            step(&mut twin, None);
            (twin.command, twin.arm.q)
        })
        .collect();
    let (mut effort, mut named, mut full) = (0.0_f64, true, true);
    // The first entries are those of inputs that are no numbers, the second of those that are.
    let (mut off, mut late) = ([0.0_f64; 2], [0; 2]);
    for (input, joint) in
        INPUTS.into_iter().flat_map(|input| (0..6).map(move |joint| (input, joint)))
    {
        for value in values::<R>() {
            let kind = usize::from(value.is_finite());
            let (mut bench, poison) = (start, Some(Poison { input, joint, value }));
            for (tick, (torque, q)) in whole.iter().enumerate() {
                let command = step(&mut bench, poison.filter(|_| tick == 0));
                effort = larger(effort, bench.effort());
                full &= command.status.mode == Mode::Full;
                let fault = command.status.fault;
                named &= match (input, tick) {
                    (_, 1..) => fault.is_none(),
                    _ if !value.is_finite() => fault.is_some(),
                    (Input::Position, _) if value.to_f64().abs() > 1e30 => {
                        fault == Some(Fault::Position { joint })
                    }
                    _ => true,
                };
                let away = apart(&bench.arm.q, q);
                off[kind] = larger(off[kind], away);
                if away > 1e-4 || apart(&bench.command, torque) > 1.0 {
                    late[kind] = late[kind].max(tick);
                }
            }
        }
    }
    rows.push(Row::stated("controller: torque, of what is allowed", scalar, effort, 1.0));
    rows.push(Row::claim(
        "controller: the fault is named, in its tick and no other",
        scalar,
        named,
    ));
    rows.push(Row::claim("controller: it is ridden through", scalar, full));
    for (kind, what, way, ticks) in [(0, "no number", 5e-6, 1.0), (1, "a number", 2e-3, 196.0)] {
        let (away, back) = (
            format!("controller: {what}, off the way of before, rad"),
            format!("controller: {what}, ticks till within 0.1 mrad and 1 N·m of it"),
        );
        rows.push(Row::measured(away, scalar, off[kind], way));
        rows.push(Row::stated(back, scalar, late[kind] as f64, ticks));
    }
}
