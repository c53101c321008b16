//! Every effect once, with the parameters of an arm of the UR5e's size, those of the scene where it
//! has them, to measure the cost of effects on the target and on the host.
//!
//! A scene is a rigid body on earth and one effect more; of a rigid body's own terms, the rigid
//! body without it. Except for gravity all numbers are assumed, of the order that such arms have.

use dynamics_core::effects::{
    Armature, AsymmetricCoulomb, BodyWrench, Cogging, Contact, ContactPoint, Coriolis, Coulomb,
    Effect, EndStops, Gravity, GyroscopicRotors, Inertia, LoadFriction, Lugre, MovingBase, Payload,
    RIGID_BODY, Spring, Stribeck, Viscous, Width, WorldWrench,
};
use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::{Force, Motion};
use firmware_demo::scenes::ur5e;
use glam::Vec3;

/// The scene that all others are compared with.
pub const RIGID: &str = "rigid_body";
/// The prefix of the name of a scene without an effect.
pub const WITHOUT: &str = "less_";

/// Visits each scene.
pub trait Visitor<const N: usize> {
    /// Takes the scene of this name.
    fn scene<E: Effect<f32, N, N>>(&mut self, name: &'static str, effects: E);
}

/// The rigid body, and that with each of its terms left out.
///
/// ```
/// use dynamics_core::effects::Effect;
/// use lab_target::effect_presets::{RIGID, Visitor, rigid};
/// struct Names(Vec<&'static str>);
/// impl Visitor<6> for Names {
///     fn scene<E: Effect<f32, 6, 6>>(&mut self, name: &'static str, _: E) {
///         self.0.push(name);
///     }
/// }
/// let mut names = Names(Vec::new());
/// rigid(&mut names);
/// assert_eq!(names.0, [RIGID, "less_gravity", "less_inertia", "less_coriolis"]);
/// ```
pub fn rigid<const N: usize>(visitor: &mut impl Visitor<N>) {
    visitor.scene(RIGID, RIGID_BODY);
    visitor.scene("less_gravity", (Inertia, Coriolis));
    visitor.scene("less_inertia", (Gravity::EARTH, Coriolis));
    visitor.scene("less_coriolis", (Gravity::EARTH, Inertia));
}

pub fn joints<const N: usize>(visitor: &mut impl Visitor<N>) {
    let (.., Viscous(viscous), Coulomb { torque, width }, Armature(rotors)) = ur5e::EFFECTS;
    let [sliding, viscous, rotors] = [torque, viscous, rotors].map(spread);
    let (excess, stribeck_speed) = (sliding.map(|f| 0.4 * f), Width::f32(0.1));
    visitor.scene("viscous", (RIGID_BODY, Viscous(viscous)));
    let coulomb = Coulomb {
        torque: sliding,
        width,
    };
    visitor.scene("coulomb", (RIGID_BODY, coulomb));
    let asymmetric = AsymmetricCoulomb {
        forward: sliding,
        backward: sliding.map(|f| 0.8 * f),
        width,
    };
    visitor.scene("asymmetric_coulomb", (RIGID_BODY, asymmetric));
    let stribeck = Stribeck {
        excess,
        stribeck_speed,
        width: Width::f32(0.01),
    };
    visitor.scene("stribeck", (RIGID_BODY, stribeck));
    let lugre = Lugre {
        stiffness: sliding.map(|f| 1e4 * f),
        damping: sliding,
        viscous,
        sliding,
        excess,
        stribeck_speed,
        bristle: [0.0; N],
    };
    visitor.scene("lugre", (RIGID_BODY, lugre));
    let gears = LoadFriction {
        driving: [0.25; N],
        backdriving: [0.2; N],
        width,
    };
    visitor.scene("load_friction", (RIGID_BODY, gears));
    visitor.scene("armature", (RIGID_BODY, Armature(rotors)));
    let spring = Spring {
        stiffness: [5.0; N],
        rest: [0.0; N],
    };
    visitor.scene("spring", (RIGID_BODY, spring));
    let stops = EndStops {
        lower: [-6.0; N],
        upper: [6.0; N],
        stiffness: 1e4,
        damping: 50.0,
        damping_depth: Width::f32(1e-3),
    };
    visitor.scene("end_stops", (RIGID_BODY, stops));
    let cogging = Cogging {
        per_turn: [1200.0; N],
        cos: sliding.map(|f| [0.05 * f, 0.0]),
        sin: sliding.map(|f| [0.05 * f, 0.02 * f]),
    };
    visitor.scene("cogging", (RIGID_BODY, cogging));
}

/// The effects on the body of the number BODY, or on the base.
pub fn bodies<const N: usize, const BODY: usize>(visitor: &mut impl Visitor<N>) {
    let body = BODY;
    let payload = Payload::<_, BODY>::from_inertia(BodyInertia {
        mass: 2.0,
        com: [0.0, 0.02, 0.08],
        inertia: [0.01, 0.0, 0.0, 0.01, 0.0, 0.005],
    });
    visitor.scene("payload", (RIGID_BODY, payload));
    let wrench = Force::new(Vec3::new(0.5, 0.0, 1.0), Vec3::new(0.0, 5.0, 20.0));
    visitor.scene("body_wrench", (RIGID_BODY, BodyWrench { body, wrench }));
    visitor.scene("world_wrench", (RIGID_BODY, WorldWrench { body, wrench }));
    let floor = Contact {
        points: [ContactPoint {
            body,
            point: Vec3::new(0.0, 0.0, 0.1),
        }],
        normal: Vec3::Z,
        height: -1.0,
        stiffness: 1e4,
        damping: 100.0,
        damping_depth: Width::f32(1e-3),
        friction: 0.5,
        slip_tolerance: 1e-3,
    };
    visitor.scene("contact", (RIGID_BODY, floor));
    let ship = MovingBase {
        velocity: Motion::new(Vec3::new(0.2, 0.1, 0.0), Vec3::new(1.0, 0.0, 0.3)),
        acceleration: Motion::new(Vec3::new(0.1, 0.1, 0.0), Vec3::new(0.5, 0.5, 1.0)),
    };
    visitor.scene("moving_base", (RIGID_BODY, ship));
}

/// Rotors as bodies that spin, which the engine does not have.
pub fn spinning<const N: usize>(visitor: &mut impl Visitor<N>) {
    let ratio = [100.0; N];
    let (.., Armature(rotors)) = ur5e::EFFECTS;
    let inertia = spread(rotors).map(|i| i * 1e-4);
    visitor.scene(
        "gyroscopic_rotors",
        (RIGID_BODY, GyroscopicRotors { inertia, ratio }),
    );
}

/// The numbers of the UR5e's joints for N joints: the last one's for those beyond.
fn spread<const N: usize>(numbers: [f32; 6]) -> [f32; N] {
    core::array::from_fn(|joint| numbers[joint.min(5)])
}
