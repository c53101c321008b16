//! Prints the rows of the scene `so101_learn`, as the firmware's bin of this name does.

fn main() {
    lab_target::learning::run::rows(|row| println!("{row}"));
}
