//! The queue between the interrupt of the control tick and the main loop.
//!
//! It is two of [`heapless::spsc`]: neither side waits for the other, and neither masks an
//! interrupt. They pass on where a sample is, not the sample: the interrupt writes each one where
//! the main loop reads it.

use core::mem;

use heapless::spsc;

use crate::message::{Sample, Tick};

/// The memory for the samples of a [`Queue`]: Q ticks of N joints.
#[derive(Debug)]
pub struct Slots<const N: usize, const Q: usize> {
    /// The one that is written.
    first: Sample<N>,
    others: [Sample<N>; Q],
}

/// Room for Q − 1 ticks of N joints in [`Slots`].
///
/// ```
/// let mut slots = machine_link::Slots::<6, 32>::default();
/// let mut queue = machine_link::Queue::new();
/// let (mut interrupt, _) = machine_link::split(&mut slots, &mut queue, 0);
/// assert_eq!((0..40).filter(|_| interrupt.push()).count(), 31);
/// ```
#[derive(Debug)]
pub struct Queue<'s, const N: usize, const Q: usize> {
    filled: spsc::Queue<&'s mut Sample<N>, Q>,
    free: spsc::Queue<&'s mut Sample<N>, Q>,
}

/// The interrupt's side.
#[allow(missing_debug_implementations, reason = "heapless's sides have none")]
pub struct Producer<'q, 's, const N: usize> {
    filled: spsc::Producer<'q, &'s mut Sample<N>>,
    free: spsc::Consumer<'q, &'s mut Sample<N>>,
    sample: &'s mut Sample<N>,
    number: u32,
    dropped: u32,
}

/// The main loop's side.
#[allow(missing_debug_implementations, reason = "heapless's sides have none")]
pub struct Consumer<'q, 's, const N: usize> {
    filled: spsc::Consumer<'q, &'s mut Sample<N>>,
    free: spsc::Producer<'q, &'s mut Sample<N>>,
    period: u32,
}

impl<const N: usize, const Q: usize> Default for Slots<N, Q> {
    fn default() -> Self {
        Self { first: Sample::default(), others: [(); Q].map(|()| Sample::default()) }
    }
}

impl<const N: usize, const Q: usize> Queue<'_, N, Q> {
    /// An empty queue.
    ///
    /// ```
    /// const EMPTY: machine_link::Queue<'_, 6, 32> = machine_link::Queue::new();
    /// # let _ = EMPTY;
    /// ```
    #[must_use]
    pub const fn new() -> Self {
        Self { filled: spsc::Queue::new(), free: spsc::Queue::new() }
    }
}

impl<const N: usize, const Q: usize> Default for Queue<'_, N, Q> {
    fn default() -> Self {
        Self::new()
    }
}

/// The two sides of a queue. `period` is the number of counts after which the timer of the samples
/// begins again; 0 if there is no timer.
///
/// ```
/// use machine_link::{Queue, Slots, split};
/// let mut slots = Slots::<1, 2>::default(); // room for one tick
/// let mut queue = Queue::new();
/// let (mut interrupt, mut main) = split(&mut slots, &mut queue, 0);
/// assert!(interrupt.push());
/// assert!(!interrupt.push()); // full: dropped
/// assert_eq!(interrupt.dropped(), 1);
/// assert!(main.pop().is_some() && main.pop().is_none());
/// ```
#[must_use]
pub fn split<'q, 's, const N: usize, const Q: usize>(
    slots: &'s mut Slots<N, Q>,
    queue: &'q mut Queue<'s, N, Q>,
    period: u32,
) -> (Producer<'q, 's, N>, Consumer<'q, 's, N>) {
    // One more than the queue has room for.
    for slot in slots.others.iter_mut().skip(1) {
        let _ = queue.free.enqueue(slot);
    }
    let (filled, waiting) = queue.filled.split();
    let (used, free) = queue.free.split();
    let producer = Producer { filled, free, sample: &mut slots.first, number: 0, dropped: 0 };
    let consumer = Consumer { filled: waiting, free: used, period };
    (producer, consumer)
}

impl<const N: usize> Producer<'_, '_, N> {
    /// The sample of this tick, to be written; it has the contents of an older one.
    ///
    /// ```
    /// use machine_link::{Queue, Slots, split};
    /// let mut slots = Slots::<1, 4>::default();
    /// let mut queue = Queue::new();
    /// let (mut interrupt, mut main) = split(&mut slots, &mut queue, 0);
    /// interrupt.sample().torque = [12.0];
    /// interrupt.push();
    /// assert_eq!(main.pop().map(|tick| tick.joints[0].torque), Some(12.0));
    /// ```
    #[inline(always)]
    pub fn sample(&mut self) -> &mut Sample<N> {
        self.sample
    }

    /// Puts the sample into the queue, with its number and the number of ticks that were dropped
    /// before it; drops it if the queue is full. Returns whether it was kept.
    ///
    /// # Cost
    /// The cost of two pointers, whatever the number of joints. [`Consumer::pop`] arranges the
    /// message outside the interrupt.
    ///
    /// ```
    /// let mut slots = machine_link::Slots::<6, 4>::default();
    /// let mut queue = machine_link::Queue::new();
    /// assert!(machine_link::split(&mut slots, &mut queue, 0).0.push());
    /// ```
    #[inline]
    pub fn push(&mut self) -> bool {
        (self.sample.number, self.sample.dropped) = (self.number, self.dropped);
        self.number = self.number.wrapping_add(1);
        let Some(free) = self.free.dequeue() else {
            self.dropped = self.dropped.wrapping_add(1);
            return false;
        };
        // There is room for as many as there are.
        let _ = self.filled.enqueue(mem::replace(&mut self.sample, free));
        true
    }

    /// Ticks that were dropped so far.
    ///
    /// ```
    /// let mut slots = machine_link::Slots::<6, 4>::default();
    /// let mut queue = machine_link::Queue::new();
    /// assert_eq!(machine_link::split(&mut slots, &mut queue, 0).0.dropped(), 0);
    /// ```
    #[must_use]
    pub fn dropped(&self) -> u32 {
        self.dropped
    }
}

impl<const N: usize> Consumer<'_, '_, N> {
    /// The oldest tick in the queue, which leaves it.
    ///
    /// ```
    /// let mut slots = machine_link::Slots::<6, 4>::default();
    /// let mut queue = machine_link::Queue::new();
    /// assert!(machine_link::split(&mut slots, &mut queue, 0).1.pop().is_none());
    /// ```
    pub fn pop(&mut self) -> Option<Tick<N>> {
        let sample = self.filled.dequeue()?;
        let tick = sample.message(self.period);
        let _ = self.free.enqueue(sample);
        Some(tick)
    }
}
