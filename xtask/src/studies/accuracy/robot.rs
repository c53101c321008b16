//! The robots whose accuracy is measured.

/// A robot with measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Robot {
    Ur5e,
    Panda,
    #[value(name = "a1_leg")]
    A1Leg,
    #[value(skip)]
    DoublePendulum,
}

impl Robot {
    pub const ALL: [Self; 4] = [Self::Ur5e, Self::Panda, Self::A1Leg, Self::DoublePendulum];
    /// The robots whose torques are computed.
    pub const COMPUTED: [Self; 3] = [Self::Ur5e, Self::Panda, Self::A1Leg];

    /// Its name in rows, lines and files, in print, and in the library; and the number of its
    /// joints.
    pub fn names(self) -> [&'static str; 4] {
        match self {
            Self::Ur5e => ["ur5e", "UR5e", "Ur5e", "6"],
            Self::Panda => ["panda", "Panda", "Panda", "7"],
            Self::A1Leg => ["a1_leg", "leg of the A1", "A1Leg", "3"],
            Self::DoublePendulum => ["double_pendulum", "double pendulum", "", "2"],
        }
    }

    /// Its name in rows, lines and files.
    pub fn name(self) -> &'static str {
        self.names()[0]
    }
}
