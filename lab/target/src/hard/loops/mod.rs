//! Hard cases with kinematic loops: planar linkages that the host tests and the firmware share.
//!
//! The host compares the results with a 50-digit oracle (`host-tests/oracle/loops_precise.py`).

mod compute;
mod machines;
mod starts;

pub use compute::{Scene, digests, scene};
pub use machines::{FourBar, LINKAGES, Linkage, Rig, SliderCrank};

use dynamics_core::loops::{LoopRobot, Loops, Moving};
use dynamics_core::model::ArmModel;

/// q, q̇ and q̈ as they are written: those of the coordinates that are held, and a guess of the
/// others.
pub type Start<const N: usize> = [[f32; N]; 3];

/// One problem of a hard case: a machine with one loop of five rows, of which A coordinates have
/// motors.
#[derive(Clone, Copy, Debug)]
pub struct LoopProblem<const N: usize, const A: usize> {
    /// The number of the case that it belongs to.
    pub case: u32,
    pub name: &'static str,
    /// Its index in [`LINKAGES`], if it is one of them.
    pub linkage: Option<usize>,
    pub tree: &'static ArmModel<f64, N>,
    /// The same in f32: what is computed with.
    pub single: &'static ArmModel<f32, N>,
    pub loops: &'static Loops<1, 5, A>,
    /// The coordinates that are given: the others follow.
    pub held: &'static [usize],
    /// The coordinates that assembly moves.
    pub moving: Moving,
    pub starts: &'static [Start<N>],
}

trait Constants<const N: usize, const A: usize>: LoopRobot<N, N, N, 1, 5, A> {
    const TREE: &'static ArmModel<f64, N> = &Self::MODEL;
    const SINGLE: &'static ArmModel<f32, N> = &Self::MODEL.to_f32();
    const CLOSED: &'static Loops<1, 5, A> = &Self::LOOPS;
}

impl<T: LoopRobot<N, N, N, 1, 5, A>, const N: usize, const A: usize> Constants<N, A> for T {}

/// A problem of the K-th linkage.
const fn four_bar<const K: usize>(
    case: u32,
    name: &'static str,
    starts: &'static [Start<3>],
) -> LoopProblem<3, 1> {
    LoopProblem {
        case,
        name,
        linkage: Some(K),
        tree: FourBar::<K>::TREE,
        single: FourBar::<K>::SINGLE,
        loops: FourBar::<K>::CLOSED,
        held: &[0],
        moving: Moving::Passive,
        starts,
    }
}

const fn slider_crank(name: &'static str, starts: &'static [Start<3>]) -> LoopProblem<3, 1> {
    LoopProblem {
        case: 60,
        name,
        linkage: None,
        tree: SliderCrank::TREE,
        single: SliderCrank::SINGLE,
        loops: SliderCrank::CLOSED,
        held: &[0],
        moving: Moving::All,
        starts,
    }
}

/// The problems of three bodies and one motor.
pub static PROBLEMS: [LoopProblem<3, 1>; 22] = [
    four_bar::<0>(49, "planar four-bar in space", &starts::PLAIN),
    four_bar::<1>(50, "2⁻³ rad", &starts::parallelogram(0.125)),
    four_bar::<1>(50, "2⁻⁶ rad", &starts::parallelogram(1.0 / 64.0)),
    four_bar::<1>(50, "2⁻¹⁰ rad", &starts::parallelogram(1.0 / 1024.0)),
    four_bar::<1>(50, "2⁻¹⁷ rad", &starts::parallelogram(1.0 / 131_072.0)),
    four_bar::<1>(50, "flat", &starts::parallelogram(0.0)),
    four_bar::<2>(51, "2⁻³ rad", &starts::changing(0.125)),
    four_bar::<2>(51, "2⁻⁶ rad", &starts::changing(1.0 / 64.0)),
    four_bar::<2>(51, "2⁻¹⁰ rad", &starts::changing(1.0 / 1024.0)),
    four_bar::<2>(51, "2⁻¹⁷ rad", &starts::changing(1.0 / 131_072.0)),
    four_bar::<2>(51, "change point", &starts::AT_REST),
    four_bar::<7>(52, "out of reach", &starts::OUT_OF_REACH),
    four_bar::<3>(55, "rocker × 10⁶", &starts::PLAIN),
    four_bar::<4>(55, "coupler × 10⁻⁶", &starts::PLAIN),
    four_bar::<5>(57, "rod of no mass", &starts::PLAIN),
    four_bar::<6>(58, "links of 1 mm and 1 m", &starts::THIN),
    four_bar::<0>(59, "1000 rad/s", &starts::FAST),
    slider_crank("2⁻³ rad", &starts::slider(0.125)),
    slider_crank("2⁻⁵ rad", &starts::slider(1.0 / 32.0)),
    slider_crank("2⁻¹⁰ rad", &starts::slider(1.0 / 1024.0)),
    slider_crank("dead point", &starts::slider(0.0)),
    four_bar::<0>(61, "10⁴ rad", &starts::TURNS),
];

pub static RIG: LoopProblem<4, 3> = LoopProblem {
    case: 56,
    name: "three motors for two degrees of freedom",
    linkage: None,
    tree: Rig::TREE,
    single: Rig::SINGLE,
    loops: Rig::CLOSED,
    held: &[0, 2],
    moving: Moving::All,
    starts: &starts::RIG,
};
