//! Limits of torque by the motors' temperatures: `..._thermal_...` of the header.

use motion_control::limits::{ConfigError, ConfigParameter, SafetyLimits};
use motion_control::safety::{ThermalLimit, ThermalStatus};

use crate::control::{Config, Rejected, Where};
use crate::controller::located;
use crate::memory::{Handle, Kept};
use crate::status::{self, NULL};
use crate::{Exports, Library, check, field, status_of};

/// Motors, from data sheets: `..._motors` of the header.
pub type Motors<const N: usize> = motion_control::safety::ThermalConfig<f32, N>;
/// Temperatures to be saved: `..._temperatures` of the header.
pub type Temperatures<const N: usize> = motion_control::safety::ThermalState<f32, N>;

/// The state of the limits: `..._heat` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat<const N: usize> {
    /// Limits in the next tick, N·m or N.
    pub torque: [f32; N],
    /// Temperatures of the windings, °C.
    pub celsius: [f32; N],
    /// Temperatures to be saved.
    pub saved: Temperatures<N>,
    /// 0 if no torque is limited, 1 if one is, 2 if a winding is too hot.
    pub state: i32,
    /// The hottest limited joint, or −1.
    pub joint: i32,
}

/// The limits: `..._thermal` of the header.
pub type Thermal<L, const N: usize> = Kept<ThermalLimit<f32, N>, L>;

fn number<const N: usize>(joint: i32) -> Result<usize, i32> {
    usize::try_from(joint).ok().filter(|&joint| joint < N).ok_or(status::NO_FAULT)
}

/// The motor that was refused.
fn rejected(error: ConfigError) -> Rejected {
    use ConfigParameter::{ThermalMotor, ThermalTorque};
    let (field, joint) = match error {
        ConfigError::OutOfRange { parameter: ThermalTorque { joint } } => {
            (field::THERMAL_TORQUE, Some(joint))
        }
        ConfigError::OutOfRange { parameter: ThermalMotor { joint } } => {
            (field::THERMAL_MOTOR, Some(joint))
        }
        _ => (field::TICK, None),
    };
    (status::CONFIG, Where::of(field, joint, None))
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The limits of motors with temperatures that were saved, or as hot as they may be.
    pub fn thermal_init(
        thermal: Option<&mut Thermal<L, N>>,
        motors: Option<&Motors<N>>,
        config: Option<&Config<N>>,
        saved: Option<&Temperatures<N>>,
        off: f32,
        at: Option<&mut Where>,
    ) -> i32 {
        let (Some(thermal), Some(motors)) = (thermal, motors) else {
            return NULL;
        };
        let most = [f32::INFINITY; N];
        let any = SafetyLimits { torque: most, rate: most, speed: most, lower: most, upper: most };
        let gate = config.map_or(any, |config| config.motion_controller().supervisor.limits);
        let made = check::inputs([&[off]]).map_err(|status| (status, Where::NOWHERE));
        let made = made.and_then(|()| ThermalLimit::try_new(*motors, &gate).map_err(rejected));
        let made = made.map(|limit| {
            let limit = saved.map_or(limit, |saved| limit.resumed(saved, off));
            *thermal = Kept::of(limit);
        });
        located(made, at)
    }

    /// Takes the torques of a tick.
    pub fn thermal_update(
        thermal: Option<&mut Thermal<L, N>>,
        torque: Option<&[f32; N]>,
        limit: Option<&mut [f32; N]>,
    ) -> i32 {
        status_of(|| {
            let (thermal, torque) = (Kept::get_mut(thermal)?, torque.ok_or(NULL)?);
            thermal.update(torque);
            check::inputs([torque])?;
            if let Some(limit) = limit {
                *limit = *thermal.torque();
            }
            Ok(())
        })
    }

    /// A temperature that a drive has measured.
    pub fn thermal_measured(thermal: Option<&mut Thermal<L, N>>, joint: i32, celsius: f32) -> i32 {
        status_of(|| {
            let (thermal, joint) = (Kept::get_mut(thermal)?, number::<N>(joint)?);
            check::inputs([&[celsius]])?;
            thermal.measured(joint, celsius);
            Ok(())
        })
    }

    /// How long a joint can hold a torque.
    pub fn thermal_holds_for(
        thermal: Option<&Thermal<L, N>>,
        joint: i32,
        torque: f32,
        seconds: Option<&mut f32>,
    ) -> i32 {
        status_of(|| {
            let (thermal, joint, seconds) =
                (Kept::get(thermal)?, number::<N>(joint)?, seconds.ok_or(NULL)?);
            check::inputs([&[torque]])?;
            *seconds = thermal.holds_for(joint, torque).min(f32::MAX);
            Ok(())
        })
    }

    /// Limits, temperatures and state.
    pub fn thermal_report(thermal: Option<&Thermal<L, N>>, report: Option<&mut Heat<N>>) -> i32 {
        status_of(|| {
            let (thermal, report) = (Kept::get(thermal)?, report.ok_or(NULL)?);
            let (state, joint) = match thermal.status() {
                ThermalStatus::Cool => (0, -1),
                ThermalStatus::Limited { joint } => (1, joint as i32),
                ThermalStatus::Hot { joint } => (2, joint as i32),
            };
            let celsius = core::array::from_fn(|joint| thermal.celsius(joint));
            let (torque, saved) = (*thermal.torque(), thermal.state());
            check::results([&torque, &celsius, &saved.winding, &saved.housing])?;
            *report = Heat { torque, celsius, saved, state, joint };
            Ok(())
        })
    }

    /// Gives the limits to the gate of a controller.
    pub fn controller_limit(memory: Option<Handle>, thermal: Option<&Thermal<L, N>>) -> i32 {
        status_of(|| {
            Self::control(memory)?.controller.limit_torques(Kept::get(thermal)?);
            Ok(())
        })
    }
}
