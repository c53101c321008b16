//! Masses and inertias of very different sizes.

use super::measure::{ErrorBounds, against_oracle, by_joints};
use super::naive::floored;
use super::setup::list::{arm, light_links};
use dynamics_core::algorithms::NotPositiveDefinite;
use fixtures::hard::{N, Scene, scene};
use host_tests::hard::{Case, Row};

const ORACLE: &str = "computation in 50 digits from the same f32 bits (oracle/hard.py)";

pub const CASES: &[Case] = &[
    Case {
        number: 1,
        name: "tip mass × 10⁶",
        parameters: "UR5e, mass and inertia of the last link × 10⁶, four states",
        source: "a crane's hook; Featherstone, RBDA (2008), chapter 10: M is ill-conditioned if a \
            heavy body is outward of light ones",
        oracle: ORACLE,
        reason: "torques are rounded as in any other arm; accelerations of light links between \
            heavy ones are differences, with errors below κ ε / 10",
        run: || against_oracle(&arm(1, "tip × 10⁶"), &TIP_HEAVY),
    },
    Case {
        number: 2,
        name: "tip mass × 10⁻⁶",
        parameters: "UR5e, mass and inertia of the last link × 10⁻⁶, four states",
        source: "a needle on an arm; solvers that add 10⁻⁶ to every pivot make it thousands of \
            times heavier",
        oracle: ORACLE,
        reason: "κ is 10¹⁰ by its units alone: elimination does not depend on the scale of rows \
            and columns (van der Sluis, 1969)",
        run: || against_oracle(&arm(2, "tip × 10⁻⁶"), &TIP_LIGHT),
    },
    Case {
        number: 3,
        name: "base link × 10⁶",
        parameters: "UR5e, mass and inertia of the first link × 10⁶, four states",
        source: "an arm on a turret",
        oracle: ORACLE,
        reason: "as case 2: one row and one column are scaled",
        run: || against_oracle(&arm(3, "base link × 10⁶"), &BASE_HEAVY),
    },
    Case {
        number: 4,
        name: "massless wrist links in between",
        parameters: "UR5e, the first two wrist links without mass and inertia, four states",
        source: "URDF files whose intermediate links are frames without <inertial>",
        oracle: ORACLE,
        reason: "no algorithm divides by the inertia of one link, only by that of all bodies that \
            a joint moves",
        run: || against_oracle(&arm(4, "massless wrist links"), &WRIST),
    },
    Case {
        number: 5,
        name: "massless last link, no armature",
        parameters: "UR5e, the last link without mass and inertia, four states",
        source: "a tool frame modelled as a moving body; ABA then divides zero by zero",
        oracle: "a row of M is zero, so that no acceleration exists",
        reason: "RNEA needs no inverse; every algorithm of forward dynamics names joint 5",
        run: massless_tip,
    },
    Case {
        number: 6,
        name: "the same with armature 10⁻⁸ … 10⁻²",
        parameters: "rotor inertias of 10⁻⁸, 10⁻⁶, 10⁻⁴ and 10⁻² kg·m² at joint 5, four states \
            each",
        source: "rotors of fingers reflect 10⁻⁸ to 10⁻⁵ kg·m²; libraries with a lower bound of \
            10⁻⁶ on inertias enlarge them",
        oracle: ORACLE,
        reason: "κ = 3·10³ … 4·10⁸ comes from scaling alone: the error must not depend on the \
            armature",
        run: armature,
    },
    Case {
        number: 12,
        name: "1 kg on ten links of 1 g",
        parameters: "ten rods of 1 g and 0.1 m, their axes transverse and vertical in turn, and a \
            rod of 1 kg; four states",
        source: "ropes and cables as chains of small links",
        oracle: ORACLE,
        reason: "κ ε = 2·10⁻² in f32: the pivots of the light links are remainders after the heavy \
            link's share is subtracted",
        run: || against_oracle(&light_links(), &LIGHT_LINKS),
    },
    Case {
        number: 46,
        name: "payload from 0 to 10 times the arm",
        parameters: "UR5e with 0, 1.77, 17.7, 177 kg at (0.02, −0.01, 0.08) m in its last frame, \
            four states each",
        source: "identification and overload tests; the library's `Payload` effect",
        oracle: ORACLE,
        reason: "as case 1, with a ratio a thousand times smaller",
        run: payload,
    },
];

fn massless_tip() -> Vec<Row> {
    let setup = arm(5, "massless terminal link");
    let truth = setup.truth();
    let answers = setup.answers(&truth);
    let single =
        by_joints(answers.iter().map(|(a, _)| Ok(a.rnea)), &truth.states, |t| Some(&t.rnea));
    let double =
        by_joints(answers.iter().map(|(_, a)| Ok(a.rnea)), &truth.states, |t| Some(&t.rnea));
    let mut rows = vec![
        Row::measured("RNEA", "f32", single, 5e-7),
        Row::measured("RNEA", "f64", double, 1e-15),
    ];
    let named = |e: Option<NotPositiveDefinite>| e.is_some_and(|e| e.joint == 5);
    for (quantity, ask) in
        [("CRBA + LᵀDL", 0_usize), ("ABA", 1), ("OSIM⁻¹ by bodies", 2), ("OSIM⁻¹ by J M⁻¹ Jᵀ", 3)]
    {
        let single = answers.iter().all(|(a, _)| named(refusals(a)[ask]));
        let double = answers.iter().all(|(_, a)| named(refusals(a)[ask]));
        let quantity = format!("{quantity}: joint 5 is named");
        rows.push(Row::claim(&quantity, "f32", single));
        rows.push(Row::claim(&quantity, "f64", double));
    }
    rows
}

/// The joint that each algorithm of forward dynamics names.
pub(super) fn refusals<R, const K: usize>(
    a: &fixtures::hard::Answers<R, K>,
) -> [Option<NotPositiveDefinite>; 4] {
    [
        a.forward.as_ref().err().copied(),
        a.aba.as_ref().err().copied(),
        a.mobility.as_ref().err().copied(),
        a.by_matrix.as_ref().err().copied(),
    ]
}

fn armature() -> Vec<Row> {
    let mut rows = Vec::new();
    for name in ["armature 10⁻⁸", "armature 10⁻⁶", "armature 10⁻⁴", "armature 10⁻²"]
    {
        rows.extend(against_oracle(&arm(6, name), &ARMATURE));
    }
    let setup = arm(6, "armature 10⁻⁸");
    let truth = setup.truth();
    let scene: Scene<f32, N> = scene(&setup.extras);
    let found = (0..setup.states.len()).map(|k| {
        let (state, tau) = (&setup.states[k], setup.tau(&truth, k));
        Ok(floored(&setup.single, state, &tau, &scene, 1e-6))
    });
    let error = by_joints(found, &truth.states, |t| t.qdd.as_deref());
    let name = "naive: pivots of at least 10⁻⁶, armature 10⁻⁸";
    rows.push(Row::naive(name, "f32", error, ARMATURE.single[1]));
    rows
}

fn payload() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, bounds) in PAYLOADS {
        rows.extend(against_oracle(&arm(46, name), bounds));
    }
    rows
}

const PAYLOADS: [(&str, &ErrorBounds); 4] = [
    ("payload 0", &PAYLOAD_NONE),
    ("payload 0.1 × the arm", &PAYLOAD_TENTH),
    ("payload 1 × the arm", &PAYLOAD_ONE),
    ("payload 10 × the arm", &PAYLOAD_TEN),
];

const TIP_HEAVY: ErrorBounds = ErrorBounds {
    single: [6e-7, 1e-3, 8e-4, 6e-5, 3e-6],
    double: [1.5e-15, 2e-12, 2e-12, 2e-13, 8e-15],
};

const TIP_LIGHT: ErrorBounds = ErrorBounds {
    single: [5e-7, 5e-6, 6e-6, 4e-7, 6e-7],
    double: [1e-15, 8e-15, 1e-14, 1.5e-15, 8e-16],
};

const BASE_HEAVY: ErrorBounds = ErrorBounds {
    single: [4e-7, 5e-6, 5e-6, 3e-7, 3e-7],
    double: [8e-16, 1e-14, 8e-15, 1.5e-15, 6e-16],
};

const WRIST: ErrorBounds = ErrorBounds {
    single: [4e-7, 2e-5, 1e-5, 2e-6, 1e-6],
    double: [8e-16, 2e-14, 4e-14, 4e-15, 2e-15],
};

const ARMATURE: ErrorBounds = ErrorBounds {
    single: [5e-7, 3e-6, 8e-6, 5e-7, 4e-7],
    double: [8e-16, 6e-15, 1e-14, 1.5e-15, 8e-16],
};

const LIGHT_LINKS: ErrorBounds = ErrorBounds {
    single: [6e-7, 3e-2, 1.5e-2, 7e-5, 6e-5],
    double: [1e-15, 4e-11, 4e-11, 2e-13, 6e-14],
};

const PAYLOAD_NONE: ErrorBounds = ErrorBounds {
    single: [4e-7, 6e-6, 5e-6, 6e-7, 4e-7],
    double: [8e-16, 1e-14, 1.5e-14, 6e-16, 6e-16],
};

const PAYLOAD_TENTH: ErrorBounds = ErrorBounds {
    single: [4e-7, 4e-6, 3e-6, 4e-7, 3e-7],
    double: [1.5e-15, 8e-15, 8e-15, 1.5e-15, 1e-15],
};

const PAYLOAD_ONE: ErrorBounds = ErrorBounds {
    single: [5e-7, 6e-6, 2e-5, 1.5e-6, 8e-7],
    double: [1e-15, 2e-14, 1.5e-14, 1.5e-15, 4e-15],
};

const PAYLOAD_TEN: ErrorBounds = ErrorBounds {
    single: [8e-7, 3e-5, 8e-5, 8e-6, 8e-6],
    double: [1e-15, 4e-14, 1e-13, 8e-15, 1.5e-14],
};
