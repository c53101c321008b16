//! Kinematic loops of closed form as clusters of joints: a robot with four-bars, parallel ankles or
//! differentials.
//!
//! A loop whose position is a function q = γ(y) of independent coordinates y becomes one joint of
//! several bodies, a
//! [`Cluster`]: q̇ = G ẏ, q̈ = G ÿ + Ġ ẏ, τ_y = Gᵀ τ. The robot is described by its spanning tree, a
//! [`Robot`](crate::model::Robot) like any other, and by which of the tree's coordinates each
//! cluster drives, a [`ClusteredRobot`]. [`Clustered`] has the algorithms, of core and engine:
//!
//! ```
//! use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Driven, FourBar};
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
//! use dynamics_core::{Engine, effects::RIGID_BODY, state::State};
//!
//! /// A shank on a four-bar knee, and the crank that drives it.
//! struct Knee;
//!
//! impl Robot<3, 3, 3> for Knee {
//!     const MODEL: ArmModel<f64, 3> = Model::new("knee", [
//!         Body::new("crank", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(0.1).com([0.02, 0.0, 0.0]),
//!         Body::new("rod", 0, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.05, 0.0, 0.0]).mass(0.1)
//!             .com([0.1, 0.0, 0.0]),
//!         Body::new("shank", BASE, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.2, 0.0, 0.0]).mass(1.0)
//!             .com([0.0, -0.2, 0.0]),
//!     ]);
//! }
//!
//! impl ClusteredRobot<3, 3, 3, 1, 1> for Knee {
//!     type Clusters = (Driven<FourBar, 3, 1>,);
//!     const CLUSTERS: Self::Clusters = (Driven::new("knee", FourBar::new(0.2, 0.05, 0.2, 0.06, Branch::Positive)),);
//!     const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
//! }
//!
//! let bent = State { q: [1.0_f32], qd: [2.0], qdd: [10.0] }; // the crank's
//! let [tau] = Clustered::<Engine<Knee>>::rnea(&bent, &RIGID_BODY)?; // N·m at the crank
//! assert!(tau.is_finite());
//! # Ok::<(), dynamics_core::clusters::ClusterError>(())
//! ```
//!
//! | linkage | M, N | y |
//! |---|---|---|
//! | [`FourBar`] | 3, 1 | the crank |
//! | [`FiveBar`] | 4, 2 | both cranks |
//! | [`Differential`] | 2, 2 | both motors |
//! | [`Belt`] | 2, 1 | the driving pulley |
//! | [`ParallelAnkle`] | 8, 2 | pitch and roll |
//! | [`Delta`] | 12, 3 | the cranks |
//! | [`Stewart`] | 24, 6 | the platform's position and attitude |
//! | [`Transmission`](crate::drivetrain::Transmission) | its V, its M | its motors |
//!
//! Motors at other coordinates of a linkage than y are those of [`Driven::actuated`];
//! [`Clustered::rnea_of_motors`] and [`TreeMotion::to_motors`] have their torques,
//! [`Clustered::motors`] their motion.
//!
//! Every other algorithm works on the tree: [`Clustered::motion`] gives the tree's state with its
//! sines and cosines, which every algorithm of [`Core`](crate::Core) and [`Engine`](crate::Engine)
//! accepts, and the maps of torques, M and Jacobians to y.

mod aba;
mod articulated;
mod cluster;
mod clustered;
mod description;
mod forward_dynamics;
mod inward;
mod layout;
mod linkages;
mod motor_motion;
mod motor_torques;
mod motors;
mod passes;
mod places;
mod set;
mod status;
mod stiffness;
mod tree_motion;

pub use aba::ForwardError;
pub use cluster::{Cluster, ClusterError, ClusterMotion, ClusterProblem};
pub use clustered::{Clustered, TreeAlgorithms};
pub use description::{ClusterSet, ClusteredRobot, DEAD_POINT, Driven};
pub use linkages::{
    Belt, Branch, Delta, Differential, FiveBar, FourBar, Leg, ParallelAnkle, Rod, Stewart,
};
pub use motor_torques::MotorTorques;
pub use status::{ClusteredTorque, Conditioning, NEAR_SINGULAR, NearSingular};
pub use tree_motion::TreeMotion;
