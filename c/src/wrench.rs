//! Wrenches in joints and of loads, and the load of a force sensor at rest.

use dynamics_core::{
    Core, Engine, algorithms::Kinematics, glam::Vec3, model::OnBody, spatial::Motion,
};
use motion_control::estimate::{SensorLoadError, SensorLoadFit};

use crate::status::{self, NULL};
use crate::tool::{Tool, is_gravity};
use crate::{Exports, Library, State, check, status_of};

/// A couple and a force: `..._wrench` of the header.
pub type Wrench = dynamics_core::spatial::Force<f32>;
/// Poses at rest, of which any bits are a value: `..._sensor_fit` of the header, with as many words.
pub type SensorFit = SensorLoadFit<f32>;
const _: () = assert!(size_of::<SensorFit>() == 4 * 34 && align_of::<SensorFit>() == 4);
/// The load beyond a force sensor, and its offset: `..._sensor_load` of the header.
pub type SensorLoad = motion_control::estimate::SensorLoad<f32>;

#[inline(always)]
fn write(result: Wrench, output: &mut Wrench) -> Result<(), i32> {
    check::results([result.ang.as_ref(), result.lin.as_ref()])?;
    *output = result;
    Ok(())
}

fn numbers(SensorLoad { mass, first_moment, offset }: &SensorLoad) -> [&[f32]; 4] {
    [core::slice::from_ref(mass), first_moment.as_ref(), offset.ang.as_ref(), offset.lin.as_ref()]
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The torques of a motion, and the wrench in the joint of a body.
    pub fn joint_wrench(
        state: Option<&State<N>>,
        tool: Option<&Tool>,
        body: i32,
        torque: Option<&mut [f32; N]>,
        wrench: Option<&mut Wrench>,
    ) -> i32 {
        status_of(|| {
            let (state, torque, wrench) =
                (state.ok_or(NULL)?, torque.ok_or(NULL)?, wrench.ok_or(NULL)?);
            Self::motion(state)?;
            let body = usize::try_from(body).map_err(|_| status::NO_BODY)?;
            let tool = Self::set_tool(tool.unwrap_or(&Self::NO_TOOL))?;
            let (tau, result) = if body == TOOL && tool.is_on(TOOL) {
                let found =
                    Engine::<L::Arm>::rnea_and_wrenches(state, &Self::usual(tool), OnBody::<TOOL>);
                (found.tau, found.wrenches[0])
            } else {
                let all = Core::<L::Arm>::rnea_and_wrenches(state, &Self::anywhere(tool));
                (all.tau, *all.wrenches.get(body).ok_or(status::NO_BODY)?)
            };
            check::results([&tau])?;
            write(result, wrench)?;
            *torque = tau;
            Ok(())
        })
    }

    /// The wrench that a body exerts on the load of its tool.
    pub fn tool_wrench(
        state: Option<&State<N>>,
        tool: Option<&Tool>,
        wrench: Option<&mut Wrench>,
    ) -> i32 {
        status_of(|| {
            let (state, tool, wrench) =
                (state.ok_or(NULL)?, Self::set_tool(tool.ok_or(NULL)?)?, wrench.ok_or(NULL)?);
            Self::motion(state)?;
            let (pose, v, a) = if tool.is_on(TOOL) {
                let found = Engine::<L::Arm>::kinematics_of(state, &(), OnBody::<TOOL>);
                (found.poses[0], found.velocities[0], found.accelerations[0])
            } else {
                let Kinematics { poses, velocities, accelerations } =
                    Core::<L::Arm>::kinematics(state, &());
                let mut each = poses.into_iter().zip(velocities).zip(accelerations);
                let ((pose, v), a) = each.nth(tool.body as usize).ok_or(status::TOOL)?;
                (pose, v, a)
            };
            // Gravity is an acceleration of the base against it.
            let fall = Motion::new(Vec3::ZERO, pose.rot.transpose() * tool.gravity().0);
            write(tool.inertia().force(a - fall, v), wrench)
        })
    }

    /// Adds a pose at rest.
    pub fn sensor_fit_add(
        fit: Option<&mut SensorFit>,
        gravity: Option<&Vec3>,
        measured: Option<&Wrench>,
    ) -> i32 {
        status_of(|| {
            let (fit, gravity, measured) =
                (fit.ok_or(NULL)?, gravity.ok_or(NULL)?, measured.ok_or(NULL)?);
            check::inputs([measured.ang.as_ref(), measured.lin.as_ref()])?;
            is_gravity(gravity.as_ref())?;
            fit.add(*gravity, measured);
            Ok(())
        })
    }

    /// The load and the offset that the poses show.
    pub fn sensor_fit_load(fit: Option<&SensorFit>, load: Option<&mut SensorLoad>) -> i32 {
        status_of(|| {
            let (fit, load) = (fit.ok_or(NULL)?, load.ok_or(NULL)?);
            let found = fit.load().map_err(|error| match error {
                SensorLoadError::FewPoses(_) => status::FEW_POSES,
                SensorLoadError::OneDirection => status::ONE_DIRECTION,
                SensorLoadError::Sign => status::SENSOR_SIGN,
                SensorLoadError::Turned => status::SENSOR_AXES,
                _ => status::OVERFLOW,
            })?;
            check::results(numbers(&found))?;
            *load = found;
            Ok(())
        })
    }

    /// The wrench that the sensor shows at rest.
    pub fn sensor_at_rest(
        load: Option<&SensorLoad>,
        gravity: Option<&Vec3>,
        shown: Option<&mut Wrench>,
    ) -> i32 {
        status_of(|| {
            let (load, gravity, shown) =
                (load.ok_or(NULL)?, gravity.ok_or(NULL)?, shown.ok_or(NULL)?);
            is_gravity(gravity.as_ref())?;
            check::inputs(numbers(load))?;
            write(load.at_rest(*gravity), shown)
        })
    }
}
