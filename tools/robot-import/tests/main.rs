//! Imports from files to written code and projects, in one program.

mod held;
mod hostile;
mod imports;
mod mjcf;
mod names;
mod outputs;
mod project;
mod readers;
mod written;
