//! Pose and Jacobian of a body.

use dynamics_core::Core;
use dynamics_core::algorithms::frame::{self, LocalWorldAligned};
use dynamics_core::glam::Mat3;

use crate::status::{self, NULL};
use crate::tool::is_rotation;
use crate::{Exports, Library, check, status_of};

/// The pose of a body's frame: `..._pose` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Pose {
    /// From the body's coordinates to the base's, by rows: its columns are the body's axes.
    pub rotation: [[f32; 3]; 3],
    /// The origin in base coordinates, m.
    pub position: [f32; 3],
}

impl Pose {
    /// The pose that a tip may have.
    pub(crate) fn checked(&self) -> Result<frame::Pose<f32>, i32> {
        check::inputs([self.rotation.as_flattened(), &self.position])?;
        if !is_rotation(&self.rotation) {
            return Err(status::ROTATION);
        }
        let rot = Mat3::from_cols_array_2d(&self.rotation).transpose();
        Ok(frame::Pose { rot, pos: self.position.into() })
    }
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The pose of a body.
    pub fn body_pose(q: Option<&[f32; N]>, body: i32, pose: Option<&mut Pose>) -> i32 {
        status_of(|| {
            let (q, pose) = (q.ok_or(NULL)?, pose.ok_or(NULL)?);
            Self::positions(q)?;
            let body = usize::try_from(body).map_err(|_| status::NO_BODY)?;
            let poses = Core::<L::Arm>::poses(q);
            let at = poses.get(body).ok_or(status::NO_BODY)?;
            let result = Pose {
                rotation: at.rot.transpose().to_cols_array_2d(),
                position: at.pos.to_array(),
            };
            check::results([result.rotation.as_flattened(), &result.position])?;
            *pose = result;
            Ok(())
        })
    }

    /// The Jacobian of a body, by rows: three of the angular velocity, three of the velocity.
    pub fn body_jacobian(
        q: Option<&[f32; N]>,
        body: i32,
        jacobian: Option<&mut [[f32; N]; 6]>,
    ) -> i32 {
        status_of(|| {
            let (q, jacobian) = (q.ok_or(NULL)?, jacobian.ok_or(NULL)?);
            Self::positions(q)?;
            let body = usize::try_from(body).ok().filter(|&body| body < N);
            let columns =
                Core::<L::Arm>::jacobian(q, body.ok_or(status::NO_BODY)?, LocalWorldAligned);
            let mut rows = [[0.0; N]; 6];
            for (joint, column) in columns.iter().enumerate() {
                let entries = column.ang.to_array().into_iter().chain(column.lin.to_array());
                for (row, entry) in rows.iter_mut().zip(entries) {
                    if let Some(place) = row.get_mut(joint) {
                        *place = entry;
                    }
                }
            }
            check::results([rows.as_flattened()])?;
            *jacobian = rows;
            Ok(())
        })
    }
}
