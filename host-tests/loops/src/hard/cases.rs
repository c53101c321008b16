//! The cases.

use fixtures::hard::loops::RIG;
use host_tests::hard::Case;

use super::four_bars::{of_case, problem};
use super::setup::{Planar, Setup};
use super::{geared, robots, status};

const ORACLE: &str = "computation in 50 digits from the same numbers (oracle/loops_precise.py)";

pub const CASES: &[&[Case]] = &[LINKAGES, SINGULAR, MASSES, MOTIONS, GEARS];

const LINKAGES: &[Case] = &[
    Case {
        number: 49,
        name: "loop with redundant rows",
        parameters: "a planar four-bar in space: three of the five rows of its pin depend on the \
            others; four states",
        source: "overconstrained mechanisms: K Kᵀ is singular everywhere, and its inverse needs \
            damping",
        oracle: ORACLE,
        reason: "elimination with complete pivoting finds the rank and leaves out redundant rows: \
            some ε of full scale",
        run: || {
            let mut rows = of_case(49);
            rows.extend(status::redundant_rows());
            rows
        },
    },
    Case {
        number: 52,
        name: "loop that cannot close",
        parameters: "a four-bar whose crank points 0.25 m to the other side, and the coupler is \
            0.1 m too short; two states",
        source: "a wrong calibration of a crank's encoder",
        oracle: "the triangle inequality of diagonal, coupler and rocker",
        reason: "assembly, inverse dynamics and the cluster each return the error with the loop's \
            name",
        run: || status::out_of_reach(problem(52, "out of reach")),
    },
    Case {
        number: 56,
        name: "more motors than degrees of freedom",
        parameters: "a five-bar with motors at both cranks and at the root of a coupler; four \
            states",
        source: "antagonistic and redundantly driven rigs",
        oracle: ORACLE,
        reason: "torques of least norm by a 3 × 3 inverse of Gᵀ G",
        run: || {
            let mut rows = Planar::of(&RIG).rows();
            rows.extend(status::least_norm());
            rows
        },
    },
];

const SINGULAR: &[Case] = &[
    Case {
        number: 50,
        name: "parallelogram near flat",
        parameters: "sides of 0.25 and 0.5 m, 2⁻³ to 2⁻¹⁷ rad from flat, and flat; two states each",
        source: "a palletiser's parallelogram at the end of its stroke; flat, coupler and rocker \
            may turn either way",
        oracle: ORACLE,
        reason: "general loops: torques are damped and named below the default distance of 5·10⁻³, \
            and exact above; inverse dynamics is measured with the least damping, which f64 is \
            free of to 2·10⁻⁷ and f32 to 4·10⁻³: ε over the angle from flat. Forward dynamics \
            names the rank that drops at 10⁻⁷ (f64) or 2·10⁻³ (f32). Clusters have the angle from \
            a difference of squares: at most ε over its square in G and over its cube in Ġ ẏ; \
            their status begins at 1.1·10⁻² (f32) and 6·10⁻⁵ rad (f64), where the error of Ġ ẏ is \
            10⁻³ of ẏ² in f64",
        run: || of_case(50),
    },
    Case {
        number: 51,
        name: "change point of a Grashof four-bar",
        parameters: "crank, coupler, rocker and ground of 0.125, 0.625, 0.25 and 0.5 m (shortest + \
            longest = sum of the others); 2⁻³ to 2⁻¹⁷ rad from the change point, two states each, \
            and at it, still",
        source: "Grashof (1883): the linkage is flat at the change point, and may continue on \
            either branch",
        oracle: ORACLE,
        reason: "as case 50; a cluster's status begins at 2·10⁻² (f32) and 1.2·10⁻⁴ rad (f64). At \
            2⁻¹⁷ rad it has no digit of the acceleration left, and is damped and named; general \
            loops have eleven digits of the torque there. The guess decides on a loop's branch, a \
            constant on a cluster's",
        run: || of_case(51),
    },
    Case {
        number: 53,
        name: "Delta near its singular postures",
        parameters: "the Delta with cranks and rods stretched downwards; another, rods 0.3125 m, \
            whose rods and platform lie in one plane while the cranks are level, 2⁻³ to 2⁻¹⁰ rad \
            from there, and there",
        source: "Gosselin & Angeles (1990): singularities of the first kind (stretched) and the \
            second, in which the motors do not hold the platform",
        oracle: ORACLE,
        reason: "stretched arms are regular for the motors; near coplanar rods ε over the angle \
            with the least damping; with the default damping named, finite and within its bound. \
            Coplanar, three more rows of K depend on the others, which forward dynamics in f32 \
            names at 2⁻⁵ rad. f32 rounds the description of the Delta, too",
        run: || {
            let mut rows: Vec<_> = robots::deltas().iter().flat_map(Setup::rows).collect();
            rows.extend(status::coplanar_delta());
            rows
        },
    },
    Case {
        number: 54,
        name: "Stewart platform, singular postures",
        parameters: "the platform above the base's centre, turned about the vertical by 90° less \
            2⁻³ to 2⁻¹⁰ rad, and by ±90°; a platform similar to its base, singular everywhere",
        source: "Fichter (1986): turned by ±90°; Ma & Angeles (1991): architecture singularity",
        oracle: ORACLE,
        reason: "inverse dynamics: ε over the angle with the least damping, and named where the \
            legs do not determine the platform's motion; with the default damping named from 2⁻⁵ \
            rad. Forward dynamics is regular",
        run: || robots::stewarts().iter().flat_map(Setup::rows).collect(),
    },
    Case {
        number: 60,
        name: "slider-crank near its dead point",
        parameters: "crank of 0.125 m, rod of 0.5 m, the motor at the piston, 2⁻³ to 2⁻¹⁰ rad from \
            the dead point, and there; two states each",
        source: "a piston engine at its top: the piston's force has no lever",
        oracle: ORACLE,
        reason: "the crank's rate is the piston's over the angle, whose square the piston's \
            position knows: at most ε over the square of the angle with the least damping; with \
            the default damping named from 2⁻⁵ rad. Forward dynamics is regular",
        run: || of_case(60),
    },
];

const MASSES: &[Case] = &[
    Case {
        number: 55,
        name: "mass ratio of 10⁶ across a loop",
        parameters: "a four-bar with a rocker of 2²⁰ kg on links of 1 kg, and with a coupler of \
            2⁻²⁰ kg between links of 1 kg; four states each",
        source: "presses and excavators; a rod of carbon fibre between motors",
        oracle: ORACLE,
        reason: "a light rod costs nothing. With the heavy rocker the torque would accelerate the \
            crank alone 10⁷ times as much as the linkage; forward dynamics of general loops solves \
            for the motion that the loops allow and keeps four digits in f32, as a cluster does",
        run: || of_case(55),
    },
    Case {
        number: 57,
        name: "rod of no mass",
        parameters: "a four-bar whose coupler has no inertia; four states",
        source: "rods that a description models as distances",
        oracle: ORACLE,
        reason: "inverse dynamics needs no inverse. Forward dynamics of general loops factors the \
            tree's M and names the coupler's joint, since the coupler alone has no inertia",
        run: || of_case(57),
    },
    Case {
        number: 58,
        name: "links of 1 mm and 1 m",
        parameters: "a four-bar with a crank of 2⁻¹⁰ m, a rocker of 2⁻⁶ m, coupler and ground of 1 \
            m; four states",
        source: "eccentrics",
        oracle: ORACLE,
        reason: "the closure is a difference of lengths of 1 m: ε over the ratio of the lengths. \
            In f32 the crank's inertia is lost beside the coupler's, and forward dynamics of \
            general loops names its joint",
        run: || of_case(58),
    },
];

const MOTIONS: &[Case] = &[
    Case {
        number: 59,
        name: "loop at 1000 rad/s",
        parameters: "the four-bar of case 49 with its crank at ±1000 rad/s; four states",
        source: "high-speed linkages: velocity products of 10⁶ rad/s²",
        oracle: ORACLE,
        reason: "as case 49: every term is as large as the result",
        run: || of_case(59),
    },
    Case {
        number: 61,
        name: "crank after 1600 turns",
        parameters: "the four-bar of case 49 with its crank at ±10⁴ rad; two states",
        source: "a crank that turns all day, its angle counted on; 10⁴ rad is the most that the \
            kernels promise",
        oracle: ORACLE,
        reason: "the number is exact in f32 and reduced to one turn; loops and clusters read only \
            its sine and cosine",
        run: || of_case(61),
    },
];

const GEARS: &[Case] = &[
    Case {
        number: 62,
        name: "differential of extreme ratio",
        parameters: "pitch at 1 and roll at 1/1024 of its motors; one state of two turns, one of \
            700 rad at 1000 rad/s",
        source: "harmonic drives behind a differential",
        oracle: ORACLE,
        reason: "the inertia that the motors see has κ = 10⁶, which costs f64 as many digits of \
            the accelerations. In f32 the smaller pivot is within its rounding errors, and forward \
            dynamics names the cluster",
        run: geared::differential_rows,
    },
    Case {
        number: 63,
        name: "belt of steep slope",
        parameters: "an arm that turns by 1024 rad per rad of its pulley, the slope changing by \
            1024 per rad; two states",
        source: "spiral pulleys, and transmissions that run back",
        oracle: ORACLE,
        reason: "the arm's angle of 10 rad is known to ε times itself",
        run: geared::belt_rows,
    },
];
