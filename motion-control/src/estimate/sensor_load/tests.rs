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
