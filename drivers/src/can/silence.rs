//! The joints of a bus that are silent, and what that says of the bus.

use super::frame::CanError;

/// So many readings without a position in a second are no lost frame.
const FEW: u8 = 3;

/// The readings of a second in which joints had no position, of joints in the order of their cable.
///
/// ```
/// use joint_drivers::can::{CanError, Silence, Silent};
/// let mut silence = Silence::new(500);
/// let cut = [Ok(()), Err(CanError::NoReply), Err(CanError::NoReply)];
/// let found = [0, 1, 2].map(|tick| silence.update(tick, Some(&cut)));
/// let behind = Silent { lossy: false, behind: Some(1), joints: [false; 3] };
/// assert_eq!(found, [None, None, Some(behind)]);
/// // Answers that come again in the same second.
/// let other = [Err(CanError::NoReply), Ok(()), Ok(())];
/// assert!(silence.update(3, Some(&other)).is_some_and(|silent| silent.lossy));
/// assert!(!silence.is_heard());
/// assert_eq!((silence.update(503, None), silence.is_heard()), (None, true));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Silence<const V: usize> {
    second: u32,
    since: u32,
    counts: [u8; V],
}

/// The silent joints of a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Silent<const V: usize> {
    /// A joint that was silent has a position now: answers are lost now and then.
    pub lossy: bool,
    /// This joint and all behind it, which are two or more, send nothing.
    pub behind: Option<usize>,
    /// The others that have no position.
    pub joints: [bool; V],
}

impl<const V: usize> Silence<V> {
    /// No joint is silent; a second has so many ticks.
    pub const fn new(second: u32) -> Self {
        Self { second, since: 0, counts: [0; V] }
    }

    /// Takes the last reading, of this tick, if it has failed:
    /// [`CanJoints::unread`](crate::CanJoints::unread).
    #[cold]
    pub fn update(
        &mut self,
        now: u32,
        unread: Option<&[Result<(), CanError>; V]>,
    ) -> Option<Silent<V>> {
        if now.wrapping_sub(self.since) >= self.second {
            (self.since, self.counts) = (now, [0; V]);
        }
        let unread = unread?;
        let mut found = Silent { lossy: false, behind: None, joints: [false; V] };
        let all = self.counts.iter_mut().zip(unread).zip(&mut found.joints);
        for ((count, unread), silent) in all {
            *count = count.saturating_add(unread.is_err().into());
            *silent = *count >= FEW && unread.is_err();
            found.lossy |= *count >= FEW && unread.is_ok();
        }
        if self.is_heard() {
            return None;
        }
        let sends = |(silent, unread): (&bool, &_)| !silent || *unread != Err(CanError::NoReply);
        let last = found.joints.iter().zip(unread).rposition(sends);
        let behind = last.map_or(0, |last| last + 1);
        if behind + 1 < V && !found.lossy {
            found.behind = Some(behind);
            found.joints.iter_mut().skip(behind).for_each(|silent| *silent = false);
        }
        Some(found)
    }

    /// Whether no joint was silent in this second.
    pub fn is_heard(&self) -> bool {
        self.counts.iter().all(|count| *count < FEW)
    }
}
