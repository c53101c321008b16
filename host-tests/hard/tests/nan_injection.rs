use crate::demand_part;
use hard_cases::nan_injection::in_single_precision;

#[test]
fn injected_nan_reaches_no_drive_and_is_forgotten() {
    demand_part(37, in_single_precision);
}
