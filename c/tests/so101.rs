//! The functions of a library for an arm of six joints, in the engine's form.

mod claims;

mod scene {
    use dynamics_core::effects::{Coriolis, Gravity, Inertia};

    pub use dynamics_core::{Engine as Form, robots::So101 as Arm};

    pub const N: usize = 6;
    pub const GRAVITY: f64 = 9.81;
    pub type Forces = (Inertia, Coriolis);
    pub const FORCES: Forces = (Inertia, Coriolis);
    pub const EFFECTS: (Gravity, Forces) = Form::<Arm>::scene_f32((Gravity::new(GRAVITY), FORCES));
    pub const TOOL_BODY: usize = N - 1;
    pub const MOST_POINTS: usize = 8;
}

mod library {
    use super::scene;

    dynamics_c::export!("so101", scene, ["1", "2", "3", "4", "5", "6"]);
}
