//! Inverse dynamics with clusters that says how close y is to a singular configuration.
//!
//! There G, the rates of the tree's joints per rate of y, grows without bound, and with it the
//! torques: a torque of 10¹¹ N·m may be right, but no motor has it, and rounding errors grow with
//! the square of G. The status is computed from the G of the motion, by whoever asks:
//! [`Clustered::rnea`] has no instruction more.

use core::fmt;

use super::clustered::evaluate;
use super::description::sealed::Set;
use super::{ClusterError, Clustered, ClusteredRobot, TreeAlgorithms, TreeMotion};
use crate::effects::{Effect, no_load_friction};
use crate::scalar::Real;
use crate::state::State;

/// The rates of a tree's joints per rate of y beyond which [`ClusteredTorque::regular`] refuses by
/// default.
///
/// Linkages at work have up to some ten, and the reciprocal is [`DEAD_POINT`](super::DEAD_POINT),
/// that of motors. In f32 the damping of the linkages begins at some 60, in f64 at 30,000.
pub const NEAR_SINGULAR: f64 = 100.0;

/// The motion of the clusters' joints with y.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Conditioning<R> {
    /// The cluster with the fastest joint, relative to y.
    pub cluster: &'static str,
    /// The largest |∂q/∂y| of its joints, with a metre counted like a radian. It is constant for
    /// gears and belts; for linkages it grows without bound towards a singular configuration,
    /// unless G is damped there.
    pub transmission: R,
    /// The first cluster that is at a singularity, where G is damped and the tree's velocities do
    /// not close the loop.
    pub singular: Option<&'static str>,
}

/// The torques at y, and how close y is to a singular configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClusteredTorque<R, const Y: usize> {
    /// The torque of each coordinate of y, N·m or N.
    pub tau: [R; Y],
    /// The motion of the clusters' joints.
    pub conditioning: Conditioning<R>,
}

/// A cluster is so close to a singular configuration that its torques are of no use.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct NearSingular {
    /// The cluster's name.
    pub cluster: &'static str,
    /// The largest rate of the joints of all clusters per rate of y.
    pub transmission: f64,
    /// Whether G is damped.
    pub damped: bool,
}

impl fmt::Display for NearSingular {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cluster, transmission, damped } = self;
        if *damped {
            return write!(
                out,
                "cluster `{cluster}` is at a singular configuration: its rates are damped and do \
                 not close the loop"
            );
        }
        write!(
            out,
            "cluster `{cluster}` is near a singular configuration: a joint moves \
             {transmission:.1e} times as fast as y"
        )
    }
}

impl core::error::Error for NearSingular {}

impl<R: Real, const Y: usize> ClusteredTorque<R, Y> {
    /// The torques, if no cluster is damped, and no joint of one is more than `most` times as fast
    /// as y: such as [`NEAR_SINGULAR`], times the ratio of a gear.
    ///
    /// # Errors
    /// [`NearSingular`] names the cluster.
    pub fn regular(&self, most: R) -> Result<[R; Y], NearSingular> {
        let Conditioning { cluster, transmission, singular } = self.conditioning;
        // False of a NaN, too.
        if singular.is_none() && transmission <= most {
            return Ok(self.tau);
        }
        Err(NearSingular {
            cluster: singular.unwrap_or(cluster),
            transmission: transmission.to_f64(),
            damped: singular.is_some(),
        })
    }
}

impl<A> Clustered<A> {
    /// [`Clustered::rnea`] and how close y is to a singular configuration, where its torques grow
    /// without bound.
    ///
    /// # Cost
    /// The cost of [`Clustered::rnea`], and a comparison for each entry of G.
    ///
    /// # Errors
    /// As [`Clustered::rnea`].
    ///
    /// # Example
    /// ```
    /// # use dynamics_core::clusters::{Branch, Clustered, ClusteredRobot, Driven, FourBar, NEAR_SINGULAR};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
    /// use dynamics_core::{Core, effects::RIGID_BODY, state::State};
    /// # struct Knee;
    /// # impl Robot<3, 3, 3> for Knee {
    /// #     const MODEL: ArmModel<f64, 3> = Model::new("knee", [
    /// #         Body::new("crank", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(0.1).com([0.02, 0.0, 0.0]),
    /// #         Body::new("rod", 0, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.05, 0.0, 0.0]).mass(0.1)
    /// #             .com([0.1, 0.0, 0.0]),
    /// #         Body::new("shank", BASE, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.2, 0.0, 0.0]).mass(1.0)
    /// #             .com([0.0, -0.2, 0.0]),
    /// #     ]);
    /// # }
    /// impl ClusteredRobot<3, 3, 3, 1, 1> for Knee {
    ///     type Clusters = (Driven<FourBar, 3, 1>,);
    ///     // The crank is longer than the rocker, and does not turn all around.
    ///     const CLUSTERS: Self::Clusters =
    ///         (Driven::new("knee", FourBar::new(0.2, 0.06, 0.2, 0.05, Branch::Positive)),);
    ///     const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
    /// }
    /// let at = |crank| Clustered::<Core<Knee>>::rnea_with_status(&State { q: [crank], qd: [1.0_f64], qdd: [0.0] }, &RIGID_BODY);
    /// let inside = at(1.0)?;
    /// assert_eq!(inside.regular(NEAR_SINGULAR), Ok(inside.tau));
    /// // Rod and rocker in line, the end of the crank's range: the law of cosines.
    /// let end = ((0.06_f64 * 0.06 + 0.2 * 0.2 - 0.25 * 0.25) / (2.0 * 0.06 * 0.2)).acos();
    /// let near = at(end - 1e-7)?;
    /// assert!(near.tau[0].abs() > 1e6); // N·m
    /// let error = near.regular(NEAR_SINGULAR).unwrap_err();
    /// assert!(error.cluster == "knee" && error.transmission > 1e3);
    /// # Ok::<(), dynamics_core::clusters::ClusterError>(())
    /// ```
    #[inline(never)]
    pub fn rnea_with_status<
        R,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
        effects: &E,
    ) -> Result<ClusteredTorque<R, Y>, ClusterError>
    where
        R: Real,
        A: TreeAlgorithms<R, B, Q, V>,
        A::Robot: ClusteredRobot<B, Q, V, P, Y>,
        E: Effect<R, B, V>,
    {
        no_load_friction::<R, E, B, V>();
        let motion = evaluate::<R, A, B, Q, V, P, Y>(y)?;
        let tau = A::rnea(&motion.trig, &motion.tree, effects);
        let tau = TreeMotion::<R, A::Robot, B, Q, V, P, Y>::finite(motion.torque(&tau))?;
        let conditioning = motion.conditioning();
        Ok(ClusteredTorque { tau, conditioning })
    }
}

impl<R, T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>
    TreeMotion<R, T, B, Q, V, P, Y>
where
    R: Real,
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    /// The motion of the clusters' joints with y: of [`Clustered::rnea_with_status`], and of
    /// every other algorithm that is given this motion.
    pub fn conditioning(&self) -> Conditioning<R> {
        let (mut fastest, mut transmission) = (0, R::ZERO);
        for (c, &[rows, _]) in <T::Clusters as Set>::SIZES.iter().enumerate() {
            for row in 0..rows {
                let (g, _) = <T::Clusters as Set>::row(&self.motions, c, row);
                for &rate in g {
                    // True of a NaN, which then stays.
                    let below = rate.abs() <= transmission;
                    if !below {
                        (fastest, transmission) = (c, rate.abs());
                    }
                }
            }
        }
        Conditioning { cluster: T::CLUSTERS.name(fastest), transmission, singular: self.singular() }
    }
}
