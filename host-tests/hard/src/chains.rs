//! Long chains, and folded ones.

use super::measure::{ErrorBounds, against_oracle};
use super::setup::list::{Stance, arm, chain};
use host_tests::hard::{Case, Row};

const ORACLE: &str = "computation in 50 digits from the same f32 bits (oracle/hard.py)";
const AS_CASE_7: &str = "as case 7";

pub const CASES: &[Case] = &[
    Case {
        number: 7,
        name: "chain of 8 rods",
        parameters: "8 rods of 1 kg and 0.25 m: straight on parallel axes, and random on crossed \
            axes; four states each",
        source: "Featherstone, \"An empirical study of the joint-space inertia matrix\" (2004): κ \
            grows as n⁴ in the worst case",
        oracle: ORACLE,
        reason: "a backward stable elimination errs by about κ ε at worst; the bounds are \
            measured, and smaller. Torques and Λ⁻¹ do not depend on κ",
        run: || rods::<8>(7, &[STRAIGHT_8, RANDOM_8]),
    },
    Case {
        number: 8,
        name: "chain of 16 rods",
        parameters: "as case 7, 16 rods",
        source: AS_CASE_7,
        oracle: ORACLE,
        reason: AS_CASE_7,
        run: || rods::<16>(8, &[STRAIGHT_16, RANDOM_16]),
    },
    Case {
        number: 9,
        name: "chain of 32 rods",
        parameters: "as case 7, 32 rods",
        source: AS_CASE_7,
        oracle: ORACLE,
        reason: AS_CASE_7,
        run: || rods::<32>(9, &[STRAIGHT_32, RANDOM_32]),
    },
    Case {
        number: 10,
        name: "chain of 64 rods",
        parameters: "as case 7, 64 rods",
        source: AS_CASE_7,
        oracle: ORACLE,
        reason: "f32 keeps two digits of the accelerations of random chains, and none of straight \
            ones: there κ ε = 8, and the errors of LᵀDL and ABA are 1.1 and 0.1 of full scale. The \
            cause is the rounding of M: refinement with torques of RNEA in f32 does not improve on \
            ABA. Torques and Λ⁻¹ do not depend on κ",
        run: || rods::<64>(10, &[STRAIGHT_64, RANDOM_64]),
    },
    Case {
        number: 11,
        name: "six links in a zigzag",
        parameters: "six rods of 1 kg and 1 m on parallel axes, joints alternately at ±75°, and \
            the mirrored chain",
        source: "Featherstone (2004): κ depends on how a chain is folded; here it is 725",
        oracle: ORACLE,
        reason: "κ ε = 9·10⁻⁵ in f32",
        run: || against_oracle(&arm(11, "zigzag ±75°"), &ZIGZAG),
    },
];

fn rods<const K: usize>(case: u32, [straight, random]: &[ErrorBounds; 2]) -> Vec<Row> {
    let mut rows = against_oracle(&chain::<K>(case, Stance::Straight), straight);
    rows.extend(against_oracle(&chain::<K>(case, Stance::Random), random));
    rows
}

const STRAIGHT_8: ErrorBounds = ErrorBounds {
    single: [3e-7, 3e-4, 2e-4, 1e-7, 3e-6],
    double: [3e-16, 3e-13, 3e-13, 0.0, 2e-15],
};

const RANDOM_8: ErrorBounds = ErrorBounds {
    single: [4e-7, 8e-6, 6e-6, 4e-7, 8e-7],
    double: [2e-15, 8e-15, 1e-14, 1.5e-15, 8e-16],
};

const STRAIGHT_16: ErrorBounds = ErrorBounds {
    single: [3e-7, 2e-2, 3e-3, 1.5e-7, 3e-6],
    double: [5e-16, 3e-11, 3e-12, 5e-16, 2e-15],
};

const RANDOM_16: ErrorBounds = ErrorBounds {
    single: [2e-6, 2e-4, 8e-5, 6e-7, 1e-6],
    double: [3e-15, 6e-13, 1.5e-13, 1e-15, 8e-15],
};

const STRAIGHT_32: ErrorBounds = ErrorBounds {
    single: [4e-7, 1.5e-1, 8e-3, 1.5e-7, 2e-6],
    double: [5e-16, 3e-10, 5e-11, 5e-16, 3e-15],
};

const RANDOM_32: ErrorBounds = ErrorBounds {
    single: [2e-6, 2.5e-3, 1e-3, 5e-7, 8e-7],
    double: [4e-15, 4e-12, 1e-12, 8e-16, 2e-15],
};

const STRAIGHT_64: ErrorBounds =
    ErrorBounds { single: [6e-7, 3e0, 3e-1, 8e-9, 3e-6], double: [6e-16, 3e-9, 4e-10, 0.0, 4e-15] };

const RANDOM_64: ErrorBounds = ErrorBounds {
    single: [7e-6, 3e-2, 8e-3, 8e-7, 6e-7],
    double: [1e-14, 3e-11, 1.5e-11, 8e-16, 2e-15],
};

const ZIGZAG: ErrorBounds = ErrorBounds {
    single: [8e-7, 2e-5, 8e-6, 3e-7, 5e-7],
    double: [2e-15, 3e-14, 2e-14, 1.5e-15, 1e-15],
};
