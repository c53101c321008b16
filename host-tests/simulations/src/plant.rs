//! A UR5e that a wall touches, and how it differs from its model.

use dynamics_core::algorithms::{NotPositiveDefinite, frame, kinematics};
use dynamics_core::effects::{
    Armature, Coulomb, Effect, JointState, Lugre, RIGID_BODY, Viscous, Width, hook,
};
use dynamics_core::model::{ArmModel, model};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Matrix, Real, Vector, positive_part};
use dynamics_core::sim::{Integrator, KahanState, LinearlyImplicit, ModelDynamics};
use dynamics_core::state::State;

/// The body that touches.
pub const TIP: usize = 5;
/// Rotor inertias of the scene [`ur5e`](firmware_demo::scenes::ur5e), as its friction below, kg·m².
pub const ROTORS: [f64; 6] = [0.9, 0.9, 0.9, 0.25, 0.25, 0.25];
/// Viscous friction, N·m·s/rad.
pub const VISCOUS: [f64; 6] = [12.0, 12.0, 8.0, 2.0, 2.0, 1.5];
/// Sliding friction, N·m.
pub const SLIDING: [f64; 6] = [8.0, 8.0, 6.0, 1.5, 1.5, 1.2];
/// Stiction exceeds sliding friction by this share of it.
pub const EXCESS: f64 = 0.15;

pub fn rotors<R: Real>() -> Armature<R, 6> {
    Armature(ROTORS.map(R::from_f64))
}

/// Viscous and Coulomb friction times a share of each joint.
pub fn coulomb<R: Real>(share: [R; 6], width: Width<R>) -> (Viscous<R, 6>, Coulomb<R, 6>) {
    let torque = shares(SLIDING, share);
    (Viscous(shares(VISCOUS, share)), Coulomb { torque, width })
}

/// The same friction by bristles, with stiction and Stribeck's effect: they slide from 10⁻⁴ rad on.
pub fn bristles<R: Real>(share: [R; 6]) -> Lugre<R, 6> {
    let sliding = shares(SLIDING, share);
    Lugre {
        stiffness: sliding.map(|f| f * R::from_f64(1e4)),
        damping: sliding.map(|f| R::from_f64(30.0) * f),
        viscous: shares(VISCOUS, share),
        sliding,
        excess: sliding.map(|f| R::from_f64(EXCESS) * f),
        stribeck_speed: Width::new(R::from_f64(0.01)),
        bristle: [R::ZERO; 6],
    }
}

fn shares<R: Real>(of: [f64; 6], share: [R; 6]) -> [R; 6] {
    core::array::from_fn(|i| share[i] * R::from_f64(of[i]))
}

/// The arm with each body's inertia times a share.
pub fn arm<R: Real>(share: [R; 6]) -> ArmModel<R, 6> {
    let mut arm = *model::<R, Ur5e, 6, 6, 6>();
    for (link, share) in arm.links.iter_mut().zip(share) {
        let inertia = &mut link.inertia;
        inertia.mass *= share;
        inertia.first_moment = inertia.first_moment * share;
        inertia.rotational = inertia.rotational * share;
    }
    arm
}

/// Every other body heavier by a share, and the others lighter.
pub fn alternating<R: Real>(off: R) -> [R; 6] {
    core::array::from_fn(|i| if i % 2 == 0 { R::ONE + off } else { R::ONE - off })
}

/// The place and the velocity of the tip, m and m/s.
pub fn tip<R: Real>(state: &State<R, 6, 6>) -> [R::Vec3; 2] {
    let k = kinematics(model::<R, Ur5e, 6, 6, 6>(), state, &());
    let v = k.velocity(TIP, frame::LocalWorldAligned);
    [k.poses[TIP].pos, v.lin]
}

/// An elastic wall, the plane through `origin` whose `normal` points into it, and a hand at the
/// tip.
#[derive(Clone, Copy, Debug)]
pub struct Wall<R: Real> {
    /// A point of its surface, m.
    pub origin: R::Vec3,
    /// It points into the wall.
    pub normal: R::Vec3,
    /// Stiffness, N/m.
    pub stiffness: R,
    /// The share of its force for each m/s into it, s/m (Hunt & Crossley, 1975).
    pub loss: R,
    /// The force of a hand on the tip, N.
    pub hand: R::Vec3,
}

impl<R: Real> Wall<R> {
    /// The force of the tip on the wall, N.
    pub fn force(&self, [place, velocity]: [R::Vec3; 2]) -> R {
        let depth = (place - self.origin).dot(self.normal);
        let share = R::ONE + self.loss * velocity.dot(self.normal);
        self.stiffness * positive_part(depth) * positive_part(share)
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Wall<R> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_state(|wall, body, at, fx| {
        if body == TIP {
            let velocity = at.pose.rot.transpose_mul(at.velocity.lin);
            let back = wall.normal * wall.force([at.pose.pos, velocity]);
            fx.lin += at.pose.rot * (wall.hand - back);
        }
    });
}

/// A simulated UR5e with friction of the kind `F`.
#[derive(Clone, Debug)]
pub struct Plant<F> {
    pub at: KahanState<f32, 6, true>,
    /// Torques on its joints from outside, N·m.
    pub pushed: [f32; 6],
    arm: ArmModel<f32, 6>,
    friction: F,
}

impl<F: Effect<f32, 6, 6> + Clone> Plant<F> {
    /// At rest, with inertias off by these shares.
    pub fn new(q: [f32; 6], inertia: [f32; 6], friction: F) -> Self {
        Self { at: KahanState::at(State::at(q)), pushed: [0.0; 6], arm: arm(inertia), friction }
    }

    /// Moves on by `steps` linearly implicit steps of `h` seconds with compensated sums under the
    /// drives' torques, N·m.
    ///
    /// # Errors
    /// As forward dynamics.
    pub fn advance(
        &mut self,
        torque: &[f32; 6],
        steps: u32,
        h: f32,
    ) -> Result<(), NotPositiveDefinite> {
        let tau = core::array::from_fn(|i| torque[i] + self.pushed[i]);
        for _ in 0..steps {
            let mechanics = ModelDynamics {
                robot: &self.arm,
                tau,
                effects: &(RIGID_BODY, rotors(), self.friction.clone()),
            };
            let step = LinearlyImplicit.step(&mechanics, &self.at.state, h)?;
            self.at.add(&step, h);
            for joint in 0..6 {
                let at = JointState::new(self.at.state.q[joint], self.at.state.qd[joint]);
                self.friction.advance(joint, at, h);
            }
        }
        Ok(())
    }
}
