//! The programs on the gates: robots, algorithms, and the ways in which the C is compiled.

/// The robots of the image `gates`.
pub const ROBOTS: [&str; 5] = ["ur5e", "panda", "iiwa14", "xarm7", "a1"];
pub const ALGORITHMS: [&str; 3] = ["rnea", "crba", "aba"];

/// Ways to compile the C, by the beginnings of their symbols' ends. Its functions are one block,
/// which the compiler by itself orders without regard to the number of registers: that takes up to a
/// third more cycles than the best of these.
pub const WAYS: [(&str, &str); 7] = [
    ("p", "-fsched-pressure"),
    ("pr", "-fsched-pressure -DRESTRICT=restrict"),
    ("pt", "-fsched-pressure -fno-tree-ter"),
    ("p7", "-fsched-pressure -mtune=sifive-7-series"),
    ("p7r", "-fsched-pressure -mtune=sifive-7-series -DRESTRICT=restrict"),
    ("n", "-fno-schedule-insns"),
    ("n7", "-fno-schedule-insns -mtune=sifive-7-series"),
];

/// The end of the name of a peer that computes sines itself.
pub const INSIDE: &str = ", sines inside";
