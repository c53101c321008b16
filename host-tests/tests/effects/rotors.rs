//! Rotors that spin as bodies, compared with the tree in which they are bodies.

use super::*;
use dynamics_core::MassMatrix;
use dynamics_core::algorithms::{
    Prescribed, aba, crba, crba_jacobian, forward_dynamics, hybrid_dynamics, kinetic_energy,
    momentum, momentum_and_coriolis, rnea,
};
use dynamics_core::drivetrain::Transmission;
use dynamics_core::effects::{GyroscopicRotors, MovingBase, RIGID_BODY};
use dynamics_core::spatial::Motion;
use glam::DVec3;
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};

/// Mass, place of the centre on the axis, transverse and axial inertia of a rotor.
const ROTORS: [[f64; 4]; 4] = [
    [0.8, 0.05, 3e-3, 2e-3],
    [0.6, -0.04, 2e-3, 1.5e-3],
    [0.5, 0.02, 1e-3, 1e-3],
    [0.3, 0.03, 8e-4, 6e-4],
];
/// Low, as where it matters; one gear turns the other way, one joint is a screw-driven slide
/// (rad/m).
const RATIOS: [f64; 4] = [6.0, -4.0, 9.0, 40.0];
const AXES: [[f64; 3]; 4] = [[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
const PLACES: [[f64; 3]; 4] = [[0.0, 0.0, 0.3], [0.1, 0.2, 0.1], [0.4, 0.0, 0.1], [0.2, 0.1, 0.0]];
const TURNS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.3, -0.2, 0.5], [1.0, 0.2, 0.0], [0.0, 0.7, 0.4]];
/// A tree: the third and the fourth joint both stand on the second link.
const PARENTS: [usize; 4] = [BASE, 0, 1, 1];

fn joint_of(i: usize) -> Joint<f64> {
    if i == 3 { Joint::prismatic(AXES[i]) } else { Joint::revolute(AXES[i]) }
}

fn link(i: usize, parent: usize) -> Body {
    const NAMES: [&str; 4] = ["column", "boom", "jib", "quill"];
    Body::new(NAMES[i], parent, joint_of(i))
        .xyz(PLACES[i])
        .rpy(TURNS[i])
        .mass(3.0 - 0.5 * i as f64)
        .com([0.1, -0.05, 0.12])
        .inertia([0.05, 0.004, -0.003, 0.06, 0.002, 0.04])
}

/// A rotor as a body: at its joint's place on the parent link, on the joint's axis.
fn rotor(i: usize, parent: usize, joint: Joint<f64>) -> Body {
    let [mass, along, across, axial] = ROTORS[i];
    let a = DVec3::from(AXES[i]);
    // across 1 + (axial − across) a aᵀ
    let of = |r: usize, c: usize| {
        let eye = if r == c { across } else { 0.0 };
        eye + (axial - across) * a[r] * a[c]
    };
    Body::new("rotor", parent, joint)
        .xyz(PLACES[i])
        .rpy(TURNS[i])
        .mass(mass)
        .com((a * along).to_array())
        .inertia([of(0, 0), of(0, 1), of(0, 2), of(1, 1), of(1, 2), of(2, 2)])
}

/// Links with their rotors: locked to the parents (fixed joints), or turning.
fn robot<const V: usize>(locked: bool) -> Model<f64, 8, V, V> {
    let bodies = core::array::from_fn(|k| {
        let (i, is_rotor) = (k / 2, k % 2 == 0);
        let parent = if PARENTS[i] == BASE { BASE } else { 2 * PARENTS[i] + 1 };
        if !is_rotor {
            link(i, parent)
        } else if locked {
            rotor(i, parent, Joint::fixed())
        } else {
            rotor(i, parent, Joint::revolute(AXES[i]))
        }
    });
    Model::try_new("geared", bodies).unwrap()
}

fn gears() -> Transmission<f64, 4, 8> {
    Transmission {
        matrix: core::array::from_fn(|k| {
            let mut row = [0.0; 4];
            row[k / 2] = if k % 2 == 0 { RATIOS[k / 2] } else { 1.0 };
            row
        }),
        offset: [0.0; 8],
    }
}

const GYROSCOPIC_ROTORS: GyroscopicRotors<f64, 4> = GyroscopicRotors {
    inertia: [ROTORS[0][3], ROTORS[1][3], ROTORS[2][3], ROTORS[3][3]],
    ratio: RATIOS,
};

// The expanded tree has the rotors as bodies.
#[test]
fn gyroscopic_rotors_have_the_expanded_trees_dynamics() {
    let (compact, expanded) = (robot::<4>(true), robot::<8>(false));
    let (gears, rng) = (gears(), &mut random_numbers());
    let base = MovingBase::<f64> {
        velocity: Motion::new(DVec3::new(0.3, -0.5, 0.7), DVec3::new(0.1, 0.2, -0.3)),
        acceleration: Motion::new(DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.4, 1.0, -2.0)),
    };
    let still = MovingBase::<f64>::default();
    let mut worst: [Worst; 7] = Default::default();
    let mut single = Worst::default();
    for i in 0..400 {
        let [q, qd, qdd] = [3.0, 3.0, 10.0].map(|bound| within::<4>(rng, bound));
        let state = State { q, qd, qdd };
        let base = if i % 2 == 0 { still } else { base };
        let rigid = (RIGID_BODY, base);
        let scene = (RIGID_BODY, GYROSCOPIC_ROTORS, base);

        let tau = rnea(&compact, &state, &scene);
        let all = gears.state(&state);
        let want = gears.torque(&rnea(&expanded, &all, &rigid));
        worst[0].see_all(&tau, &want);
        if i % 2 == 0 {
            let rotors = GyroscopicRotors {
                inertia: GYROSCOPIC_ROTORS.inertia.map(|x| x as f32),
                ratio: GYROSCOPIC_ROTORS.ratio.map(|x| x as f32),
            };
            let got = rnea(&compact.to_f32(), &cast::<f32, 4>(&state), &(RIGID_BODY, rotors));
            single.see_all(&got, &want);
        }

        let rows = |m: MassMatrix<f64, 4>| [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| m.get(i, j)));
        let want = rows(gears.inertia(&crba(&expanded, &all.q, &rigid)));
        let (composite, _) = crba_jacobian(&compact, &q, 3, &scene);
        for m in [crba(&compact, &q, &scene), composite] {
            for (got, want) in rows(m).iter().zip(&want) {
                worst[1].see_all(got, want);
            }
        }

        worst[2].see_all(&aba(&compact, &state, &tau, &scene).unwrap(), &qdd);
        worst[2].see_all(&forward_dynamics(&compact, &state, &tau, &scene).unwrap(), &qdd);
        let mut given = tau.map(Prescribed::Torque);
        given[1] = Prescribed::Acceleration(qdd[1]);
        given[3] = Prescribed::Acceleration(qdd[3]);
        let response = hybrid_dynamics(&compact, &state, &given, &scene).unwrap();
        worst[2].see_all(&response.qdd, &qdd);
        worst[0].see_all(&response.tau, &tau);

        let energy = kinetic_energy(&compact, &state, &scene);
        worst[3].see(energy, kinetic_energy(&expanded, &all, &rigid));
        let [got, want] = [momentum(&compact, &state, &scene), momentum(&expanded, &all, &rigid)];
        worst[4].see_all(&got.ang.to_array(), &want.ang.to_array());
        worst[4].see_all(&got.lin.to_array(), &want.lin.to_array());
        let got = momentum_and_coriolis(&compact, &state, &scene);
        let want = momentum_and_coriolis(&expanded, &all, &rigid);
        worst[5].see_all(&got.p, &gears.torque(&want.p));
        worst[6].see_all(&got.ct_qd, &gears.torque(&want.ct_qd));
    }
    let names = ["rnea", "crba", "aba", "kinetic energy", "momentum", "M qd", "Cᵀ qd"];
    single.check::<f32>("spinning rotors", "rnea");
    for (worst, name) in worst.iter().zip(names) {
        assert!(worst.error <= 1e-12 * worst.full_scale.max(1.0) || name == "aba", "{name}");
        worst.check::<f64>("spinning rotors", name);
    }
}

#[test]
fn at_high_ratios_rotors_act_as_armatures() {
    use dynamics_core::effects::Armature;
    let (compact, rng) = (robot::<4>(true), &mut random_numbers());
    let [q, qd, qdd] = [3.0, 3.0, 10.0].map(|bound| within::<4>(rng, bound));
    let state = State { q, qd, qdd };
    let error = |ratio: f64| {
        // The reflected inertia stays the same, the coupling ρ I falls with 1/ρ.
        let inertia = [0.05; 4].map(|reflected| reflected / (ratio * ratio));
        let full = GyroscopicRotors { inertia, ratio: [ratio; 4] };
        let full = rnea(&compact, &state, &(RIGID_BODY, full));
        let less = rnea(&compact, &state, &(RIGID_BODY, Armature([0.05; 4])));
        largest((0..4).map(|i| (full[i] - less[i]).abs()))
    };
    for ratio in [10.0, 100.0] {
        let halved = error(ratio) / error(2.0 * ratio);
        assert!((halved - 2.0).abs() < 1e-6, "{halved}");
    }
}
