use super::*;
use crate::estimate::tests::{Numbers, solved};
use dynamics_core::glam::DVec3;

const LOAD: SensorLoad<f64> = SensorLoad {
    mass: 1.2,
    first_moment: DVec3::new(0.012, -0.006, 0.096),
    offset: Force { ang: DVec3::new(0.2, -0.1, 0.05), lin: DVec3::new(3.0, -2.0, 5.0) },
};
/// The standard deviations of the noise of a Robotiq FT 300 (instruction manual, specifications):
/// N, and N·m about x and y and about z.
const NOISE: [f64; 3] = [0.1, 0.005, 0.003];

/// Twelve numbers' sum is close enough to a Gaussian one.
fn gaussian(numbers: &mut Numbers) -> f64 {
    (0..12).map(|_| 0.5 * numbers.next()).sum()
}

fn direction(numbers: &mut Numbers) -> DVec3 {
    loop {
        let way = DVec3::from_array([(); 3].map(|()| numbers.next()));
        if (0.01..1.0).contains(&way.length_squared()) {
            return 9.81 * way.normalize();
        }
    }
}

fn measured(gravity: DVec3, numbers: &mut Numbers) -> Force<f64> {
    let mut noise = |[x, y, z]: [f64; 3]| {
        DVec3::new(x * gaussian(numbers), y * gaussian(numbers), z * gaussian(numbers))
    };
    let [n, m, about_z] = NOISE;
    let Force { ang, lin } = LOAD.at_rest(gravity);
    Force::new(ang + noise([m, m, about_z]), lin + noise([n; 3]))
}

/// The ten numbers by the normal equations of all six rows of each pose.
fn by_ten(poses: &[(DVec3, Force<f64>)]) -> [f64; 10] {
    let (mut a, mut b) = ([[0.0; 10]; 10], [0.0; 10]);
    for (g, wrench) in poses {
        for k in 0..6 {
            let mut row = [0.0; 10];
            let (unit, across) = (DVec3::AXES[k % 3], g.cross(DVec3::AXES[k % 3]));
            row[4 + k] = 1.0;
            let shown = if k < 3 {
                row[0] = -g.dot(unit);
                wrench.lin.dot(unit)
            } else {
                row[1..4].copy_from_slice(&(-across).to_array());
                wrench.ang.dot(unit)
            };
            for i in 0..10 {
                (0..10).for_each(|j| a[i][j] += row[i] * row[j]);
                b[i] += row[i] * shown;
            }
        }
    }
    solved(a, b)
}

#[test]
fn twelve_poses_give_the_load_within_a_per_cent_and_as_the_least_squares_of_ten_numbers_do() {
    let mut numbers = Numbers(1);
    let mut worst = [0.0_f64; 2];
    for _ in 0..1000 {
        // A mean over 64 samples in each pose: the noise is that of a single one.
        let poses: Vec<(DVec3, Force<f64>)> = (0..12)
            .map(|_| {
                let gravity = direction(&mut numbers);
                let samples = (0..64).map(|_| measured(gravity, &mut numbers));
                let sum = samples.fold(Force::ZERO, |mut sum, sample| {
                    sum += sample;
                    sum
                });
                (gravity, Force::new(sum.ang / 64.0, sum.lin / 64.0))
            })
            .collect();
        let (mut fit, mut single) = (SensorLoadFit::new(), SensorLoadFit::<f32>::new());
        for (gravity, wrench) in &poses {
            fit.add(*gravity, wrench);
            let wrench = Force::new(wrench.ang.as_vec3(), wrench.lin.as_vec3());
            single.add(gravity.as_vec3(), &wrench);
        }
        let found = fit.load().expect("poses in all directions");
        let [mass, x, y, z, fx, fy, fz, nx, ny, nz] = by_ten(&poses);
        let h = DVec3::new(x, y, z);
        assert!((found.mass - mass).abs() < 1e-11 && (found.first_moment - h).length() < 1e-12);
        assert!((found.offset.lin - DVec3::new(fx, fy, fz)).length() < 1e-10);
        assert!((found.offset.ang - DVec3::new(nx, ny, nz)).length() < 1e-11);
        let f32 = single.load().expect("poses in all directions");
        assert!((f64::from(f32.mass) - mass).abs() < 1e-4 * mass);
        assert!((f32.first_moment.as_dvec3() - h).length() < 1e-4 * h.length());
        let centre = |load: &SensorLoad<f64>| load.first_moment / load.mass;
        let off = (centre(&found) - centre(&LOAD)).length() / centre(&LOAD).length();
        worst = [worst[0].max((found.mass / LOAD.mass - 1.0).abs()), worst[1].max(off)];
    }
    println!("mass off by {:.2} %, centre by {:.2} %", 100.0 * worst[0], 100.0 * worst[1]);
    assert!(worst.iter().all(|off| *off < 0.01), "{worst:?}");
}

#[test]
fn poses_that_say_nothing_are_refused() {
    let mut fit = SensorLoadFit::<f64>::new();
    assert_eq!(fit.load(), Err(SensorLoadError::FewPoses(0)));
    for k in 0..12 {
        // About one line: upright, hanging, and again.
        let gravity = DVec3::Z * if k % 2 == 0 { 9.81 } else { -9.81 };
        fit.add(gravity, &LOAD.at_rest(gravity));
    }
    assert_eq!(fit.load(), Err(SensorLoadError::OneDirection));
    fit.add(DVec3::X * 9.81, &LOAD.at_rest(DVec3::X * 9.81));
    assert!((fit.load().expect("a third direction").mass - 1.2).abs() < 1e-12);
    for wrong in [f64::NAN, f64::INFINITY, 1e300] {
        let mut wild = fit;
        wild.add(DVec3::Y * wrong, &Force::new(DVec3::X * wrong, DVec3::Y * wrong));
        assert_eq!(wild.load(), Err(SensorLoadError::NotFinite));
    }
}

/// The fit and the error of poses whose readings are changed, for scalars of both sizes.
fn fitted(
    poses: &[DVec3],
    shown: impl Fn(DVec3) -> Force<f64>,
) -> [Result<f64, SensorLoadError>; 2] {
    let (mut fit, mut single) = (SensorLoadFit::new(), SensorLoadFit::<f32>::new());
    for &gravity in poses {
        let wrench = shown(gravity);
        fit.add(gravity, &wrench);
        single.add(gravity.as_vec3(), &Force::new(wrench.ang.as_vec3(), wrench.lin.as_vec3()));
    }
    [fit.load().map(|load| load.mass), single.load().map(|load| f64::from(load.mass))]
}

#[test]
fn a_wrong_sign_and_turned_axes_are_refused_and_noise_is_not() {
    use core::f64::consts::{FRAC_PI_2, PI};
    use dynamics_core::glam::{DMat3, DQuat};
    let mut numbers = Numbers(7);
    for count in [4, 6, 12, 40] {
        let poses: Vec<DVec3> = (0..count).map(|_| direction(&mut numbers)).collect();
        let readings: Vec<Force<f64>> = poses.iter().map(|g| measured(*g, &mut numbers)).collect();
        let read = |g: DVec3| readings[poses.iter().position(|pose| *pose == g).expect("a pose")];
        let by =
            |turn: DMat3| fitted(&poses, |g| Force::new(turn * read(g).ang, turn * read(g).lin));
        let right = by(DMat3::IDENTITY);
        assert!(right.iter().all(|mass| mass.is_ok_and(|m| (m - 1.2).abs() < 0.05)), "{right:?}");
        assert_eq!(by(-DMat3::IDENTITY), [Err(SensorLoadError::Sign); 2]);
        for (axis, angle) in [(DVec3::Z, FRAC_PI_2), (DVec3::X, PI), (DVec3::ONE, 0.3)] {
            let turn = DMat3::from_quat(DQuat::from_axis_angle(axis.normalize(), angle));
            assert_eq!(by(turn), [Err(SensorLoadError::Turned); 2], "{count} {axis} {angle}");
        }
        // One axis the other way, and a turn of 2°, as of a flange.
        assert_eq!(
            by(DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0))),
            [Err(SensorLoadError::Turned); 2]
        );
        assert!(by(DMat3::from_rotation_z(0.035)).iter().all(Result::is_ok));
    }
    // A sensor without a load: its offset and noise alone.
    for _ in 0..1000 {
        let poses: Vec<DVec3> = (0..12).map(|_| direction(&mut numbers)).collect();
        let noises: Vec<Force<f64>> =
            poses.iter().map(|_| measured(DVec3::ZERO, &mut numbers)).collect();
        let bare =
            fitted(&poses, |g| noises[poses.iter().position(|pose| *pose == g).expect("a pose")]);
        assert!(bare.iter().all(Result::is_ok), "{bare:?}");
    }
}

#[test]
fn the_residual_is_that_of_the_poses() {
    let mut numbers = Numbers(3);
    let mut fit = SensorLoadFit::new();
    let poses: Vec<_> = (0..12).map(|_| direction(&mut numbers)).collect();
    let poses: Vec<_> = poses.into_iter().map(|g| (g, measured(g, &mut numbers))).collect();
    poses.iter().for_each(|(g, wrench)| fit.add(*g, wrench));
    let found = fit.load().expect("poses in all directions");
    let light = SensorLoad { mass: 0.4, ..LOAD };
    for load in [found, LOAD, light] {
        let left = poses.iter().map(|(g, wrench)| *wrench - load.at_rest(*g));
        let squares = left.fold([0.0; 2], |[n, f], left| {
            [n + left.ang.length_squared(), f + left.lin.length_squared()]
        });
        for (residual, squares) in fit.residual(&load).iter().zip(squares) {
            assert!((residual - (squares / 12.0_f64).sqrt()).abs() < 1e-7, "{residual} {squares}");
        }
    }
    assert!(fit.residual(&light)[1] > 5.0 && fit.residual(&found)[1] < 3.0 * NOISE[0]);
}
