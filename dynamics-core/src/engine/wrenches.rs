//! Inverse dynamics with the wrenches in the joints of some bodies.

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::acceleration_field::Wrench;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, CompiledRobot};
use super::reaction::{Reactions, Wrenches};
use super::rnea::Task;
use super::{Engine, loaded_again};
use crate::algorithms::TorquesAndWrenches;
use crate::effects::{Declared, Effect};
use crate::model::{BASE, Bodies, JointCoordinate, Robot};
use crate::scalar::Real;
use crate::spatial::Force;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The recursion of inverse dynamics, which also keeps the wrenches of some bodies; `tau` holds
    /// zeros.
    #[cfg_attr(optimised, inline(always))]
    fn write_torques_and<List: Bodies<N>, const N: usize>(
        self,
        back: &[JointCoordinate<R>; Q],
        state: &State<R, Q, V>,
        tau: &mut [R; V],
        seen: &mut Wrenches<R, List, N>,
    ) {
        let (base, mut carried) = (self.base(), [Wrench::ZERO; N]);
        let mut task = Task { call: self, back, state, tau, seen };
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            visit = Task::visit::<J> as fn(&mut _, &_) -> Wrench<R>,
            {
                let returned = visit(&mut task, &base);
                <&mut Wrenches<R, List, N> as Reactions<R, T>>::add::<J>(&mut carried, &returned);
            }
        );
        task.seen.keep::<E, BASE, B, Q, V>(self, &base, &Wrench::ZERO, &carried, None);
    }
}

impl<T, K> Engine<T, K> {
    /// The torques of [`Engine::rnea`] and, beside them, the wrenches fᵢ in the joints of some
    /// bodies: what the parent exerts on body i through its joint, N·m and N, in the body's own
    /// frame and about its origin, as [`crate::algorithms::rnea_and_wrenches`] computes it.
    ///
    /// A force sensor in a link is a fixed joint of the description, whose body is all that is
    /// beyond it: its fᵢ is the prediction of the sensor under every effect of the scene, to be
    /// subtracted from the measurement. Other bodies add nothing to the machine code. A body that
    /// the robot does not have does not compile; nor does a scene with
    /// [`BaseParameters`](crate::effects::BaseParameters), of which no wrench follows.
    ///
    /// # Shape
    /// V, and N wrenches in the order of the list.
    ///
    /// # Cost
    /// Some 60 cycles of a Cortex-M4F for a last body, on top of [`Engine::rnea`]; the same
    /// instructions for all data.
    ///
    /// # Source
    /// Featherstone & Orin (2000), (3) to (8), over base parameters and those that they lack.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Core, Engine, effects::RIGID_BODY, model::{OnBody, Robot}, robots::Ur5e, state::State};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let state = State { q: [0.1_f64; 6], qd: [0.5; 6], qdd: [1.0; 6] };
    /// let one = Engine::<Ur5e>::rnea_and_wrenches(&state, &RIGID_BODY, OnBody::<WRIST>);
    /// let all = Core::<Ur5e>::rnea_and_wrenches(&state, &RIGID_BODY);
    /// assert!((one.wrenches[0].lin - all.wrenches[WRIST].lin).length() < 1e-13);
    /// ```
    #[doc(alias = "reaction wrench")]
    #[doc(alias = "force sensor")]
    #[inline(never)]
    #[must_use]
    pub fn rnea_and_wrenches<
        R: Real,
        E,
        List,
        const N: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        bodies: List,
    ) -> TorquesAndWrenches<R, V, N>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
        List: Bodies<N>,
    {
        scene_is_taken!();
        const {
            assert!(
                E::BASE_PARAMETERS == 0,
                "wrenches in joints do not follow from base parameters"
            );
        }
        let _ = bodies;
        let trig = state.configuration().trig_or(Self::trig_source());
        let trig = trig.borrow();
        let mut kept = Wrenches::<R, List, N>([Force::ZERO; N], PhantomData);
        let mut tau = const { [R::ZERO; V] };
        let call: Call<'_, R, CompiledRobot<T, B, Q, V>, _, B, Q, V> = Self::call(trig, effects);
        let back = loaded_again(&state, trig);
        call.write_torques_and(&back.coordinates, state.state(), &mut tau, &mut kept);
        TorquesAndWrenches { tau, wrenches: kept.0 }
    }
}
