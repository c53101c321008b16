//! The damping: its modes, by how an arm swings and by the law that defines it.

use crate::common::*;
use crate::impedance::plant::*;
use dynamics_core::algorithms::Conditioning;
use dynamics_core::model::Robot;
use dynamics_core::robots::{Panda, Ur5e};
use glam::{DMat3, DQuat, DVec3};
use motion_control::law::{CartesianImpedance, ImpedanceConfig};

fn times(m: &[[f64; 6]; 6], x: [f64; 6]) -> [f64; 6] {
    m.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum())
}

/// The force along which the fastest or the slowest mode moves alone, K Λ⁻¹ f = ω² f, of 1 N·m or N
/// at most, and ω.
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
    (f, if fastest { square.sqrt() } else { 1.0 / square.sqrt() })
}

/// The damping ratio of a mode by how far an arm, released from a small displacement along it,
/// swings beyond its goal.
fn damping_ratio<const N: usize>(mut sprung: Sprung<N>, fastest: bool) -> f64 {
    let (f, omega) = mode(&sprung.task(), fastest);
    // The goal moves, not the arm: by a small translation and rotation along K⁻¹ f.
    let [a, b, c, x, y, z] = core::array::from_fn(|i| 1e-4 * f[i] / STIFFNESS[i]);
    sprung.goal.pos += DVec3::new(x, y, z);
    sprung.goal.rot =
        DMat3::from_quat(DQuat::from_scaled_axis(DVec3::new(a, b, c))) * sprung.goal.rot;
    let along = |sprung: &Sprung<N>| -> f64 {
        f.iter().zip(sprung.deviation().position).map(|(f, x)| f * x).sum()
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
fn the_fastest_and_slowest_modes_have_the_damping_ratio() {
    let mut worst = [(); 2].map(|()| Worst::default());
    for zeta in [0.3, 0.5, 0.7] {
        let config = ImpedanceConfig { zeta, ..CONFIG };
        let impedance = CartesianImpedance::try_new(config).unwrap();
        for fastest in [true, false] {
            let ur5e = Sprung { impedance, ..Sprung::at(Ur5e::MODEL, UR5E) };
            worst[0].see([damping_ratio(ur5e, fastest)], [zeta]);
            let panda = Sprung { impedance, ..Sprung::at(Panda::MODEL, PANDA) };
            worst[1].see([damping_ratio(panda, fastest)], [zeta]);
        }
    }
    let mut verdict = Verdict::default();
    verdict.see("ur5e", "damping ratio of a mode", "f64", &worst[0]);
    verdict.see("panda", "damping ratio of a mode", "f64", &worst[1]);
    verdict.speak();
}

/// D Λ⁻¹ D and 4 ζ² K at random poses, and what the same says of a damping of each direction by
/// itself.
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
        let transposed: [[f64; 6]; 6] = core::array::from_fn(|i| d.map(|row| row[i]));
        assert_eq!(d, transposed);
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
