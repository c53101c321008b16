//! Reads rows of f32 (q, q̇, q̈, τ of a state) and writes what `Core` computes for a robot
//! that is known at compile time, as firmware does: the referee of the wheel's bits.
//!
//! ```console
//! robot-dynamics-bits ur5e "core rnea" < states > results
//! ```

mod machines;

use std::io::{Read as _, Write as _};

use dynamics_core::Core;
use dynamics_core::algorithms;
use dynamics_core::drivetrain::{ElasticJoints, ElasticReference, elastic_inverse_dynamics};
use dynamics_core::effects::{Coriolis, Gravity, GyroscopicRotors, RIGID_BODY, Width};
use dynamics_core::model::{Robot, Static};
use dynamics_core::robots::{
    A1, A1Free, A1Leg, G1, G1Free, Gen3, Iiwa14, Panda, So101, Ur5e, XArm7, Z1,
};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;

const BIAS: (Gravity, Coriolis) = (Gravity::EARTH, Coriolis);

fn rows<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
    quantity: &str,
    numbers: &[f32],
) -> Option<Vec<f32>> {
    let mut found = Vec::new();
    // At the joints of a free base there are no motors.
    let rotor = |i: usize| if Q > V && i < 6 { 0.0 } else { 1e-4 };
    let rotors = GyroscopicRotors {
        inertia: std::array::from_fn(rotor),
        ratio: std::array::from_fn(|i| 5.0 - 2.0 * i as f32),
    };
    let spinning = (RIGID_BODY, rotors);
    for row in numbers.chunks_exact(Q + 3 * V) {
        let part = |at: usize| std::array::from_fn(|i| row[at + i]);
        let q: [f32; Q] = std::array::from_fn(|i| row[i]);
        let (qd, qdd, tau) = (part(Q), part(Q + V), part(Q + 2 * V));
        let state = State { q, qd, qdd };
        match quantity {
            "core rnea" => found.extend(Core::<T>::rnea(&state, &RIGID_BODY)),
            "core bias" => found.extend(Core::<T>::rnea(&state, &BIAS)),
            "core gravity" => found.extend(Core::<T>::rnea(&state, &Gravity::EARTH)),
            "core crba" => {
                let m = Core::<T>::crba(&q, &RIGID_BODY);
                (0..V).for_each(|i| found.extend((0..V).map(|j| m.get(i, j))));
            }
            "core rnea spinning" => found.extend(Core::<T>::rnea(&state, &spinning)),
            "core aba spinning" => found.extend(Core::<T>::aba(&state, &tau, &spinning).ok()?),
            "core aba" => found.extend(Core::<T>::aba(&state, &tau, &RIGID_BODY).ok()?),
            "core forward_dynamics" => {
                found.extend(Core::<T>::forward_dynamics(&state, &tau, &RIGID_BODY).ok()?);
            }
            _ => {
                let quantity = quantity.strip_prefix("algorithms ")?;
                found.extend(algorithm::<T, B, Q, V>(quantity, &state, &tau)?);
            }
        }
    }
    Some(found)
}

/// The results of an algorithm that `Core` does not list.
fn algorithm<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
    quantity: &str,
    state: &State<f32, Q, V>,
    tau: &[f32; V],
) -> Option<Vec<f32>> {
    let (robot, q) = (&Static::<T>::NEW, &state.q);
    let mut out = Vec::new();
    let m = || algorithms::crba(robot, q, &RIGID_BODY);
    match quantity {
        "ltdl" => {
            let factors = algorithms::ltdl(robot, &m()).ok()?;
            square::<V>(&mut out, |i, j| factors.get(i, j));
            out.extend(factors.d_inv());
            out.extend(algorithms::solve(robot, &factors, tau));
            let inverse = algorithms::inverse(robot, &factors);
            square::<V>(&mut out, |i, j| inverse.get(i, j));
        }
        "rnea_and_wrenches" => {
            let found = algorithms::rnea_and_wrenches(robot, state, &RIGID_BODY);
            out.extend(found.tau);
            let six = |f: &Force<f32>| [f.ang.to_array(), f.lin.to_array()];
            out.extend(found.wrenches.iter().flat_map(six).flatten());
        }
        "cholesky" => {
            let factor = algorithms::cholesky(robot, &m()).ok()?;
            out.extend(factor.l_inv());
            out.extend(factor.solve(robot, tau));
        }
        "spatial_operator" => {
            let factors = algorithms::spatial_operator_ltdl(robot, q, &RIGID_BODY).ok()?;
            square::<V>(&mut out, |i, j| factors.get(i, j));
            out.extend(factors.d_inv());
            let inverse = algorithms::spatial_operator_inverse(robot, q, &RIGID_BODY).ok()?;
            square::<V>(&mut out, |i, j| inverse.get(i, j));
        }
        "crba_jacobian" => {
            let (m, columns) = algorithms::crba_jacobian(robot, q, B - 1, &RIGID_BODY);
            square::<V>(&mut out, |i, j| m.get(i, j));
            out.extend_from_slice(algorithms::jacobian_rows(&columns).as_flattened());
        }
        "forward_dynamics_with_error" => {
            let found = algorithms::forward_dynamics_with_error(robot, state, tau, &RIGID_BODY);
            let found = found.ok()?;
            out.extend(found.qdd.iter().chain(&found.error));
        }
        "rnea_derivatives" => {
            let found = algorithms::rnea_derivatives(robot, state, &RIGID_BODY);
            out.extend([found.dq, found.dqd].as_flattened().as_flattened());
        }
        "forward_dynamics_derivatives" => {
            let found = algorithms::forward_dynamics_derivatives(robot, state, tau, &RIGID_BODY);
            let found = found.ok()?;
            out.extend([found.dq, found.dqd].as_flattened().as_flattened());
        }
        "regressor_row" => {
            let row = algorithms::regressor_row(robot, state, &RIGID_BODY, V - 1);
            out.extend_from_slice(row.as_flattened());
        }
        "friction_regressor" => {
            let found = algorithms::friction_regressor(&state.qd, Width::new(0.3));
            out.extend_from_slice(found.as_flattened());
        }
        "elastic_inverse_dynamics" => {
            let reference = ElasticReference { state: *state, jerk: *tau, snap: *tau };
            let joints = ElasticJoints { stiffness: [1e4; V], rotor: [0.7; V], friction: [3.0; V] };
            let found = elastic_inverse_dynamics(robot, &joints, &reference, &RIGID_BODY).ok()?;
            out.extend([found.torque, found.position, found.velocity].as_flattened());
        }
        _ => return None,
    }
    Some(out)
}

fn square<const V: usize>(out: &mut Vec<f32>, of: impl Fn(usize, usize) -> f32) {
    (0..V).for_each(|i| out.extend((0..V).map(|j| of(i, j))));
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, robot, quantity] = arguments.as_slice() else {
        return Err(std::io::Error::other("expected ROBOT QUANTITY"));
    };
    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes)?;
    let numbers: Vec<f32> =
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let found = match robot.as_str() {
        "ur5e" => rows::<Ur5e, 6, 6, 6>(quantity, &numbers),
        "panda" => rows::<Panda, 7, 7, 7>(quantity, &numbers),
        "iiwa14" => rows::<Iiwa14, 7, 7, 7>(quantity, &numbers),
        "a1" => rows::<A1, 16, 12, 12>(quantity, &numbers),
        "a1_leg" => rows::<A1Leg, 4, 3, 3>(quantity, &numbers),
        "a1_free" => rows::<A1Free, 17, 19, 18>(quantity, &numbers),
        "gen3" => rows::<Gen3, 7, 7, 7>(quantity, &numbers),
        "so101" => rows::<So101, 6, 6, 6>(quantity, &numbers),
        "xarm7" => rows::<XArm7, 7, 7, 7>(quantity, &numbers),
        "z1" => rows::<Z1, 7, 7, 7>(quantity, &numbers),
        "g1" => rows::<G1, 29, 29, 29>(quantity, &numbers),
        "g1_free" => rows::<G1Free, 30, 36, 35>(quantity, &numbers),
        "bars" => machines::bars(quantity, &numbers),
        "wrist" => machines::wrist(&numbers),
        "boom" => machines::boom(quantity, &numbers),
        _ => None,
    };
    let found = found.ok_or_else(|| std::io::Error::other("no such robot or quantity"))?;
    let bytes: Vec<u8> = found.iter().flat_map(|x| x.to_le_bytes()).collect();
    std::io::stdout().write_all(&bytes)
}
