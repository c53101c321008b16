//! Loops of closed form on a robot that is known at run time: the library's clusters, and which
//! coordinates they drive.

use dynamics_core::clusters::{
    Belt, Cluster, ClusterMotion, ClusterProblem, Delta, Differential, FiveBar, FourBar,
    ParallelAnkle, Stewart,
};
use dynamics_core::model::{JointCoordinate, JointKind};
use dynamics_core::scalar::{Native, Real};

use crate::job::Problem;
use crate::model::{Bodies, Counts};

/// The most coefficients of a belt.
pub const MOST_COEFFICIENTS: usize = 8;

/// The most coordinates of a linkage, and the most of them that are independent.
const MOST: usize = 24;
const INDEPENDENT: usize = 6;

macro_rules! linkages {
    ($($name:ident $(<$c:ident>)? $m:literal $n:literal),* $(,)?) => {
        /// A linkage of the library, with its dimensions.
        #[derive(Clone, Copy, Debug)]
        pub enum Linkage {
            $(
                #[doc = concat!("[`", stringify!($name), "`].")]
                $name($name $(<$c>)?),
            )*
        }

        impl Linkage {
            /// Its numbers of coordinates, and of independent ones.
            pub fn sizes(&self) -> [usize; 2] {
                match self {
                    $(Self::$name(_) => [$m, $n],)*
                }
            }

            /// Its motion at independent coordinates y and their rates.
            ///
            /// # Errors
            /// Why there is none.
            fn motion<R: Real>(&self, y: &[R; INDEPENDENT], yd: &[R; INDEPENDENT]) -> Result<Motion<R>, ClusterProblem> {
                match self {
                    $(Self::$name(linkage) => {
                        let y = std::array::from_fn(|k| JointCoordinate::with_kernel::<Native>(y[k]));
                        let yd = std::array::from_fn(|k| yd[k]);
                        let found: ClusterMotion<R, $m, $n> = linkage.evaluate::<R, Native>(&y, &yd)?;
                        let independent = <$name $(<$c>)? as Cluster<$m, $n>>::INDEPENDENT;
                        Ok(Motion::of(&found, &independent))
                    })*
                }
            }
        }
    };
}

linkages! {
    FourBar 3 1, FiveBar 4 2, Differential 2 2, Belt<MOST_COEFFICIENTS> 2 1, ParallelAnkle 8 2, Delta 12 3, Stewart 24 6,
}

/// The motion of a linkage, filled up.
#[derive(Clone, Copy)]
struct Motion<R> {
    q: [JointCoordinate<R>; MOST],
    g: [[R; INDEPENDENT]; MOST],
    bias: [R; MOST],
    independent: [Option<usize>; MOST],
    singular: bool,
}

impl<R: Real> Motion<R> {
    fn of<const M: usize, const N: usize>(
        found: &ClusterMotion<R, M, N>,
        independent: &[Option<usize>; M],
    ) -> Self {
        let mut motion = Self {
            q: [JointCoordinate::default(); MOST],
            g: [[R::ZERO; INDEPENDENT]; MOST],
            bias: [R::ZERO; MOST],
            independent: [None; MOST],
            singular: found.singular,
        };
        motion.q[..M].copy_from_slice(&found.q);
        motion.bias[..M].copy_from_slice(&found.bias);
        motion.independent[..M].copy_from_slice(independent);
        for (row, found) in motion.g.iter_mut().zip(&found.g) {
            row[..N].copy_from_slice(found);
        }
        motion
    }
}

/// A linkage on a robot.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The linkage with its dimensions.
    pub linkage: Linkage,
    /// The velocity coordinates that it drives, in the order of its rows.
    pub coordinates: Vec<usize>,
    /// The position coordinates that belong to these.
    positions: Vec<usize>,
    /// The places where its own coordinates begin in y and in ẏ.
    first: [usize; 2],
}

/// The linkages of a robot.
#[derive(Clone, Debug)]
pub struct Linkages {
    all: Vec<Placed>,
    /// Position coordinates in no linkage: of the tree, and of y.
    free_q: Vec<[usize; 2]>,
    /// Velocity coordinates in no linkage: of the tree, and of ẏ.
    free: Vec<[usize; 2]>,
    /// The numbers of positions and velocities of y.
    pub sizes: [usize; 2],
}

/// Why linkages do not fit a robot: which, and a sentence.
pub type Misfit = (usize, String);

impl Linkages {
    /// Linkages that drive these velocity coordinates.
    ///
    /// # Errors
    /// Another number of coordinates than a linkage has, one that the robot does not have, that is
    /// driven twice or is not the derivative of a position, or bodies that are on two bodies
    /// outside.
    pub fn of(bodies: &Bodies, given: Vec<(Linkage, Vec<usize>)>) -> Result<Self, Misfit> {
        let Counts { v, .. } = bodies.counts();
        let mut of = vec![None; v];
        for (c, (linkage, coordinates)) in given.iter().enumerate() {
            let [m, _] = linkage.sizes();
            if coordinates.len() != m {
                return Err((c, format!("it drives {m} coordinates, not {}", coordinates.len())));
            }
            for &at in coordinates {
                match of.get_mut(at) {
                    None => return Err((c, format!("the robot has no velocity coordinate {at}"))),
                    Some(Some(_)) => return Err((c, format!("coordinate {at} is driven twice"))),
                    Some(free) => *free = Some(c),
                }
            }
        }
        let mut all: Vec<Placed> = Vec::new();
        for (linkage, coordinates) in given {
            all.push(Placed {
                linkage,
                positions: vec![0; coordinates.len()],
                coordinates,
                first: [usize::MAX; 2],
            });
        }
        let (mut free_q, mut free, mut sizes) = (Vec::new(), Vec::new(), [0, 0]);
        let (mut idx, mut driving, mut outside) = ([0, 0], Vec::new(), vec![None; all.len()]);
        for (kind, parent) in bodies.kinds().zip(bodies.parents()) {
            let (nq, nv) = kind.coordinates();
            let [q, v] = idx;
            idx = [q + nq, v + nv];
            let c = if nv == 0 { None } else { of[v] };
            driving.push(c);
            let Some(c) = c else {
                if let Some(c) = (v..v + nv).find_map(|k| of[k]) {
                    return Err((c, "it drives a part of a joint's coordinates".to_owned()));
                }
                free_q.extend((0..nq).map(|k| [q + k, sizes[0] + k]));
                free.extend((0..nv).map(|k| [v + k, sizes[1] + k]));
                sizes = [sizes[0] + nq, sizes[1] + nv];
                continue;
            };
            if (v..v + nv).any(|k| of[k] != Some(c)) {
                return Err((c, "it drives a part of a joint's coordinates".to_owned()));
            }
            if matches!(kind, JointKind::Spherical | JointKind::Planar | JointKind::Free) {
                let text =
                    "it drives a joint whose velocities are not the derivatives of its positions";
                return Err((c, text.to_owned()));
            }
            let on_its_own = parent.is_some_and(|parent| driving[parent] == Some(c));
            if !on_its_own && *outside[c].get_or_insert(parent) != parent {
                let text = "its bodies are not all on each other or on one body outside it";
                return Err((c, text.to_owned()));
            }
            let placed = &mut all[c];
            for k in 0..nv {
                let row = placed.coordinates.iter().position(|&at| at == v + k);
                placed.positions[row.unwrap_or_default()] = q + k;
            }
            if placed.first[0] == usize::MAX {
                placed.first = sizes;
                let [_, n] = placed.linkage.sizes();
                sizes = [sizes[0] + n, sizes[1] + n];
            }
        }
        Ok(Self { all, free_q, free, sizes })
    }
}

/// The state of the tree at independent coordinates, and the maps of torques and M to these.
pub struct TreeMotion<'a, R: Real, const Q: usize, const V: usize> {
    linkages: &'a Linkages,
    motions: Vec<Motion<R>>,
    /// The tree's coordinates of linkages, with sines and cosines of the linkages' own.
    pub turns: Vec<(usize, JointCoordinate<R>)>,
    /// The positions q of the tree.
    pub q: [R; Q],
    /// The velocities q̇ of the tree.
    pub qd: [R; V],
    /// The accelerations q̈ of the tree.
    pub qdd: [R; V],
}

/// Nothing if no number of a linkage is larger.
fn all_within(
    most: f64,
    each: impl Iterator<Item = impl Iterator<Item = f64>>,
) -> Result<(), Problem> {
    for (c, mut numbers) in each.enumerate() {
        if let Some(angle) = numbers.find(|x| x.abs() > most) {
            return Err(Problem::Angle(c, angle));
        }
    }
    Ok(())
}

/// aᵀ b without an addition to zero.
fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    let mut products = a.iter().zip(b).map(|(&a, &b)| a * b);
    let first = products.next().unwrap_or_default();
    products.fold(first, |sum, product| sum + product)
}

impl Linkages {
    /// The motion of the tree at y, ẏ and ÿ.
    ///
    /// # Errors
    /// The linkage that has none, and why.
    pub fn motion<R: Real, const Q: usize, const V: usize>(
        &self,
        y: &[R; Q],
        yd: &[R; V],
        ydd: &[R; V],
    ) -> Result<TreeMotion<'_, R, Q, V>, (usize, ClusterProblem)> {
        let mut tree = TreeMotion {
            linkages: self,
            motions: Vec::new(),
            turns: Vec::new(),
            q: [R::ZERO; Q],
            qd: [R::ZERO; V],
            qdd: [R::ZERO; V],
        };
        for &[to, from] in &self.free_q {
            tree.q[to] = y[from];
        }
        for &[to, from] in &self.free {
            (tree.qd[to], tree.qdd[to]) = (yd[from], ydd[from]);
        }
        for (c, placed) in self.all.iter().enumerate() {
            let ([p, first], [_, n]) = (placed.first, placed.linkage.sizes());
            let own = |from: &[R], at: usize| {
                std::array::from_fn(|k| if k < n { from[at + k] } else { R::ZERO })
            };
            let (yd, ydd): ([R; INDEPENDENT], [R; INDEPENDENT]) = (own(yd, first), own(ydd, first));
            let motion = placed.linkage.motion(&own(y, p), &yd);
            let motion = motion.map_err(|problem| (c, problem))?;
            let places = placed.coordinates.iter().zip(&placed.positions);
            for (j, (&v, &q)) in places.enumerate() {
                tree.turns.push((q, motion.q[j]));
                tree.q[q] = motion.q[j].q;
                (tree.qd[v], tree.qdd[v]) = match motion.independent[j] {
                    Some(k) => (yd[k], ydd[k]),
                    None => {
                        let g = &motion.g[j][..n];
                        (dot(g, &yd), dot(g, &ydd) + motion.bias[j])
                    }
                };
            }
            tree.motions.push(motion);
        }
        Ok(tree)
    }
}

impl Linkages {
    /// The place of each position that is in no linkage: in q of the tree, and in y.
    pub fn outside(&self) -> &[[usize; 2]] {
        &self.free_q
    }

    /// Nothing if no linkage has an own coordinate beyond an angle; lengths are never so large.
    ///
    /// # Errors
    /// [`Problem::Angle`] with the first that has.
    pub fn within<R: Real>(&self, y: &[R], most: f64) -> Result<(), Problem> {
        all_within(
            most,
            self.all.iter().map(|placed| {
                let ([p, _], [_, n]) = (placed.first, placed.linkage.sizes());
                y[p..p + n].iter().map(|y| y.to_f64())
            }),
        )
    }

    /// The linkage of an independent coordinate that moves no inertia; none if it is of none.
    pub fn without_inertia(&self, coordinate: usize) -> (usize, ClusterProblem) {
        let found = self.all.iter().position(|placed| {
            let ([_, first], [_, n]) = (placed.first, placed.linkage.sizes());
            (first..first + n).contains(&coordinate)
        });
        (found.unwrap_or(usize::MAX), ClusterProblem::NoInertia)
    }
}

impl<R: Real, const Q: usize, const V: usize> TreeMotion<'_, R, Q, V> {
    /// Nothing if no linkage drives a joint beyond an angle.
    ///
    /// # Errors
    /// [`Problem::Angle`] with the first that does.
    pub fn within(&self, most: f64) -> Result<(), Problem> {
        let each = self.linkages.all.iter().zip(&self.motions);
        all_within(
            most,
            each.map(|(placed, motion)| {
                let [m, _] = placed.linkage.sizes();
                motion.q[..m].iter().map(|q| q.q.to_f64())
            }),
        )
    }

    /// Gᵀ τ: the torques at y that do the work of the tree's.
    pub fn torque(&self, tau: &[R; V]) -> [R; V] {
        let mut out = [R::ZERO; V];
        for &[from, to] in &self.linkages.free {
            out[to] = tau[from];
        }
        for (placed, motion) in self.linkages.all.iter().zip(&self.motions) {
            let [_, n] = placed.linkage.sizes();
            let mut sums = [None; INDEPENDENT];
            let mut add = |k: usize, term: R| {
                let sum: &mut Option<R> = &mut sums[k];
                *sum = Some(sum.map_or(term, |sum| sum + term));
            };
            for (j, &v) in placed.coordinates.iter().enumerate() {
                match motion.independent[j] {
                    Some(k) => add(k, tau[v]),
                    None => (0..n).for_each(|k| add(k, motion.g[j][k] * tau[v])),
                }
            }
            for (k, sum) in sums.iter().enumerate().take(n) {
                out[placed.first[1] + k] = sum.unwrap_or_default();
            }
        }
        out
    }

    /// G by rows of the tree's coordinates.
    pub fn g(&self) -> [[R; V]; V] {
        let mut g = [[R::ZERO; V]; V];
        for &[from, to] in &self.linkages.free {
            g[from][to] = R::ONE;
        }
        for (placed, motion) in self.linkages.all.iter().zip(&self.motions) {
            let ([_, first], [_, n]) = (placed.first, placed.linkage.sizes());
            for (j, &v) in placed.coordinates.iter().enumerate() {
                g[v][first..first + n].copy_from_slice(&motion.g[j][..n]);
            }
        }
        g
    }

    /// Whether a linkage is at or near a singularity, where its motion is damped.
    pub fn is_singular(&self) -> bool {
        self.motions.iter().any(|motion| motion.singular)
    }

    /// The linkage of the first number that is not finite; none if it is of none.
    pub fn not_finite(&self, of_y: &[R]) -> (usize, ClusterProblem) {
        let is_own = |placed: &Placed| {
            let ([_, first], [_, n]) = (placed.first, placed.linkage.sizes());
            !of_y[first..first + n].iter().all(|x| x.is_finite())
        };
        let found = self.linkages.all.iter().position(is_own);
        (found.unwrap_or(usize::MAX), ClusterProblem::NotFinite)
    }
}
