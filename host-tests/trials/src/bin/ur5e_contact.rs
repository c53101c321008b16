//! Prints the rows of the scene `ur5e_contact`, as the firmware's bin of this name does.

fn main() {
    firmware_demo::contact::crash::rows(|row| println!("{row}"));
}
