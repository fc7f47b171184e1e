//! The springs of a net as lines through many nodes, for drawing.

use crate::sim::net_plan::{Form, Grid, Lists, NetPlan};

/// A line through nodes that springs join one after the other.
#[derive(Debug)]
pub(super) struct Thread {
    /// The numbers of the nodes.
    pub(super) nodes: Vec<usize>,
    /// Whether it is a part of the border, which alone tells where the net is.
    pub(super) is_border: bool,
}

/// The rows and columns of a grid, without the diagonals, or lines through all springs of lists.
pub(super) fn threads(plan: &NetPlan, lists: &Lists) -> Vec<Thread> {
    match &plan.form {
        Form::Grid(grid) => of_grid(*grid),
        Form::Lists(_) => of_lists(lists),
    }
}

fn of_grid(Grid { columns, rows, .. }: Grid) -> Vec<Thread> {
    let across = (0..rows).map(|row| Thread {
        nodes: (0..columns).map(|column| row * columns + column).collect(),
        is_border: row == 0 || row + 1 == rows,
    });
    let down = (0..columns).map(|column| Thread {
        nodes: (0..rows).map(|row| row * columns + column).collect(),
        is_border: column == 0 || column + 1 == columns,
    });
    across.chain(down).filter(|thread| thread.nodes.len() > 1).collect()
}

/// Each line goes on as long as there is a spring that none has.
fn of_lists(lists: &Lists) -> Vec<Thread> {
    let mut at_node = vec![Vec::new(); lists.nodes.len()];
    for (place, spring) in lists.springs.iter().enumerate() {
        spring.between.iter().for_each(|&end| at_node[end].push(place));
    }
    let mut is_drawn = vec![false; lists.springs.len()];
    let mut threads = Vec::new();
    for first in 0..lists.springs.len() {
        if is_drawn[first] {
            continue;
        }
        is_drawn[first] = true;
        let mut nodes = lists.springs[first].between.to_vec();
        while let Some(&next) = at_node[nodes[nodes.len() - 1]].iter().find(|it| !is_drawn[**it]) {
            is_drawn[next] = true;
            let [a, b] = lists.springs[next].between;
            nodes.push(if a == nodes[nodes.len() - 1] { b } else { a });
        }
        threads.push(Thread { nodes, is_border: true });
    }
    threads
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::net_plan::PlannedSpring;

    /// The springs that lines go along, each once.
    fn drawn(threads: &[Thread]) -> Vec<[usize; 2]> {
        let pairs = threads.iter().flat_map(|thread| thread.nodes.windows(2));
        let mut pairs: Vec<_> =
            pairs.map(|ends| [ends[0].min(ends[1]), ends[0].max(ends[1])]).collect();
        pairs.sort_unstable();
        pairs
    }

    #[test]
    fn lines_go_along_every_spring_of_lists_once() {
        let springs = [[0, 1], [1, 2], [2, 0], [2, 3], [4, 3], [5, 6]];
        let spring = |between| PlannedSpring { between, ..Default::default() };
        let lists = Lists {
            nodes: (0..7).map(|i| [f64::from(i), 0.0]).collect(),
            fixed: vec![],
            springs: springs.map(spring).to_vec(),
        };
        let threads = of_lists(&lists);
        assert_eq!(drawn(&threads), [[0, 1], [0, 2], [1, 2], [2, 3], [3, 4], [5, 6]]);
        assert_eq!(threads.len(), 3);
    }

    #[test]
    fn a_grid_is_drawn_as_its_rows_and_columns() {
        let grid = Grid { columns: 3, rows: 2, spacing: 1.0, shear: true, pin: None };
        let threads = of_grid(grid);
        assert_eq!(drawn(&threads), [[0, 1], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [4, 5]]);
        assert_eq!(threads.iter().filter(|thread| thread.is_border).count(), 4);
    }
}
