//! The cost of every effect in the core's inverse dynamics.
#![no_std]
#![no_main]

mod costs;

costs::main!({
    costs::effects::core::<robots::Ur5e, 6, 5>();
    costs::effects::core::<robots::Panda, 7, 6>();
    costs::done()
});
