//! Draws the springs of a net as lines through many nodes.

use crate::sim::bodies::{Grid, Lists, NetLayout, NetPlan};

/// A line through successive nodes that are joined by springs.
#[derive(Debug)]
pub struct NodeLine {
    /// Indices of the nodes.
    pub nodes: Vec<usize>,
    /// Whether the line belongs to the border, which alone shows the place of the net.
    pub is_border: bool,
}

/// Maximum number of drawn rows and of drawn columns of a grid. On a stage of a thousand pixels, threads nearer than
/// eight pixels would look like a surface.
const MAX_LINES: usize = 128;

/// Maximum number of drawn nodes of a line, limited like `MAX_LINES` by the pixels of a stage.
const MAX_POINTS: usize = 512;

/// Maximum number of drawn springs of a net in the form of lists.
const MAX_SPRINGS: usize = 20_000;

/// Returns the rows and columns of a grid, without the diagonals, or lines through the springs of lists. If there are
/// more lines than pixels can show, only every n-th of them and the border are returned.
pub(super) fn lines(plan: &NetPlan) -> Vec<NodeLine> {
    match &plan.form {
        NetLayout::Grid(grid) => of_grid(*grid),
        NetLayout::Lists(lists) => of_lists(lists),
    }
}

/// Returns every n-th of `count` indices and the last one, at most `most` + 1 in all.
fn strided_indices(count: usize, most: usize) -> impl Iterator<Item = usize> + Clone {
    let step = (count - 1).div_ceil(most).max(1);
    (0..count).filter(move |index| index.is_multiple_of(step) || index + 1 == count)
}

fn of_grid(Grid { columns, rows, .. }: Grid) -> Vec<NodeLine> {
    let across = strided_indices(rows, MAX_LINES).map(|row| NodeLine {
        nodes: strided_indices(columns, MAX_POINTS).map(|column| row * columns + column).collect(),
        is_border: row == 0 || row + 1 == rows,
    });
    let down = strided_indices(columns, MAX_LINES).map(|column| NodeLine {
        nodes: strided_indices(rows, MAX_POINTS).map(|row| row * columns + column).collect(),
        is_border: column == 0 || column + 1 == columns,
    });
    across.chain(down).filter(|line| line.nodes.len() > 1).collect()
}

/// Joins springs to lines. Each line continues until no unused spring leaves its last node.
fn of_lists(lists: &Lists) -> Vec<NodeLine> {
    let drawn: Vec<usize> = strided_indices(lists.springs.len(), MAX_SPRINGS).collect();
    let mut at_node = vec![Vec::new(); lists.nodes.len()];
    for &index in drawn.iter().rev() {
        lists.springs[index].between.iter().for_each(|&end| at_node[end].push(index));
    }
    let mut is_drawn = vec![false; lists.springs.len()];
    let mut lines = Vec::new();
    for first in drawn {
        if is_drawn[first] {
            continue;
        }
        is_drawn[first] = true;
        let mut nodes = lists.springs[first].between.to_vec();
        loop {
            let offered = &mut at_node[nodes[nodes.len() - 1]];
            while offered.pop_if(|it| is_drawn[*it]).is_some() {}
            let Some(next) = offered.pop() else { break };
            is_drawn[next] = true;
            let [a, b] = lists.springs[next].between;
            nodes.push(if a == nodes[nodes.len() - 1] { b } else { a });
        }
        lines.push(NodeLine { nodes, is_border: true });
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::PlannedSpring;

    /// Returns the springs under the lines, each spring once.
    fn drawn(lines: &[NodeLine]) -> Vec<[usize; 2]> {
        let pairs = lines.iter().flat_map(|line| line.nodes.windows(2));
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
        let lines = of_lists(&lists);
        assert_eq!(drawn(&lines), [[0, 1], [0, 2], [1, 2], [2, 3], [3, 4], [5, 6]]);
        assert_eq!(lines.len(), 3);
    }

    #[test]
    fn a_large_grid_is_thinned_but_keeps_its_border() {
        for (columns, rows) in [(400, 250), (100_000, 1), (1000, 100), (129, 130)] {
            let lines = of_grid(Grid { columns, rows, spacing: 1.0, shear: true, pin: None });
            let points: usize = lines.iter().map(|line| line.nodes.len()).sum();
            assert!(
                lines.len() <= 2 * (MAX_LINES + 2),
                "{columns} × {rows}: {} lines",
                lines.len()
            );
            assert!(points <= 2 * (MAX_LINES + 2) * (MAX_POINTS + 2), "{points} points");
            let corners = [0, columns - 1, (rows - 1) * columns, rows * columns - 1];
            let has =
                |node: &usize| lines.iter().any(|line| line.is_border && line.nodes.contains(node));
            assert!(corners.iter().all(has), "{columns} × {rows}");
        }
    }

    #[test]
    fn a_grid_is_drawn_as_its_rows_and_columns() {
        let grid = Grid { columns: 3, rows: 2, spacing: 1.0, shear: true, pin: None };
        let lines = of_grid(grid);
        assert_eq!(drawn(&lines), [[0, 1], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [4, 5]]);
        assert_eq!(lines.iter().filter(|line| line.is_border).count(), 4);
    }
}
