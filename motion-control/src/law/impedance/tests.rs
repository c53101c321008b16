use dynamics_core::Core;
use dynamics_core::algorithms::{frame, jacobian_rows};
use dynamics_core::effects::{Armature, Inertia};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;

use super::*;

mod numbers;

fn law<R: Real>() -> CartesianImpedance<R, 6> {
    let stiffness = [30.0, 30.0, 30.0, 600.0, 600.0, 600.0].map(R::from_f64);
    let [zeta, slowest] = [0.7, 2.0].map(R::from_f64);
    let config = ImpedanceConfig { stiffness, zeta, slowest };
    CartesianImpedance::try_new(config).expect("a good one")
}

/// Posture, rates along the directions and torques of a posture at a time, s; the elbow passes the
/// stretched arm.
fn at<R: Real>(t: f64, speed: f64) -> [[R; 6]; 3] {
    let each = |f: &dyn Fn(f64) -> f64| core::array::from_fn(|i| R::from_f64(f(i as f64)));
    let middle = [0.2, -1.2, 0.0, 0.3, 0.7, 0.1];
    [
        core::array::from_fn(|i| {
            let w = 1.0 + 0.37 * i as f64;
            R::from_f64(middle[i] + speed / w * (w * t).sin())
        }),
        each(&|i| 0.4 * (3.0 * t + 2.0 * i).sin()),
        each(&|i| 5.0 * (2.0 * t + i).cos()),
    ]
}

/// The torques of damper and null space there.
fn tick<R: Real>(
    law: &mut CartesianImpedance<R, 6>,
    [q, velocity, posture]: &[[R; 6]; 3],
) -> Result<ImpedanceTorque<R, 6>, Fault> {
    let rows = jacobian_rows(&Core::<Ur5e>::jacobian(q, 5, frame::LocalWorldAligned));
    let rotors = Armature([R::from_f64(0.01); 6]);
    let m = Core::<Ur5e>::crba(q, &(Inertia, rotors));
    let factors = Core::<Ur5e>::ltdl(&m).expect("an arm with mass");
    let deviation = TaskDeviation { position: [R::ZERO; 6], velocity: *velocity };
    let solve = |tau: &_| Core::<Ur5e>::solve(&factors, tau);
    law.torque(&rows, solve, &deviation, &[R::ZERO; 6], posture)
}

/// The largest difference of its torques from those of modes that are searched anew in f64, as a
/// share of the largest torque, and the ticks that took one pass.
fn over<R: Real>(ticks: u32, speed: f64) -> (f64, u32) {
    let (mut follows, mut error, mut most, mut followed) = (law::<R>(), 0.0_f64, 0.0_f64, 0);
    for k in 0..ticks {
        let t = 1e-3 * f64::from(k);
        let got = tick(&mut follows, &at(t, speed)).expect("finite");
        let want = tick(&mut law::<f64>(), &at(t, speed)).expect("finite");
        assert!(matches!(want.modes, ModeSearch::Searched { passes: ..=5 }));
        assert!(got.modes != ModeSearch::Coupled);
        followed += u32::from(got.modes == ModeSearch::Followed);
        for (got, want) in got.tau.iter().zip(want.tau) {
            error = error.max((got.to_f64() - want).abs());
            most = most.max(want.abs());
        }
    }
    (error / most, followed)
}

// Ten seconds at 1 and at 3 rad/s of every joint, through the stretched elbow and other singular
// postures.
#[test]
fn modes_that_follow_the_arm_are_those_of_its_postures() {
    for (speed, bound, least) in [(1.0, 2e-5, 9_999), (3.0, 5e-5, 9_500)] {
        let (error, followed) = over::<f32>(10_000, speed);
        std::println!("f32 {speed} rad/s: {error:e}, one pass in {followed}");
        assert!(error < bound && followed >= least, "{error:e} {followed}");
    }
    let (error, _) = over::<f64>(10_000, 3.0);
    std::println!("f64: {error:e}");
    assert!(error < 1e-11, "{error:e}");
}

/// The torques of D by eigenvectors at a posture.
fn by_eigenvectors<R: Real>([q, velocity, _]: &[[R; 6]; 3]) -> ([R; 6], Conditioning<R>) {
    let rows = jacobian_rows(&Core::<Ur5e>::jacobian(q, 5, frame::LocalWorldAligned));
    let m = Core::<Ur5e>::crba(q, &(Inertia, Armature([R::from_f64(0.01); 6])));
    let factors = Core::<Ur5e>::ltdl(&m).expect("an arm with mass");
    let x = rows.map(|row| Core::<Ur5e>::solve(&factors, &row));
    let (d, how) = law::<R>().damping(&rows.map(|row| x.map(|x| dot(&row, &x))));
    (combine(&rows, &d.map(|row| dot(&row, velocity))), how)
}

// It is the law that defines D; in f32 the modes lose fewer digits than eigenvectors of Λ⁻¹ do.
#[test]
fn the_damper_is_that_of_double_diagonalisation() {
    let mut worst = [0.0_f64; 3];
    for k in 0..300 {
        let t = 0.1 * f64::from(k);
        let (mut double, mut single) = (at::<f64>(t, 2.0), at::<f32>(t, 2.0));
        (double[2], single[2]) = ([0.0; 6], [0.0; 6]);
        let (want, how) = by_eigenvectors(&double);
        let got = tick(&mut law::<f64>(), &double).expect("finite");
        let regular = [got.conditioning, how].map(|how| how == Conditioning::Regular);
        assert_eq!(regular[0], regular[1]);
        let singles =
            [tick(&mut law::<f32>(), &single).expect("finite").tau, by_eigenvectors(&single).0];
        for (i, want) in want.into_iter().enumerate() {
            let all = [got.tau[i], singles[0][i].into(), singles[1][i].into()];
            for (worst, x) in worst.iter_mut().zip(all) {
                *worst = worst.max((x - want).abs());
            }
        }
    }
    std::println!("{worst:?} N·m");
    assert!(worst[0] < 1e-11 && worst[1] < worst[2], "{worst:?}");
}

#[test]
fn a_memory_that_is_spoilt_is_forgotten() {
    let (good, mut fresh) = (at::<f32>(0.3, 1.0), law::<f32>());
    let want = tick(&mut fresh, &good).expect("finite").tau;
    assert_eq!(tick(&mut fresh, &good).expect("finite").modes, ModeSearch::Followed);
    for (k, spoilt) in [f32::NAN, f32::INFINITY, 0.0, 1e20].into_iter().enumerate() {
        let mut law = fresh;
        law.modes.vectors[k] = [spoilt; 6];
        // Columns that are finite are compared in turn.
        let all = (0..6).map(|_| tick(&mut law, &good).expect("finite"));
        let (mut searched, mut last) = (0, [0.0; 6]);
        for torque in all {
            searched += u32::from(matches!(torque.modes, ModeSearch::Searched { .. }));
            last = torque.tau;
        }
        assert!(searched == 1, "{spoilt} {searched}");
        let off = last.iter().zip(want).map(|(a, b)| (a - b).abs());
        let off = off.fold(0.0, f32::max);
        assert!(off < 1e-3, "{spoilt} {off:e}");
    }
    // Numbers that are not finite are refused and not kept.
    let mut bad = good;
    bad[1][2] = f32::NAN;
    assert_eq!(tick(&mut fresh, &bad), Err(Fault::NotFinite { joint: 0 }));
    let again = tick(&mut fresh, &good).expect("finite");
    assert!(matches!(again.modes, ModeSearch::Searched { .. }) && again.tau == want);
}

#[test]
fn a_jump_is_not_taken_for_a_motion() {
    let mut law = law::<f32>();
    for k in 0..50 {
        let jump = tick(&mut law, &at(f64::from(k), 3.0)).expect("finite");
        assert!(matches!(jump.modes, ModeSearch::Searched { .. }), "{k}");
    }
}

fn orthogonal<R: Real, const M: usize>(vectors: &[[R; M]; M], small: f64) {
    for (i, a) in vectors.iter().enumerate() {
        for (j, b) in vectors.iter().enumerate() {
            let off = dot(a, b).to_f64() - f64::from(u8::from(i == j));
            assert!(off.abs() < small, "{i} {j} {off:e}");
        }
    }
}

/// Modes of M directions whose squares spread over many powers of ten, in f64 and f32: within eight
/// passes, and orthogonal.
fn spread<R: Real, const M: usize>(small: f64) {
    let mut seed = 1_u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / 8_388_608.0 - 1.0
    };
    let mut most = 0;
    for round in 0..200 {
        let powers = f64::from(round % 9);
        let equal = round % 4 == 0;
        let scale: [f64; M] = core::array::from_fn(|_| {
            if equal { 10.0 } else { 10_f64.powf(2.0 - 0.5 * powers * (1.0 + random())) }
        });
        // Scaled rows of a random matrix, and one without a mode.
        let rows: [[R; M]; M] = core::array::from_fn(|i| {
            core::array::from_fn(|_| {
                R::from_f64(if round % 5 == 1 && i == 0 { 0.0 } else { scale[i] * random() })
            })
        });
        let mut modes = modes::Modes::<R, M>::start();
        let found = modes.follow(&rows, &|x: &[R; M]| *x, &[R::ONE; M], R::ONE);
        assert!(found.search() != ModeSearch::Coupled, "{round}");
        most = most.max(found.passes);
        orthogonal(&modes.vectors, small);
    }
    std::println!("{M} directions: {most} passes");
    assert!(most <= 7);
}

#[test]
fn modes_of_any_spread_are_found_within_the_passes() {
    spread::<f64, 6>(1e-14);
    spread::<f32, 6>(5e-6);
    spread::<f32, 3>(5e-6);
    spread::<f64, 1>(1e-15);
    spread::<f64, 8>(1e-14);
}

// A million rotations, as of a minute and more.
#[test]
fn the_modes_stay_orthogonal() {
    let mut modes = modes::Modes::<f32, 6>::start();
    for k in 0..60_000 {
        let t = 1e-3 * f64::from(k);
        let rows: [[f32; 6]; 6] = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                (2.0 * (t + i as f64 * 1.3 + j as f64 * (2.1 + t * 1e-2)).sin()) as f32
            })
        });
        let _ = modes.follow(&rows, &|x: &[f32; 6]| *x, &[0.0; 6], 1e-2);
    }
    orthogonal(&modes.vectors, 5e-6);
}
