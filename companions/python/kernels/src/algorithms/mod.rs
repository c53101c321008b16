//! The library's algorithms over rows of numbers.

use dynamics_core::algorithms::frame::AnyFrame;
use dynamics_core::algorithms::{
    self, Damping, MassMatrix, OperationalSpace, Pose, Prescribed, jacobian_rows,
};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;

use crate::algorithm::{Algorithm, Call, Done, Sizes};
use crate::dispatch::terms;
use crate::job::{Problem, Row, Rows};
use crate::lanes::Lanes;
use crate::model::Counts;
use crate::scene::{Parts, Scene, Terms};

/// An algorithm: which scenes it distinguishes, what it reads and what it writes.
macro_rules! algorithm {
    (@blocks Rnea, $this:ident, $call:ident) => { terms::blocks_all($this, $call) };
    (@blocks Crba, $this:ident, $call:ident) => { terms::blocks($this, $call) };
    (@blocks Aba, $this:ident, $call:ident) => { terms::blocks($this, $call) };
    (@blocks $other:ident, $this:ident, $call:ident) => {{
        let _ = ($this, $call);
        unreachable!("it does not compute several states at once")
    }};
    (@lanes Rnea) => { true };
    (@lanes Crba) => { true };
    (@lanes Aba) => { true };
    (@lanes $other:ident) => { false };
    (@whole LoopForward machine) => { true };
    (@whole $other:ident bending) => { true };
    (@whole $other:ident $scenes:ident) => { false };
    (@sizes $name:ident all) => { Sizes::Both };
    (@sizes $name:ident articulated) => { Sizes::Both };
    (@sizes $name:ident matrix) => { Sizes::Both };
    (@sizes Jacobian none) => { Sizes::Both };
    (@sizes Poses none) => { Sizes::Both };
    (@sizes RneaDerivatives machine) => { Sizes::Both };
    (@sizes $name:ident bending) => { Sizes::Small };
    (@sizes $name:ident $other:ident) => { Sizes::Large };
    (@spins linked) => { false };
    (@spins machine) => { false };
    (@spins bending) => { false };
    (@spins $other:ident) => { true };
    (@fast all) => { true };
    (@fast moving) => { true };
    (@fast articulated) => { true };
    (@fast estimated) => { true };
    (@fast matrix) => { true };
    (@fast factored) => { true };
    (@fast linked) => { true };
    (@fast $other:ident) => { false };
    (@fits all, $terms:ident) => { $terms.inertia == $terms.coriolis };
    (@fits moving, $terms:ident) => { $terms.coriolis };
    (@fits estimated, $terms:ident) => { $terms.coriolis };
    (@fits $other:ident, $terms:ident) => {{ let _ = $terms; true }};
    (@terms_alone Regressor) => { true };
    (@terms_alone RegressorRow) => { true };
    (@terms_alone $other:ident) => { false };
    ($(#[$doc:meta])* $name:ident $(<$life:lifetime>)? $({ $($field:ident: $type:ty),* })?, $scenes:ident,
     |$this:ident, $robot:ident, $counts:ident, $scene:ident, $row:ident| $body:expr) => {
        $(#[$doc])*
        pub struct $name $(<$life>)? { $($(#[doc = stringify!($field)] pub $field: $type),*)? }
        impl $(<$life>)? Algorithm for $name $(<$life>)? {
            const FAST: bool = algorithm!(@fast $scenes);
            const WHOLE: bool = algorithm!(@whole $name $scenes);
            const SIZES: Sizes = algorithm!(@sizes $name $scenes);
            const LANES: bool = algorithm!(@lanes $name);
            const TERMS_ALONE: bool = algorithm!(@terms_alone $name);

            fn fits(terms: Terms) -> bool {
                algorithm!(@fits $scenes, terms)
            }

            #[inline(always)]
            fn row<
                R: Real,
                D: RobotModel<R, B, Q, V>,
                const B: usize,
                const Q: usize,
                const V: usize,
                const A: bool,
                const C: bool,
                const X: bool,
            >(
                &self,
                $robot: &D,
                $counts: Counts,
                parts: &Parts<R, V>,
                $row: &mut impl Row<R>,
            ) -> Result<(), Problem> {
                let $this = self;
                let $scene = &Scene::<R, V, A, C, X, { algorithm!(@spins $scenes) }>(parts, true);
                let _ = ($this, $robot, $counts, $scene);
                $body
                Ok(())
            }

            fn all<R: Real, D, P, const B: usize, const Q: usize, const V: usize>(
                &self,
                call: Call<'_, D, P, R, V>,
            ) -> Done
            where
                D: RobotModel<R, B, Q, V>,
                P: Rows<R>,
            {
                terms::$scenes(self, call)
            }

            fn blocks<D, P, const B: usize, const Q: usize, const V: usize>(
                &self,
                call: Call<'_, D, P, Lanes, V>,
            ) -> Done
            where
                D: RobotModel<Lanes, B, Q, V>,
                P: Rows<Lanes>,
            {
                algorithm!(@blocks $name, self, call)
            }
        }
    };
}

/// q of a row, with zeros beyond the robot's.
#[inline(always)]
fn filled<R: Real, const N: usize>(row: &impl Row<R>, input: usize, count: usize) -> [R; N] {
    let mut values = [R::ZERO; N];
    for (column, value) in values.iter_mut().enumerate().take(count) {
        *value = row.get(input, column);
    }
    values
}

/// q, q̇ and q̈ of a row, of which it has so many.
#[inline(always)]
fn state<R: Real, const Q: usize, const V: usize>(
    row: &impl Row<R>,
    counts: Counts,
    given: usize,
) -> State<R, Q, V> {
    let mut state = State::at(filled(row, 0, counts.q));
    if given > 1 {
        state.qd = filled(row, 1, counts.v);
    }
    if given > 2 {
        state.qdd = filled(row, 2, counts.v);
    }
    state
}

#[inline(always)]
fn put<R: Real>(row: &mut impl Row<R>, output: usize, at: usize, values: &[R]) {
    for (column, &value) in values.iter().enumerate() {
        row.put(output, at + column, value);
    }
}

#[inline(always)]
fn six<R: Real>(ang: R::Vec3, lin: R::Vec3) -> [R; 6] {
    let ([a, b, c], [d, e, f]) = (ang.array(), lin.array());
    [a, b, c, d, e, f]
}

/// Six rows of as many columns as the robot has velocity coordinates.
#[inline(always)]
fn put_rows<R: Real>(row: &mut impl Row<R>, output: usize, rows: &[impl AsRef<[R]>], count: usize) {
    for (i, values) in rows.iter().enumerate() {
        put(row, output, i * count, &values.as_ref()[..count]);
    }
}

#[inline(always)]
fn put_matrix<R: Real, const V: usize>(
    row: &mut impl Row<R>,
    output: usize,
    m: &MassMatrix<R, V>,
    count: usize,
) {
    for i in 0..count {
        for j in 0..count {
            row.put(output, i * count + j, m.get(i, j));
        }
    }
}

/// The inertia of what fills the model up: 1.
#[inline(always)]
fn fillers<R: Real, const V: usize>(counts: Counts) -> [R; V] {
    std::array::from_fn(|i| if i < counts.v { R::ZERO } else { R::ONE })
}

// Parts of several algorithms are compiled once.

/// The torques of all effects but those of accelerations, with the friction of gears or without.
#[inline(never)]
fn bias<
    R: Real,
    D: RobotModel<R, B, Q, V>,
    const B: usize,
    const Q: usize,
    const V: usize,
    const C: bool,
    const X: bool,
>(
    robot: &D,
    state: &State<R, Q, V>,
    (parts, gears): (&Parts<R, V>, bool),
) -> [R; V] {
    algorithms::rnea(robot, state, &Scene::<R, V, false, C, X, true>(parts, gears))
}

/// The inertia matrix M.
#[inline(never)]
fn inertia<
    R: Real,
    D: RobotModel<R, B, Q, V>,
    const B: usize,
    const Q: usize,
    const V: usize,
    const X: bool,
>(
    robot: &D,
    q: &[R; Q],
    parts: &Parts<R, V>,
) -> MassMatrix<R, V> {
    algorithms::crba(robot, q, &Scene::<R, V, true, true, X, true>(parts, true))
}

/// The columns of the Jacobian of a body.
#[inline(never)]
fn columns<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &[R; Q],
    (body, frame): (usize, AnyFrame),
) -> [Motion<R>; V]
where
    D: RobotModel<R, B, Q, V>,
{
    algorithms::jacobian(robot, q, body, frame)
}

/// The factors of the inertia matrix M.
#[inline(never)]
fn factors<
    R: Real,
    D: RobotModel<R, B, Q, V>,
    const B: usize,
    const Q: usize,
    const V: usize,
    const X: bool,
>(
    robot: &D,
    q: &[R; Q],
    parts: &Parts<R, V>,
    counts: Counts,
) -> Result<algorithms::Ltdl<R, V>, Problem> {
    let m = inertia::<R, D, B, Q, V, X>(robot, q, parts);
    // x + 0 would change the sign of no pivot; the robot's own diagonal stays as it is.
    Ok(algorithms::ltdl(robot, &m.plus_diagonal(&fillers(counts)))?)
}

mod derivatives;
mod drivetrain;
mod factors;
mod flexible;
mod linkages;
mod loops;
mod manifold;
mod regressors;

pub use derivatives::*;
pub use drivetrain::*;
pub use factors::*;
pub use flexible::*;
pub use linkages::*;
pub use loops::*;
pub use manifold::*;
pub use regressors::*;

algorithm! {
    /// τ of so many of q, q̇ and q̈, or of q and q̈ at rest.
    Rnea { given: usize, still: bool }, all, |this, robot, counts, scene, row| {
        let mut state = state(row, counts, this.given);
        if this.still {
            state.qd = [R::ZERO; V];
        }
        let tau = if const { !A && C } {
            bias::<R, D, B, Q, V, C, X>(robot, &state, (parts_of(scene), true))
        } else {
            algorithms::rnea(robot, &state, scene)
        };
        put(row, 0, 0, &tau[..counts.v]);
    }
}

algorithm! {
    /// τ of q, q̇ and q̈, and the wrenches in the joints of all bodies.
    RneaAndWrenches, rigid, |this, robot, counts, scene, row| {
        let found = algorithms::rnea_and_wrenches(robot, &state(row, counts, 3), scene);
        put(row, 0, 0, &found.tau[..counts.v]);
        for (i, f) in found.wrenches[..counts.bodies].iter().enumerate() {
            put(row, 1, 6 * i, &six::<R>(f.ang, f.lin));
        }
    }
}

algorithm! {
    /// M q̈_r + C q̇_r + g + F of q, q̇, q̈_r and q̇_r.
    RneaTwoVelocities, rigid, |this, robot, counts, scene, row| {
        let (state, qd_r) = (state(row, counts, 3), filled(row, 3, counts.v));
        let tau = algorithms::rnea_two_velocities(robot, &state, &qd_r, scene);
        put(row, 0, 0, &tau[..counts.v]);
    }
}

algorithm! {
    /// The inertia matrix M(q).
    Crba, matrix, |this, robot, counts, scene, row| {
        let q = filled(row, 0, counts.q);
        let m = inertia::<R, D, B, Q, V, X>(robot, &q, parts_of(scene));
        put_matrix(row, 0, &m, counts.v);
    }
}

algorithm! {
    /// q̈ of q, q̇ and τ, by articulated bodies.
    Aba, articulated, |this, robot, counts, scene, row| {
        let (state, tau) = (state(row, counts, 2), filled(row, 2, counts.v));
        let qdd = algorithms::aba(robot, &state, &tau, scene)?;
        put(row, 0, 0, &qdd[..counts.v]);
    }
}

algorithm! {
    /// q̈ of q, q̇ and τ, by M and its factors.
    ForwardDynamics, moving, |this, robot, counts, scene, row| {
        let (state, tau) = (state(row, counts, 2), filled(row, 2, counts.v));
        let parts = parts_of(scene);
        let bias = bias::<R, D, B, Q, V, C, X>(robot, &state, (parts, false));
        let mut rest = algorithms::transmitted_torque(robot, &state, &tau, scene);
        for (rest, bias) in rest.iter_mut().zip(bias) {
            *rest -= bias;
        }
        let factors = factors::<R, D, B, Q, V, X>(robot, &state.q, parts, counts)?;
        let qdd = algorithms::solve(robot, &factors, &rest);
        put(row, 0, 0, &qdd[..counts.v]);
    }
}

algorithm! {
    /// τ and q̈ of q, q̇, what is given of each coordinate, and whether that is its acceleration.
    Hybrid, rigid, |this, robot, counts, scene, row| {
        let state = state(row, counts, 2);
        let (values, kinds) = (filled::<R, V>(row, 2, counts.v), filled::<R, V>(row, 3, counts.v));
        let given = std::array::from_fn(|i| match kinds[i] == R::ZERO {
            true => Prescribed::Torque(values[i]),
            false if kinds[i].is_finite() => Prescribed::Acceleration(values[i]),
            false => Prescribed::Acceleration(R::from_f64(f64::NAN)),
        });
        let found = algorithms::hybrid_dynamics(robot, &state, &given, scene);
        let found = found?;
        put(row, 0, 0, &found.tau[..counts.v]);
        put(row, 1, 0, &found.qdd[..counts.v]);
    }
}

algorithm! {
    /// τ behind the friction of gears, of q, q̇ and the motors' τ.
    Transmitted, rigid, |this, robot, counts, scene, row| {
        let (state, tau) = (state(row, counts, 2), filled(row, 2, counts.v));
        let found = algorithms::transmitted_torque(robot, &state, &tau, scene);
        put(row, 0, 0, &found[..counts.v]);
    }
}

algorithm! {
    /// J of a body: three rows of angular, three of linear velocity.
    Jacobian { body: usize, frame: AnyFrame }, none, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let columns = columns(robot, &q, (this.body, this.frame));
        put_rows(row, 0, &jacobian_rows(&columns), counts.v);
    }
}

algorithm! {
    /// J̇ q̇ of a body.
    BiasAcceleration { body: usize, frame: AnyFrame }, none, |this, robot, counts, scene, row| {
        let state = state(row, counts, 2);
        let a = algorithms::bias_acceleration(robot, &state, this.body, this.frame);
        put(row, 0, 0, &six::<R>(a.ang, a.lin));
    }
}

algorithm! {
    /// Rotation matrices and positions of the bodies.
    Poses, none, |this, robot, counts, scene, row| {
        let poses = algorithms::poses(robot, &filled::<R, Q>(row, 0, counts.q));
        for (i, Pose { rot, pos }) in poses.iter().enumerate().take(counts.bodies) {
            let [x, y, z] = rot.cols().map(|column| column.array());
            for k in 0..3 {
                put(row, 0, 9 * i + 3 * k, &[x[k], y[k], z[k]]);
            }
            put(row, 1, 3 * i, &pos.array());
        }
    }
}

algorithm! {
    /// Velocities and accelerations of the bodies.
    Kinematics { frame: AnyFrame }, rigid, |this, robot, counts, scene, row| {
        let state = state(row, counts, 3);
        let found = algorithms::kinematics(robot, &state, scene);
        for i in 0..counts.bodies {
            let (v, a) = (found.velocity(i, this.frame), found.acceleration(i, this.frame));
            put(row, 0, 6 * i, &six::<R>(v.ang, v.lin));
            put(row, 1, 6 * i, &six::<R>(a.ang, a.lin));
        }
    }
}

algorithm! {
    /// The kinetic energy T.
    KineticEnergy, rigid, |this, robot, counts, scene, row| {
        let energy = algorithms::kinetic_energy(robot, &state(row, counts, 2), scene);
        row.put(0, 0, energy);
    }
}

algorithm! {
    /// The potential energy U.
    PotentialEnergy, rigid, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let energy = algorithms::potential_energy(robot, &q, scene);
        row.put(0, 0, energy);
    }
}

algorithm! {
    /// The momentum of all bodies about the base's origin.
    Momentum, rigid, |this, robot, counts, scene, row| {
        let h = algorithms::momentum(robot, &state(row, counts, 2), scene);
        put(row, 0, 0, &six::<R>(h.ang, h.lin));
    }
}

algorithm! {
    /// The momentum of all bodies about their centre of mass.
    CentroidalMomentum, rigid, |this, robot, counts, scene, row| {
        let h = algorithms::centroidal_momentum(robot, &state(row, counts, 2), scene);
        put(row, 0, 0, &six::<R>(h.ang, h.lin));
    }
}

algorithm! {
    /// The matrix from q̇ to that momentum.
    CentroidalMatrix, machine, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let columns = algorithms::centroidal_matrix(robot, &q, scene);
        for (j, h) in columns.iter().enumerate().take(counts.v) {
            for (i, x) in six::<R>(h.ang, h.lin).into_iter().enumerate() {
                row.put(0, i * counts.v + j, x);
            }
        }
    }
}

algorithm! {
    /// Mass, position and velocity of the centre of mass.
    CenterOfMass, rigid, |this, robot, counts, scene, row| {
        let found = algorithms::center_of_mass(robot, &state(row, counts, 2), scene);
        row.put(0, 0, found.mass);
        put(row, 1, 0, &found.position.array());
        put(row, 2, 0, &found.velocity.array());
    }
}

algorithm! {
    /// p = M q̇ and Cᵀ q̇.
    MomentumAndCoriolis, rigid, |this, robot, counts, scene, row| {
        let found = algorithms::momentum_and_coriolis(robot, &state(row, counts, 2), scene);
        put(row, 0, 0, &found.p[..counts.v]);
        put(row, 1, 0, &found.ct_qd[..counts.v]);
    }
}

algorithm! {
    /// p = M q̇ and β = Cᵀ q̇ − g − F.
    MomentumAndDrift, rigid, |this, robot, counts, scene, row| {
        let found = algorithms::momentum_and_drift(robot, &state(row, counts, 2), scene);
        put(row, 0, 0, &found.p[..counts.v]);
        put(row, 1, 0, &found.beta[..counts.v]);
    }
}

algorithm! {
    /// The Coriolis matrix C(q, q̇).
    CoriolisMatrix, rigid, |this, robot, counts, scene, row| {
        let c = algorithms::coriolis_matrix(robot, &state(row, counts, 2), scene);
        put_rows(row, 0, &c[..counts.v], counts.v);
    }
}

algorithm! {
    /// The velocities of the base for which the momentum of all bodies is what is given.
    BaseVelocity, rigid, |this, robot, counts, scene, row| {
        let [a, b, c, d, e, f] = filled::<R, 6>(row, 2, 6);
        let h = Force::new(R::Vec3::new(a, b, c), R::Vec3::new(d, e, f));
        let state = state(row, counts, 2);
        let found = algorithms::base_velocity_from_momentum(robot, &state, h, scene);
        put(row, 0, 0, &found?[..counts.v]);
    }
}

algorithm! {
    /// The inverse Λ⁻¹ of the operational-space inertia of a body.
    OsimInverse { body: usize, frame: AnyFrame }, machine, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let found = algorithms::osim_inverse(robot, &q, this.body, this.frame, scene)?;
        for j in 0..6 {
            let unit: [R; 6] = std::array::from_fn(|i| if i == j { R::ONE } else { R::ZERO });
            let [a, b, c, d, e, f] = unit;
            let a: Motion<R> = found * Force::new(R::Vec3::new(a, b, c), R::Vec3::new(d, e, f));
            for (i, x) in six::<R>(a.ang, a.lin).into_iter().enumerate() {
                row.put(0, 6 * i + j, x);
            }
        }
    }
}

algorithm! {
    /// J, M⁻¹ Jᵀ, Λ⁻¹ and Λ of a body, damped near singular configurations.
    OperationalSpaceOf { body: usize, frame: AnyFrame, damping: f64 }, rigid,
    |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let columns = columns(robot, &q, (this.body, this.frame));
        let factors = factors::<R, D, B, Q, V, X>(robot, &q, parts_of(scene), counts)?;
        let damping = Damping::relative(R::from_f64(this.damping));
        let solve = |tau: &[R; V]| algorithms::solve(robot, &factors, tau);
        let found = OperationalSpace::new(jacobian_rows(&columns), solve, damping);
        put_rows(row, 0, &found.jacobian, counts.v);
        put_rows(row, 1, &found.response, counts.v);
        put_rows(row, 2, &found.mobility, 6);
        put_rows(row, 3, &found.inertia, 6);
    }
}

fn parts_of<
    'a,
    R: Real,
    const V: usize,
    const A: bool,
    const C: bool,
    const X: bool,
    const S: bool,
>(
    scene: &Scene<'a, R, V, A, C, X, S>,
) -> &'a Parts<R, V> {
    scene.0
}
