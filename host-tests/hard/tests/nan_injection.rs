use crate::demand;

#[test]
fn injected_nan_reaches_no_drive_and_is_forgotten() {
    demand(37);
}
