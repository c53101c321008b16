//! Derivatives of inverse dynamics keep their digits where differences lose them.

use crate::demand;

#[test]
fn derivatives_are_accurate_where_differences_are_not() {
    (95..=104).for_each(demand);
}
