use super::*;
use crate::sim::TickRate;
use crate::sim::integrators::method;

/// Returns how a method meets a criterion with one step per tick, at this cost and, if its margins are searched, with
/// this reserve.
fn met(cost_per_s: f64, reserve: Option<f64>) -> CriterionMet {
    CriterionMet {
        tick_hz: 60.into(),
        substeps: 1,
        evaluations_per_s: cost_per_s,
        cost_per_s,
        are_margins_searched: reserve.is_some(),
        slowest_hz: reserve.map(|_| 1),
        stiffness_factor: reserve,
        limited_by: reserve.map(|_| "stiffness".into()),
    }
}

/// Ids of methods, in the order of the table.
const IDS: [&str; 5] =
    ["explicit-euler", "midpoint", "rk4", "adams-bashforth-2", "velocity-verlet"];

fn with_ranking<T>(mets: &[CriterionMet], see: impl FnOnce(&Ranking) -> T) -> T {
    let methods = IDS.map(|id| method(id).expect("a method of the table"));
    see(&Ranking::new(methods.into_iter().zip(mets).enumerate()))
}

/// Returns the index of the recommended method, given costs and reserves.
fn first(costs: &[(f64, f64)]) -> Option<usize> {
    let mets: Vec<_> = costs.iter().map(|&(cost, reserve)| met(cost, Some(reserve))).collect();
    with_ranking(&mets, |it| it.recommended_index())
}

#[test]
fn equal_costs_rank_by_reserve_then_symplectic_and_then_by_table_order() {
    let unmet = (1e9, 1.0);
    let alike = (60.0, 9.0);
    assert_eq!(first(&[unmet, unmet, unmet, alike, alike]), Some(4), "velocity Verlet");
    assert_eq!(first(&[unmet, unmet, unmet, alike, (60.0, 8.9)]), Some(3));
    assert_eq!(first(&[unmet, (60.0, 1.6), (60.0, 9.0)]), Some(2));
    assert_eq!(first(&[unmet, (60.0, 9.0), (60.0, 9.0)]), Some(1));
    assert_eq!(first(&[(60.0, 1.6), (61.0, 10.0)]), Some(0), "the cost comes before the reserve");
    assert_eq!(first(&[]), None);
}

#[test]
fn explicit_euler_comes_after_every_method_of_equal_cost() {
    assert_eq!(first(&[(60.0, 9.0), (60.0, 1.1)]), Some(1), "whatever the reserves");
    assert_eq!(first(&[(60.0, 9.0), (61.0, 9.4)]), Some(0), "it is the cheapest");
    assert_eq!(first(&[(60.0, 9.0), (60.0, 1.1), (120.0, 2.0)]), Some(2));
}

#[test]
fn little_reserve_yields_to_more_at_up_to_twice_the_cost() {
    for (costs, wanted) in [
        (&[(60.0, 1.4), (120.0, 1.5)][..], 1),
        (&[(60.0, 1.4), (121.0, 10.0)], 0),
        (&[(60.0, 1.5), (120.0, 10.0)], 0),
        (&[(60.0, 1.4), (120.0, 1.4)], 0),
        // The winner is the cheapest method with enough reserve, and not the method with the largest reserve.
        (&[(60.0, 1.1), (90.0, 1.6), (120.0, 10.0)], 1),
        // The replacement may be passed over for the same reason.
        (&[(60.0, 1.1), (100.0, 1.3), (200.0, 1.7), (400.0, 10.0)], 2),
        (&[(60.0, 1.1), (100.0, 1.3), (201.0, 1.7)], 1),
    ] {
        assert_eq!(first(costs), Some(wanted), "{costs:?}");
    }
}

#[test]
fn margins_are_searched_only_until_the_first_place_is_known() {
    // Each row has the costs and reserves to be found, the recommended method, and the methods whose margins are
    // searched.
    for (all, wanted, searched) in [
        (&[(60.0, 2.0), (60.0, 3.0), (61.0, 10.0)][..], 1, &[1][..]),
        (&[(60.0, 9.0), (60.0, 9.0), (60.0, 9.0)], 1, &[1, 2]),
        (&[(60.0, 9.4), (60.0, 9.0), (60.0, 9.4)], 2, &[1, 2]),
        (&[(60.0, 1.4), (60.0, 1.2), (100.0, 2.0), (110.0, 9.0)], 2, &[1, 2]),
        (&[(60.0, 1.4), (100.0, 1.3), (110.0, 1.2), (121.0, 9.0)], 0, &[0, 1, 2]),
        (&[(60.0, 1.1), (100.0, 1.3), (200.0, 1.7), (300.0, 9.0)], 2, &[0, 1, 2]),
    ] {
        let mut mets: Vec<_> = all.iter().map(|&(cost, _)| met(cost, None)).collect();
        loop {
            let undecided = with_ranking(&mets, |it| it.undecided());
            if undecided.is_empty() {
                break;
            }
            for index in undecided {
                assert!(!mets[index].are_margins_searched);
                mets[index] = met(all[index].0, Some(all[index].1));
            }
        }
        assert_eq!(with_ranking(&mets, |it| it.recommended_index()), Some(wanted), "{all:?}");
        let found: Vec<usize> = (0..mets.len()).filter(|&i| mets[i].are_margins_searched).collect();
        assert_eq!(found, searched, "{all:?}");
        assert_eq!(first(all), Some(wanted), "all searched: {all:?}");
    }
}

#[test]
fn a_reserve_is_the_lesser_margin_and_a_rate_counts_by_its_square() {
    let of = |tick_hz: u32, slowest_hz, stiffness_factor| {
        let tick_hz = tick_hz.into();
        CriterionMet { tick_hz, slowest_hz, stiffness_factor, ..met(60.0, None) }.reserve()
    };
    // The factors are 60 / 48, 14 / 14 and 4 / 3, squared.
    assert_eq!(of(60, Some(48), Some(10.0)), Some(1.5));
    assert_eq!(of(60, Some(48), Some(1.3)), Some(1.3));
    assert_eq!(of(14, Some(14), None), Some(1.0));
    assert_eq!(of(4, Some(4), Some(1.6)), Some(1.0));
    assert_eq!(of(4, Some(3), Some(3.0)), Some(1.7));
    assert_eq!(of(1, Some(1), Some(3.0)), Some(3.0));
    assert_eq!(of(60, Some(1), None), Some(3600.0), "no limit of the search");
    assert_eq!(of(60, Some(4), Some(10.0)), Some(225.0), "a stiffness that was not found");
    assert_eq!(of(60, None, Some(10.0)), Some(10.0));
    assert_eq!(of(60, None, Some(2.0)), Some(2.0));
    assert_eq!(of(60, None, None), None);
    // From a fractional rate, the search starts at the next whole rate above.
    let tick_hz: TickRate = "66.667".parse().unwrap();
    let found = CriterionMet { tick_hz, slowest_hz: Some(67), ..met(60.0, None) };
    assert_eq!(
        (found.reserve(), found.slower()),
        (Some(1.0), Some("66.667 Hz (no reserve)".into()))
    );
}
