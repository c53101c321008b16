use super::demand;

#[test]
fn what_is_no_number_reaches_no_drive_and_is_forgotten() {
    demand(37);
}
