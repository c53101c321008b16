//! Inverse, forward and hybrid dynamics, and the matrices that they need.

use pyo3::prelude::*;
use robot_dynamics_kernels::Which;
use robot_dynamics_kernels::spec::Spec;

use super::given::{differentiable, moving};
use super::{Array, Robot, with_inertia, without_rotors};
use crate::arrays::Argument;
use crate::effects::{RIGID_BODY, with_own};
use crate::methods::{Machine, methods};

impl Robot {
    /// Inverse dynamics of q and as many derivatives as there are more arguments, under those of the
    /// effects that it keeps.
    fn inverse_dynamics<'py, const N: usize>(
        &self,
        py: Python<'py>,
        keeps: fn(&Spec) -> bool,
        effects: Option<&Array<'py>>,
        arguments: [Argument<'_, 'py>; N],
    ) -> PyResult<Array<'py>> {
        let shape: &[&[usize]] = &[&[self.counts.v]];
        if effects.is_none() && N == 3 {
            let which = Which::Rnea { given: 3, still: false };
            return self.one(py, which, &RIGID_BODY, &arguments, shape);
        }
        let scene = with_own(effects)?;
        let mut effects: Vec<Spec> = scene.iter().filter(|spec| keeps(spec)).cloned().collect();
        let mut given = N;
        // Few scenes have machine code of their own. Without Inertia, the acceleration is zero but
        // for motors; without Coriolis, the velocity but for joints.
        let has = |spec| effects.contains(&spec);
        let [inertia, coriolis] = [has(Spec::Inertia), has(Spec::Coriolis)];
        let turns =
            |spec: &Spec| matches!(spec, Spec::Armature { .. } | Spec::GyroscopicRotors { .. });
        let (mut joints, mut still) = (Vec::new(), false);
        if coriolis && !inertia {
            if given < 3 || !effects.iter().any(turns) {
                given = given.min(2);
                effects.push(Spec::Inertia);
            }
        } else if inertia && !coriolis && !effects.iter().any(Spec::is_extra) {
            still = true;
            let whole =
                |spec: &Spec| turns(spec) || matches!(spec, Spec::Gravity(_) | Spec::Inertia);
            (effects, joints) = effects.into_iter().partition(whole);
            effects.push(Spec::Coriolis);
        }
        let which = Which::Rnea { given, still };
        let mut tau = self.one(py, which, &effects, &arguments, shape)?;
        if !joints.is_empty() {
            let which = Which::Rnea { given: 2, still: false };
            tau = tau.add(self.one(py, which, &joints, &arguments, shape)?)?;
        }
        // Gravity has no velocities.
        match if N > 1 { scene.own_torque(py, &arguments)? } else { None } {
            Some(own) => tau.add(own),
            None => Ok(tau),
        }
    }

    /// Forward dynamics of q, q̇ and τ.
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        which: Which<'static>,
        effects: Option<&Array<'py>>,
        arguments: [Argument<'_, 'py>; 3],
    ) -> PyResult<Array<'py>> {
        let scene = with_own(effects)?;
        with_inertia(py, &scene)?;
        let own = scene.own_torque(py, &arguments)?;
        let [q, qd, tau] = arguments;
        let rest = own
            .map(|own| PyModule::import(py, "numpy")?.call_method1("subtract", (tau.given, own)));
        let rest = rest.transpose()?;
        let arguments = [q, qd, self.v("tau", rest.as_ref().unwrap_or(tau.given))];
        self.one(py, which, &scene, &arguments, &[&[self.counts.v]])
    }
}

/// Methods of arrays and effects, with the function that computes them and what it asks for.
macro_rules! dynamics {
    ($($(#[$doc:meta])* $method:ident($($array:ident: $kind:ident),*) = $by:ident($what:expr);)*) => {
        #[pymethods]
        impl Robot {$(
            $(#[$doc])*
            #[pyo3(signature = ($($array,)* effects = None))]
            fn $method<'py>(
                &self,
                py: Python<'py>,
                $($array: &Array<'py>,)*
                effects: Option<&Array<'py>>,
            ) -> PyResult<Array<'py>> {
                self.$by(py, $what, effects, [$(self.$kind(stringify!($array), $array)),*])
            }
        )*}
    };
}

dynamics! {
    /// Inverse dynamics: the torques (…, nv), N·m or N, for q (…, nq), q̇ and q̈ (…, nv). Equations
    /// (3) to (8) of Featherstone and Orin.
    rnea(q: q, qd: v, qdd: v) = inverse_dynamics(|_| true);

    /// The torques (…, nv), N·m or N, at q (…, nq) and q̇ (…, nv) without acceleration: C(q, q̇)
    /// q̇ + g(q) and the other effects.
    bias(q: q, qd: v) = inverse_dynamics(|spec| !matches!(spec, Spec::Inertia));

    /// The torques (…, nv), N·m or N, that hold the robot against gravity at q (…, nq). No other
    /// effects than Gravity and loads act.
    gravity(q: q) = inverse_dynamics(|spec| matches!(spec, Spec::Gravity(_) | Spec::Payload { .. }));

    /// Forward dynamics by articulated bodies: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ
    /// (…, nv).
    aba(q: q, qd: v, tau: v) = accelerations(Which::Aba);

    /// Forward dynamics by M and its factors: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ
    /// (…, nv).
    forward_dynamics(q: q, qd: v, tau: v) = accelerations(Which::ForwardDynamics);
}

methods! {
    Robot, robot => (v, nq, bodies) = (robot.counts.v, robot.counts.q, robot.counts.bodies);

    /// Inverse dynamics with the wrenches in joints: the torques (…, nv), N·m or N, and the wrench
    /// that the parent exerts on each body through its joint, (…, bodies, 6), couple and force,
    /// N·m and N, in the body's own frame; q (…, nq), q̇ and q̈ (…, nv). That of a body beyond a
    /// force sensor is what the sensor shows, but for its offset.
    rnea_and_wrenches(q: q, qd: v, qdd: v; under effects moving) = several(RneaAndWrenches): [v], [bodies, 6];

    /// The derivatives of inverse dynamics, ∂τ/∂q and ∂τ/∂q̇, each (…, nv, nv), by rows of τ: N·m/rad
    /// and N·m·s/rad between revolute joints, N/m and N·s/m between prismatic ones; q (…, nq), q̇
    /// and q̈ (…, nv). ∂τ/∂q is along `integrate`; ∂τ/∂q̈ is `crba`. `Lugre`, wrenches, rotors that
    /// spin and friction of gears have no place.
    rnea_derivatives(q: q, qd: v, qdd: v; under effects differentiable) = several(RneaDerivatives): [v, v], [v, v];

    /// The derivatives of forward dynamics, ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ = M⁻¹, each (…, nv, nv), by
    /// rows of q̈: 1/s², 1/s and 1/(kg·m²) between revolute joints; q (…, nq), q̇ and τ (…, nv). As
    /// `rnea_derivatives`.
    forward_dynamics_derivatives(q: q, qd: v, tau: v; under effects differentiable) = several(ForwardDynamicsDerivatives): [v, v], [v, v], [v, v];

    /// M q̈_r + C(q, q̇) q̇_r + g and the other effects, (…, nv): q (…, nq), q̇, q̈_r and q̇_r (…,
    /// nv).
    rnea_two_velocities(q: q, qd: v, qdd: v, qd_r: v; under effects) = one(RneaTwoVelocities): [v];

    /// M(q), the joint-space inertia matrix (…, nv, nv), kg·m² or kg, with the motors' `Armature`;
    /// q (…, nq).
    crba(q: q; under effects) = one(Crba): [v, v];

    /// Forward dynamics by M and its factors, with the error that rounding leaves: q̈ and its
    /// estimated error, each (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ (…, nv). It says
    /// whether float32 serves for a robot and a state.
    forward_dynamics_with_error(q: q, qd: v, tau: v; under effects with_inertia) = several(ForwardWithError): [v], [v];

    /// Torques and accelerations, each (…, nv), where of each coordinate one is given: its torque,
    /// or, where ``accelerated`` is not zero, its acceleration. q (…, nq), q̇, given and
    /// accelerated (…, nv).
    hybrid_dynamics(q: q, qd: v, given: v, accelerated: v; under effects moving) = several(Hybrid): [v], [v];

    /// The part of the motors' torques τ (…, nv) that arrives behind the friction of the gears
    /// (`LoadFriction`), (…, nv).
    transmitted_torque(q: q, qd: v, tau: v; under effects) = one(Transmitted): [v];

    /// C(q, q̇) (…, nv, nv), of Christoffel's symbols; q (…, nq), q̇ (…, nv).
    coriolis_matrix(q: q, qd: v; under effects) = one(CoriolisMatrix): [v, v];

    /// J (…, 6, nv), J M⁻¹ (…, 6, nv), Λ⁻¹ and Λ (…, 6, 6) of a body, Λ damped by ``damping``
    /// relative to the largest eigenvalue of Λ⁻¹ where it is nearly singular; q (…, nq).
    operational_space(q: q; at body, frame; under effects; with damping: f64 = 1e-6) = several(OperationalSpaceOf { body, frame, damping }): [6, v], [6, v], [6, 6], [6, 6];

    /// Λ⁻¹ = J M⁻¹ Jᵀ of a body, (…, 6, 6), by propagation of forces; q (…, nq).
    osim_inverse(q: q; at body, frame; under effects without_rotors) = one(OsimInverse { body, frame }): [6, 6];
}
