//! All robots of the repository that are trees.

use dynamics_core::effects::{Armature, Coulomb, Viscous};
use dynamics_core::model::Robot;
use dynamics_core::robots::{
    A1, A1Free, A1Leg, G1, G1Free, Gen3, Iiwa14, Panda, So101, Ur5e, XArm7, Z1,
};
use firmware_demo::robots::{DirectDrive, Gimbal, Leg, Scara, SpaceArm, TwoLink};
use firmware_demo::scenes::{panda_payload, scara_table, so101_teach, ur5e};

use crate::machine::{About, Friction, Machine, Sized};

/// A robot: its key, its type in Rust and where that is, and how it is made.
pub struct Listed {
    pub key: &'static str,
    pub type_name: &'static str,
    pub module: &'static str,
    pub title: &'static str,
    pub make: fn() -> Box<dyn Machine>,
}

fn made<T: Robot<B, Q, V> + 'static, const B: usize, const Q: usize, const V: usize>(
    friction: Option<Friction>,
) -> Box<dyn Machine> {
    Sized::<B, Q, V>::new(T::MODEL, friction)
}

/// Friction and rotors as a scene assumes them.
fn of_scene<const N: usize>(
    Viscous(viscous): Viscous<f32, N>,
    Coulomb { torque, width }: Coulomb<f32, N>,
    Armature(armature): Armature<f32, N>,
) -> Option<Friction> {
    let double = |xs: [f32; N]| xs.map(f64::from).to_vec();
    Some(Friction {
        viscous: double(viscous),
        coulomb: double(torque),
        armature: double(armature),
        width: width.get().into(),
    })
}

fn ur5e() -> Box<dyn Machine> {
    let (.., viscous, coulomb, armature) = ur5e::EFFECTS;
    made::<Ur5e, 6, 6, 6>(of_scene(viscous, coulomb, armature))
}

fn panda() -> Box<dyn Machine> {
    let (.., viscous, coulomb, armature, _) = panda_payload::EFFECTS;
    made::<Panda, 7, 7, 7>(of_scene(viscous, coulomb, armature))
}

fn so101() -> Box<dyn Machine> {
    use so101_teach::{ARMATURE, COMPENSATION, VISCOUS};
    let (_, _, coulomb, _) = COMPENSATION;
    made::<So101, 6, 6, 6>(of_scene(Viscous([VISCOUS; 6]), coulomb, Armature([ARMATURE; 6])))
}

fn scara() -> Box<dyn Machine> {
    let (.., viscous, coulomb, armature) = scara_table::EFFECTS;
    made::<Scara, 3, 3, 3>(of_scene(viscous, coulomb, armature))
}

const LIBRARY: &str = "dynamics_core::robots";
const DEMO: &str = "firmware_demo::robots";

macro_rules! listed {
    ($($key:literal $robot:ident in $module:ident, $title:literal: $make:expr;)*) => {
        /// Every robot, the arms first.
        pub const ALL: &[Listed] = &[$(Listed {
            key: $key,
            type_name: stringify!($robot),
            module: $module,
            title: $title,
            make: $make,
        },)*];
    };
}
listed! {
    "ur5e" Ur5e in LIBRARY, "Universal Robots UR5e": ur5e;
    "panda" Panda in LIBRARY, "Franka Emika Panda": panda;
    "so101" So101 in LIBRARY, "SO-101": so101;
    "iiwa14" Iiwa14 in LIBRARY, "KUKA LBR iiwa 14": || made::<Iiwa14, 7, 7, 7>(None);
    "gen3" Gen3 in LIBRARY, "Kinova Gen3": || made::<Gen3, 7, 7, 7>(None);
    "xarm7" XArm7 in LIBRARY, "UFACTORY xArm7": || made::<XArm7, 7, 7, 7>(None);
    "z1" Z1 in LIBRARY, "Unitree Z1": || made::<Z1, 7, 7, 7>(None);
    "a1" A1 in LIBRARY, "Unitree A1, trunk held": || made::<A1, 16, 12, 12>(None);
    "a1_leg" A1Leg in LIBRARY, "Unitree A1, one leg": || made::<A1Leg, 4, 3, 3>(None);
    "a1_free" A1Free in LIBRARY, "Unitree A1, trunk free": || made::<A1Free, 17, 19, 18>(None);
    "g1" G1 in LIBRARY, "Unitree G1, pelvis held": || made::<G1, 29, 29, 29>(None);
    "g1_free" G1Free in LIBRARY, "Unitree G1, pelvis free": || made::<G1Free, 30, 36, 35>(None);
    "scara" Scara in DEMO, "SCARA of the scene": scara;
    "two_link" TwoLink in DEMO, "Two links": || made::<TwoLink, 2, 2, 2>(None);
    "direct_drive" DirectDrive in DEMO, "Direct-drive arm": || made::<DirectDrive, 3, 3, 3>(None);
    "gimbal" Gimbal in DEMO, "Gimbal": || made::<Gimbal, 3, 3, 3>(None);
    "leg" Leg in DEMO, "Hopping leg": || made::<Leg, 5, 4, 4>(None);
    "space_arm" SpaceArm in DEMO, "Arm of a satellite": || made::<SpaceArm, 7, 13, 12>(None);
}

#[path = "../../python/src/names.rs"]
mod names;

/// The robot of a key, with its joints as the file of its source names them.
pub fn about(listed: &Listed, machine: &dyn Machine) -> About {
    let mut about = machine.about();
    for joint in about.joints.iter_mut().filter(|_| listed.module == LIBRARY) {
        joint.name = names::joint(listed.key, joint.body, &joint.name);
    }
    about
}

/// The robot of a key.
pub fn named(key: &str) -> Option<&'static Listed> {
    ALL.iter().find(|listed| listed.key == key)
}
