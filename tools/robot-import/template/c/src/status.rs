//! The results of functions: the enumeration of the header. The tests compare the numbers with it.

/// The result is written.
pub const OK: i32 = 0;
/// A pointer is null.
pub const NULL: i32 = -1;
/// An input is infinite or not a number.
pub const NOT_FINITE: i32 = -2;
/// A joint moves no inertia.
pub const NO_INERTIA: i32 = -3;
/// The inputs are finite, but a result is not.
pub const OVERFLOW: i32 = -4;
/// An angle is beyond the range of its joint.
pub const ANGLE: i32 = -5;
/// There is no body of this number.
pub const NO_BODY: i32 = -6;
/// The mass of a load is negative.
pub const MASS: i32 = -7;
/// A load has inertia without mass.
pub const MASSLESS: i32 = -8;
/// A load's moments of inertia are those of no body.
pub const MOMENTS: i32 = -9;
/// The tool was not set by `tool_set`.
pub const TOOL: i32 = -10;
/// A matrix is no rotation.
pub const ROTATION: i32 = -11;
/// The memory is too small, not aligned, or holds nothing that a function of this library has put there.
pub const MEMORY: i32 = -12;
/// A number of the configuration is not usable.
pub const CONFIG: i32 = -13;
/// A way-point or a reference is not usable.
pub const POINT: i32 = -14;
/// There is no reference yet.
pub const NO_REFERENCE: i32 = -15;
/// The arm moves, so that it takes a goal instead of way-points, or it is not stopped.
pub const STATE: i32 = -16;
/// There was no measurement in the last tick.
pub const NO_MEASUREMENT: i32 = -17;
/// A joint is outside its bounds.
pub const OUT_OF_BOUNDS: i32 = -18;
/// A joint is too far from its reference.
pub const TOO_FAR: i32 = -19;
/// There is no such fault, or no such joint.
pub const NO_FAULT: i32 = -20;
/// A sensor's load does not follow from so few poses.
pub const FEW_POSES: i32 = -21;
/// Gravity changes along one line of the sensor's frame, or hardly.
pub const ONE_DIRECTION: i32 = -22;
/// A joint is beyond its limits, or would be before its acceleration has ended.
pub const TOO_FAST: i32 = -23;
/// The motion to a goal takes 2³² ticks or more.
pub const TOO_LONG: i32 = -24;
/// No start has led to the pose.
pub const NOT_REACHED: i32 = -25;
/// No slower motion to a goal keeps a joint's limit of torque.
pub const TORQUE_LIMIT: i32 = -26;
/// The tick in which a motion to a goal starts is over, or the goal was set meanwhile.
pub const LATE: i32 = -27;

/// The status of a computation as C receives it.
#[inline(always)]
pub fn of(compute: impl FnOnce() -> Result<(), i32>) -> i32 {
    match compute() {
        Ok(()) => OK,
        Err(status) => status,
    }
}
