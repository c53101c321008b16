//! A robot without its negligible parameters: nothing else changes, and it errs by little.

use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{Pruned, Robot};
use dynamics_core::robots::{A1Leg, Ur5e};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use host_tests::recordings::load;
use host_tests::stress_robot::StressRobot;
use host_tests::tolerances::check;

/// The states recorded of a robot whose first coordinates are T's, and as many at random.
fn states<const N: usize>(recorded: &str) -> Vec<State<f64, N, N>> {
    let recording = load(recorded);
    let first = |row: &[f64]| -> [f64; N] { std::array::from_fn(|j| row[j]) };
    let rows = recording.q.iter().zip(&recording.qd).zip(&recording.qdd);
    let mut random = random_numbers();
    rows.flat_map(|((q, qd), qdd)| {
        let recorded = State { q: first(q), qd: first(qd), qdd: first(qdd) };
        let other = State {
            q: within(&mut random, std::f64::consts::PI),
            qd: within(&mut random, 3.0),
            qdd: within(&mut random, 10.0),
        };
        [recorded, other]
    })
    .collect()
}

fn nothing_left_out<T, const B: usize, const N: usize>(recorded: &str)
where
    T: Robot<B, N, N>,
{
    for state in states::<N>(recorded) {
        let (whole, pruned) = (
            Engine::<T>::rnea(&state, &RIGID_BODY),
            Engine::<Pruned<T, 0>>::rnea(&state, &RIGID_BODY),
        );
        assert_eq!(whole.map(f64::to_bits), pruned.map(f64::to_bits));
    }
}

#[test]
fn a_share_of_nothing_changes_no_bit() {
    nothing_left_out::<Ur5e, 6, 6>("ur5e");
    nothing_left_out::<A1Leg, 4, 3>("a1");
    #[cfg(feature = "full")]
    {
        nothing_left_out::<dynamics_core::robots::Panda, 7, 7>("panda");
        nothing_left_out::<StressRobot, 11, 7>("panda");
    }
}

/// The part that is left out, relative to the largest torque of the states.
fn left_out<T, const B: usize, const N: usize>(
    (name, quantity): (&str, &str),
    recorded: &str,
) -> Result<(), String>
where
    T: Robot<B, N, N>,
{
    let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
    for state in states::<N>(recorded) {
        let whole = Core::<T>::rnea(&state, &RIGID_BODY);
        let pruned = Engine::<T>::rnea(&state, &RIGID_BODY);
        for (whole, pruned) in whole.iter().zip(pruned) {
            worst = largest([worst, (whole - pruned).abs()]);
            scale = scale.max(whole.abs());
        }
    }
    check(name, quantity, "f64", worst / scale)
}

#[test]
fn what_is_left_out_is_as_little_as_it_says() {
    let results = [
        left_out::<Pruned<Ur5e, 1000>, 6, 6>(("ur5e", "left out at 0.1 %"), "ur5e"),
        #[cfg(feature = "full")]
        left_out::<Pruned<dynamics_core::robots::Panda, 1000>, 7, 7>(
            ("panda", "left out at 0.1 %"),
            "panda",
        ),
        left_out::<Pruned<A1Leg, 1000>, 4, 3>(("a1_leg", "left out at 0.1 %"), "a1"),
        left_out::<Pruned<StressRobot, 50_000>, 11, 7>(("odd", "left out at 5 %"), "panda"),
    ];
    let failed: Vec<_> = results.into_iter().filter_map(Result::err).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn a_joint_without_inertia_is_refused_by_name() {
    type Light = Pruned<Ur5e, 1000>;
    let state = State::at([0.3_f32; 6]);
    for refused in [
        Engine::<Light>::forward_dynamics(&state, &[1.0; 6], &RIGID_BODY),
        Engine::<Light>::aba(&state, &[1.0; 6], &RIGID_BODY),
    ] {
        assert_eq!(refused.map_err(|error| error.joint), Err(5));
    }
    let rotors = (Gravity::EARTH, Inertia, Coriolis, Armature([0.1; 6]));
    let moves = Engine::<Light>::forward_dynamics(&state, &[1.0; 6], &rotors);
    assert!(moves.is_ok_and(|qdd| qdd.iter().all(|x| x.is_finite())));
}
