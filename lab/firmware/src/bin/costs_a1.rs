//! The cost of inverse dynamics on the A1, and on a tree with joints of every kind.
#![no_std]
#![no_main]

mod costs;

costs::main!({
    costs::inverse::free::<robots::A1Free, 17, 19, 18>();
    costs::inverse::free::<fixtures::trees::TreeB, 17, 35, 32>();
    costs::inverse::run::<robots::A1, 16, 12>()
});
