//! The pages of the guide as documentation: `cargo test --doc -p guide` compiles and runs the code
//! on them.

/// The README's first call.
#[doc = include_str!("../../README.md")]
pub mod readme {}

macro_rules! pages {
    ($($name:ident $file:literal),* $(,)?) => {$(
        #[doc = include_str!(concat!("src/", $file))]
        pub mod $name {}
    )*};
}

pages! {
    first_torque "first-torque.md",
    own_robot "own-robot.md",
    effects "effects.md",
    accuracy "accuracy.md",
    loops "loops.md",
    flexible "flexible.md",
    firmware "firmware.md",
    board "board.md",
    second_sensor "second-sensor.md",
    c "c.md",
    telemetry "telemetry.md",
    tuning "tuning.md",
    faults "faults.md",
    contact "contact.md",
    derivatives "derivatives.md",
    impedance "impedance.md",
    guiding "guiding.md",
    can_motors "can-motors.md",
    taught_paths "taught-paths.md",
    payload "payload.md",
    learning "learning.md",
    identification "identification.md",
    porting "porting.md",
    engine "engine.md",
    faq "faq.md",
    glossary "glossary.md",
}
