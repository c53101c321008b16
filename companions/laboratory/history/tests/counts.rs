//! The operations of the ancestors, counted, against the table of published counts and of the
//! reasons of all differences.

use history::chain::Chain;
use history::composite_bodies::method_3;
use history::counting::{Counted, Operations, count};
use history::counts::{ANCESTORS, Counts, Term};
use history::walker_orin::{method_1, method_2, method_4};
use history::{
    State, balafoutis_patel, hollerbach_3, hollerbach_4, luh_walker_paul, uicker_kahn, waters,
};

fn operations<const N: usize>(key: &str) -> Operations {
    let chain = Chain::<Counted, N>::default();
    let state = State::new(&[0.3; N], &[0.5; N], &[0.7; N]);
    let (chain, state) = (&chain, &state);
    match key {
        "uicker_kahn" => count(|| uicker_kahn::torques(chain, state)),
        "waters" => count(|| waters::torques(chain, state)),
        "hollerbach_4" => count(|| hollerbach_4::torques(chain, state)),
        "hollerbach_3" => count(|| hollerbach_3::torques(chain, state)),
        "luh_walker_paul" => count(|| luh_walker_paul::torques(chain, state)),
        "balafoutis_patel" => count(|| balafoutis_patel::torques(chain, state)),
        "method_1" => count(|| method_1(chain, state)),
        "method_2" => count(|| method_2(chain, state)),
        "method_3" => count(|| method_3(chain, state)),
        "method_4" => count(|| method_4(chain, state)),
        _ => panic!("no ancestor {key}"),
    }
}

/// Fails unless the counts at N are those of the table.
fn compare<const N: usize>(counts: &Counts) -> Result<(), String> {
    let Operations { products, sums, quotients } = operations::<N>(counts.key);
    let n = i64::try_from(N).expect("few joints");
    let expected = counts.counted.map(|polynomial| polynomial.twelvefold(n));
    let measured = [products, sums].map(|count| 12 * count);
    let divides = if counts.key == "method_4" { 2 * n } else { 0 };
    if (measured, quotients) == (expected, divides) {
        return Ok(());
    }
    Err(format!("{}, n = {N}: {products} products, {sums} sums", counts.key))
}

#[test]
fn the_counted_operations_are_those_of_the_table() {
    for counts in &ANCESTORS {
        compare::<2>(counts).expect(counts.key);
        compare::<3>(counts).expect(counts.key);
        compare::<4>(counts).expect(counts.key);
        compare::<5>(counts).expect(counts.key);
        compare::<6>(counts).expect(counts.key);
        compare::<7>(counts).expect(counts.key);
        compare::<12>(counts).expect(counts.key);
    }
}

#[test]
fn every_difference_from_a_published_count_is_a_term() {
    for counts in &ANCESTORS {
        assert!(counts.is_explained(), "{}", counts.key);
    }
}

/// Hollerbach's totals for n = 6 are those of the polynomials, but for two numbers of products:
/// 66,271 is by 1,000 less than the polynomial without its constant, and 7,051 by 6 more.
#[test]
fn published_polynomials_give_the_published_totals() {
    let totals = [
        ("uicker_kahn", [66_271 + 1_000 - 128, 51_548]),
        ("waters", [7_051 - 6, 5_652]),
        ("hollerbach_4", [4_388, 3_586]),
        ("hollerbach_3", [2_195, 1_719]),
        ("luh_walker_paul", [852, 738]),
    ];
    for (key, expected) in totals {
        let counts = ANCESTORS.iter().find(|counts| counts.key == key);
        let published = counts.and_then(|counts| counts.published).expect("published");
        let at_6 = published.map(|polynomial| polynomial.twelvefold(6));
        assert_eq!(at_6, expected.map(|total| 12 * total), "{key}");
    }
}

#[test]
fn wrong_counts_and_missing_terms_are_refused() {
    for counts in &ANCESTORS {
        let mut wrong = *counts;
        wrong.counted[0].0[4] += 12;
        assert!(compare::<6>(&wrong).is_err(), "{}", counts.key);
        if counts.published.is_some() {
            assert!(!wrong.is_explained(), "{}", counts.key);
            for i in 0..counts.terms.len() {
                let others = [&counts.terms[..i], &counts.terms[i + 1..]].concat();
                let terms: &[Term] = others.leak();
                assert!(!Counts { terms, ..*counts }.is_explained(), "{} {i}", counts.key);
            }
        }
    }
}
