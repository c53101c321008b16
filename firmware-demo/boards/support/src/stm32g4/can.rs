//! FDCAN1 as the bus of the drives: classic CAN at 1 Mbit/s.
//!
//! The chip has three places for frames that have come and three for those to be sent, fewer than
//! there are joints: its interrupt moves them from and to queues in memory. The crate for this
//! peripheral can panic, so that its registers are here. RM0440, section 44.

use core::cell::RefCell;
use core::ptr;

use cortex_m::interrupt::{Mutex, free};
use cortex_m::peripheral::NVIC;
use embedded_can::nb::Can;
use embedded_can::{ErrorKind, ExtendedId, Frame, Id, StandardId};
use heapless::Deque;
use joint_drivers::can::FdFrame;
use stm32g4xx_hal::interrupt;
use stm32g4xx_hal::pac::{FDCAN1, Interrupt};
use stm32g4xx_hal::rcc::{Enable, Rcc, Reset};

/// Frames of each queue: those of a tick, and as many that are late.
const FRAMES: usize = 16;

/// The peripheral, and the frames that it cannot hold.
struct Chip {
    can: Option<FDCAN1>,
    to_send: Deque<FdFrame, FRAMES>,
    came: Deque<FdFrame, FRAMES>,
}

static CHIP: Mutex<RefCell<Chip>> =
    Mutex::new(RefCell::new(Chip { can: None, to_send: Deque::new(), came: Deque::new() }));

/// Calls a function while no interrupt is served: nobody else has the chip then.
fn with_chip<T>(call: impl FnOnce(&mut Chip) -> T) -> Option<T> {
    free(|cs| CHIP.borrow(cs).try_borrow_mut().ok().map(|mut chip| call(&mut chip)))
}

/// The bus of the drives.
pub struct Bus(());

impl Bus {
    /// The bus on its pins, with a crystal of 24 MHz.
    pub fn start(can: FDCAN1, rcc: &mut Rcc) -> Self {
        FDCAN1::enable(rcc);
        FDCAN1::reset(rcc);
        can.cccr().modify(|_, w| w.init().set_bit());
        while can.cccr().read().init().bit_is_clear() {}
        can.cccr().modify(|_, w| w.cce().set_bit());
        // 24 quanta a bit, sampled after 21 of them; each field is less by one.
        // SAFETY: values of these fields.
        can.nbtp().write(|w| unsafe {
            let w = w.nbrp().bits(0).ntseg1().bits(19);
            w.ntseg2().bits(2).nsjw().bits(2)
        });
        // Every frame goes into the first queue: after a reset there is no filter.
        // SAFETY: the three places of frames to be sent.
        can.txbtie().write(|w| unsafe { w.bits(0b111) });
        can.ie().write(|w| w.rf0ne().set_bit().tce().set_bit());
        can.ile().write(|w| w.eint0().set_bit());
        can.cccr().modify(|_, w| w.init().clear_bit());
        with_chip(|chip| chip.can = Some(can));
        // SAFETY: nothing relies on this interrupt being masked.
        unsafe { NVIC::unmask(Interrupt::FDCAN1_IT0) };
        Self(())
    }
}

impl Can for Bus {
    type Frame = FdFrame;
    type Error = ErrorKind;

    fn transmit(&mut self, frame: &FdFrame) -> nb::Result<Option<FdFrame>, ErrorKind> {
        let queued = with_chip(|chip| match chip.to_send.push_back(*frame) {
            Ok(()) => Ok(None),
            Err(_) => Err(chip.error().map_or(nb::Error::WouldBlock, nb::Error::Other)),
        });
        NVIC::pend(Interrupt::FDCAN1_IT0);
        queued.unwrap_or(Err(nb::Error::WouldBlock))
    }

    fn receive(&mut self) -> nb::Result<FdFrame, ErrorKind> {
        with_chip(|chip| chip.came.pop_front()).flatten().ok_or(nb::Error::WouldBlock)
    }
}

#[interrupt]
fn FDCAN1_IT0() {
    with_chip(Chip::exchange);
}

/// The message RAM of FDCAN1, the places of received frames and of those to be sent in it, and
/// their distance, words.
const RAM: *mut u32 = 0x4000_a400 as *mut u32;
const RECEIVED: u8 = 44;
const TO_SEND: u8 = 158;
const PLACE: u8 = 18;
/// Bits of a frame's first word.
const EXTENDED: u32 = 1 << 30;
const REMOTE: u32 = 1 << 29;

impl Chip {
    /// The last error of the bus, if frames are not sent for it.
    #[cold]
    fn error(&self) -> Option<ErrorKind> {
        let status = self.can.as_ref()?.psr().read();
        if status.bo().bit() {
            return Some(ErrorKind::Other);
        }
        match status.lec().bits() {
            1 => Some(ErrorKind::Stuff),
            2 => Some(ErrorKind::Form),
            3 => Some(ErrorKind::Acknowledge),
            4 | 5 => Some(ErrorKind::Bit),
            6 => Some(ErrorKind::Crc),
            _ => None,
        }
    }

    /// Moves frames between the chip and the queues.
    fn exchange(&mut self) {
        let Some(can) = &self.can else {
            return;
        };
        can.ir().write(|w| w.rf0n().set_bit().tc().set_bit());
        // Off the bus after 255 errors; it comes back after 128 times 11 recessive bits.
        if can.psr().read().bo().bit() {
            can.cccr().modify(|_, w| w.init().clear_bit());
        }
        while can.rxf0s().read().f0fl().bits() > 0 {
            let at = can.rxf0s().read().f0gi().bits();
            let frame = decode(read(RECEIVED, at));
            // SAFETY: the place that was just read.
            can.rxf0a().write(|w| unsafe { w.f0ai().bits(at) });
            // Without room its joint has no reply in this tick, which is said there.
            let _ = frame.map(|frame| self.came.push_back(frame));
        }
        while !can.txfqs().read().tfqf().bit() {
            let Some(frame) = self.to_send.pop_front() else {
                break;
            };
            let at = can.txfqs().read().tfqpi().bits();
            write(TO_SEND, at, encode(&frame));
            // SAFETY: one of the three places.
            can.txbar().write(|w| unsafe { w.bits(1 << at) });
        }
    }
}

/// The first four words of a place.
fn read(places: u8, at: u8) -> [u32; 4] {
    core::array::from_fn(|word| {
        let word = usize::from(places + PLACE * at) + word;
        // SAFETY: within the RAM's 212 words, as `at` is below three.
        unsafe { ptr::read_volatile(RAM.add(word)) }
    })
}

fn write(places: u8, at: u8, words: [u32; 4]) {
    let first = usize::from(places + PLACE * at);
    for (word, value) in words.into_iter().enumerate() {
        // SAFETY: as in `read`.
        unsafe { ptr::write_volatile(RAM.add(first + word), value) };
    }
}

/// A frame of at most eight bytes.
fn decode([id, length, d0, d1]: [u32; 4]) -> Option<FdFrame> {
    let (length, is_remote) = ((length >> 16 & 0xf) as usize, id & REMOTE != 0);
    let id: Id = if id & EXTENDED != 0 {
        ExtendedId::new(id & 0x1fff_ffff)?.into()
    } else {
        StandardId::new((id >> 18 & 0x7ff) as u16)?.into()
    };
    if is_remote {
        return FdFrame::new_remote(id, length);
    }
    let [a, b] = [d0, d1].map(u32::to_le_bytes);
    let mut data = [0; 8];
    for (to, from) in data.iter_mut().zip(a.into_iter().chain(b)) {
        *to = from;
    }
    FdFrame::new(id, data.get(..length)?)
}

fn encode(frame: &FdFrame) -> [u32; 4] {
    let id = match frame.id() {
        Id::Standard(id) => u32::from(id.as_raw()) << 18,
        Id::Extended(id) => id.as_raw() | EXTENDED,
    };
    let remote = if frame.is_remote_frame() { REMOTE } else { 0 };
    let byte = |at: usize| frame.data().get(at).copied().unwrap_or_default();
    let [d0, d1] = [0, 4].map(|at| u32::from_le_bytes(core::array::from_fn(|k| byte(at + k))));
    [id | remote, (frame.dlc().min(8) as u32) << 16, d0, d1]
}
