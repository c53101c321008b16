//! Drives of several makers as one type.

use embedded_can::Frame;

use super::protocol::{Address, Counts, Feedback, Protocol, Special};
use super::{Drive, cubemars, damiao, robstride};
use crate::can::frame::CanError;

/// A drive of any maker, for one [`CanJoints`](crate::CanJoints) with drives of several on its bus:
/// made from [`damiao::Damiao`], [`robstride::RobStride`], [`robstride::RobStrideMit`] and
/// [`cubemars::CubeMars`].
///
/// Identifiers of 11 and of 29 bits are never taken for each other. Among drives of 11 bits
/// [`CanJoints::enable`](crate::CanJoints::enable) refuses two whose frames cannot be told apart.
///
/// ```
/// use embedded_can::{ExtendedId, StandardId, Frame};
/// use joint_drivers::can::ClassicFrame;
/// use joint_drivers::mit::{AnyDrive, damiao::{DM4340, Damiao}, robstride::{RS00, RobStride}};
/// use joint_drivers::{CanJoints, JointDrives, JointMapping, JointRange, Outbox};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let drives: [AnyDrive; 2] = [
///     Damiao::new(1, 0x11, DM4340, 27.0, mapping)?.into(),
///     RobStride::new(2, 0xfd, RS00, 14.0, mapping)?.into(),
/// ];
/// let joints = CanJoints::new(Outbox::<ClassicFrame, 2>::new(), drives);
/// (&joints).set_torques(&[0.0, 0.0])?;
/// let [shoulder, wrist] = joints.commands().map(|frame| frame.unwrap().id());
/// assert_eq!(shoulder, StandardId::new(1).unwrap().into());
/// assert_eq!(wrist, ExtendedId::new(0x0180_0002).unwrap().into());
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub type AnyDrive = Drive<AnyProtocol>;

macro_rules! makers {
    ($($maker:ident: $protocol:ty),*) => {
        /// The identifiers of a drive of any maker.
        #[doc(hidden)]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum AnyProtocol {
            $($maker($protocol)),*
        }

        $(impl From<Drive<$protocol>> for AnyDrive {
            fn from(drive: Drive<$protocol>) -> Self {
                let Drive { protocol, axes, middle, most, turns, last, checked, differs } = drive;
                let protocol = AnyProtocol::$maker(protocol);
                Self { protocol, axes, middle, most, turns, last, checked, differs }
            }
        })*

        impl Protocol for AnyProtocol {
            fn address(&self) -> Address {
                match self { $(Self::$maker(own) => own.address()),* }
            }
            fn special<F: Frame>(&self, special: Special) -> Result<F, CanError> {
                match self { $(Self::$maker(own) => own.special(special)),* }
            }
            fn command<F: Frame>(&self, counts: &Counts) -> Result<F, CanError> {
                match self { $(Self::$maker(own) => own.command(counts)),* }
            }
            fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError> {
                match self { $(Self::$maker(own) => own.decode(frame)),* }
            }
        }
    };
}

makers!(
    Damiao: damiao::Identity,
    RobStride: robstride::NativeProtocol,
    RobStrideMit: robstride::MitProtocol,
    CubeMars: cubemars::Identity
);
