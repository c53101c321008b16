//! A scene that is composed at run time: which of the library's effects act.
//!
//! The terms of the equations of motion are parameters of the type, as in a scene of the library,
//! so that a term that is not named costs nothing; the other effects are lists, in the order in
//! which the user named them.

use dynamics_core::effects::{
    BodyState, BodyWrench, Contact, Effect, GyroscopicRotors, JointState, LoadFactors,
    LoadFriction, TorqueDerivatives, WorldWrench, hook,
};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion, SpatialInertia};

use crate::model::LARGE;

/// The terms of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Terms {
    /// Whether products of accelerations act.
    pub inertia: bool,
    /// Whether products of velocities act.
    pub coriolis: bool,
    /// Effects at bodies, at the base or in gears.
    pub extra: bool,
}

/// The most harmonics of cogging.
pub const HARMONICS: usize = 8;

/// An effect that acts at joints.
pub trait AtJoint<R: Real> {
    /// Adds its torque at a joint.
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R);
    /// Adds the derivatives of that which an implicit step takes.
    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>);
    /// Adds the derivatives of that.
    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>);
    /// Whether the library knows them.
    fn is_differentiable(&self) -> bool;
}

/// An effect of the library, for the velocity coordinates of the largest model.
pub struct At<E>(pub E);

// One function for all algorithms and models: the machine code has few copies of what few scenes
// need.
impl<R: Real, E: Effect<R, 1, LARGE>> AtJoint<R> for At<E> {
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, at, tau);
    }

    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        self.0.derivatives(joint, at, derivatives);
    }

    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        self.0.slopes(joint, at, slopes);
    }

    fn is_differentiable(&self) -> bool {
        E::DIFFERENTIABLE
    }
}

/// An effect that acts at bodies.
pub enum AtBody<R: Real> {
    Body(BodyWrench<R>),
    /// At the body's origin, or at a point in its frame.
    World(WorldWrench<R>, Option<R::Vec3>),
    Contact(Contact<R, 1>),
}

/// The effects besides the terms of the equations of motion.
pub struct Parts<R: Real, const V: usize> {
    /// The terms of the equations of motion.
    pub terms: Terms,
    /// g, m/s²; zero where gravity is not named.
    pub gravity: R::Vec3,
    /// The effects that act at joints.
    pub joints: Vec<Box<dyn AtJoint<R>>>,
    /// The inertia of the motors, at each joint.
    pub armature: Option<[R; V]>,
    /// Rotors that spin on parent links.
    pub rotors: Option<GyroscopicRotors<R, V>>,
    /// Velocity and acceleration of the base.
    pub base: Option<(Motion<R>, Motion<R>)>,
    /// Loads, with the numbers of their bodies.
    pub payloads: Vec<(usize, SpatialInertia<R>)>,
    /// The wrenches and contacts at bodies.
    pub wrenches: Vec<AtBody<R>>,
    /// The friction of the gears.
    pub gears: Option<LoadFriction<R, V>>,
}

/// A scene: whether it has the products of accelerations (A), of velocities (C), effects at bodies
/// or gears (X), and friction of gears and rotors that spin (X and S): some algorithms of the
/// library have none.
///
/// The second field is whether the friction of gears acts: forward dynamics takes the motors'
/// torques through the gears and then computes its bias without them.
pub struct Scene<
    'a,
    R: Real,
    const V: usize,
    const A: bool,
    const C: bool,
    const X: bool,
    const S: bool,
>(pub &'a Parts<R, V>, pub bool);

impl<
    R: Real,
    const B: usize,
    const V: usize,
    const A: bool,
    const C: bool,
    const X: bool,
    const S: bool,
> Effect<R, B, V> for Scene<'_, R, V, A, C, X, S>
{
    const GRAVITY_FIELD: hook::Field<Self, R> =
        hook::Field::gravity(|scene, g| *g += scene.0.gravity);
    const BASE: hook::Base<Self, R> = match X {
        true => hook::Base::moving(|scene, v, a| scene.0.move_base(v, a)),
        false => hook::Base::NONE,
    };
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = match X {
        true => hook::Wrench::of_state(Self::add_wrenches::<B>),
        false => hook::Wrench::NONE,
    };
    const ADDED_INERTIA: hook::Inertia<Self, R, B> = match X {
        true => hook::Inertia::on([true; B], |scene, body, inertia| {
            scene.0.add_payloads(body, inertia);
        }),
        false => hook::Inertia::NONE,
    };
    const LOAD_FRICTION: hook::LoadFriction<Self, R> = match X && S {
        true => hook::LoadFriction::new(Self::load_factors::<B>, Self::load_slopes::<B>),
        false => hook::LoadFriction::NONE,
    };
    const ROTOR: hook::Rotor<Self, R> = match X && S {
        true => hook::Rotor::coupling(Self::add_coupling::<B>),
        false => hook::Rotor::NONE,
    };
    const ACCELERATIONS: bool = A;
    const VELOCITY_PRODUCTS: bool = C;

    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, at, tau);
    }

    #[inline(always)]
    fn inertia(&self, joint: usize) -> Option<R> {
        let armature = self.0.armature.as_ref().and_then(|all| all.get(joint));
        if X && let Some(rotors) = &self.0.rotors {
            let own = Effect::<R, B, V>::inertia(rotors, joint)?;
            return Some(armature.map_or(own, |&armature| armature + own));
        }
        armature.copied()
    }
}

impl<R: Real, const V: usize, const A: bool, const C: bool, const X: bool, const S: bool>
    Scene<'_, R, V, A, C, X, S>
{
    fn add_coupling<const B: usize>(&self, joint: usize, coupling: &mut R) {
        let add = const { <GyroscopicRotors<R, V> as Effect<R, B, V>>::ROTOR.add };
        if let (Some(rotors), Some(add)) = (&self.0.rotors, add) {
            add(rotors, joint, coupling);
        }
    }

    fn add_wrenches<const B: usize>(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
        for wrench in &self.0.wrenches {
            match wrench {
                AtBody::Body(w) => hook::add_wrench::<R, _, B, V>(w, body, at, fx),
                AtBody::World(w, None) => hook::add_wrench::<R, _, B, V>(w, body, at, fx),
                AtBody::World(w, Some(point)) => {
                    let mut there = Force::ZERO;
                    hook::add_wrench::<R, _, B, V>(w, body, at, &mut there);
                    *fx += Force::new(there.ang + point.cross(there.lin), there.lin);
                }
                AtBody::Contact(w) => hook::add_wrench::<R, _, B, V>(w, body, at, fx),
            }
        }
    }

    fn load_factors<const B: usize>(
        &self,
        joint: usize,
        at: JointState<R>,
        factors: &mut LoadFactors<R>,
    ) {
        let add = const { <LoadFriction<R, V> as Effect<R, B, V>>::LOAD_FRICTION.factors };
        if let (true, Some(gears), Some(add)) = (self.1, &self.0.gears, add) {
            add(gears, joint, at, factors);
        }
    }

    fn load_slopes<const B: usize>(
        &self,
        joint: usize,
        at: JointState<R>,
        slopes: &mut LoadFactors<R>,
    ) {
        let add = const { <LoadFriction<R, V> as Effect<R, B, V>>::LOAD_FRICTION.slopes };
        if let (true, Some(gears), Some(add)) = (self.1, &self.0.gears, add) {
            add(gears, joint, at, slopes);
        }
    }
}

/// The effects of which the library knows derivatives, for algorithms that need these; a base that
/// moves (M) is not among them for some.
pub struct Differentiable<'a, R: Real, const V: usize, const M: bool>(pub &'a Parts<R, V>);

impl<R: Real, const B: usize, const V: usize, const M: bool> Effect<R, B, V>
    for Differentiable<'_, R, V, M>
{
    const GRAVITY_FIELD: hook::Field<Self, R> =
        hook::Field::gravity(|scene, g| *g += scene.0.gravity);
    const BASE: hook::Base<Self, R> = match M {
        true => hook::Base::moving(|scene, v, a| scene.0.move_base(v, a)),
        false => hook::Base::NONE,
    };
    const ADDED_INERTIA: hook::Inertia<Self, R, B> =
        hook::Inertia::on([true; B], |scene, body, inertia| scene.0.add_payloads(body, inertia));
    const ACCELERATIONS: bool = true;
    const VELOCITY_PRODUCTS: bool = true;
    // The extension module asks `Spec::is_differentiable` before.
    const DIFFERENTIABLE: bool = true;

    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        self.0.torque(joint, at, tau);
    }

    fn derivatives(&self, joint: usize, at: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        for effect in &self.0.joints {
            effect.derivatives(joint, at, derivatives);
        }
    }

    fn slopes(&self, joint: usize, at: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        for effect in &self.0.joints {
            effect.slopes(joint, at, slopes);
        }
    }

    fn inertia(&self, joint: usize) -> Option<R> {
        self.0.armature.as_ref().and_then(|all| all.get(joint)).copied()
    }
}

impl<R: Real, const V: usize> Parts<R, V> {
    /// Gives what fills the model up the inertia 1.
    pub fn fill(&mut self, own: usize) {
        let armature = self.armature.get_or_insert([R::ZERO; V]);
        armature[own..].fill(R::ONE);
    }

    /// Takes the velocity of the base away.
    pub fn stop_base(&mut self) {
        if let Some((velocity, _)) = &mut self.base {
            *velocity = Motion::ZERO;
        }
    }

    #[inline(always)]
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        for effect in &self.joints {
            effect.torque(joint, at, tau);
        }
    }

    fn move_base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
        if let Some((v, a)) = self.base {
            *velocity += v;
            *acceleration += a;
        }
    }

    fn add_payloads(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        for (on, payload) in &self.payloads {
            if *on == body {
                *inertia = *inertia + *payload;
            }
        }
    }
}
