//! Impossible robots and scenes, each in a constant.

use dynamics_core::delegate_effect;
use dynamics_core::effects::*;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};
use dynamics_core::robots::{Iiwa14, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::{Core, Engine};

const ROD: Body = Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0]));

pub const HEAVY: ArmModel<f64, 1> = Model::new("arm", [ROD.mass(-1.0)]); //~ body `rod`: its mass is negative or not finite
pub const NO_NUMBER: ArmModel<f64, 1> = Model::new("arm", [ROD.mass(f64::NAN)]); //~ body `rod`: its mass is negative or not finite
pub const NO_AXIS: ArmModel<f64, 1> = Model::new( //~ body `rod`: its joint axis is zero or not finite
    "arm",
    [Body::new("rod", BASE, Joint::revolute([0.0; 3]))],
);
pub const ORPHAN: ArmModel<f64, 1> = Model::new( //~ body `rod`: its parent is not listed before it
    "arm",
    [Body::new("rod", 1, Joint::revolute([0.0, 1.0, 0.0]))],
);
pub const DEGREES: ArmModel<f64, 1> = Model::new("arm", [ROD.rpy([0.0, 90.0, 0.0])]); //~ its roll, pitch or yaw is beyond 2 pi: angles are in rad
pub const NEGATIVE: ArmModel<f64, 1> = Model::new("arm", [ROD.inertia([0.03, 0.0, 0.0, -0.026, 0.0, 0.03])]); //~ body `rod`: a principal moment of its inertia is negative: -2.60e-2 kg·m²
pub const ORDER: ArmModel<f64, 1> = Model::new("arm", [ROD.inertia([0.03, 0.04, 0.05, 0.001, -0.002, 0.003])]); //~ in the order xx, yy, zz, xy, xz, yz it has none: -5.06e-2 kg·m²
const CROSSED: JointLimits<f64> = JointLimits { lower: 1.0, upper: -1.0, ..JointLimits::NONE };
pub const LIMITS: ArmModel<f64, 1> = Model::new("arm", [ROD.limits(CROSSED)]); //~ lower exceeds upper
pub const SIZES: Model<f64, 1, 2, 2> = Model::new("arm", [ROD]); //~ robot `arm`: its joints make Q = 1 and V = 1, not Q = 2 and V = 2
pub const fn run_time(bodies: [Body; 1]) -> ArmModel<f64, 1> {
    Model::new("arm", bodies)
}
pub const WRIST: usize = Ur5e::MODEL.body("wrist3"); //~ no body of the robot has the name `wrist3`: its bodies are `shoulder`, `upper_arm`, `forearm`, `wrist_1`, `wrist_2`, `wrist_3`

/// Nothing evaluates its model but a scene.
pub struct Massless;
impl Robot<1, 1, 1> for Massless {
    const MODEL: ArmModel<f64, 1> = Model::new("arm", [ROD.mass(-2.0)]); //~ body `rod`: its mass is negative or not finite
}
pub const OF_MASSLESS: Gravity = Core::<Massless>::scene_f32(Gravity::EARTH);

pub struct Axisless;
impl Robot<1, 1, 1> for Axisless {
    const MODEL: ArmModel<f64, 1> = Model::new("a", [Body::new("rod", BASE, Joint::revolute([0.0; 3]))]); //~ its joint axis is zero
}
pub const OF_AXISLESS: Gravity = Engine::<Axisless>::scene_f64(Gravity::EARTH);

type Rigid = (Gravity, Inertia, Coriolis);
const DAMPING: Viscous<f32, 6> = Viscous([0.5; 6]);
const SMALL: Width<f32> = Width::f32(0.02);
const DRY: Coulomb<f32, 6> = Coulomb { torque: [1.0; 6], width: SMALL };
const ONE_WAY: AsymmetricCoulomb<f32, 6> = AsymmetricCoulomb { forward: [1.0; 6], backward: [1.0; 6], width: SMALL };
const STICTION: Stribeck<f32, 6> = Stribeck { excess: [1.0; 6], stribeck_speed: SMALL, width: SMALL };
const GEARS: LoadFriction<f32, 6> = LoadFriction { driving: [0.2; 6], backdriving: [0.2; 6], width: SMALL };
const BRISTLES: Lugre<f32, 6> = Lugre {
    stiffness: [1.0; 6], damping: [1.0; 6], viscous: [1.0; 6], sliding: [1.0; 6], excess: [1.0; 6],
    stribeck_speed: SMALL, bristle: [0.0; 6],
};
const ROTORS: GyroscopicRotors<f32, 6> = GyroscopicRotors { inertia: [1e-4; 6], ratio: [5.0; 6] };
const SHIP: MovingBase<f32> = MovingBase {
    velocity: dynamics_core::spatial::Motion::ZERO,
    acceleration: dynamics_core::spatial::Motion::ZERO,
};
const TILTED: GravityVector<f32> = GravityVector(dynamics_core::glam::Vec3::NEG_Z);

pub const G1: (Rigid, Gravity) = Engine::<Ur5e>::scene_f32((RIGID_BODY, Gravity::MOON)); //~ several fields of gravity
pub const G2: (Rigid, GravityVector<f32>) = Core::<Ur5e>::scene_f32((RIGID_BODY, TILTED)); //~ write (Inertia, Coriolis, GravityVector(..))
pub const G3: (Gravity, ((Inertia, Gravity),)) = Core::<Ur5e>::scene_f64((Gravity::EARTH, ((Inertia, Gravity::MOON),))); //~ several fields of gravity
pub const I: (Rigid, Inertia) = Engine::<Ur5e>::scene_f64((RIGID_BODY, Inertia)); //~ contains Inertia twice, which changes nothing
pub const C: (Rigid, Coriolis) = Engine::<Ur5e>::scene_f64((RIGID_BODY, Coriolis)); //~ contains Coriolis twice, which changes nothing
pub const E: (Elasticity, Elasticity) = Core::<Ur5e>::scene_f64((Elasticity, Elasticity)); //~ contains Elasticity twice
pub const M: (MovingBase<f32>, MovingBase<f32>) = Core::<Ur5e>::scene_f32((SHIP, SHIP)); //~ contains MovingBase twice, but the base has one motion
pub const V1: (Viscous<f32, 6>, Viscous<f32, 6>) = Engine::<Ur5e>::scene_f32((DAMPING, DAMPING)); //~ write one Viscous([..]) with the sums of the coefficients
pub const V2: ((Rigid, Viscous<f32, 6>), ((), (Viscous<f32, 6>,))) = Engine::<Ur5e>::scene_f32(((RIGID_BODY, DAMPING), ((), (DAMPING,)))); //~ contains Viscous twice
pub const F1: (Coulomb<f32, 6>, Coulomb<f32, 6>) = Engine::<Ur5e>::scene_f32((DRY, DRY)); //~ contains Coulomb twice, whose torques would add
pub const F2: (AsymmetricCoulomb<f32, 6>, AsymmetricCoulomb<f32, 6>) = Engine::<Ur5e>::scene_f32((ONE_WAY, ONE_WAY)); //~ contains AsymmetricCoulomb twice
pub const F3: (Stribeck<f32, 6>, Stribeck<f32, 6>) = Engine::<Ur5e>::scene_f32((STICTION, STICTION)); //~ contains Stribeck twice
pub const F4: (Lugre<f32, 6>, Lugre<f32, 6>) = Engine::<Ur5e>::scene_f32((BRISTLES, BRISTLES)); //~ contains Lugre twice
pub const F5: (LoadFriction<f32, 6>, LoadFriction<f32, 6>) = Engine::<Ur5e>::scene_f32((GEARS, GEARS)); //~ contains LoadFriction twice
pub const A: (Armature<f32, 6>, Armature<f32, 6>) = Engine::<Ur5e>::scene_f32((Armature([0.5; 6]), Armature([0.1; 6]))); //~ write one Armature([..]) with the sums of the inertias
pub const R: (GyroscopicRotors<f32, 6>, GyroscopicRotors<f32, 6>) = Core::<Ur5e>::scene_f32((ROTORS, ROTORS)); //~ contains GyroscopicRotors twice
pub const WIDE: Gravity = Engine::<Comb>::scene_f32(Gravity::EARTH); //~ the engine takes up to 64 velocity coordinates; use `Core`
/// One coordinate more than the engine takes.
pub struct Comb;
impl Robot<65, 65, 65> for Comb {
    const MODEL: ArmModel<f64, 65> = Model::new("comb", [ROD; 65]);
}

const TOOL: Payload<f32, 9> = Payload::f32(dynamics_core::model::BodyInertia { mass: 1.0, com: [0.0; 3], inertia: [0.0; 6] });
pub const P1: (Rigid, Payload<f32, 9>) = Engine::<Ur5e>::scene_f32((RIGID_BODY, TOOL)); //~ a payload is on body 9 of a robot of 6 bodies, which are numbered from 0
pub const P2: Payload<f32, 9> = Core::<Ur5e>::scene_f32(TOOL); //~ a payload is on body 9 of a robot of 6 bodies

type Base<T> = BaseParameters<T, f32, 7, 7, 7>;
pub const fn of_another(base: Base<Iiwa14>) -> Base<Iiwa14> {
    Engine::<Panda>::scene_f32(base)
}

/// A wrapper of the user's own forwards them.
pub struct Cell<E>(Viscous<f32, 6>, E);
delegate_effect! {
    impl[E: Effect<f32, B, 6>, const B: usize] Effect<f32, B, 6> for Cell<E>,
    |this| { Viscous<f32, 6> => this.0, E => this.1 }
}
pub const W1: Cell<Viscous<f32, 6>> = Engine::<Ur5e>::scene_f32(Cell(DAMPING, DAMPING)); //~ contains Viscous twice
pub const W2: Cell<Payload<f32, 9>> = Engine::<Ur5e>::scene_f32(Cell(DAMPING, TOOL)); //~ a payload is on body 9
/// One that is off forwards nothing.
pub struct Off(Viscous<f32, 6>);
delegate_effect! {
    if false, impl[const B: usize] Effect<f32, B, 6> for Off, |this| { Viscous<f32, 6> => this.0 }
}
pub const W3: (Off, Viscous<f32, 6>) = Engine::<Ur5e>::scene_f32((Off(DAMPING), DAMPING));
/// An effect of the user's own may occur as often as the user says.
pub struct Magnet;
impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Magnet {
    const GRAVITY_FIELD: hook::Field<Self, R> = hook::Field::gravity(|_, _| {});
}
pub const W4: (Rigid, Magnet) = Core::<Ur5e>::scene_f32((RIGID_BODY, Magnet)); //~ several fields of gravity
