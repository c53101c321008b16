//! The ends of written loops, against the links of the file.

use dynamics_core::glam::{DMat3, DVec3};

use super::energy::{Energy, identity, product, rows};
use super::random::Random;
use super::{SIZE, in_library};
use crate::description::{Description, Pose};
use crate::error::Result;
use crate::loops::Closed;
use crate::model::AnyModel;
use crate::number::Attitude;
use crate::selection::Selected;
use crate::tree::Tree;

/// The largest difference between frames on the tree's bodies and on the file's links at random
/// positions: of origins in m, of axes of length one.
///
/// The links' poses are those of the energies that torques are checked with, the bodies' those of
/// the library; the tree has the numbers of the file, not the exact ones.
///
/// # Errors
/// A robot that is too large, or that the library refuses.
pub fn loops(
    robot: &Description,
    selected: &Selected,
    given: &Tree,
    closed: &[Closed],
    states: usize,
) -> Result<f64> {
    let (library, energy) = (AnyModel::of(given)?, Energy::of(robot, selected));
    let (mut random, mut most) = (Random::new(2), 0.0_f64);
    for _ in 0..states {
        let u: Vec<f64> = (0..energy.coordinates).map(|_| SIZE * random.symmetric()).collect();
        let still = vec![0.0; u.len()];
        let (motion, _) = in_library(given, &u, &still, &still);
        let (links, bodies) = (energy.poses(&u), library.poses(&motion.q));
        for one in closed {
            let source = &robot.loops[one.source];
            for (i, (body, xyz, attitude)) in one.ends.iter().enumerate() {
                let Some(link) = &links[source.links[i]] else {
                    return Ok(f64::INFINITY);
                };
                let expected = product(link, &rows(&source.frames[i]));
                let own =
                    rows(&Pose { position: DVec3::from_array(*xyz), rotation: rotation(attitude) });
                let found = match body {
                    Some(body) => product(&bodies[*body], &own),
                    None => product(&identity(), &own),
                };
                let pairs = expected.iter().flatten().zip(found.iter().flatten());
                most = pairs.fold(most, |most, (a, b)| match (a - b).is_nan() {
                    true => f64::INFINITY,
                    false => most.max((a - b).abs()),
                });
            }
        }
    }
    Ok(most)
}

/// R = R_z(yaw) R_y(pitch) R_x(roll).
fn rotation(attitude: &Attitude) -> DMat3 {
    let [roll, pitch, yaw] = match *attitude {
        Attitude::QuarterTurns(turns) => {
            turns.map(|turns| f64::from(turns) * std::f64::consts::FRAC_PI_2)
        }
        Attitude::Rpy(rpy) => rpy,
    };
    DMat3::from_rotation_z(yaw) * DMat3::from_rotation_y(pitch) * DMat3::from_rotation_x(roll)
}
