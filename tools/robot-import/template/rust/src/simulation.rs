//! The robot and its devices, simulated: replaced by your board.

use core::cell::Cell;
use core::convert::Infallible;
use core::f32::consts::TAU;

use dynamics_core::algorithms::{MassMatrix, NotPositiveDefinite, crba};
use dynamics_core::effects::{Effect, JointState, TorqueDerivatives};
use dynamics_core::model::Calibrated;
use dynamics_core::sim::{Integrator, LinearlyImplicit, ModelDynamics};
use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};
use joint_drivers::Direction;

use crate::board::{BITS, Drive, Encoder};
use crate::control::{SetupError, encoder_mappings};
use crate::scene::{Arm, EFFECTS, Effects, Motion, N, TICK, encoder_ratios};

/// Steps of the simulation in a tick.
const STEPS: u8 = 2;
/// The duty that a simulated timer counts to.
const MAX_DUTY: u16 = 16_800;

/// The wires between the board and the simulated robot.
#[derive(Debug)]
pub struct Wires {
    angles: [Cell<u16>; N],
    duties: [Cell<u16>; N],
    brake: Cell<bool>,
}

impl Wires {
    /// Encoders at zero, drives at zero torque, no brake.
    pub fn new() -> Self {
        Self {
            angles: [const { Cell::new(0) }; N],
            duties: [const { Cell::new(MAX_DUTY / 2) }; N],
            brake: Cell::new(false),
        }
    }

    /// The encoders, which read zero at the positions `zero`, rad or m.
    ///
    /// # Errors
    /// [`SetupError::Encoder`].
    pub fn encoders(
        &self,
        motion: &Motion,
        zero: &[f32; N],
    ) -> Result<[Encoder<SimEncoder<'_>>; N], SetupError> {
        let ratio = encoder_ratios();
        let at_zero = core::array::from_fn(|joint| -zero[joint] / ratio[joint]);
        let mappings = encoder_mappings(motion, &at_zero, &[Direction::Forward; N])?;
        Ok(core::array::from_fn(|joint| {
            Encoder::new(SimEncoder(&self.angles[joint]), mappings[joint])
        }))
    }

    /// The drives, which deliver `full_scale` at full duty, N·m or N.
    pub fn drives(&self, full_scale: &[f32; N]) -> [Drive<SimDrive<'_>>; N] {
        core::array::from_fn(|joint| Drive::new(SimDrive(&self.duties[joint]), full_scale[joint]))
    }

    /// The brake.
    pub fn brake(&self) -> SimBrake<'_> {
        SimBrake(&self.brake)
    }
}

impl Default for Wires {
    fn default() -> Self {
        Self::new()
    }
}

/// The simulated robot.
#[derive(Debug)]
pub struct Plant {
    robot: Calibrated<Arm, f32, N, N, N>,
    effects: Effects,
    zero: [f32; N],
    ratio: [f32; N],
    full_scale: [f32; N],
    /// The state of the simulated robot.
    pub state: State<f32, N, N>,
}

impl Plant {
    /// At rest at `zero`, where its encoders read zero.
    pub fn new(zero: [f32; N], full_scale: [f32; N]) -> Self {
        Self {
            robot: Calibrated::nominal(),
            effects: EFFECTS,
            zero,
            ratio: encoder_ratios(),
            full_scale,
            state: State::at(zero),
        }
    }

    /// Moves on by a tick under the duties of now, and shows the encoders where the robot is.
    ///
    /// # Errors
    /// A joint moves no inertia.
    pub fn advance(&mut self, wires: &Wires) -> Result<(), NotPositiveDefinite> {
        if wires.brake.get() {
            self.state = State::at(self.state.q);
            return Ok(());
        }
        let half = f32::from(MAX_DUTY) * 0.5;
        let torque = core::array::from_fn(|joint| {
            (f32::from(wires.duties[joint].get()) / half - 1.0) * self.full_scale[joint]
        });
        for _ in 0..STEPS {
            self.step(&torque, TICK / f32::from(STEPS))?;
        }
        for (joint, angle) in wires.angles.iter().enumerate() {
            let turned = (self.state.q[joint] - self.zero[joint]) / self.ratio[joint];
            let counts = turned * ((1_u32 << BITS) as f32 / TAU);
            let nearest = counts + if counts < 0.0 { -0.5 } else { 0.5 };
            angle.set((nearest as i32 & ((1 << BITS) - 1)) as u16);
        }
        Ok(())
    }

    /// A step of `h` seconds.
    fn step(&mut self, torque: &[f32; N], h: f32) -> Result<(), NotPositiveDefinite> {
        let start = self.state;
        let friction = Friction::new(&self.effects, &start);
        let mechanics = ModelDynamics {
            robot: &self.robot,
            tau: *torque,
            effects: &self.effects,
        };
        LinearlyImplicit.advance(&mechanics, &mut self.state, h)?;
        let change = self.state.qdd.map(|qdd| h * qdd);
        if !friction.is_linear(&change) {
            let m = crba(&self.robot, &start.q, &self.effects);
            let change = friction.implicit(&m, &change, h);
            for (joint, change) in change.into_iter().enumerate() {
                self.state.qd[joint] = start.qd[joint] + change;
                self.state.q[joint] = start.q[joint] + h * self.state.qd[joint];
                self.state.qdd[joint] = change / h;
            }
        }
        for joint in 0..N {
            let at = JointState::new(self.state.q[joint], self.state.qd[joint]);
            Effect::<f32, N, N>::advance(&mut self.effects, joint, at, h);
        }
        Ok(())
    }
}

/// The friction of the joints in a step, as a function of their velocities at its end.
///
/// A linearly implicit step extends friction by its slope. Dry friction on a light joint bends
/// within the step: without its own curve the joint would be thrown from one direction into the
/// other.
struct Friction<'a> {
    effects: &'a Effects,
    start: &'a State<f32, N, N>,
    /// At the start, N·m or N.
    torque: [f32; N],
    /// The slope that the linearly implicit step takes, N·m·s/rad or N·s/m.
    slope: [f32; N],
}

/// The accuracy of the velocity at a step's end, rad/s or m/s.
const FOUND: f32 = 1e-5;
/// The number of rounds over the joints.
const ROUNDS: u8 = 20;

impl<'a> Friction<'a> {
    fn new(effects: &'a Effects, start: &'a State<f32, N, N>) -> Self {
        let mut friction = Self {
            effects,
            start,
            torque: [0.0; N],
            slope: [0.0; N],
        };
        for joint in 0..N {
            let mut derivatives = TorqueDerivatives::default();
            let at = JointState::new(start.q[joint], start.qd[joint]);
            Effect::<f32, N, N>::derivatives(effects, joint, at, &mut derivatives);
            friction.torque[joint] = friction.added(joint, 0.0);
            friction.slope[joint] = derivatives.dqd;
        }
        friction
    }

    /// The addition to the torque at the start where a joint's velocity has changed.
    fn added(&self, joint: usize, change: f32) -> f32 {
        let at = JointState::new(self.start.q[joint], self.start.qd[joint] + change);
        let mut torque = 0.0;
        Effect::<f32, N, N>::torque(self.effects, joint, at, &mut torque);
        torque - self.torque[joint]
    }

    /// Whether the slopes describe it, up to rounding.
    fn is_linear(&self, change: &[f32; N]) -> bool {
        (0..N).all(|joint| {
            let (added, extended) = (
                self.added(joint, change[joint]),
                self.slope[joint] * change[joint],
            );
            (added - extended).abs() <= 1e-5 * (self.torque[joint].abs() + extended.abs())
        })
    }

    /// The changes x of the velocities with the friction of the step's end: M x + h (f(q̇ + x) −
    /// f(q̇)) = b, joint by joint, where b is that of the linearly implicit step, which changes
    /// them by `linear`.
    fn implicit(&self, m: &MassMatrix<f32, N>, linear: &[f32; N], h: f32) -> [f32; N] {
        let row = |joint: usize, x: &[f32; N]| (0..N).map(|k| m.get(joint, k) * x[k]).sum::<f32>();
        let b: [f32; N] = core::array::from_fn(|joint| {
            row(joint, linear) + h * self.slope[joint] * linear[joint]
        });
        let mut x = *linear;
        for _ in 0..ROUNDS {
            let mut most = 0.0_f32;
            for joint in 0..N {
                let before = x[joint];
                let inertia = m.get(joint, joint);
                let driving = b[joint] - row(joint, &x) + inertia * before;
                let excess = |x: f32| inertia * x + h * self.added(joint, x) - driving;
                // Friction grows with velocity, so that the solution lies between these two.
                let (mut near, mut far) = (before, before - excess(before) / inertia);
                let falls = far < near;
                while (far - near).abs() > FOUND {
                    let middle = 0.5 * (near + far);
                    if middle == near || middle == far {
                        break;
                    }
                    match (excess(middle) > 0.0) == falls {
                        true => near = middle,
                        false => far = middle,
                    }
                }
                x[joint] = 0.5 * (near + far);
                most = most.max((x[joint] - before).abs());
            }
            if most <= FOUND {
                break;
            }
        }
        x
    }
}

/// An encoder.
#[derive(Debug)]
pub struct SimEncoder<'a>(&'a Cell<u16>);

impl spi::ErrorType for SimEncoder<'_> {
    type Error = Infallible;
}

impl SpiDevice for SimEncoder<'_> {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            if let Operation::Read([high, low]) = operation {
                [*high, *low] = self.0.get().to_be_bytes();
            }
        }
        Ok(())
    }
}

/// The PWM channel of a drive.
#[derive(Debug)]
pub struct SimDrive<'a>(&'a Cell<u16>);

impl pwm::ErrorType for SimDrive<'_> {
    type Error = Infallible;
}

impl SetDutyCycle for SimDrive<'_> {
    fn max_duty_cycle(&self) -> u16 {
        MAX_DUTY
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        self.0.set(duty);
        Ok(())
    }
}

/// The pin of the brake.
#[derive(Debug)]
pub struct SimBrake<'a>(&'a Cell<bool>);

impl digital::ErrorType for SimBrake<'_> {
    type Error = Infallible;
}

impl OutputPin for SimBrake<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set(false);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set(true);
        Ok(())
    }
}
