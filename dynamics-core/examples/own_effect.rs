//! A user-defined effect: a gas spring at a shoulder, which the library does not contain.
//!
//! `cargo run -p dynamics-core --example own_effect`

use dynamics_core::effects::{Effect, JointState, RIGID_BODY, TorqueDerivatives};
use dynamics_core::scalar::Real;
use dynamics_core::{Core, Engine, robots::Ur5e, state::State};

/// A gas spring between the base and a crank on the shoulder: it pushes with a constant force at
/// the lever r cos q.
#[derive(Clone, Copy)]
struct GasSpring<R> {
    /// Force, N.
    force: R,
    /// Length of the crank, m.
    crank: R,
}

const SHOULDER: usize = 1;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for GasSpring<R> {
    const DIFFERENTIABLE: bool = true;

    /// The torque that the motor must supply: the spring reduces it.
    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        if joint == SHOULDER {
            *tau -= self.force * self.crank * at.q.sin_cos().1;
        }
    }

    /// ∂τ/∂q, for simulations and derivatives of dynamics; an effect in a controller does not need it.
    #[inline(always)]
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        if joint == SHOULDER {
            derivatives.dq += self.force * self.crank * at.q.sin_cos().0;
        }
    }
}

fn main() {
    let spring = GasSpring { force: -900.0_f32, crank: 0.05 };
    println!("shoulder, rad | without  with the spring, N·m");
    for shoulder in [0.0, -0.4, -0.8, -1.2, -1.57] {
        let arm = State::at([0.0, shoulder, 0.4, 0.0, 0.0, 0.0]);
        let bare = Core::<Ur5e>::rnea(&arm, &RIGID_BODY);
        let helped = Core::<Ur5e>::rnea(&arm, &(RIGID_BODY, spring));
        println!("{shoulder:13.2} | {:7.2}  {:7.2}", bare[SHOULDER], helped[SHOULDER]);

        let lever = 0.05 * shoulder.cos();
        assert!((helped[SHOULDER] - bare[SHOULDER] - 900.0 * lever).abs() < 1e-3);
        assert_eq!(helped[0], bare[0]);
        // The engine accepts the same effect.
        let engine = Engine::<Ur5e>::rnea(&arm, &(RIGID_BODY, spring));
        assert!((engine[SHOULDER] - helped[SHOULDER]).abs() < 1e-3);
    }
}
