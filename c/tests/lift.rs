//! The functions of a library for a rod on a lift, with friction, in the textbook's form: a joint
//! slides, and the other one turns as far as it likes.

mod claims;

mod scene {
    use dynamics_core::effects::{Coriolis, Gravity, Inertia, Viscous};
    use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

    pub use dynamics_core::Core as Form;

    pub struct Arm;

    impl Robot<2, 2, 2> for Arm {
        const MODEL: ArmModel<f64, 2> = {
            let limits =
                JointLimits { lower: -0.2, upper: 0.8, velocity: f64::INFINITY, torque: 200.0 };
            let carriage = Body::new("carriage", BASE, Joint::prismatic([0.0, 0.0, 1.0]));
            let rod = Body::new("rod", 0, Joint::revolute([0.0, 1.0, 0.0]));
            let moments = [0.1667, 0.0, 0.0, 0.1667, 0.0, 0.0005];
            let rod = rod.mass(2.0).com([0.0, 0.0, -0.5]).inertia(moments);
            Model::new("lift", [carriage.mass(3.0).limits(limits), rod.xyz([0.1, 0.0, 0.0])])
        };
    }

    pub const N: usize = 2;
    pub const GRAVITY: f64 = 9.81;
    pub type Forces = (Inertia, Coriolis, Viscous<f32, N>);
    pub const FORCES: Forces = (Inertia, Coriolis, Viscous([5.0, 0.1]));
    pub const EFFECTS: (Gravity, Forces) = Form::<Arm>::scene_f32((Gravity::new(GRAVITY), FORCES));
    pub const TOOL_BODY: usize = N - 1;
    pub const MOST_POINTS: usize = 8;
}

mod library {
    use super::scene;

    dynamics_c::export!("lift", scene, ["lift", "bearing"]);
}
