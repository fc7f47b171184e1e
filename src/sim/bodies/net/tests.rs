//! A grid by rows has the same bits as the net given as lists, for all sizes, pins and vector widths.

use super::*;
use crate::sim::batch::InstructionSet;
use crate::sim::net_plan::{Grid, NetLayout, NetPlan, Pin};

const VALUES: [f64; 8] = [0.02, 200.0, 0.03, 0.01, 9.81, 0.9, 1.5, -0.5];

fn net(plan: &NetPlan, by_rows: bool) -> Net {
    let topology = Topology::laid_out(Arc::new(plan.clone()), by_rows);
    Net::blank(Arc::new(topology)).with_parameters(&VALUES)
}

/// Numbers about zero, with some zeros of both signs.
fn noise(count: usize, seed: u64) -> Vec<f64> {
    let mut bits = seed;
    let mut next = || {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        match bits >> 60 {
            0 => 0.0,
            1 => -0.0,
            _ => (bits >> 11) as f64 / (1_u64 << 53) as f64 - 0.5,
        }
    };
    (0..count).map(|_| next()).collect()
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// The start, where many numbers are zeros, and states around it, each with a direction.
fn states(net: &Net) -> Vec<[State<Vec<f64>>; 2]> {
    let State { q, v } = net.start();
    let state = |(seed, size): (u64, f64)| {
        let off = noise(q.len(), seed);
        let moved = q.iter().zip(&off).map(|(q, off)| q + size * off).collect();
        let [v, dq, dv] = [10, 20, 30].map(|more| noise(q.len(), seed + more));
        [State { q: moved, v }, State { q: dq, v: dv }]
    };
    let still = [State { q: q.clone(), v: v.clone() }, State { q: v.clone(), v }];
    [(2, 0.03), (3, 0.3)].map(state).into_iter().chain([still]).collect()
}

fn acceleration(net: &Net, State { q, v }: &State<Vec<f64>>) -> Vec<u64> {
    let mut a = noise(q.len(), 7);
    net.acceleration(0.0, q, v, &mut a);
    bits(&a)
}

fn assert_same(plan: &NetPlan) {
    let [rows, lists] = [true, false].map(|by_rows| net(plan, by_rows));
    for ([state, along], n) in states(&lists).iter().zip(0..) {
        let said = format!("state {n}: {plan:?}");
        assert!(acceleration(&rows, state) == acceleration(&lists, state), "{said}");
        let slope = |net: &Net| {
            let mut slope = noise(state.q.len(), 8);
            assert!(net.query(0.0, Query::Slope { state, along, slope: &mut slope }));
            bits(&slope)
        };
        assert!(slope(&rows) == slope(&lists), "slope, {said}");
        let energies = |net: &Net| bits(&net.mechanical_energy(state).expect("it has both"));
        assert_eq!(energies(&rows), energies(&lists), "{said}");
    }
    let of_springs = |net: &Net| {
        let rates = [net.fastest_rate(), net.reference_work(), net.shortest_spring()];
        (net.springs(), bits(&rates), bits(&net.start().q))
    };
    assert_eq!(of_springs(&rows), of_springs(&lists), "{plan:?}");
    let NetLayout::Grid(grid) = plan.form else { panic!("{plan:?} is no grid") };
    for node in 0..grid.nodes() {
        assert_eq!(
            rows.topology.index_of(node),
            lists.topology.index_of(node),
            "{node} of {plan:?}"
        );
        assert_eq!(rows.topology.place(node), lists.topology.place(node), "{node} of {plan:?}");
    }
    for index in 0..rows.topology.free {
        assert_eq!(
            rows.topology.node_at(index),
            lists.topology.node_at(index),
            "{index} of {plan:?}"
        );
    }
}

const PINS: [Option<Pin>; 3] = [None, Some(Pin::Top), Some(Pin::Corners)];

#[test]
fn a_grid_by_rows_has_the_bits_of_the_same_net_as_lists() {
    let sizes = [[1, 2], [2, 1], [1, 7], [9, 1], [2, 2], [3, 2], [5, 4], [8, 3], [7, 9], [62, 2]];
    let at_tiles = [[63, 3], [64, 2], [65, 3], [126, 2], [127, 1], [2, 70], [130, 4]];
    for [columns, rows] in sizes.into_iter().chain(at_tiles) {
        for pin in PINS {
            for shear in [false, true] {
                let grid = Grid { columns, rows, spacing: 0.1, shear, pin };
                let middle = columns * rows / 2;
                let kicked = [0, 1, columns - 1, columns / 2, middle].map(Some);
                for kicked in kicked.into_iter().chain([None]) {
                    let plan = NetPlan { form: NetLayout::Grid(grid), kicked };
                    if plan.faults().is_empty() {
                        assert_same(&plan);
                    }
                }
            }
        }
    }
}

#[test]
fn the_width_of_vectors_changes_no_bit_of_a_grid() {
    let grid = Grid { columns: 90, rows: 7, spacing: 0.1, shear: true, pin: Some(Pin::Corners) };
    let plan = NetPlan { form: NetLayout::Grid(grid), kicked: Some(301) };
    let net = net(&plan, true);
    let Storage::Rows(rows) = &net.topology.storage else { panic!("they are rows") };
    let Springs { shared, rest, .. } = &*net.springs;
    let forces = Accelerations { drag: 0.3, gravity: 9.81 };
    let [state, _] = &states(&net)[0];
    let sums = |set| {
        let mut sums = vec![0.0; state.q.len()];
        let vectors = [&state.q, &state.v].map(|vector| Net::nodes(vector));
        rows.sum(set, forces, (*shared, rest), vectors, Net::nodes_mut(&mut sums));
        bits(&sums)
    };
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        assert!(sums(set) == sums(InstructionSet::Portable), "{set:?}");
    }
}
