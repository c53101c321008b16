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
use heapless::spsc::{Consumer, Producer, Queue};
use joint_drivers::can::FdFrame;
use stm32g4xx_hal::interrupt;
use stm32g4xx_hal::pac::{FDCAN1, Interrupt};
use stm32g4xx_hal::rcc::{Enable, Rcc, Reset};

/// Frames of each queue: those of a tick, and as many that are late.
const FRAMES: usize = 17;

/// The queues, which `start` puts to work.
pub struct Queues {
    to_send: Queue<FdFrame, FRAMES>,
    came: Queue<FdFrame, FRAMES>,
}

impl Queues {
    pub const fn new() -> Self {
        Self {
            to_send: Queue::new(),
            came: Queue::new(),
        }
    }
}

/// The bus of the drives: the queues' other ends.
pub struct Bus {
    to_send: Producer<'static, FdFrame>,
    came: Consumer<'static, FdFrame>,
}

/// The interrupt's ends, and the peripheral.
struct Chip {
    can: FDCAN1,
    to_send: Consumer<'static, FdFrame>,
    came: Producer<'static, FdFrame>,
}

static CHIP: Mutex<RefCell<Option<Chip>>> = Mutex::new(RefCell::new(None));

impl Bus {
    /// The bus on its pins, with a crystal of 24 MHz.
    pub fn start(can: FDCAN1, queues: &'static mut Queues, rcc: &mut Rcc) -> Self {
        FDCAN1::enable(rcc);
        FDCAN1::reset(rcc);
        can.cccr().modify(|_, w| w.init().set_bit());
        while can.cccr().read().init().bit_is_clear() {}
        can.cccr().modify(|_, w| w.cce().set_bit());
        // 24 quanta a bit, sampled after 21 of them; the fields are less by one.
        // SAFETY: values of these fields.
        can.nbtp().write(|w| unsafe {
            (w.nbrp().bits(0).ntseg1().bits(19))
                .ntseg2()
                .bits(2)
                .nsjw()
                .bits(2)
        });
        // Every frame into the first queue: after a reset there is no filter.
        can.txbtie().write(|w| unsafe { w.bits(0b111) }); // SAFETY: the three places.
        can.ie().write(|w| w.rf0ne().set_bit().tce().set_bit());
        can.ile().write(|w| w.eint0().set_bit());
        can.cccr().modify(|_, w| w.init().clear_bit());
        let (to_send, from_tick) = queues.to_send.split();
        let (to_tick, came) = queues.came.split();
        let chip = Chip {
            can,
            to_send: from_tick,
            came: to_tick,
        };
        free(|cs| CHIP.borrow(cs).replace(Some(chip)));
        // SAFETY: nothing waits for this interrupt to be masked.
        unsafe { NVIC::unmask(Interrupt::FDCAN1_IT0) };
        Self { to_send, came }
    }
}

impl Can for Bus {
    type Frame = FdFrame;
    type Error = ErrorKind;

    fn transmit(&mut self, frame: &FdFrame) -> nb::Result<Option<FdFrame>, ErrorKind> {
        let queued = self.to_send.enqueue(*frame);
        NVIC::pend(Interrupt::FDCAN1_IT0);
        queued.map(|()| None).map_err(|_| nb::Error::WouldBlock)
    }

    fn receive(&mut self) -> nb::Result<FdFrame, ErrorKind> {
        self.came.dequeue().ok_or(nb::Error::WouldBlock)
    }
}

#[interrupt]
fn FDCAN1_IT0() {
    free(|cs| {
        if let Some(chip) = CHIP.borrow(cs).borrow_mut().as_mut() {
            chip.exchange();
        }
    });
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
    /// Moves frames between the chip and the queues.
    fn exchange(&mut self) {
        let can = &self.can;
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
            let _ = frame.map(|frame| self.came.enqueue(frame));
        }
        while !can.txfqs().read().tfqf().bit() {
            let Some(frame) = self.to_send.dequeue() else {
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
    let length = (length >> 16 & 0xf) as usize;
    let id: Id = if id & EXTENDED != 0 {
        ExtendedId::new(id & 0x1fff_ffff)?.into()
    } else {
        StandardId::new((id >> 18 & 0x7ff) as u16)?.into()
    };
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
