//! The quantities of a hard case, by every algorithm.

use super::Extras;
use dynamics_core::algorithms::{
    Damping, NotPositiveDefinite, aba, forward_dynamics, frame, operational_space, osim_inverse,
    rnea,
};
use dynamics_core::effects::{Armature, Coriolis, Effect, GravityVector, Inertia, Payload, hook};
use dynamics_core::model::{AllRevolute, BodyInertia};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, SpatialInertia};
use dynamics_core::state::State;
use firmware_demo::digest::Digest;

/// The effects of every hard case.
pub type Scene<R, const N: usize> = (
    GravityVector<R>,
    Inertia,
    Coriolis,
    Armature<R, N>,
    OnLast<R>,
);

/// A payload of the last body of an arm of any length, where [`Payload`] names a body by its
/// number.
#[derive(Clone, Copy, Debug)]
pub struct OnLast<R: Real>(SpatialInertia<R>);

impl<R: Real> OnLast<R> {
    /// As [`Payload::from_inertia`].
    pub fn new(mass: R, com: [R; 3], inertia: [R; 6]) -> Self {
        let inertia = BodyInertia { mass, com, inertia };
        Self(Payload::<R, 0>::from_inertia(inertia).0)
    }
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for OnLast<R> {
    const ADDED_INERTIA: hook::Inertia<Self, R, B> = {
        let mut last = [false; B];
        last[B - 1] = true;
        hook::Inertia::on(last, Self::add_to::<B>)
    };
}

impl<R: Real> OnLast<R> {
    /// Adds the load to the inertia of `body` of a robot of B bodies.
    #[inline(always)]
    fn add_to<const B: usize>(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        if body + 1 == B {
            *inertia = *inertia + self.0;
        }
    }
}

/// An arm of which it is known that every joint turns: half the code to compile.
pub type Revolute<'a, R, const N: usize> = AllRevolute<'a, R, N, N, N>;

/// 9.8125 m/s² down: a number that f32 has.
pub const GRAVITY: f64 = 9.8125;

pub fn scene<R: Real, const N: usize>(extras: &Extras<N>) -> Scene<R, N> {
    let real = |x: f32| R::select(f64::from(x), x);
    let payload = OnLast::new(
        real(extras.payload),
        extras.payload_at.map(real),
        extras.payload_inertia.map(real),
    );
    let g = R::Vec3::new(R::ZERO, R::ZERO, R::from_f64(-GRAVITY));
    let rotors = Armature(extras.rotors.map(real));
    (GravityVector(g), Inertia, Coriolis, rotors, payload)
}

/// The results for one state of an arm.
#[derive(Clone, Copy, Debug)]
pub struct Answers<R, const N: usize> {
    /// τ of the state's q̈.
    pub rnea: [R; N],
    /// q̈ of that τ by M = Lᵀ D L.
    pub forward: Result<[R; N], NotPositiveDefinite>,
    pub aba: Result<[R; N], NotPositiveDefinite>,
    /// Λ⁻¹ of the last body's origin in that body's axes, 1/kg, by articulated bodies.
    pub mobility: Result<[[R; 3]; 3], NotPositiveDefinite>,
    /// The same by J M⁻¹ Jᵀ.
    pub by_matrix: Result<[[R; 3]; 3], NotPositiveDefinite>,
}

impl Answers<f32, 6> {
    /// Adds all numbers to a digest; where there are none, the joint that is named.
    pub(super) fn digest(&self, digest: &mut Digest) {
        digest.add(self.rnea);
        let named = |e: NotPositiveDefinite| [e.joint as f32; 6];
        digest.add(self.forward.unwrap_or_else(named));
        digest.add(self.aba.unwrap_or_else(named));
        for matrix in [self.mobility, self.by_matrix] {
            match matrix {
                Ok(rows) => rows.into_iter().for_each(|row| digest.add(row)),
                Err(e) => digest.add(named(e)),
            }
        }
    }
}

/// Computes everything of one state, and the accelerations of torques of one's own.
pub fn answers_to<R: Real, const N: usize>(
    arm: &Revolute<'_, R, N>,
    state: &State<R, N, N>,
    tau: &[R; N],
    scene: &Scene<R, N>,
) -> Answers<R, N> {
    Answers {
        rnea: torques(arm, state, scene),
        forward: by_matrix(arm, state, tau, scene),
        aba: by_bodies(arm, state, tau, scene),
        mobility: mobility_by_bodies(arm, &state.q, scene),
        by_matrix: mobility_by_matrix(arm, &state.q, scene),
    }
}

/// Forces along the three axes.
fn axes<R: Real>() -> [Force<R>; 3] {
    let (o, e) = (R::ZERO, R::ONE);
    [[e, o, o], [o, e, o], [o, o, e]]
        .map(|[x, y, z]| Force::new(R::Vec3::ZERO, R::Vec3::new(x, y, z)))
}

#[inline(never)]
fn torques<R: Real, const N: usize>(
    arm: &Revolute<'_, R, N>,
    state: &State<R, N, N>,
    scene: &Scene<R, N>,
) -> [R; N] {
    rnea(arm, state, scene)
}

#[inline(never)]
fn by_matrix<R: Real, const N: usize>(
    arm: &Revolute<'_, R, N>,
    state: &State<R, N, N>,
    tau: &[R; N],
    scene: &Scene<R, N>,
) -> Result<[R; N], NotPositiveDefinite> {
    forward_dynamics(arm, state, tau, scene)
}

#[inline(never)]
fn by_bodies<R: Real, const N: usize>(
    arm: &Revolute<'_, R, N>,
    state: &State<R, N, N>,
    tau: &[R; N],
    scene: &Scene<R, N>,
) -> Result<[R; N], NotPositiveDefinite> {
    aba(arm, state, tau, scene)
}

#[inline(never)]
fn mobility_by_bodies<R: Real, const N: usize>(
    arm: &Revolute<'_, R, N>,
    q: &[R; N],
    scene: &Scene<R, N>,
) -> Result<[[R; 3]; 3], NotPositiveDefinite> {
    Ok(osim_inverse(arm, q, N - 1, frame::Local, scene)?.along(&axes()))
}

#[inline(never)]
fn mobility_by_matrix<R: Real, const N: usize>(
    arm: &Revolute<'_, R, N>,
    q: &[R; N],
    scene: &Scene<R, N>,
) -> Result<[[R; 3]; 3], NotPositiveDefinite> {
    let damping = Damping::relative(R::ZERO);
    let body = (N - 1, frame::Local);
    Ok(operational_space(arm, q, body, &axes(), scene, damping)?.mobility)
}
