//! Inverse dynamics, gravity, inertia matrix and forward dynamics, without and with a tool.

use core::marker::PhantomData;

use dynamics_core::algorithms::{MassMatrix, NotPositiveDefinite, TorqueGradient};
use dynamics_core::effects::{Effect, Payload};
use dynamics_core::model::Robot;
use dynamics_core::{Core, Engine};

use crate::status::{self, NULL};
use crate::tool::{Anywhere, Tool, With};
use crate::{Exports, Library, State, check, status_of};

/// The trait of functions that two types have, and its implementations.
macro_rules! forms {
    ($($(#[$doc:meta])* $name:ident($($in:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The algorithms of a library that are in two forms: `Engine` is the faster one; beyond
        /// about 12 joints it compiles for minutes, and `Core` takes its place.
        pub trait Form<A, const N: usize> {$(
            $(#[$doc])*
            fn $name($($in: $type,)* effects: &impl Effect<f32, N, N>) -> $result;
        )*}

        forms! { Engine $($name($($in: $type),*) -> $result;)* }
        forms! { Core $($name($($in: $type),*) -> $result;)* }
    };
    ($form:ident $($name:ident($($in:ident: $type:ty),*) -> $result:ty;)*) => {
        impl<A: Robot<N, N, N>, const N: usize> Form<A, N> for $form<A> {$(
            #[inline(always)]
            fn $name($($in: $type,)* effects: &impl Effect<f32, N, N>) -> $result {
                $form::<A>::$name($($in,)* effects)
            }
        )*}
    };
}

forms! {
    /// The inertia matrix.
    crba(q: &[f32; N]) -> MassMatrix<f32, N>;
    /// The derivatives of inverse dynamics.
    rnea_derivatives(state: &State<N>) -> TorqueGradient<f32, N>;
    /// Forward dynamics.
    ///
    /// # Errors
    /// A joint moves no inertia.
    forward_dynamics(
        state: &State<N>, torque: &[f32; N]
    ) -> Result<[f32; N], NotPositiveDefinite>;
}

#[inline(always)]
fn write<const N: usize>(result: [f32; N], output: &mut [f32; N]) -> Result<(), i32> {
    check::results([&result])?;
    *output = result;
    Ok(())
}

#[inline(always)]
fn solved<const N: usize>(
    result: Result<[f32; N], NotPositiveDefinite>,
    output: &mut [f32; N],
) -> Result<(), i32> {
    match result {
        Ok(result) => write(result, output),
        Err(_) => Err(status::NO_INERTIA),
    }
}

#[inline(always)]
fn write_rows<const N: usize>(
    m: &MassMatrix<f32, N>,
    output: &mut [[f32; N]; N],
) -> Result<(), i32> {
    // It is symmetric: half of it says whether all of it is finite.
    let half =
        core::array::from_fn::<_, N, _>(|i| m.row(i).and_then(|row| row.get(..=i)).unwrap_or(&[]));
    check::results(half)?;
    for (i, row) in output.iter_mut().enumerate() {
        *row = m.row(i).copied().unwrap_or([0.0; N]);
    }
    Ok(())
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The torques of a motion.
    pub fn inverse_dynamics(state: Option<&State<N>>, torque: Option<&mut [f32; N]>) -> i32 {
        status_of(|| {
            let (state, torque) = (state.ok_or(NULL)?, torque.ok_or(NULL)?);
            Self::motion(state)?;
            write(Engine::<L::Arm>::rnea(state, L::EFFECTS), torque)
        })
    }

    /// The torques of a motion with a tool.
    pub fn inverse_dynamics_with_tool(
        state: Option<&State<N>>,
        tool: Option<&Tool>,
        torque: Option<&mut [f32; N]>,
    ) -> i32 {
        status_of(|| {
            let (state, tool, torque) =
                (state.ok_or(NULL)?, tool.ok_or(NULL)?, torque.ok_or(NULL)?);
            Self::motion(state)?;
            write(Self::inverse_dynamics_of(state, Some(Self::set_tool(tool)?)), torque)
        })
    }

    /// The torques that hold the robot at a position.
    pub fn gravity(q: Option<&[f32; N]>, torque: Option<&mut [f32; N]>) -> i32 {
        status_of(|| {
            let (q, torque) = (q.ok_or(NULL)?, torque.ok_or(NULL)?);
            Self::positions(q)?;
            write(Engine::<L::Arm>::rnea(&State::at(*q), &L::EFFECTS.0), torque)
        })
    }

    /// The torques that hold the robot and a tool at a position.
    pub fn gravity_with_tool(
        q: Option<&[f32; N]>,
        tool: Option<&Tool>,
        torque: Option<&mut [f32; N]>,
    ) -> i32 {
        status_of(|| {
            let (q, tool, torque) = (q.ok_or(NULL)?, tool.ok_or(NULL)?, torque.ok_or(NULL)?);
            Self::positions(q)?;
            let (tool, at) = (Self::set_tool(tool)?, State::at(*q));
            let result = if tool.is_on(TOOL) {
                Engine::<L::Arm>::rnea(&at, &(tool.gravity(), tool.load::<TOOL>()))
            } else {
                Core::<L::Arm>::rnea(&at, &(tool.gravity(), tool.anywhere()))
            };
            write(result, torque)
        })
    }

    /// ∂τ/∂q and ∂τ/∂q̇ of the torques of a motion, by rows of τ.
    pub fn inverse_dynamics_derivatives(
        state: Option<&State<N>>,
        by_q: Option<&mut [[f32; N]; N]>,
        by_qd: Option<&mut [[f32; N]; N]>,
    ) -> i32 {
        status_of(|| {
            let (state, by_q, by_qd) = (state.ok_or(NULL)?, by_q.ok_or(NULL)?, by_qd.ok_or(NULL)?);
            Self::motion(state)?;
            let by = L::Form::rnea_derivatives(state, L::EFFECTS);
            check::results([by.dq.as_flattened(), by.dqd.as_flattened()])?;
            (*by_q, *by_qd) = (by.dq, by.dqd);
            Ok(())
        })
    }

    /// The inertia matrix, all of its rows.
    pub fn inertia(q: Option<&[f32; N]>, inertia: Option<&mut [[f32; N]; N]>) -> i32 {
        status_of(|| {
            let (q, inertia) = (q.ok_or(NULL)?, inertia.ok_or(NULL)?);
            Self::positions(q)?;
            write_rows(&L::Form::crba(q, L::EFFECTS), inertia)
        })
    }

    /// The inertia matrix with a tool, all of its rows.
    pub fn inertia_with_tool(
        q: Option<&[f32; N]>,
        tool: Option<&Tool>,
        inertia: Option<&mut [[f32; N]; N]>,
    ) -> i32 {
        status_of(|| {
            let (q, tool, inertia) = (q.ok_or(NULL)?, tool.ok_or(NULL)?, inertia.ok_or(NULL)?);
            Self::positions(q)?;
            let tool = Self::set_tool(tool)?;
            let m = if tool.is_on(TOOL) {
                L::Form::crba(q, &Self::usual(tool))
            } else {
                Core::<L::Arm>::crba(q, &Self::anywhere(tool))
            };
            write_rows(&m, inertia)
        })
    }

    /// The accelerations of torques; those in the state are not read.
    pub fn forward_dynamics(
        state: Option<&State<N>>,
        torque: Option<&[f32; N]>,
        acceleration: Option<&mut [f32; N]>,
    ) -> i32 {
        status_of(|| {
            let (state, torque, acceleration) =
                (state.ok_or(NULL)?, torque.ok_or(NULL)?, acceleration.ok_or(NULL)?);
            Self::positions(&state.q)?;
            check::inputs([&state.qd, torque])?;
            solved(L::Form::forward_dynamics(state, torque, L::EFFECTS), acceleration)
        })
    }

    /// The accelerations of torques with a tool; those in the state are not read.
    pub fn forward_dynamics_with_tool(
        state: Option<&State<N>>,
        torque: Option<&[f32; N]>,
        tool: Option<&Tool>,
        acceleration: Option<&mut [f32; N]>,
    ) -> i32 {
        status_of(|| {
            let (state, torque, tool, acceleration) = (
                state.ok_or(NULL)?,
                torque.ok_or(NULL)?,
                tool.ok_or(NULL)?,
                acceleration.ok_or(NULL)?,
            );
            Self::positions(&state.q)?;
            check::inputs([&state.qd, torque])?;
            let tool = Self::set_tool(tool)?;
            let qdd = if tool.is_on(TOOL) {
                L::Form::forward_dynamics(state, torque, &Self::usual(tool))
            } else {
                Core::<L::Arm>::forward_dynamics(state, torque, &Self::anywhere(tool))
            };
            solved(qdd, acceleration)
        })
    }

    /// The torques of a motion, N·m or N, unchecked.
    #[inline(always)]
    pub(crate) fn inverse_dynamics_of(state: &State<N>, tool: Option<&Tool>) -> [f32; N] {
        match tool {
            None => Engine::<L::Arm>::rnea(state, L::EFFECTS),
            Some(tool) if tool.is_on(TOOL) => Engine::<L::Arm>::rnea(state, &Self::usual(tool)),
            Some(tool) => Core::<L::Arm>::rnea(state, &Self::anywhere(tool)),
        }
    }

    /// What acts with a tool on the usual body.
    #[inline(always)]
    pub(crate) fn usual(tool: &Tool) -> With<Self, Payload<f32, TOOL>> {
        let (gravity, load) = (tool.gravity(), tool.load::<TOOL>());
        With { gravity, load, library: PhantomData }
    }

    /// What acts with a tool on any body.
    #[inline(always)]
    pub(crate) fn anywhere(tool: &Tool) -> With<Self, Anywhere> {
        let (gravity, load) = (tool.gravity(), tool.anywhere());
        With { gravity, load, library: PhantomData }
    }

    #[inline(always)]
    pub(crate) fn motion(state: &State<N>) -> Result<(), i32> {
        Self::positions(&state.q)?;
        check::inputs([&state.qd, &state.qdd])
    }
}
