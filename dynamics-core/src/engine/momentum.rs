//! p = M q̇ and Cᵀ q̇ by one recursion over the bodies: velocities on entering a joint, momenta on returning.
//!
//! De Luca & Mattone (2003), over base parameters: they give the same kinetic energy for all q and q̇, hence the same
//! p = ∂T/∂q̇ and Cᵀ q̇ = ∂T/∂q. Masses are known zeros behind revolute joints.

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::acceleration_field::{Inertia, Wrench, along_z, enter};
use super::base::no_gyroscopic_rotors;
use super::compile::{CompiledRobot, Joint};
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::rnea::{inertia, is_on_base, is_parent};
use super::{Engine, Specialised};
use crate::algorithms::MomentumAndCoriolis;
use crate::effects::Effect;
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::spatial::Motion;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The generalised momentum p = M q̇ and the transposed Coriolis product Cᵀ q̇, in joint coordinates, N·m·s and N·m, as
    /// [`crate::algorithms::momentum_and_coriolis`] computes them.
    ///
    /// Effects that change neither are ignored. Angles as in [`Engine::rnea`].
    ///
    /// # Cost
    /// `docs/costs.md` in the repository; the same instructions for all data.
    ///
    /// # Source
    /// De Luca & Mattone (2003); Haddadin, De Luca & Albu-Schäffer (2017), section V.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5, -1.0, 2.0, 0.3, 0.0, 1.0], ..State::at([0.3_f64; 6]) };
    /// let (a, b) = (
    ///     Core::<Ur5e>::momentum_and_coriolis(&state, &()),
    ///     Engine::<Ur5e>::momentum_and_coriolis(&state, &()),
    /// );
    /// assert!((0..6).all(|i| (a.p[i] - b.p[i]).abs() < 1e-14 && (a.ct_qd[i] - b.ct_qd[i]).abs() < 1e-14));
    /// ```
    #[doc(alias = "momentum observer")]
    #[inline(never)]
    pub fn momentum_and_coriolis<R: Real, S, E, const B: usize, const Q: usize, const V: usize>(
        state: S,
        effects: &E,
    ) -> MomentumAndCoriolis<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        S: RobotState<R, Q, V>,
        E: Effect<R, B, V>,
    {
        let trig = state
            .configuration()
            .trig_or(Specialised::<T, K, B, V>(PhantomData));
        no_gyroscopic_rotors::<R, E, B, V>();
        let mut result = MomentumAndCoriolis {
            p: [R::ZERO; V],
            ct_qd: [R::ZERO; V],
        };
        let base = Velocity::of_base::<E, B, V>(
            effects,
            const { CompiledRobot::<T, B, Q, V>::TREE.length },
        );
        let mut task = Task {
            turns: &trig.borrow().coordinates,
            state: state.state(),
            effects,
            result: &mut result,
        };
        for_each_joint!(J, {
            if const { is_on_base::<T, B, Q, V>(J) } {
                visit::<R, T, E, B, Q, V, J>(&mut task, base);
            }
        });
        result
    }
}

/// The data that all bodies share.
struct Task<'a, R: Real, E, const Q: usize, const V: usize> {
    turns: &'a [JointCoordinate<R>; Q],
    state: &'a State<R, Q, V>,
    effects: &'a E,
    result: &'a mut MomentumAndCoriolis<R, V>,
}

/// Visits joint I and its descendants; returns their momentum about the origin of the parent, in its frame.
#[inline(always)]
fn visit<R, T, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    parent: Velocity<R>,
) -> Wrench<R>
where
    R: Real,
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let joint = const { &CompiledRobot::<T, B, Q, V>::joint(I) };
    let length_inv = Folded::constant(const { 1.0 / CompiledRobot::<T, B, Q, V>::TREE.length });
    let (turn, qd) = (task.turns[I], task.state.qd[I]);
    let slide = Folded::runtime(turn.q) * length_inv;
    let velocity = parent.across(joint, turn, slide, Folded::runtime(qd), length_inv);
    let mut h = velocity.momentum(&inertia::<R, T, E, B, Q, V, I>(
        task.effects,
        E::BASE_MOTION,
    ));
    for_each_joint!(J, {
        if const { is_parent::<T, B, Q, V>(I, J) } {
            let child = visit::<R, T, E, B, Q, V, J>(task, velocity);
            h = Wrench {
                f: h.f + child.f,
                n: h.n + child.n,
            };
        }
    });
    let mut p = h.along(joint.prismatic, length_inv).get();
    if let Some(armature) = task.effects.inertia(I) {
        p += armature * qd;
    }
    task.result.p[I] = p;
    task.result.ct_qd[I] = velocity.rate(h, joint.prismatic, length_inv).get();
    h.to_parent::<T, B, Q, V, I>(turn, slide)
}

/// The velocity of a body's frame, in that frame; v in units of length.
#[derive(Clone, Copy)]
struct Velocity<R> {
    omega: Vec3<R>,
    v: Vec3<R>,
}

impl<R: Real> Velocity<R> {
    /// The velocity of the base: known zeros if it is at rest.
    #[inline(always)]
    fn of_base<E, const B: usize, const V: usize>(effects: &E, length: f64) -> Self
    where
        E: Effect<R, B, V>,
    {
        let (mut omega, mut v) = (Vec3::ZERO, Vec3::ZERO);
        if E::BASE_MOTION {
            let (mut velocity, mut acceleration) = (Motion::ZERO, Motion::ZERO);
            effects.base(&mut velocity, &mut acceleration);
            omega = Vec3::runtime(velocity.ang);
            v = Vec3::runtime(velocity.lin).scale(Folded::constant(1.0 / length));
        }
        Self { omega, v }
    }

    /// The velocity of a child behind `joint`.
    #[inline(always)]
    fn across(
        &self,
        joint: &Joint,
        turn: JointCoordinate<R>,
        slide: Folded<R>,
        qd: Folded<R>,
        length_inv: Folded<R>,
    ) -> Self {
        let (rot, mut p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        if joint.prismatic {
            p = p + rot.0[2].scale(slide);
            return Self {
                omega: rot.transpose_mul(self.omega),
                v: rot.transpose_mul(self.v + self.omega.cross(p)) + along_z(qd * length_inv),
            };
        }
        Self {
            omega: enter(&rot, turn, self.omega) + along_z(qd),
            v: enter(&rot, turn, self.v + self.omega.cross(p)),
        }
    }

    /// The momentum I v: m v + ω × h, and h × v + tr(Σ) ω − Σ ω.
    #[inline(always)]
    fn momentum(&self, body: &Inertia<R>) -> Wrench<R> {
        let (s, [wx, wy, wz]) = (&body.second, self.omega.0);
        let (xy, xz, yz) = (s.xx + s.yy, s.xx + s.zz, s.yy + s.zz);
        let spin = Vec3([
            yz * wx - s.xy * wy - s.xz * wz,
            xz * wy - s.xy * wx - s.yz * wz,
            xy * wz - s.xz * wx - s.yz * wy,
        ]);
        Wrench {
            f: self.v.scale(body.mass) + self.omega.cross(body.moment),
            n: body.moment.cross(self.v) + spin,
        }
    }

    /// The entry of Cᵀ q̇ of a joint along z: (v × S)ᵀ h.
    #[inline(always)]
    fn rate(&self, h: Wrench<R>, prismatic: bool, length_inv: Folded<R>) -> Folded<R> {
        let ([wx, wy, _], [vx, vy, _]) = (self.omega.0, self.v.0);
        let ([fx, fy, _], [nx, ny, _]) = (h.f.0, h.n.0);
        if prismatic {
            (wy * fx - wx * fy) * length_inv
        } else {
            wy * nx - wx * ny + (vy * fx - vx * fy)
        }
    }
}
