//! Gravity compensation as it is written without a library: the poses of the links by 4 × 4
//! matrices with `libm`'s sines, then the moment of each weight about each joint.

use core::array;

use dynamics_core::model::Robot;
use dynamics_core::robots::So101;

const N: usize = 6;

type Matrix = [[f32; 4]; 4];

const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// A link: its pose on the link before at q = 0, its mass and its centre. Its joint turns about z.
struct Link {
    placement: Matrix,
    mass: f32,
    com: [f32; 3],
}

/// The numbers of the library's description.
static LINKS: [Link; N] = {
    let mut links = [const { Link { placement: IDENTITY, mass: 0.0, com: [0.0; 3] } }; N];
    let mut i = 0;
    while i < N {
        let of = &So101::MODEL.links[i];
        let (x, y, z) = (of.placement.rot.x_axis, of.placement.rot.y_axis, of.placement.rot.z_axis);
        let (r, h, m) = (of.placement.pos, of.inertia.first_moment, of.inertia.mass);
        links[i].placement = [
            [x.x as f32, x.y as f32, x.z as f32, r.x as f32],
            [y.x as f32, y.y as f32, y.z as f32, r.y as f32],
            [z.x as f32, z.y as f32, z.z as f32, r.z as f32],
            [0.0, 0.0, 0.0, 1.0],
        ];
        links[i].mass = m as f32;
        links[i].com = [(h.x / m) as f32, (h.y / m) as f32, (h.z / m) as f32];
        i += 1;
    }
    links
};

#[allow(clippy::needless_range_loop, reason = "as the product of matrices is usually written")]
fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    let mut product = [[0.0; 4]; 4];
    for i in 0..4 {
        for j in 0..4 {
            for k in 0..4 {
                product[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    product
}

/// The torques that hold the SO-101.
#[inline(never)]
pub fn gravity(q: &[f32; N]) -> [f32; N] {
    let mut pose = IDENTITY;
    // Of axes, origins and centres of mass a weight's moment needs x and y.
    let (mut axes, mut origins, mut centres) = ([[0.0; 2]; N], [[0.0; 2]; N], [[0.0; 2]; N]);
    for (i, link) in LINKS.iter().enumerate() {
        // Weights do not feel the first joint, which turns about the vertical.
        let (s, c) = if i == 0 { (0.0, 1.0) } else { libm::sincosf(q[i]) };
        let mut turn = IDENTITY;
        (turn[0][0], turn[0][1], turn[1][0], turn[1][1]) = (c, -s, s, c);
        pose = multiply(&multiply(&pose, &link.placement), &turn);
        let [x, y, z] = link.com;
        axes[i] = [pose[0][2], pose[1][2]];
        origins[i] = [pose[0][3], pose[1][3]];
        centres[i] = [pose[0], pose[1]].map(|row| row[0] * x + row[1] * y + row[2] * z + row[3]);
    }
    array::from_fn(|joint| {
        let moment = |link: usize| {
            let [x, y] = [0, 1].map(|k| centres[link][k] - origins[joint][k]);
            LINKS[link].mass * 9.81 * (axes[joint][0] * y - axes[joint][1] * x)
        };
        (joint..N).map(moment).sum()
    })
}
