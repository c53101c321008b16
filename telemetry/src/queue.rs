//! The queue between the interrupt of the control tick and the main loop.
//!
//! It is [`heapless::spsc`]: neither side waits for the other, and neither masks an interrupt.

use heapless::spsc;

use crate::message::{Sample, Tick};

/// Room for Q − 1 ticks of N joints.
///
/// ```
/// let queue = telemetry::Queue::<6, 32>::new();
/// assert_eq!(queue.capacity(), 31);
/// ```
pub type Queue<const N: usize, const Q: usize> = spsc::Queue<Sample<N>, Q>;

/// The interrupt's side.
#[allow(missing_debug_implementations, reason = "heapless's sides have none")]
pub struct Producer<'q, const N: usize> {
    queue: spsc::Producer<'q, Sample<N>>,
    number: u32,
    dropped: u32,
}

/// The main loop's side.
#[allow(missing_debug_implementations, reason = "heapless's sides have none")]
pub struct Consumer<'q, const N: usize> {
    queue: spsc::Consumer<'q, Sample<N>>,
    period: u32,
}

/// The two sides of a queue. `period` is the number of counts after which the timer of the samples begins again; 0 if there
/// is no timer.
///
/// ```
/// use telemetry::{Queue, Sample, split};
/// let mut queue = Queue::<1, 2>::new(); // room for one tick
/// let (mut interrupt, mut main) = split(&mut queue, 0);
/// assert!(interrupt.push(&Sample::default()));
/// assert!(!interrupt.push(&Sample::default())); // full: dropped
/// assert_eq!(interrupt.dropped(), 1);
/// assert!(main.pop().is_some() && main.pop().is_none());
/// ```
#[must_use]
pub fn split<const N: usize, const Q: usize>(
    queue: &mut Queue<N, Q>,
    period: u32,
) -> (Producer<'_, N>, Consumer<'_, N>) {
    let (queue, consumer) = queue.split();
    let producer = Producer {
        queue,
        number: 0,
        dropped: 0,
    };
    let consumer = Consumer {
        queue: consumer,
        period,
    };
    (producer, consumer)
}

impl<const N: usize> Producer<'_, N> {
    /// Puts a tick into the queue, with its number and the number of ticks that were dropped before it; drops it if the
    /// queue is full. Returns whether it was kept.
    ///
    /// # Cost
    /// One copy of the sample; less if it is dropped. [`Consumer::pop`] arranges the message outside the interrupt.
    ///
    /// ```
    /// use telemetry::{Queue, Sample, split};
    /// let mut queue = Queue::<6, 4>::new();
    /// assert!(split(&mut queue, 0).0.push(&Sample::default()));
    /// ```
    #[inline]
    pub fn push(&mut self, sample: &Sample<N>) -> bool {
        // Field by field: the sample in one piece would be copied by `memcpy`, which takes twice the cycles.
        let sample = Sample {
            number: self.number,
            dropped: self.dropped,
            tick: sample.tick,
            status: sample.status,
            reference: sample.reference,
            estimate: sample.estimate,
            torque: sample.torque,
            counts: sample.counts,
        };
        self.number = self.number.wrapping_add(1);
        let kept = self.queue.enqueue(sample).is_ok();
        if !kept {
            self.dropped = self.dropped.wrapping_add(1);
        }
        kept
    }

    /// Ticks that were dropped so far.
    ///
    /// ```
    /// let mut queue = telemetry::Queue::<6, 4>::new();
    /// assert_eq!(telemetry::split(&mut queue, 0).0.dropped(), 0);
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
    /// assert!(telemetry::split(&mut queue, 0).1.pop().is_none());
    /// ```
    pub fn pop(&mut self) -> Option<Tick<N>> {
        Some(self.queue.dequeue()?.message(self.period))
    }
}
