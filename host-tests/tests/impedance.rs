//! Cartesian impedance control: the spring and the damping that an arm shows, its null space, and singular postures.

mod common;

use common::*;
use dynamics_core::algorithms::{
    Conditioning, Damping, OperationalSpace, Pose, frame, kinematics, operational_space, rnea,
};
use dynamics_core::control::{
    CartesianImpedance, Fault, ImpedanceConfig, TaskDeviation, TaskFrame, pose_error,
    quaternion_error,
};
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, Inertia, hook};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use glam::{DMat3, DQuat, DVec3};

const STIFFNESS: [f64; 6] = [40.0, 40.0, 40.0, 400.0, 400.0, 400.0];
const CONFIG: ImpedanceConfig<f64, 6> = ImpedanceConfig {
    stiffness: STIFFNESS,
    zeta: 0.5,
    slowest: 2.0,
};
const UR5E: [f64; 6] = [0.2, -1.2, 1.5, 0.3, 0.7, 0.1];
const PANDA: [f64; 7] = [0.3, -0.4, 0.2, -2.0, 0.3, 1.9, 0.5];

/// A constant force on the origin of a body, N, along the base's axes.
#[derive(Clone, Copy)]
struct Push {
    body: usize,
    force: DVec3,
}

impl<const B: usize, const V: usize> Effect<f64, B, V> for Push {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
        hook::Wrench::of_state(|push, body, at, fx| {
            if body == push.body {
                fx.lin += at.pose.rot * push.force;
            }
        });
}

/// An arm on an impedance.
struct Sprung<const N: usize> {
    arm: ArmModel<f64, N>,
    impedance: CartesianImpedance<f64, 6>,
    goal: Pose<f64>,
    state: State<f64, N, N>,
    /// The wanted posture, its stiffness and damping; `projected`: only in the null space.
    posture: ([f64; N], f64, f64),
    projected: bool,
    damping: Damping<f64>,
}

type Task<const N: usize> = OperationalSpace<f64, 6, N>;

impl<const N: usize> Sprung<N> {
    /// At rest at its goal.
    fn at(arm: ArmModel<f64, N>, q: [f64; N]) -> Self {
        let state = State::at(q);
        Self {
            arm,
            impedance: CartesianImpedance::try_new(CONFIG).unwrap(),
            goal: kinematics(&arm, &state, &()).poses[N - 1],
            state,
            posture: (q, 0.0, 4.0),
            projected: true,
            damping: Damping::relative(1e-4),
        }
    }

    fn rotors() -> Armature<f64, N> {
        Armature([0.3; N])
    }

    fn task(&self) -> Task<N> {
        let scene = (Inertia, Self::rotors());
        let directions = TaskFrame::BASE.turn_and_place(1.0);
        let tip = (N - 1, frame::LocalWorldAligned);
        operational_space(
            &self.arm,
            &self.state.q,
            tip,
            &directions,
            &scene,
            self.damping,
        )
        .unwrap()
    }

    fn deviation(&self) -> TaskDeviation<f64, 6> {
        let directions = TaskFrame::BASE.turn_and_place(1.0);
        let tip = kinematics(&self.arm, &self.state, &());
        let off = pose_error(&tip.poses[N - 1], &self.goal);
        let v = tip.velocity(N - 1, frame::LocalWorldAligned);
        TaskDeviation {
            position: directions.map(|d| off.dot(d)),
            velocity: directions.map(|d| -v.dot(d)),
        }
    }

    fn torque(&self) -> Result<([f64; N], Conditioning<f64>), Fault> {
        let rest = State::at(self.state.q);
        let bias = rnea(&self.arm, &rest, &Gravity::EARTH);
        let (wanted, kn, dn) = self.posture;
        let free =
            core::array::from_fn(|i| kn * (wanted[i] - self.state.q[i]) - dn * self.state.qd[i]);
        let (mut bias, mut posture) = (bias, free);
        if !self.projected {
            bias = core::array::from_fn(|i| bias[i] + free[i]);
            posture = [0.0; N];
        }
        let out = self
            .impedance
            .torque(&self.task(), &self.deviation(), &bias, &posture)?;
        Ok((out.tau, out.conditioning))
    }

    /// A tick of h seconds under a push.
    fn advance(&mut self, push: DVec3, h: f64) {
        let (tau, _) = self.torque().unwrap();
        let push = Push {
            body: N - 1,
            force: push,
        };
        let scene = ((Gravity::EARTH, Inertia, Coriolis), (Self::rotors(), push));
        semi_implicit(&self.arm, &mut self.state, &tau, &scene, h).unwrap();
    }
}

/// The displacement by a force after it has settled, and that of the spring; m and rad.
fn displaced<const N: usize>(mut sprung: Sprung<N>, worst: &mut Worst) {
    let push = DVec3::new(20.0, -12.0, 8.0);
    (0..4000).for_each(|_| sprung.advance(push, 2e-3));
    let moved = sprung.deviation().position.map(|x| -x);
    let [x, y, z] = (push / STIFFNESS[5]).to_array();
    worst.see(moved, [0.0, 0.0, 0.0, x, y, z]);
}

#[test]
fn a_force_on_the_tip_displaces_it_by_force_over_stiffness_whatever_the_posture() {
    let mut worst = [(); 2].map(|()| Worst::default());
    displaced(Sprung::at(Ur5e::MODEL, UR5E), &mut worst[0]);
    displaced(Sprung::at(Panda::MODEL, PANDA), &mut worst[1]);
    // A posture that pulls on the elbow does not change that.
    let mut pulled = Sprung::at(Panda::MODEL, PANDA);
    pulled.posture = (PANDA.map(|q| q + 0.5), 5.0, 4.0);
    displaced(pulled, &mut worst[1]);
    let mut verdict = Verdict::default();
    verdict.see("ur5e", "displacement of an impedance", "f64", &worst[0]);
    verdict.see("panda", "displacement of an impedance", "f64", &worst[1]);
    verdict.speak();
    // Outside the null space it does.
    let mut pulled = Sprung::at(Panda::MODEL, PANDA);
    (pulled.posture.0, pulled.posture.1) = (PANDA.map(|q| q + 0.5), 5.0);
    pulled.projected = false;
    let mut off = Worst::default();
    displaced(pulled, &mut off);
    assert!(off.error > 0.1 * off.full_scale, "{:e}", off.error);
}

fn times(m: &[[f64; 6]; 6], x: [f64; 6]) -> [f64; 6] {
    m.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum())
}

/// The force along which the fastest or the slowest mode moves alone, K Λ⁻¹ f = ω² f, of 1 N·m or N at most, and ω.
fn mode<const N: usize>(task: &Task<N>, fastest: bool) -> ([f64; 6], f64) {
    let (mut f, mut square) = ([1.0, 0.8, -0.6, 0.4, 0.3, -0.7], 0.0);
    for _ in 0..2000 {
        let next = if fastest {
            let x = times(&task.mobility, f);
            core::array::from_fn(|i| STIFFNESS[i] * x[i])
        } else {
            times(&task.inertia, core::array::from_fn(|i| f[i] / STIFFNESS[i]))
        };
        let most = next.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        (f, square) = (next.map(|x| x / most), most);
    }
    (
        f,
        if fastest {
            square.sqrt()
        } else {
            1.0 / square.sqrt()
        },
    )
}

/// The damping ratio of a mode by how far an arm, released from a small displacement along it, swings beyond its goal.
fn damping_ratio<const N: usize>(mut sprung: Sprung<N>, fastest: bool) -> f64 {
    let (f, omega) = mode(&sprung.task(), fastest);
    // The goal moves, not the arm: by a small translation and rotation along K⁻¹ f.
    let [a, b, c, x, y, z] = core::array::from_fn(|i| 1e-4 * f[i] / STIFFNESS[i]);
    sprung.goal.pos += DVec3::new(x, y, z);
    sprung.goal.rot =
        DMat3::from_quat(DQuat::from_scaled_axis(DVec3::new(a, b, c))) * sprung.goal.rot;
    let along = |sprung: &Sprung<N>| -> f64 {
        f.iter()
            .zip(sprung.deviation().position)
            .map(|(f, x)| f * x)
            .sum()
    };
    let (start, h) = (along(&sprung), 2e-3 / omega);
    let mut beyond = 0.0_f64;
    for _ in 0..3000 {
        sprung.advance(DVec3::ZERO, h);
        beyond = beyond.max(-along(&sprung) / start);
    }
    let log = -beyond.ln();
    log / log.hypot(core::f64::consts::PI)
}

#[test]
fn the_fastest_and_the_slowest_mode_swing_with_the_damping_ratio() {
    let mut worst = [(); 2].map(|()| Worst::default());
    for zeta in [0.3, 0.5, 0.7] {
        let config = ImpedanceConfig { zeta, ..CONFIG };
        let impedance = CartesianImpedance::try_new(config).unwrap();
        for fastest in [true, false] {
            let ur5e = Sprung {
                impedance,
                ..Sprung::at(Ur5e::MODEL, UR5E)
            };
            worst[0].see([damping_ratio(ur5e, fastest)], [zeta]);
            let panda = Sprung {
                impedance,
                ..Sprung::at(Panda::MODEL, PANDA)
            };
            worst[1].see([damping_ratio(panda, fastest)], [zeta]);
        }
    }
    let mut verdict = Verdict::default();
    verdict.see("ur5e", "damping ratio of a mode", "f64", &worst[0]);
    verdict.see("panda", "damping ratio of a mode", "f64", &worst[1]);
    verdict.speak();
}

/// D Λ⁻¹ D and 4 ζ² K at random poses, and what the same says of a damping of each direction by itself.
#[test]
fn the_damping_diagonalises_inertia_and_stiffness_at_once() {
    let (mut rng, mut worst) = (Rng::new(41), [(); 3].map(|()| Worst::default()));
    let impedance = CartesianImpedance::try_new(CONFIG).unwrap();
    let small = CartesianImpedance::try_new(ImpedanceConfig {
        stiffness: STIFFNESS.map(|k| k as f32),
        zeta: 0.5,
        slowest: 2.0,
    })
    .unwrap();
    let mut regular = 0;
    for _ in 0..300 {
        let task = Sprung::at(Panda::MODEL, rng.vector(2.5)).task();
        let (d, how) = impedance.damping(&task.mobility);
        for i in 0..6 {
            for j in 0..6 {
                assert_eq!(d[i][j].to_bits(), d[j][i].to_bits());
            }
        }
        if how != Conditioning::Regular {
            continue;
        }
        regular += 1;
        let mut see = |k: usize, d: [[f64; 6]; 6]| {
            for (i, row) in d.iter().enumerate() {
                let through = times(&task.mobility, *row);
                let want = core::array::from_fn(|j| if i == j { STIFFNESS[i] } else { 0.0 });
                worst[k].see(times(&d, through), want);
            }
        };
        see(0, d);
        let mobility = task.mobility.map(|row| row.map(|x| x as f32));
        see(1, small.damping(&mobility).0.map(|row| row.map(f64::from)));
        see(
            2,
            core::array::from_fn(|i| {
                core::array::from_fn(|j| {
                    let own = (STIFFNESS[i] * task.inertia[i][i]).sqrt();
                    if i == j { own } else { 0.0 }
                })
            }),
        );
    }
    assert!(regular > 200, "{regular}");
    let mut verdict = Verdict::default();
    verdict.see("panda", "damping of an impedance", "f64", &worst[0]);
    verdict.see("panda", "damping of an impedance", "f32", &worst[1]);
    verdict.speak();
    assert!(worst[2].error > 0.1 * worst[2].full_scale);
}

#[test]
fn a_motion_of_the_elbow_does_not_move_the_tip() {
    let swing = |projected| {
        let mut sprung = Sprung::at(Panda::MODEL, PANDA);
        let config = ImpedanceConfig {
            zeta: 1.0,
            ..CONFIG
        };
        sprung.impedance = CartesianImpedance::try_new(config).unwrap();
        sprung.projected = projected;
        sprung.posture = (PANDA, 20.0, 15.0);
        sprung.posture.0[2] += 1.0;
        let (mut off, mut elbow) = (0.0_f64, 0.0_f64);
        for _ in 0..3000 {
            sprung.advance(DVec3::ZERO, 1e-3);
            let [.., x, y, z] = sprung.deviation().position;
            off = off.max(DVec3::new(x, y, z).length());
            elbow = elbow.max((sprung.state.q[2] - PANDA[2]).abs());
        }
        (off, elbow)
    };
    let ((off, elbow), (without, _)) = (swing(true), swing(false));
    assert!(elbow > 0.2, "{elbow}");
    let mut verdict = Verdict::default();
    let worst = Worst {
        error: off,
        full_scale: 1.0,
    };
    verdict.see("panda", "tip by a motion of the elbow, m", "f64", &worst);
    verdict.speak();
    assert!(without > 20.0 * off, "{without} {off}");
}

/// The largest step of a torque between neighbours in a sweep through the stretched elbow, N·m.
fn largest_step(impedance: CartesianImpedance<f64, 6>, damping: f64, steps: i32) -> f64 {
    let (mut last, mut largest, mut damped) = (None, 0.0_f64, false);
    for k in -steps..=steps {
        let mut sprung = Sprung::at(Ur5e::MODEL, UR5E);
        let elbow = 0.3 * f64::from(k) / f64::from(steps);
        sprung.goal.pos += DVec3::new(0.3, 0.2, 0.4);
        sprung.goal.rot = DMat3::from_rotation_x(0.8) * sprung.goal.rot;
        sprung.impedance = impedance;
        sprung.damping = Damping::relative(damping);
        sprung.posture.1 = 20.0;
        sprung.state.q = [0.2, -1.2, elbow, 0.3, 0.7, 0.1];
        sprung.state.qd = [0.3, 0.4, 1.0, -0.5, 0.2, 0.1];
        let (tau, how) = sprung.torque().unwrap();
        damped |= how != Conditioning::Regular;
        if let Some(last) = last.replace(tau) {
            let steps = tau
                .iter()
                .zip(last)
                .map(|(a, b): (&f64, f64)| (a - b).abs());
            largest = steps.fold(largest, f64::max);
        }
    }
    assert!(damped, "the sweep meets the singularity");
    largest
}

#[test]
fn the_torque_does_not_jump_where_the_elbow_passes_its_stretched_posture() {
    let impedance = CartesianImpedance::try_new(CONFIG).unwrap();
    let [coarse, fine] = [200, 2000].map(|steps| largest_step(impedance, 1e-4, steps));
    // Of a function with a slope, steps go to zero with the distance of the neighbours.
    assert!(fine < 0.15 * coarse, "{coarse} {fine}");
    // Without damping of the null space and of slow modes they do not.
    let config = ImpedanceConfig {
        slowest: 1e-9,
        ..CONFIG
    };
    let naive = CartesianImpedance::try_new(config).unwrap();
    let [coarse, fine] = [200, 2000].map(|steps| largest_step(naive, 0.0, steps));
    assert!(fine > 0.5 * coarse, "{coarse} {fine}");
}

#[test]
fn the_shortest_rotation_is_found_from_every_attitude() {
    let (mut rng, mut worst) = (Rng::new(43), [(); 2].map(|()| Worst::default()));
    for k in 0..2000 {
        let from = DQuat::from_slice(&rng.vector::<4>(1.0)).normalize();
        let axis = DVec3::from(rng.vector(1.0)).normalize();
        // Every tenth within 10⁻⁹ of half a turn or of none.
        let angle = match k % 20 {
            0 => core::f64::consts::PI - 1e-9,
            10 => 1e-9,
            _ => rng.within(3.1),
        };
        let to = DQuat::from_axis_angle(axis, angle) * from;
        let want = axis * (2.0 * (0.5 * angle).sin());
        let (from, to) = (DMat3::from_quat(from), DMat3::from_quat(to));
        worst[0].see(
            quaternion_error::<f64>(&from, &to).to_array(),
            want.to_array(),
        );
        let error = quaternion_error::<f32>(&from.as_mat3(), &to.as_mat3()).as_dvec3();
        // In f32 half a turn has two directions.
        let error = if angle > 3.14 && error.dot(want) < 0.0 {
            -error
        } else {
            error
        };
        worst[1].see(error.to_array(), want.to_array());
    }
    let mut verdict = Verdict::default();
    verdict.see("rotations", "shortest rotation", "f64", &worst[0]);
    verdict.see("rotations", "shortest rotation", "f32", &worst[1]);
    verdict.speak();
    for half in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE.normalize()] {
        let turn = DMat3::from_quat(DQuat::from_xyzw(half.x, half.y, half.z, 0.0));
        let error = quaternion_error::<f64>(&DMat3::IDENTITY, &turn);
        assert!((error.length() - 2.0).abs() < 1e-15 && error.cross(half).length() < 1e-15);
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let mut sprung = Sprung::at(Ur5e::MODEL, UR5E);
    assert!(sprung.torque().is_ok());
    sprung.state.qd[2] = f64::NAN;
    assert_eq!(sprung.torque(), Err(Fault::NotFinite { joint: 0 }));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let stiffness = [40.0, bad, 40.0, 400.0, 400.0, 400.0];
        let configs = [
            ImpedanceConfig {
                stiffness,
                ..CONFIG
            },
            ImpedanceConfig {
                zeta: bad,
                ..CONFIG
            },
            ImpedanceConfig {
                slowest: bad,
                ..CONFIG
            },
        ];
        for config in configs {
            assert!(CartesianImpedance::try_new(config).is_err());
        }
    }
}

#[test]
fn the_damping_is_bounded_where_a_mode_has_no_frequency() {
    let impedance = CartesianImpedance::try_new(CONFIG).unwrap();
    let (d, how) = impedance.damping(&[[0.0; 6]; 6]);
    assert_eq!(how, Conditioning::Damped { smallest: 0.0 });
    let bound = 3.0 * CONFIG.zeta * STIFFNESS[5] / CONFIG.slowest;
    assert!((d[5][5] - bound).abs() < 1e-9, "{}", d[5][5]);
    // Nor does rounding of a singular mobility, here in f32, exceed the bound.
    let slow = CartesianImpedance::try_new(ImpedanceConfig {
        stiffness: STIFFNESS.map(|k| k as f32),
        zeta: 0.5,
        slowest: 1e-2,
    })
    .unwrap();
    for q4 in [0.0, 0.3, 0.6] {
        let task = Sprung::at(Ur5e::MODEL, [0.2, -1.2, 0.0, q4, 0.7, 0.1]).task();
        let (d, how) = slow.damping(&task.mobility.map(|row| row.map(|x| x as f32)));
        assert!(how != Conditioning::Regular);
        for i in 0..6 {
            let bound = 3.0 * 0.5 * STIFFNESS[i] / 1e-2;
            assert!(f64::from(d[i][i]) < bound * (1.0 + 1e-6), "{}", d[i][i]);
        }
    }
    let (d, how) = impedance.damping(&[[f64::NAN; 6]; 6]);
    assert!(d[0][0].is_nan() && how != Conditioning::Regular);
}
