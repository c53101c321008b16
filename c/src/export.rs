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
            version();
            inverse_dynamics(state: &State, torque: &mut Joints);
            gravity(q: &Joints, torque: &mut Joints);
            inertia(q: &Joints, inertia: &mut Rows);
            inverse_dynamics_derivatives(state: &State, by_q: &mut Rows, by_qd: &mut Rows);
            forward_dynamics(state: &State, torque: &Joints, acceleration: &mut Joints);
            tool_set(tool: &mut Tool, body = i32, load: &Load, gravity: &[f32; 3]);
            gravity_of_base(attitude: &[[f32; 3]; 3], gravity: &mut [f32; 3]);
            inverse_dynamics_with_tool(state: &State, tool: &Tool, torque: &mut Joints);
            gravity_with_tool(q: &Joints, tool: &Tool, torque: &mut Joints);
            inertia_with_tool(q: &Joints, tool: &Tool, inertia: &mut Rows);
            forward_dynamics_with_tool(
                state: &State, torque: &Joints, tool: &Tool, acceleration: &mut Joints
            );
            joint_wrench(
                state: &State, tool: &Tool, body = i32, torque: &mut Joints, wrench: &mut Wrench
            );
            tool_wrench(state: &State, tool: &Tool, wrench: &mut Wrench);
            sensor_fit_add(fit: &mut SensorFit, gravity: &Vec3, measured: &Wrench);
            sensor_fit_load(fit: &SensorFit, load: &mut SensorLoad);
            sensor_at_rest(load: &SensorLoad, gravity: &Vec3, shown: &mut Wrench);
            body_pose(q: &Joints, body = i32, pose: &mut Pose);
            body_jacobian(q: &Joints, body = i32, jacobian: &mut [Joints; 6]);
            config_of_description(tick = f32, frequency = f32, config: &mut Config);
            config_advice(config: &Config, advice: &mut AdviceText);
            controller_init(memory: Handle, bytes = usize, config: &Config, at: &mut Where);
            controller_tool(memory: Handle, tool: &Tool);
            controller_move(memory: Handle, motion: &Motion, at: &mut Where);
            controller_follow(memory: Handle, reference: &State, at: &mut Where);
            controller_observe(memory: Handle, q: &Joints, valid: &[u8; N]);
            controller_command(memory: Handle, command: &mut Command);
            controller_stop(memory: Handle);
            controller_off(memory: Handle);
            controller_fault(memory: Handle, kind = i32, joint = i32);
            controller_missed(memory: Handle, ticks = u32);
            controller_reset(memory: Handle, at: &mut Where);
            controller_report(memory: Handle, report: &mut Report);
            goal_init(goal: &mut Goal, config: &Config, jerk: &Joints, at: &mut Where);
            goal_limits(goal: &mut Goal, config: &Config, jerk: &Joints, at: &mut Where);
            controller_goal(
                memory: Handle, goal: &mut Goal, q: &Joints, ticks: &mut u32, at: &mut Where
            );
            controller_goal_begin(
                memory: Handle, goal: &Goal, change: &mut GoalChange, start = u32, q: &Joints,
                torque: &Joints, at: &mut Where
            );
            controller_goal_advance(
                memory: Handle, goal: &mut Goal, change: &mut GoalChange, tick = u32,
                ticks: &mut u32, at: &mut Where
            );
            goal_state(goal: &Goal, tick = u32, state: &mut State);
            tip_init(
                tip: &mut Tip, config: &Config, start: &State, damping = f32, length = f32,
                posture_gain = f32, at: &mut Where
            );
            tip_step(tip: &mut Tip, twist: &[f32; 6], reference: &mut State, at: &mut Where);
            tip_goal(
                tip: &mut Tip, pose: &Pose, gain = f32, angular = f32, linear = f32,
                reference: &mut State, at: &mut Where
            );
            solve_pose(solver: &PoseSolver, pose: &Pose, q: &mut Joints);
            thermal_init(
                thermal: &mut Thermal, motors: &Motors, config: &Config, saved: &Temperatures,
                off = f32, at: &mut Where
            );
            thermal_update(thermal: &mut Thermal, torque: &Joints, limit: &mut Joints);
            thermal_measured(thermal: &mut Thermal, joint = i32, celsius = f32);
            thermal_holds_for(thermal: &Thermal, joint = i32, torque = f32, seconds: &mut f32);
            thermal_report(thermal: &Thermal, report: &mut Heat);
            controller_limit(memory: Handle, thermal: &Thermal);
        }
    };
}

/// The functions of [`export!`]: pointers, which may be null, and numbers behind `=`.
#[doc(hidden)]
#[macro_export]
macro_rules! functions {
    (
        $prefix:literal $($name:ident($($argument:ident $(: $pointer:ty)? $(= $number:ty)?),*);)*
    ) => {
        /// The functions with C's pointers.
        #[allow(clippy::useless_transmute, reason = "numbers are passed as they are")]
        pub mod raw {
            use super::*;
            $(
                #[doc = concat!("`", $prefix, "_", stringify!($name), "` of the header.")]
                ///
                /// # Safety
                /// Its pointers are as the header describes them.
                // SAFETY: no other symbol has this name, whose prefix is the library's.
                #[unsafe(export_name = concat!($prefix, "_", stringify!($name)))]
                pub unsafe extern "C" fn $name(
                    $($argument: <$($number)? $(Option<$pointer>)? as $crate::Argument>::Raw),*
                ) -> i32 {
                    let is_aligned = true $(
                        & <$($number)? $(Option<$pointer>)? as $crate::Argument>::is_aligned($argument)
                    )*;
                    if !is_aligned {
                        return $crate::status::MEMORY;
                    }
                    // Only as arguments of a function, which is inlined, do references say that
                    // outputs overlap nothing: without it some take 70 instructions more.
                    extern "C" fn of($($argument: $($number)? $(Option<$pointer>)?),*) -> i32 {
                        Exports::$name($($argument),*)
                    }
                    // SAFETY: null is `None`; they are aligned, and what else a pointer has to be
                    // is in the header.
                    unsafe { of($(core::mem::transmute($argument)),*) }
                }
            )*
        }
        $(
            #[doc = concat!("`", $prefix, "_", stringify!($name), "` for callers in Rust.")]
            #[allow(clippy::useless_transmute, reason = "numbers are passed as they are")]
            pub fn $name($($argument: $($number)? $(Option<$pointer>)?),*) -> i32 {
                // SAFETY: references are whole, aligned objects.
                unsafe { raw::$name($(core::mem::transmute($argument)),*) }
            }
        )*
    };
}
