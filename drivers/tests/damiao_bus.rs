//! Damiao drives on a simulated bus: their registers, errors, watchdog, supply and the scale after
//! which their count begins again. Drives of RobStride with 29 bits can be beside them. The
//! written project's bench has this file, too.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::f64::consts::TAU;

use embedded_can::nb::Can;
use embedded_can::{ErrorKind, ExtendedId, Frame, Id, StandardId};
use joint_drivers::can::FdFrame;
use joint_drivers::mit::Scale;
use joint_drivers::mit::damiao::{MODE, PMAX, TIMEOUT, TMAX, VMAX};

/// A drive and its shaft. Its numbers are those that its maker's tool shows.
#[derive(Clone, Debug)]
pub struct Drive {
    /// ESC_ID and MST_ID.
    pub number: u8,
    pub host: u16,
    /// Whether it has RobStride's own protocol, without registers. Its host is then below 256, and
    /// its error has the bits 16 to 21 of an identifier.
    pub is_robstride: bool,
    /// PMAX, VMAX, TMAX, and the gains of MIT mode.
    pub scale: Scale,
    /// 1: MIT; 2: position; 3: velocity.
    pub mode: u32,
    /// Seconds without a command after which it stops; zero: never.
    pub timeout: f64,
    pub has_supply: bool,
    pub is_enabled: bool,
    /// The number of the error in its replies, and whether its cause lasts.
    pub error: u8,
    pub error_lasts: bool,
    /// The shaft, rad and rad/s, and its angle where the count is zero.
    pub angle: f64,
    pub speed: f64,
    pub zero: f64,
    /// Position, velocity, K_p, K_d and torque of the last command, and the seconds since then.
    pub command: [f64; 5],
    pub silence: f64,
}

impl Drive {
    /// An enabled one at zero, without an error and a watchdog.
    pub fn new(number: u8, scale: Scale) -> Self {
        Self {
            number,
            host: 0x10 + u16::from(number),
            is_robstride: false,
            scale,
            mode: 1,
            timeout: 0.0,
            has_supply: true,
            is_enabled: true,
            error: 0,
            error_lasts: false,
            angle: 0.0,
            speed: 0.0,
            zero: 0.0,
            command: [0.0; 5],
            silence: 0.0,
        }
    }

    /// The torque of the shaft, N·m.
    pub fn torque(&self) -> f64 {
        let [q, qd, kp, kd, torque] = self.command;
        let sum = kp * (q - (self.angle - self.zero)) + kd * (qd - self.speed) + torque;
        let most = f64::from(self.scale.torque);
        if self.has_supply && self.is_enabled && self.mode == 1 && self.error == 0 {
            sum.clamp(-most, most)
        } else {
            0.0
        }
    }

    /// Switches the supply. A drive that starts counts from within a turn of its zero, and delivers
    /// no torque.
    pub fn supply(&mut self, has_supply: bool) {
        if has_supply && !self.has_supply {
            self.zero += ((self.angle - self.zero) / TAU).round() * TAU;
            (self.is_enabled, self.command) = (false, [0.0; 5]);
            self.error = if self.error_lasts { self.error } else { 0 };
        }
        self.has_supply = has_supply;
    }

    /// Moves its clock on.
    pub fn advance(&mut self, seconds: f64) {
        self.silence += seconds;
        if self.timeout > 0.0 && self.silence > self.timeout && self.is_enabled {
            (self.error, self.is_enabled) = (0xd, false);
        }
    }

    /// The reply to a frame, if it is for this drive.
    pub fn take(&mut self, frame: &FdFrame) -> Option<FdFrame> {
        let data: [u8; 8] = frame.data().try_into().ok()?;
        if !self.has_supply {
            return None;
        }
        let id = match frame.id() {
            Id::Standard(id) if !self.is_robstride => id,
            Id::Extended(id) if self.is_robstride => {
                let [kind, .., number] = id.as_raw().to_be_bytes();
                self.is_enabled &= kind != 4;
                // Types 1, 3, 4 and 6.
                let request = [0, 0xfc, 0xfd - 2 * (data[0] & 1), 0xfe][usize::from(kind / 2)];
                return (number == self.number).then(|| self.obey(request, frame));
            }
            _ => return None,
        };
        if id.as_raw() == 0x7ff && data[..3] == [self.number, 0, 0x33] {
            let value = match data[3] {
                PMAX => self.scale.position.to_le_bytes(),
                VMAX => self.scale.velocity.to_le_bytes(),
                TMAX => self.scale.torque.to_le_bytes(),
                MODE => self.mode.to_le_bytes(),
                TIMEOUT => ((self.timeout / 50e-6) as u32).to_le_bytes(),
                _ => return None,
            };
            let [b0, b1, b2, b3] = value;
            return Some(self.frame([self.number, 0, 0x33, data[3], b0, b1, b2, b3]));
        }
        let request = if data[..7] == [0xff; 7] { data[7] } else { 0 };
        (id.as_raw() == u16::from(self.number)).then(|| self.obey(request, frame))
    }

    fn obey(&mut self, request: u8, frame: &FdFrame) -> FdFrame {
        self.silence = 0.0;
        match request {
            0xfb if !self.error_lasts => self.error = 0,
            0xfc if self.error == 0 => self.is_enabled = true,
            0xfd => self.is_enabled = false,
            0xfe => self.zero = self.angle,
            0 => self.command = decoded(frame, &self.scale),
            _ => {}
        }
        self.reply()
    }

    /// Its feedback. At the end of its scale the count of the position begins again; the very ends
    /// are left out.
    pub fn reply(&self) -> FdFrame {
        let count = |x: f64, most: f32, last: f64| {
            ((x / f64::from(most) + 1.0) * last / 2.0).round().clamp(0.0, last) as u64
        };
        let most = f64::from(self.scale.position);
        let angle = (self.angle - self.zero + most).rem_euclid(2.0 * most) - most;
        if self.is_robstride {
            let Scale { position, velocity, torque, .. } = self.scale;
            let all = [(angle, position), (self.speed, velocity), (self.torque(), torque)];
            let pack = |data, &(x, most): &_| data << 16 | count(x, most, 65_535.0);
            let data = all.iter().fold(0_u64, pack) << 16 | 300;
            let state = u32::from(self.is_enabled) << 7 | u32::from(self.error);
            let id = 2 << 24 | state << 16 | u32::from(self.number) << 8 | u32::from(self.host);
            let id = ExtendedId::new(id).expect("29 bits");
            return FdFrame::new(id, &data.to_be_bytes()).expect("8 bytes");
        }
        let status = match self.error {
            0 => u8::from(self.is_enabled),
            error => error,
        };
        let all = u64::from(status << 4 | self.number & 0x0f) << 56
            | count(angle, self.scale.position, 65_535.0).clamp(1, 65_534) << 40
            | count(self.speed, self.scale.velocity, 4095.0) << 28
            | count(self.torque(), self.scale.torque, 4095.0) << 16
            | 40 << 8
            | 35;
        self.frame(all.to_be_bytes())
    }

    fn frame(&self, data: [u8; 8]) -> FdFrame {
        FdFrame::new(StandardId::new(self.host).expect("11 bits"), &data).expect("8 bytes")
    }
}

/// The command of a drive as it decodes it, in f64.
pub fn decoded(frame: &FdFrame, scale: &Scale) -> [f64; 5] {
    let data = u64::from_be_bytes(frame.data().try_into().unwrap());
    let bits = |from: u32, count: u32| ((data >> from) & ((1 << count) - 1)) as f64;
    let ([v, kp, kd, torque], last) = match frame.id() {
        Id::Standard(_) => ([36, 24, 12, 0].map(|from| bits(from, 12)), 4095.0),
        Id::Extended(id) => {
            let torque = f64::from((id.as_raw() >> 8) as u16);
            ([bits(32, 16), bits(16, 16), bits(0, 16), torque], 65_535.0)
        }
    };
    let signed = |count: f64, most: f32, last: f64| (2.0 * count / last - 1.0) * f64::from(most);
    [
        signed(bits(48, 16), scale.position, 65_535.0),
        signed(v, scale.velocity, last),
        kp / last * f64::from(scale.kp),
        kd / last * f64::from(scale.kd),
        signed(torque, scale.torque, last),
    ]
}

/// The wire, what is wrong with it, and the drives in their order from the board.
#[derive(Debug, Default)]
pub struct Wire {
    pub drives: Vec<Drive>,
    pub replies: VecDeque<FdFrame>,
    /// Only so many drives are connected.
    pub reaches: Option<usize>,
    /// The places for frames to be sent, which are free again in the next tick if a drive
    /// acknowledges them.
    pub places: usize,
    used: usize,
    /// The error that the controller of the bus has.
    pub error: Option<ErrorKind>,
    /// So many frames of others come in each tick.
    pub foreign: usize,
    /// One reply of so many is destroyed; zero: none.
    pub destroys: usize,
    count: usize,
}

impl Wire {
    /// Drives at a board with a queue of sixteen frames.
    pub fn new(drives: Vec<Drive>) -> Self {
        Self { drives, places: 16, ..Self::default() }
    }

    /// Ends a tick of so many seconds.
    pub fn advance(&mut self, seconds: f64) {
        let reaches = self.reaches.unwrap_or(usize::MAX);
        if self.drives.iter().take(reaches).any(|drive| drive.has_supply) {
            self.used = 0;
        }
        self.drives.iter_mut().for_each(|drive| drive.advance(seconds));
        let id = StandardId::new(0x700).expect("11 bits");
        let other = FdFrame::new(id, &[0; 8]).expect("8 bytes");
        self.replies.extend(core::iter::repeat_n(other, self.foreign));
    }
}

/// The board's end of a wire.
#[derive(Clone, Copy, Debug)]
pub struct Bus<'a>(pub &'a RefCell<Wire>);

impl Can for Bus<'_> {
    type Frame = FdFrame;
    type Error = ErrorKind;

    fn transmit(&mut self, frame: &FdFrame) -> nb::Result<Option<FdFrame>, ErrorKind> {
        let wire = &mut *self.0.borrow_mut();
        if let Some(error) = wire.error {
            return Err(nb::Error::Other(error));
        }
        if wire.used == wire.places {
            return Err(nb::Error::WouldBlock);
        }
        wire.used += 1;
        for drive in wire.drives.iter_mut().take(wire.reaches.unwrap_or(usize::MAX)) {
            let Some(reply) = drive.take(frame) else { continue };
            wire.count += 1;
            if wire.destroys == 0 || !wire.count.is_multiple_of(wire.destroys) {
                wire.replies.push_back(reply);
            }
        }
        Ok(None)
    }

    fn receive(&mut self) -> nb::Result<FdFrame, ErrorKind> {
        self.0.borrow_mut().replies.pop_front().ok_or(nb::Error::WouldBlock)
    }
}
