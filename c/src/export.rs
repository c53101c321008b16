//! The functions of a library under its prefix, and the check of its header.

/// Fails to compile if a header has another number of joints or of way-points than the library
/// that it is of.
///
/// # Panics
/// If they differ, or the header defines one of them otherwise than at the start of a line.
#[track_caller]
pub const fn assert_header(header: &str, joints: usize, points: usize) {
    assert!(defined(header, "_JOINTS ") == joints, "the header has another number of joints");
    assert!(
        defined(header, "_MOST_POINTS ") == points,
        "MOST_POINTS of the header is not that of the scene"
    );
}

/// The number behind the first place of a name in a header.
const fn defined(header: &str, name: &str) -> usize {
    let (text, name) = (header.as_bytes(), name.as_bytes());
    let mut at = 0;
    while at + name.len() < text.len() {
        let mut same = 0;
        while same < name.len() && text[at + same] == name[same] {
            same += 1;
        }
        let mut end = at + same;
        let mut number = 0;
        while end < text.len() && text[end].is_ascii_digit() {
            number = 10 * number + (text[end] - b'0') as usize;
            end += 1;
        }
        if same == name.len() && end > at + same {
            return number;
        }
        at += 1;
    }
    usize::MAX
}

/// Exports the functions of the header to C: their names have a prefix, and what they compute with
/// is in a module of the caller's: the robot `Arm` with `N` joints, `Form`, `GRAVITY`, `Forces`,
/// `EFFECTS`, `TOOL_BODY` and `MOST_POINTS`. The names of the joints are the third argument.
///
/// The types of the functions are defined beside them. The caller's crate gives its version to the
/// memory that the functions know.
#[macro_export]
macro_rules! export {
    ($prefix:literal, $scene:ident, $joints:expr) => {
        const N: usize = $scene::N;
        const POINTS: usize = $scene::MOST_POINTS;

        /// The robot and what acts on it.
        #[derive(Clone, Copy, Debug)]
        pub enum Library {}

        impl $crate::Named for Library {
            const NAME: &'static str = concat!($prefix, env!("CARGO_PKG_VERSION"));
        }

        impl $crate::Library<N, { $scene::TOOL_BODY }, POINTS> for Library {
            type Arm = $scene::Arm;
            type Form = $scene::Form<$scene::Arm>;
            type Forces = $scene::Forces;
            const JOINTS: [&'static str; N] = $joints;
            const GRAVITY: f64 = $scene::GRAVITY;
            const EFFECTS: &'static ($crate::Gravity, Self::Forces) = &$scene::EFFECTS;
        }

        /// The library's functions.
        pub type Exports = $crate::Exports<Library, N, { $scene::TOOL_BODY }, POINTS>;
        const _: () = Exports::FITS;

        /// The numbers of a robot's joints.
        pub type Joints = [f32; N];
        /// A matrix of them, by rows.
        pub type Rows = [Joints; N];
        #[allow(missing_docs, reason = "as in the header")]
        mod types {
            use super::{Library, N, POINTS};
            pub use $crate::{
                AdviceText, Handle, Load, Pose, SensorFit, SensorLoad, Tool, Vec3, Where, Wrench,
            };
            pub type State = $crate::State<N>;
            pub type Config = $crate::Config<N>;
            pub type Motion = $crate::Motion<N, POINTS>;
            pub type Command = $crate::Command<N>;
            pub type Report = $crate::Report<N>;
            pub type Goal = $crate::Goal<Library, N>;
            pub type GoalChange = $crate::GoalChange<Library, N>;
            pub type Tip = $crate::Tip<Library, N>;
            pub type PoseSolver = $crate::PoseSolver<N>;
            pub type Motors = $crate::Motors<N>;
            pub type Temperatures = $crate::Temperatures<N>;
            pub type Thermal = $crate::Thermal<Library, N>;
            pub type Heat = $crate::Heat<N>;
        }
        pub use types::*;

        $crate::functions! { $prefix
            inverse_dynamics(state: Option<&State>, torque: Option<&mut Joints>);
            gravity(q: Option<&Joints>, torque: Option<&mut Joints>);
            inertia(q: Option<&Joints>, inertia: Option<&mut Rows>);
            inverse_dynamics_derivatives(
                state: Option<&State>, by_q: Option<&mut Rows>, by_qd: Option<&mut Rows>
            );
            forward_dynamics(
                state: Option<&State>, torque: Option<&Joints>, acceleration: Option<&mut Joints>
            );
            tool_set(
                tool: Option<&mut Tool>, body: i32, load: Option<&Load>,
                gravity: Option<&[f32; 3]>
            );
            gravity_of_base(attitude: Option<&[[f32; 3]; 3]>, gravity: Option<&mut [f32; 3]>);
            inverse_dynamics_with_tool(
                state: Option<&State>, tool: Option<&Tool>, torque: Option<&mut Joints>
            );
            gravity_with_tool(q: Option<&Joints>, tool: Option<&Tool>, torque: Option<&mut Joints>);
            inertia_with_tool(q: Option<&Joints>, tool: Option<&Tool>, inertia: Option<&mut Rows>);
            forward_dynamics_with_tool(
                state: Option<&State>, torque: Option<&Joints>, tool: Option<&Tool>,
                acceleration: Option<&mut Joints>
            );
            joint_wrench(
                state: Option<&State>, tool: Option<&Tool>, body: i32,
                torque: Option<&mut Joints>, wrench: Option<&mut Wrench>
            );
            tool_wrench(state: Option<&State>, tool: Option<&Tool>, wrench: Option<&mut Wrench>);
            sensor_fit_add(
                fit: Option<&mut SensorFit>, gravity: Option<&Vec3>, measured: Option<&Wrench>
            );
            sensor_fit_load(fit: Option<&SensorFit>, load: Option<&mut SensorLoad>);
            sensor_at_rest(
                load: Option<&SensorLoad>, gravity: Option<&Vec3>, shown: Option<&mut Wrench>
            );
            body_pose(q: Option<&Joints>, body: i32, pose: Option<&mut Pose>);
            body_jacobian(q: Option<&Joints>, body: i32, jacobian: Option<&mut [Joints; 6]>);
            config_of_description(tick: f32, frequency: f32, config: Option<&mut Config>);
            config_advice(config: Option<&Config>, advice: Option<&mut AdviceText>);
            controller_init(
                memory: Option<Handle>, bytes: usize, config: Option<&Config>,
                at: Option<&mut Where>
            );
            controller_tool(memory: Option<Handle>, tool: Option<&Tool>);
            controller_move(
                memory: Option<Handle>, motion: Option<&Motion>, at: Option<&mut Where>
            );
            controller_follow(
                memory: Option<Handle>, reference: Option<&State>, at: Option<&mut Where>
            );
            controller_observe(memory: Option<Handle>, q: Option<&Joints>, valid: Option<&[u8; N]>);
            controller_command(memory: Option<Handle>, command: Option<&mut Command>);
            controller_stop(memory: Option<Handle>);
            controller_off(memory: Option<Handle>);
            controller_fault(memory: Option<Handle>, kind: i32, joint: i32);
            controller_missed(memory: Option<Handle>, ticks: u32);
            controller_reset(memory: Option<Handle>, at: Option<&mut Where>);
            controller_report(memory: Option<Handle>, report: Option<&mut Report>);
            goal_init(
                goal: Option<&mut Goal>, config: Option<&Config>, jerk: Option<&Joints>,
                at: Option<&mut Where>
            );
            controller_goal(
                memory: Option<Handle>, goal: Option<&mut Goal>, q: Option<&Joints>,
                ticks: Option<&mut u32>, at: Option<&mut Where>
            );
            controller_goal_begin(
                memory: Option<Handle>, goal: Option<&Goal>, change: Option<&mut GoalChange>,
                start: u32, q: Option<&Joints>, torque: Option<&Joints>, at: Option<&mut Where>
            );
            controller_goal_advance(
                memory: Option<Handle>, goal: Option<&mut Goal>, change: Option<&mut GoalChange>,
                tick: u32, ticks: Option<&mut u32>, at: Option<&mut Where>
            );
            goal_state(goal: Option<&Goal>, tick: u32, state: Option<&mut State>);
            tip_init(
                tip: Option<&mut Tip>, config: Option<&Config>, start: Option<&State>,
                damping: f32, length: f32, posture_gain: f32, at: Option<&mut Where>
            );
            tip_step(
                tip: Option<&mut Tip>, twist: Option<&[f32; 6]>, reference: Option<&mut State>,
                at: Option<&mut Where>
            );
            tip_goal(
                tip: Option<&mut Tip>, pose: Option<&Pose>, gain: f32, angular: f32, linear: f32,
                reference: Option<&mut State>, at: Option<&mut Where>
            );
            solve_pose(solver: Option<&PoseSolver>, pose: Option<&Pose>, q: Option<&mut Joints>);
            thermal_init(
                thermal: Option<&mut Thermal>, motors: Option<&Motors>, config: Option<&Config>,
                saved: Option<&Temperatures>, off: f32, at: Option<&mut Where>
            );
            thermal_update(
                thermal: Option<&mut Thermal>, torque: Option<&Joints>, limit: Option<&mut Joints>
            );
            thermal_measured(thermal: Option<&mut Thermal>, joint: i32, celsius: f32);
            thermal_holds_for(
                thermal: Option<&Thermal>, joint: i32, torque: f32, seconds: Option<&mut f32>
            );
            thermal_report(thermal: Option<&Thermal>, report: Option<&mut Heat>);
            controller_limit(memory: Option<Handle>, thermal: Option<&Thermal>);
        }
    };
}

/// The functions of [`export!`].
#[doc(hidden)]
#[macro_export]
macro_rules! functions {
    ($prefix:literal $($name:ident($($argument:ident: $type:ty),*);)*) => {$(
        #[doc = concat!("`", $prefix, "_", stringify!($name), "` of the header.")]
        // SAFETY: no other symbol has this name, whose prefix is the library's.
        #[unsafe(export_name = concat!($prefix, "_", stringify!($name)))]
        pub extern "C" fn $name($($argument: $type),*) -> i32 {
            Exports::$name($($argument),*)
        }
    )*};
}
