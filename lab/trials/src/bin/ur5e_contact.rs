//! Prints the rows of the scene `ur5e_contact`, as the firmware's bin of this name does.

fn main() {
    lab_target::contact::crash::rows(|row| println!("{row}"));
}
