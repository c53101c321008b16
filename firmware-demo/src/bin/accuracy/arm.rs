//! An arm: as a robot of rigid joints, and on joints that give way.

use dynamics_core::control::Reference;
use firmware_demo::accuracy::list;
use firmware_demo::accuracy::robots::{Compared, Swung};
use firmware_demo::target;

use super::accuracy;

/// The ways of the robot T, rigid and on joints that give way.
pub fn run<T: Compared<N, N, W> + Swung<N>, const N: usize, const W: usize>() -> ! {
    let Ok(swing) = T::swing() else {
        target::fail("the robot cannot swing there");
    };
    let mut priced = accuracy::rigid::<T, N, N, W>();
    let mut tick = swing.ticks() / 8;
    priced.course = [(); accuracy::TICKS].map(|()| {
        tick += 1;
        swing.course(tick)
    });
    priced.spread = priced.course;
    list::compliant::<T, N>(&mut priced);
    accuracy::done()
}
