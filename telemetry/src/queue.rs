//! The queue between the interrupt of the control tick and the main loop.
//!
//! It is [`heapless::spsc`]: neither side waits for the other, and neither masks an interrupt.

use heapless::Vec;
use heapless::spsc;

use crate::message::{Sample, Tick};

/// Room for Q − 1 ticks of N joints.
///
/// ```
/// let queue = telemetry::Queue::<6, 32>::new();
/// assert_eq!(queue.capacity(), 31);
/// ```
pub type Queue<const N: usize, const Q: usize> = spsc::Queue<Tick<N>, Q>;

/// The interrupt's side.
#[allow(missing_debug_implementations, reason = "heapless's sides have none")]
pub struct Producer<'q, const N: usize> {
    queue: spsc::Producer<'q, Tick<N>>,
    number: u32,
    dropped: u32,
}

/// The main loop's side.
#[allow(missing_debug_implementations, reason = "heapless's sides have none")]
pub struct Consumer<'q, const N: usize>(spsc::Consumer<'q, Tick<N>>);

/// The two sides of a queue.
///
/// ```
/// use telemetry::{Queue, Sample, split};
/// let mut queue = Queue::<1, 2>::new(); // room for one tick
/// let (mut interrupt, mut main) = split(&mut queue);
/// assert!(interrupt.push(Sample::default()));
/// assert!(!interrupt.push(Sample::default())); // full: dropped
/// assert_eq!(interrupt.dropped(), 1);
/// assert!(main.pop().is_some() && main.pop().is_none());
/// ```
#[must_use]
pub fn split<const N: usize, const Q: usize>(
    queue: &mut Queue<N, Q>,
) -> (Producer<'_, N>, Consumer<'_, N>) {
    let (queue, consumer) = queue.split();
    let producer = Producer {
        queue,
        number: 0,
        dropped: 0,
    };
    (producer, Consumer(consumer))
}

impl<const N: usize> Producer<'_, N> {
    /// Puts a tick into the queue, with its number and the number of ticks that were dropped before it; drops it if the
    /// queue is full. Returns whether it was kept.
    ///
    /// # Cost
    /// One copy of the tick; less if it is dropped.
    ///
    /// ```
    /// use telemetry::{Queue, Sample, split};
    /// let mut queue = Queue::<6, 4>::new();
    /// assert!(split(&mut queue).0.push(Sample::default()));
    /// ```
    pub fn push(&mut self, sample: Sample<N>) -> bool {
        let number = self.number;
        self.number = number.wrapping_add(1);
        if !self.queue.ready() {
            self.dropped = self.dropped.wrapping_add(1);
            return false;
        }
        let tick = Tick {
            number,
            dropped: self.dropped,
            tick: sample.tick,
            status: sample.status,
            joints: Vec::from_array(sample.joints),
            cost: sample.cost,
        };
        // There is room: only this side fills the queue.
        self.queue.enqueue(tick).is_ok()
    }

    /// Ticks that were dropped so far.
    ///
    /// ```
    /// let mut queue = telemetry::Queue::<6, 4>::new();
    /// assert_eq!(telemetry::split(&mut queue).0.dropped(), 0);
    /// ```
    #[must_use]
    pub fn dropped(&self) -> u32 {
        self.dropped
    }
}

impl<const N: usize> Consumer<'_, N> {
    /// The oldest tick in the queue, which leaves it.
    ///
    /// ```
    /// let mut queue = telemetry::Queue::<6, 4>::new();
    /// assert!(telemetry::split(&mut queue).1.pop().is_none());
    /// ```
    pub fn pop(&mut self) -> Option<Tick<N>> {
        self.0.dequeue()
    }
}
