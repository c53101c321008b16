//! The command line of the importer.

fn main() {}
