//! Large grids, which are stepped by rows on all cores.

use rayon::ThreadPoolBuilder;
use regatta::sim::bodies::{Input, MAX_NODES};

use super::*;

const VALUES: Values = Values {
    damping: 0.03,
    drag: 0.01,
    gravity: 9.81,
    rest_ratio: 0.9,
    kick: [1.5, -0.5],
    ..PLAIN
};

fn plan(columns: usize, rows: usize) -> NetPlan {
    let kicked = Some(columns * rows / 2);
    NetPlan { kicked, ..grid(columns, rows, Some(Pin::Corners)) }
}

/// The same nodes and springs one by one.
fn one_by_one(plan: &NetPlan) -> NetPlan {
    NetPlan { form: NetLayout::Lists(plan.lists()), kicked: plan.kicked }
}

/// The bits of the state after some ticks from a kick.
fn state_after(plan: &NetPlan, id: &str, ticks: u32) -> Vec<u64> {
    let mut net = build(plan, VALUES, with(id));
    net.input(0.0, Input::Kick(1.0));
    run(&mut *net, 240.0, ticks, |_, _| {});
    net.q().iter().chain(net.v()).map(|number| number.to_bits()).collect()
}

#[test]
fn the_number_of_threads_changes_no_bit_of_a_large_net() {
    // Both are shared by threads: one by rows, the other by columns.
    for (columns, rows, methods) in [
        (131, 127, &["rk4", "semi-implicit-euler"][..]),
        (10_001, 1, &["rk4", "implicit-euler"][..]),
    ] {
        let plan = plan(columns, rows);
        for id in methods {
            let of_lists = state_after(&one_by_one(&plan), id, 1);
            for threads in [1, 2, 7] {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let of_rows = pool.install(|| state_after(&plan, id, 1));
                assert!(of_rows == of_lists, "{id} on {threads} threads, {columns} × {rows}");
            }
        }
    }
}

#[test]
fn a_net_has_at_most_a_hundred_thousand_nodes() {
    let net = build(&plan(400, 250), VALUES, with("semi-implicit-euler"));
    assert_eq!(net.q().len(), 2 * (MAX_NODES - 2));
    let said = grid(401, 250, None).faults().remove(0);
    assert_eq!(said.what, "the grid has 100250 nodes");
}
