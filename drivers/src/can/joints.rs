//! The controllers of a robot's joints on one CAN bus, whose replies carry the positions: encoders
//! and drives at once.

use core::cell::{RefCell, RefMut};
use core::mem;

use embedded_can::nb::Can;
use embedded_can::{Error as _, ErrorKind, Frame};
use motion_control::{limits::Fault, motion::PreviousTick};
use nb::Error::{Other, WouldBlock};

use super::frame::CanError;
use super::joint::{CanJoint, PdCanJoint};
use super::mit::Drive;
use super::mit::protocol::Protocol;
use crate::MappingError;
use crate::drives::pd::{PdDrives, SetpointAt};
use crate::joint::{
    DriveFault, DriveFaultKind, EncoderType, JointDrives, JointEncoders, JointError,
};

/// The most frames of others that are taken in a tick, more than a bus of 1 Mbit/s has in 2 ms.
const MOST_FRAMES: usize = 64;

/// The joints on one bus. A [`ControlLoop`](crate::ControlLoop) takes a reference to it twice, as
/// its encoders and its drives.
///
/// In each tick it takes the frames that have come since the last one, and then sends a torque to
/// each joint: a position is that of the tick before. A joint without a position since then has no
/// angle in this tick, and its error is that of the last wrong frame that it sent meanwhile, such
/// as [`CanError::Range`], [`CanError::Remote`], [`CanError::Length`] or [`CanError::Short`];
/// [`CanError::Identifier`] if only frames of no joint came, [`CanError::NoReply`] if none did.
///
/// # Stale replies
/// A position counts in one tick alone. A reply that comes too late for its tick leaves that one
/// with [`CanError::NoReply`], and counts in the next one if no other follows it. No reply of these
/// protocols has a number: replies that are all late by a tick are noticed in the first tick alone,
/// and a drive that repeats an old position by
/// [`FrozenEncoder`](motion_control::safety::FrozenEncoder).
///
/// ```
/// use embedded_can::{ExtendedId, Frame, nb::Can};
/// use joint_drivers::can::{CanError, FdFrame};
/// use joint_drivers::{CanJoints, JointDrives, JointEncoders, JointError, JointMapping, JointRange, moteus::Moteus};
/// # struct Bus(Vec<FdFrame>);
/// # impl Can for Bus {
/// #     type Frame = FdFrame;
/// #     type Error = embedded_can::ErrorKind;
/// #     fn transmit(&mut self, _: &FdFrame) -> nb::Result<Option<FdFrame>, Self::Error> { Ok(None) }
/// #     fn receive(&mut self) -> nb::Result<FdFrame, Self::Error> { self.0.pop().ok_or(nb::Error::WouldBlock) }
/// # }
/// # // The reply of the protocol's own example: 2.88°, position mode.
/// # let data = [0x24, 4, 0, 0x0a, 0, 0x50, 0, 0, 1, 0x70, 0xff, 0x23, 0x0d, 0x18, 0x14, 0];
/// # let bus = Bus(vec![FdFrame::new(ExtendedId::new(0x100).unwrap(), &data).unwrap()]);
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Within { lower: -3.0, upper: 3.0 }, 5e-3)?;
/// let joints = CanJoints::new(bus, [Moteus::new(1, 0, 10.0, mapping)?]);
/// let (mut encoders, mut drives) = (&joints, &joints);
/// assert!((encoders.read()?[0].to_degrees() - 2.88).abs() < 1e-5);
/// drives.set_torques(&[0.5])?;
/// assert_eq!(encoders.read(), Err(JointError { joint: 0, error: CanError::NoReply }));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CanJoints<Bus, Joint, const V: usize>(RefCell<Network<Bus, Joint, V>>);

#[derive(Debug)]
struct Network<Bus, Joint, const V: usize> {
    bus: Bus,
    joints: [Joint; V],
    /// Why there is none: nothing has come since the last tick, or what has.
    positions: [Result<f32, CanError>; V],
    delivers: [Result<(), CanError>; V],
    /// Why joints had no position in the last reading that failed.
    unread: [Result<(), CanError>; V],
    /// The joint behind the one that took the last frame: replies mostly come in order.
    next: usize,
}

impl<Bus: JointBus, Joint: CanJoint, const V: usize> CanJoints<Bus, Joint, V> {
    /// The joints, of which none has reported yet.
    pub const fn new(bus: Bus, joints: [Joint; V]) -> Self {
        let (positions, delivers) = ([Err(CanError::NoReply); V], [Ok(()); V]);
        let unread = delivers;
        Self(RefCell::new(Network { bus, joints, positions, delivers, unread, next: 0 }))
    }

    /// Takes a joint to be at `position` rad or m, which ends [`CanError::LostTurn`]: the next
    /// position is within half a turn of its shaft from there.
    ///
    /// # Errors
    /// [`MappingError::Range`]: there is no such joint, or no such position.
    pub fn place_near(&self, joint: usize, position: f32) -> Result<(), MappingError> {
        let mut network = self.0.try_borrow_mut().map_err(|_| MappingError::Range)?;
        network.joints.get_mut(joint).ok_or(MappingError::Range)?.place_near(position)
    }

    /// Why each joint delivers no torque, by its last report; the errors of the positions are those
    /// of [`JointEncoders::read`].
    pub fn errors(&self) -> [Result<(), CanError>; V] {
        self.0.try_borrow().map_or([Err(CanError::Full); V], |network| network.delivers)
    }

    /// Why each joint had no position in the last reading that failed, whose error is that of the
    /// first of them: which of them are silent tells a drive from a cable.
    #[cold]
    pub fn unread(&self) -> [Result<(), CanError>; V] {
        self.0.try_borrow().map_or([Err(CanError::Full); V], |network| network.unread)
    }

    /// Clears the faults of a joint. Call it between two ticks.
    ///
    /// # Errors
    /// [`CanError::Node`]: there is no such joint. [`CanError::Unknown`]: it has no such frame.
    /// [`CanError::Full`] and [`CanError::Bus`]: the frame was not sent.
    pub fn clear_errors(&self, joint: usize) -> Result<(), JointError<CanError>> {
        self.request(joint, |joint| joint.clear_errors())
    }

    /// Makes the present position of a joint the zero of its controller, which is to deliver no
    /// torque: [`CanJoint::set_zero`]. Call it between two ticks, as [`Self::clear_errors`].
    ///
    /// # Errors
    /// As [`Self::clear_errors`].
    pub fn set_zero(&self, joint: usize) -> Result<(), JointError<CanError>> {
        self.request(joint, Joint::set_zero)
    }

    #[cold]
    fn request(
        &self,
        joint: usize,
        frame: impl FnOnce(&mut Joint) -> Result<Bus::Frame, CanError>,
    ) -> Result<(), JointError<CanError>> {
        let at = |error| JointError { joint, error };
        let mut network = self.network()?;
        let of = network.joints.get_mut(joint).ok_or(at(CanError::Node))?;
        let frame = frame(of).map_err(at)?;
        network.bus.send(&frame, joint, true).map_err(at)
    }

    /// Returns the bus to its owner.
    pub fn release(self) -> Bus {
        self.0.into_inner().bus
    }

    /// Nobody else holds it: each of these functions returns it before it ends.
    fn network(&self) -> Result<RefMut<'_, Network<Bus, Joint, V>>, JointError<CanError>> {
        self.0.try_borrow_mut().map_err(|_| JointError { joint: 0, error: CanError::Full })
    }

    /// Lets the drives deliver torque: that of their last command, send one of zero before.
    ///
    /// A joint of your own around a drive implements `AsRef` of it, and passes
    /// [`CanJoint::learn`] on to it. Drives of several makers are of one type as
    /// [`AnyDrive`](crate::mit::AnyDrive).
    ///
    /// Drives that have registers of their scale and their mode are asked for them first, one
    /// register in each call, which is to be made in tick after tick until it succeeds: seven drives
    /// of Damiao take 28 calls. A drive whose scale or mode is not the one of this program delivers
    /// no torque, and neither do the others.
    ///
    /// # Errors
    /// [`CanError::Missing`] is the register that was asked for, [`CanError::Scale`] the one that
    /// has another scale, [`CanError::Mode`] another mode, for which the drive is asked anew.
    /// [`CanError::Clash`]: the frames of this joint and of another cannot be told apart. Else the
    /// first joint whose frame was not sent.
    ///
    /// ```
    /// # use embedded_can::{Frame, StandardId};
    /// # use joint_drivers::can::{CanError, ClassicFrame};
    /// # use joint_drivers::mit::damiao::{DM4310, Damiao, PMAX};
    /// # use joint_drivers::{CanJoints, JointError, JointMapping, JointRange, Outbox};
    /// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
    /// let joints = CanJoints::new(Outbox::<ClassicFrame, 1>::new(), [Damiao::new(1, 0x11, DM4310, 7.0, mapping)?]);
    /// assert_eq!(joints.enable(), Err(JointError { joint: 0, error: CanError::Missing(PMAX.into()) }));
    /// let query = joints.commands();
    /// # let [Some(query)] = query else { panic!("no query") };
    /// // The drive answers that its counts are of ±15 rad.
    /// let [b0, b1, b2, b3] = 15.0_f32.to_le_bytes();
    /// # assert_eq!(query.data(), [1, 0, 0x33, PMAX, 0, 0, 0, 0]);
    /// joints.receive(&ClassicFrame::new(StandardId::new(0x11).unwrap(), &[1, 0, 0x33, PMAX, b0, b1, b2, b3]).unwrap());
    /// assert_eq!(joints.enable(), Err(JointError { joint: 0, error: CanError::Scale(PMAX) }));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[cold]
    pub fn enable<P: Protocol>(&self) -> Result<(), JointError<CanError>>
    where
        Joint: AsRef<Drive<P>>,
    {
        let mut state = self.network()?;
        let drives = || state.joints.iter().map(AsRef::as_ref).enumerate();
        let unknown = drives().find_map(|(joint, drive)| {
            if drives().any(|(other, of)| other != joint && drive.clashes(of)) {
                return Some((joint, CanError::Clash, Err(CanError::Clash)));
            }
            let (register, error) = drive.unchecked().err()?;
            Some((joint, error, drive.query(register)))
        });
        let Some((joint, error, query)) = unknown else {
            return state.send(&[(); V], true, |joint, ()| joint.as_ref().enable());
        };
        let sent = query.and_then(|query| state.bus.send(&query, joint, true));
        Err(JointError { joint, error: sent.err().unwrap_or(error) })
    }

    /// As [`Self::enable`], for a start by a button: clears the faults that drives keep before, one
    /// in each call, and returns whether all drives deliver torque. Until then do not reset.
    ///
    /// # Errors
    /// As [`Self::enable`] and [`Self::clear_errors`].
    #[cold]
    pub fn start_up<P: Protocol>(&self) -> Result<bool, JointError<CanError>>
    where
        Joint: AsRef<Drive<P>>,
    {
        let has_failed = |state: &Result<(), CanError>| {
            state.is_err_and(|error| error.kind() == DriveFaultKind::Failed)
        };
        if let Some(joint) = self.errors().iter().position(has_failed) {
            return self.clear_errors(joint).map(|()| false);
        }
        self.enable()?;
        Ok(self.errors().iter().all(Result::is_ok))
    }

    /// Takes the torque from the drives.
    ///
    /// # Errors
    /// The first joint whose frame was not sent.
    pub fn disable<P: Protocol>(&self) -> Result<(), JointError<CanError>>
    where
        Joint: AsRef<Drive<P>>,
    {
        self.network()?.send(&[(); V], true, |joint, ()| joint.as_ref().disable())
    }

    /// Asks a drive for its faults, which no feedback of
    /// [`RobStrideMit`](crate::mit::robstride::RobStrideMit) has: call it between two ticks, for
    /// one joint after the other. The reply counts until the next one: a fault is the error of
    /// [`JointDrives::set_torques`] in each tick.
    ///
    /// # Errors
    /// As [`Self::clear_errors`]; [`CanError::Unknown`]: each reply of the drive has its faults.
    ///
    /// ```
    /// # use embedded_can::{Frame, StandardId};
    /// # use joint_drivers::can::{CanError, FdFrame};
    /// # use joint_drivers::mit::robstride::{RS02, RobStrideMit};
    /// # use joint_drivers::{CanJoints, JointDrives, JointError, JointMapping, JointRange, Outbox};
    /// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
    /// let drive = RobStrideMit::new(0x7f, 0xfd, RS02, 17.0, mapping)?;
    /// let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [drive]);
    /// joints.read_faults(0)?;
    /// assert_eq!(joints.commands()[0].unwrap().data(), [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0, 0xfb]);
    /// // The drive answers that its motor is too hot.
    /// joints.receive(&FdFrame::new(StandardId::new(0xfd).unwrap(), &[0x7f, 1, 0, 0, 0, 0, 0, 0]).unwrap());
    /// let error = (&joints).set_torques(&[1.0]).unwrap_err().error;
    /// assert_eq!(error.to_string(), "the node's motor is too hot");
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn read_faults<P: Protocol>(&self, joint: usize) -> Result<(), JointError<CanError>>
    where
        Joint: AsRef<Drive<P>>,
    {
        self.request(joint, |joint| joint.as_ref().read_faults())
    }
}

impl<Bus: JointBus, Joint: CanJoint, const V: usize> Network<Bus, Joint, V> {
    /// Takes the frames that have come: so many that a bus which is busy ends the tick. With others
    /// left behind them the last positions may be old.
    fn receive(
        &mut self,
        mut next: impl FnMut(&mut Bus) -> nb::Result<Bus::Frame, ErrorKind>,
    ) -> Result<(), ErrorKind> {
        for _ in 0..MOST_FRAMES + 4 * V {
            match next(&mut self.bus) {
                Ok(frame) => self.take(&frame),
                Err(WouldBlock) => return Ok(()),
                Err(Other(error)) => return Err(error),
            }
        }
        Err(ErrorKind::Overrun)
    }

    /// The joint keeps the error of a frame that is wrong, unless it has a position.
    fn take(&mut self, frame: &Bus::Frame) {
        for _ in 0..V {
            let at = self.next;
            self.next = if at + 1 < V { at + 1 } else { 0 };
            let Some(joint) = self.joints.get_mut(at) else { return };
            let report = match joint.report(frame) {
                Err(CanError::Identifier) => continue,
                report => report,
            };
            let kept = self.positions.get_mut(at).zip(self.delivers.get_mut(at));
            let Some((position, delivers)) = kept else { return };
            match report {
                Ok(report) => {
                    *position = report.position.map_or(*position, Ok);
                    *delivers = report.delivers.unwrap_or(*delivers);
                }
                Err(error) => *position = position.or(Err(error)),
            }
            return;
        }
        if self.joints.iter_mut().any(|joint| joint.learn(frame)) {
            return;
        }
        for position in &mut self.positions {
            if *position == Err(CanError::NoReply) {
                *position = Err(CanError::Identifier);
            }
        }
    }

    /// Sends a frame for each joint.
    fn send<T>(
        &mut self,
        all: &[T; V],
        is_request: bool,
        frame: impl Fn(&Joint, &T) -> Result<Bus::Frame, CanError>,
    ) -> Result<(), JointError<CanError>> {
        let mut failed = Ok(());
        for (joint, (of, each)) in self.joints.iter().zip(all).enumerate() {
            let sent = frame(of, each).and_then(|frame| self.bus.send(&frame, joint, is_request));
            if let (Err(error), Ok(())) = (sent, failed) {
                failed = Err(JointError { joint, error });
            }
        }
        failed
    }

    /// The error of the first joint that failed, else of the first that is not ready.
    fn delivered(&self) -> Result<(), JointError<CanError>> {
        let faults = || {
            let all = self.delivers.iter().enumerate();
            all.filter_map(|(joint, state)| state.err().map(|error| JointError { joint, error }))
        };
        let Some(first) = faults().next() else { return Ok(()) };
        Err(faults().find(|fault| fault.error != CanError::NotReady).unwrap_or(first))
    }

    /// Notes why joints have no position. Not inlined: the usual reading is in short memory.
    #[cold]
    #[inline(never)]
    fn note(&mut self, received: Result<(), CanError>) {
        self.unread = self.positions.map(|position| received.and(position.map(|_| ())));
    }
}

/// The bus of joints: any [`Can`] that has a place for a frame of each, or an [`Outbox`].
///
/// ```
/// use joint_drivers::can::{CanError, ClassicFrame};
/// use joint_drivers::mit::damiao::{DM4310, Damiao};
/// use joint_drivers::{CanJoints, JointBus, JointError, JointMapping, JointRange, Outbox};
/// // A program for any board.
/// fn stop<Bus: JointBus>(joints: &CanJoints<Bus, Damiao, 1>) -> Result<(), JointError<CanError>> {
///     joints.disable()
/// }
/// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let drives = [Damiao::new(1, 0x11, DM4310, 7.0, mapping)?];
/// stop(&CanJoints::new(Outbox::<ClassicFrame, 1>::new(), drives))?;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub trait JointBus {
    /// A frame of this bus.
    type Frame: Frame;

    /// Sends the frame of a joint, counted from zero: its command, of which the newest counts, or a
    /// request, which is not replaced by another one.
    ///
    /// # Errors
    /// [`CanError::Full`]: this frame, or the command that it replaces, is not sent in its tick.
    /// [`CanError::Bus`]: the controller of the bus has this error.
    fn send(&mut self, frame: &Self::Frame, joint: usize, is_request: bool)
    -> Result<(), CanError>;

    /// The next frame that has come.
    ///
    /// # Errors
    /// `WouldBlock`: there is none. The kind of an error of the bus.
    fn next(&mut self) -> nb::Result<Self::Frame, ErrorKind>;
}

impl<Bus: Can> JointBus for Bus {
    type Frame = Bus::Frame;

    fn send(&mut self, frame: &Bus::Frame, _: usize, _: bool) -> Result<(), CanError> {
        match self.transmit(frame) {
            Ok(None) => Ok(()),
            // Another frame, of a lower priority, was taken out of the queue for it.
            Ok(Some(_)) | Err(WouldBlock) => Err(CanError::Full),
            Err(Other(error)) => Err(CanError::Bus(error.kind())),
        }
    }

    fn next(&mut self) -> nb::Result<Bus::Frame, ErrorKind> {
        self.receive().map_err(|error| error.map(|error| error.kind()))
    }
}

impl<Bus, Joint: CanJoint, const V: usize> EncoderType for &CanJoints<Bus, Joint, V> {
    type Error = CanError;
    type Age = PreviousTick;

    fn missed(&mut self, ticks: u32) {
        // Nobody else holds it: each of these functions returns it before it ends.
        if let Ok(mut network) = self.0.try_borrow_mut() {
            network.joints.iter_mut().for_each(|joint| joint.missed(ticks));
        }
    }

    fn fault(error: &CanError, joint: usize) -> Fault {
        match error {
            CanError::LostTurn => Fault::LostTurn { joint },
            _ => Fault::Encoder { joint },
        }
    }
}

impl<Bus: JointBus, Joint: CanJoint, const V: usize> JointEncoders<V>
    for &CanJoints<Bus, Joint, V>
{
    /// Commands zero torque, which is replied to with the first positions.
    fn start(&mut self) {
        // Errors are those of the first reading.
        let _ = self.set_torques(&[0.0; V]);
    }

    fn read(&mut self) -> Result<[f32; V], JointError<CanError>> {
        let mut state = self.network()?;
        let received = state.receive(Bus::next).map_err(CanError::Bus);
        let mut positions = [0.0; V];
        let mut failed = received.map_err(|error| JointError { joint: 0, error });
        let Network { positions: reported, joints, .. } = &mut *state;
        let reported = positions.iter_mut().zip(reported).zip(joints);
        for (joint, ((position, reported), of)) in reported.enumerate() {
            match *reported {
                Ok(reported) => *position = reported,
                Err(error) => {
                    of.missed(1);
                    failed = failed.and(Err(JointError { joint, error }));
                }
            }
        }
        if failed.is_err() {
            state.note(received);
        }
        // After an error of the bus, too: a position counts in one tick alone.
        state.positions = [Err(CanError::NoReply); V];
        failed.map(|()| positions)
    }
}

impl<Bus: JointBus, Joint: CanJoint, const V: usize> JointDrives<V> for &CanJoints<Bus, Joint, V> {
    type Error = CanError;

    fn set_torques(&mut self, torques: &[f32; V]) -> Result<(), JointError<CanError>> {
        let mut state = self.network()?;
        state.send(torques, false, |joint, &torque| joint.command(torque))?;
        state.delivered()
    }
}

impl<Bus: JointBus, Joint: PdCanJoint, const V: usize> PdDrives<V> for &CanJoints<Bus, Joint, V> {
    fn set_sums(&mut self, sums: &[SetpointAt; V]) -> Result<(), JointError<CanError>> {
        let mut state = self.network()?;
        let delivered = state.delivered();
        state.send(sums, false, |joint, setpoint| {
            if delivered.is_ok() {
                joint.pd_command(setpoint)
            } else {
                joint.command(setpoint.sum.torque)
            }
        })?;
        delivered
    }
}

/// A bus in memory, for a controller that has fewer places than there are joints, and for a task
/// that awaits its own or blocks in it.
///
/// It has a place for the command of each joint and one for a request to it. The commands take
/// turns, so that one that still waits is before the newer ones; the requests are behind them. A
/// command that still waits in the next tick is replaced by the newer one in its place, and the
/// joint has [`CanError::Full`] in that tick: its drive got none for a tick.
///
/// # Controllers of few places
/// [`CanJoints::exchange`] sends what waits as places become free, and takes what has come.
///
/// # Tasks
/// [`CanJoints::commands`] has the frames to send, [`CanJoints::receive`] takes those that came.
///
/// `embedded-can` has no asynchronous trait, so that each HAL of Embassy has functions of its own,
/// and its blocking one waits for a frame: only the program knows how many replies come in a tick.
/// Send the frames that the start of a loop leaves here before its first tick.
///
/// ```
/// use embedded_can::{ExtendedId, Frame};
/// use joint_drivers::{CanJoints, JointDrives, JointEncoders, JointMapping, JointRange, Outbox};
/// use joint_drivers::{can::FdFrame, moteus::Moteus};
/// # struct Hal(Vec<FdFrame>);
/// # impl Hal {
/// #     async fn read(&mut self) -> FdFrame { self.0.pop().unwrap() }
/// #     async fn write(&mut self, frame: &FdFrame) { self.0.push(*frame) }
/// # }
/// async fn tick(can: &mut Hal, joints: &CanJoints<Outbox<FdFrame, 1>, Moteus, 1>) {
///     joints.receive(&can.read().await);
///     let (mut encoders, mut drives) = (joints, joints); // those of a `ControlLoop`
///     if encoders.read().is_ok() {
///         let _ = drives.set_torques(&[0.5]);
///     }
///     for frame in joints.commands().into_iter().flatten() {
///         can.write(&frame).await;
///     }
/// }
/// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// # let data = [0x24, 4, 0, 0x0a, 0, 0x50, 0, 0, 1, 0x70, 0xff, 0x23, 0x0d, 0x18, 0x14, 0];
/// # let mut hal = Hal(vec![FdFrame::new(ExtendedId::new(0x100).unwrap(), &data).unwrap()]);
/// let joints = CanJoints::new(Outbox::new(), [Moteus::new(1, 0, 10.0, mapping)?]);
/// # {
/// #     let ticked = core::pin::pin!(tick(&mut hal, &joints));
/// #     let mut context = core::task::Context::from_waker(core::task::Waker::noop());
/// #     assert!(core::future::Future::poll(ticked, &mut context).is_ready());
/// # }
/// # assert_eq!(hal.0[0].data()[9..13], 0.5_f32.to_le_bytes());
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Outbox<F, const V: usize> {
    /// The commands of the joints, and the requests to them.
    places: [[Place<F>; V]; 2],
    /// The place whose turn it is: the commands from it on have waited longest.
    next: usize,
    error: Option<ErrorKind>,
}

/// The last frame of a joint.
#[derive(Clone, Copy, Debug)]
struct Place<F> {
    frame: Option<F>,
    waits: bool,
}

impl<F, const V: usize> Outbox<F, V> {
    /// An empty one, with room for a command of each joint and a request to it.
    pub const fn new() -> Self {
        let places = [const { [const { Place { frame: None, waits: false } }; V] }; 2];
        Self { places, next: 0, error: None }
    }

    /// The place of the command that has waited longest, else of a request.
    fn oldest(&mut self) -> Option<&mut Place<F>> {
        let places = self.places.as_flattened_mut();
        let waits = |at: &usize| places.get(*at).is_some_and(|place| place.waits);
        let mut turns = (self.next..V).chain(0..self.next.min(V)).chain(V..2 * V);
        self.next = turns.find(waits).unwrap_or(0);
        places.get_mut(self.next).filter(|place| place.waits)
    }
}

impl<F: Frame, const V: usize> Outbox<F, V> {
    /// Sends the frames that wait, so many that a bus which takes them out for ever ends, too.
    fn send_to(&mut self, bus: &mut impl Can<Frame = F>) -> Result<(), ErrorKind> {
        for _ in 0..MOST_FRAMES {
            let Some(place) = self.oldest() else { break };
            let Some(frame) = &place.frame else { break };
            let displaced = match bus.transmit(frame) {
                Err(WouldBlock) => break,
                Err(Other(error)) => return Err(error.kind()),
                Ok(displaced) => displaced,
            };
            place.waits = false;
            self.next += 1;
            let Some(displaced) = displaced else { continue };
            // A frame of a lower priority was taken out for it: it waits as before, unless there is
            // a newer one in its place.
            let is_it =
                |frame: &F| frame.id() == displaced.id() && frame.data() == displaced.data();
            let places = self.places.as_flattened_mut().iter_mut().enumerate();
            for (at, place) in places.filter(|(_, place)| place.frame.as_ref().is_some_and(is_it)) {
                (place.waits, self.next) = (true, at);
            }
        }
        Ok(())
    }
}

impl<F, const V: usize> Default for Outbox<F, V> {
    fn default() -> Self {
        Self::new()
    }
}

impl<F: Frame + Clone, const V: usize> JointBus for Outbox<F, V> {
    type Frame = F;

    fn send(&mut self, frame: &F, joint: usize, is_request: bool) -> Result<(), CanError> {
        let [commands, requests] = &mut self.places;
        let places = if is_request { requests } else { commands };
        let place = places.get_mut(joint).ok_or(CanError::Full)?;
        let waited = mem::replace(&mut place.waits, true);
        if !(waited && is_request) {
            place.frame = Some(frame.clone());
        }
        if waited { Err(CanError::Full) } else { Ok(()) }
    }

    fn next(&mut self) -> nb::Result<F, ErrorKind> {
        Err(self.error.take().map_or(WouldBlock, Other))
    }
}

impl<F: Frame + Clone, Joint: CanJoint, const V: usize> CanJoints<Outbox<F, V>, Joint, V> {
    /// Takes a frame that has come; the error of a wrong one is that of the next reading.
    pub fn receive(&self, frame: &F) {
        // Nobody else holds it: each of these functions returns it before it ends.
        if let Ok(mut state) = self.0.try_borrow_mut() {
            state.take(frame);
        }
    }

    /// The frames to send, in their order, which are then no longer here. While the last one is a
    /// frame, call it again: there may be requests beside the commands of all joints.
    pub fn commands(&self) -> [Option<F>; V] {
        let mut all = [const { None }; V];
        let Ok(mut state) = self.0.try_borrow_mut() else { return all };
        let waiting = state.bus.places.as_flattened_mut().iter_mut().filter(|place| place.waits);
        for (frame, place) in all.iter_mut().zip(waiting) {
            place.waits = false;
            // Not a clone: an `Option` that is copied in parts takes 250 instructions.
            *frame = place.frame.take();
        }
        all
    }

    /// Takes the frames that have come on a bus, and sends those that wait, the oldest first, as
    /// far as it has places for them. Call it again and again between two ticks, or when the
    /// controller says that a place is free or a frame came: with three places and seven joints
    /// three times at least. An error of the bus is that of the next reading.
    ///
    /// ```
    /// # use embedded_can::{ErrorKind, ExtendedId, Frame, nb::Can};
    /// # use joint_drivers::can::{CanError, FdFrame};
    /// # use joint_drivers::moteus::Moteus;
    /// # use joint_drivers::{CanJoints, JointDrives, JointEncoders, JointMapping, JointRange, Outbox};
    /// # // A controller of one place that is never free again.
    /// # struct Chip(Option<FdFrame>, Vec<FdFrame>);
    /// # impl Can for Chip {
    /// #     type Frame = FdFrame;
    /// #     type Error = ErrorKind;
    /// #     fn transmit(&mut self, frame: &FdFrame) -> nb::Result<Option<FdFrame>, ErrorKind> {
    /// #         if self.0.is_some() { return Err(nb::Error::WouldBlock) }
    /// #         self.0 = Some(*frame);
    /// #         Ok(None)
    /// #     }
    /// #     fn receive(&mut self) -> nb::Result<FdFrame, ErrorKind> { self.1.pop().ok_or(nb::Error::WouldBlock) }
    /// # }
    /// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
    /// # let data = [0x24, 4, 0, 0x0a, 0, 0x50, 0, 0, 1, 0x70, 0xff, 0x23, 0x0d, 0x18, 0x14, 0];
    /// # let mut chip = Chip(None, vec![FdFrame::new(ExtendedId::new(0x100).unwrap(), &data).unwrap()]);
    /// # let drives = [Moteus::new(1, 0, 10.0, mapping)?, Moteus::new(2, 0, 10.0, mapping)?];
    /// let joints = CanJoints::new(Outbox::<FdFrame, 2>::new(), drives);
    /// (&joints).set_torques(&[0.5, 0.5])?;
    /// // The controller has one place, and it is not free again before the next tick.
    /// joints.exchange(&mut chip);
    /// let silent = (&joints).read().unwrap_err();
    /// assert_eq!((silent.joint, silent.error), (1, CanError::NoReply));
    /// let late = (&joints).set_torques(&[0.6, 0.6]).unwrap_err();
    /// assert_eq!((late.joint, late.error), (1, CanError::Full));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn exchange(&self, bus: &mut impl Can<Frame = F>) {
        let Ok(mut state) = self.0.try_borrow_mut() else { return };
        let received = state.receive(|_| bus.next());
        let sent = state.bus.send_to(bus);
        state.bus.error = state.bus.error.or(received.and(sent).err());
    }
}
