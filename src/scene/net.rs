//! Reads a `[[net]]`, which is masses joined by springs, as a grid or as lists.

use std::ops::Range as Span;
use std::sync::Arc;

use super::keys::{Key, list, number, numbers, quoted, replace_if_read};
use super::nearest::nearest;
use super::table::Table;
use super::wanted::{Field, Wanted};
use crate::sim::bodies::{
    Grid, Kind, Lists, MAX_NODES, NetFault, NetLayout, NetPart, NetPlan, Pin, PlannedSpring, Range,
    net_kind,
};

/// The name of the table array.
pub(super) const NET: &str = "net";

const COUNT: Wanted = Wanted::Whole(1..=MAX_NODES as u64);
const COLUMNS: Field = Field::required("columns", "how many nodes are in a row", COUNT);
const SPACING: Field =
    Field::required("spacing_m", "the distance of neighbours", Wanted::Number(Range::POSITIVE));
const PIN: Field = Field::optional(
    "pin",
    "`top` fixes the top row, `corners` its ends; none if left out",
    Wanted::Pin,
);
const NODES: Field = Field::optional("nodes", "where each node stands, in metres", Wanted::Places);
const FIXED: Field = Field::optional("fixed", "which nodes stay where they are", Wanted::Nodes);
const SPRINGS: Field = Field::required("springs", "which nodes are joined", Wanted::Springs);
pub(super) const KICKED: Field = Field::optional(
    "kicked_node",
    "the node that a kick hits, and that plots show; by default every free node",
    Wanted::Whole(0..=MAX_NODES as u64 - 1),
);
const BETWEEN: Field =
    Field::required("between", "the numbers of the nodes at its ends, from 0", Wanted::Ends);
const OWN: &str = "its own, in place of the net's";

/// The keys of a net in the form of a grid.
pub(super) static GRID_KEYS: [Key<Grid, Grid>; 5] = [
    Key {
        field: COLUMNS,
        read: |grid, row, field| {
            replace_if_read(&mut grid.columns, row.whole::<u32>(field).map(index))
        },
        write: |grid| Some(grid.columns.to_string()),
    },
    Key {
        field: Field::required("rows", "how many rows there are", COUNT),
        read: |grid, row, field| {
            replace_if_read(&mut grid.rows, row.whole::<u32>(field).map(index))
        },
        write: |grid| Some(grid.rows.to_string()),
    },
    Key {
        field: SPACING,
        read: |grid, row, field| replace_if_read(&mut grid.spacing, row.number(field)),
        write: |grid| Some(number(grid.spacing)),
    },
    Key {
        field: Field::optional(
            "shear",
            "springs across each square too; false if left out",
            Wanted::Boolean,
        ),
        read: |grid, row, field| replace_if_read(&mut grid.shear, row.boolean(field)),
        write: |grid| Some(grid.shear.to_string()),
    },
    Key {
        field: PIN,
        read: |grid, row, field| grid.pin = read_pin(row, field),
        write: |grid| grid.pin.map(|pin| quoted(pin.id())),
    },
];

/// The keys of a net in the form of lists.
pub(super) static LIST_KEYS: [Key<(Lists, Spans), Lists>; 3] = [
    Key {
        field: NODES,
        read: |(lists, _), row, field| {
            let field = Field { is_required: true, ..field.clone() };
            replace_if_read(&mut lists.nodes, row.points(&field));
        },
        write: |lists| Some(list(lists.nodes.iter().map(|node| numbers(node)))),
    },
    Key {
        field: FIXED,
        read: |(lists, spans), row, field| {
            let fixed = row.node_numbers(field).unwrap_or_default();
            (spans.fixed, lists.fixed) = fixed.into_iter().unzip();
        },
        write: |lists| Some(list(lists.fixed.iter().map(usize::to_string))),
    },
    Key {
        field: SPRINGS,
        read: |(lists, spans), row, field| {
            for mut table in row.spring_rows(field).unwrap_or_default() {
                spans.springs.push(table.header.clone());
                let mut spring = PlannedSpring::default();
                Key::read_all(&SPRING_KEYS, &mut spring, &mut table);
                lists.springs.push(spring);
                row.add_faults_of(table);
            }
        },
        write: |lists| {
            let row = |spring| Key::lines(&SPRING_KEYS, spring).trim_end().replace('\n', ", ");
            let rows = lists.springs.iter().map(|spring| format!("  {{ {} }},\n", row(spring)));
            Some(format!("[\n{}]", rows.collect::<String>()))
        },
    },
];

/// The keys of a spring in the list of springs.
pub(super) static SPRING_KEYS: [Key<PlannedSpring, PlannedSpring>; 4] = [
    Key {
        field: BETWEEN,
        read: |spring, table, field| replace_if_read(&mut spring.between, read_ends(table, field)),
        write: |spring| Some(list(spring.between.iter().map(usize::to_string))),
    },
    Key {
        field: Field::optional("stiffness_n_per_m", OWN, Wanted::Number(Range::POSITIVE)),
        read: |spring, table, field| spring.stiffness = table.number(field),
        write: |spring| spring.stiffness.map(number),
    },
    Key {
        field: Field::optional("damping_n_s_per_m", OWN, Wanted::Number(Range::NON_NEGATIVE)),
        read: |spring, table, field| spring.damping = table.number(field),
        write: |spring| spring.damping.map(number),
    },
    Key {
        field: Field::optional("rest_m", OWN, Wanted::Number(Range::NON_NEGATIVE)),
        read: |spring, table, field| spring.rest = table.number(field),
        write: |spring| spring.rest.map(number),
    },
];

fn index(count: u32) -> usize {
    count as usize
}

/// The places of a plan's parts in the file.
#[derive(Default)]
pub(super) struct Spans {
    fixed: Vec<Span<usize>>,
    springs: Vec<Span<usize>>,
}

/// Reads the kind of a net; `None` if it has a fault.
pub(super) fn read_net(row: &mut Table<'_>) -> Option<Arc<Kind>> {
    let of_grid: Vec<&str> = GRID_KEYS.iter().map(|it| it.field.key).collect();
    let of_lists: Vec<&str> = LIST_KEYS.iter().map(|it| it.field.key).collect();
    let all = of_grid.iter().chain(&of_lists).chain([&KICKED.key]);
    all.for_each(|key| row.allow_key(key));
    let given = |keys: &[&'static str]| keys.iter().find(|key| row.has(key)).copied();
    let list = given(&of_lists);
    if let (Some(list), Some(of_grid)) = (list, given(&of_grid)) {
        let what = format!("the net is given twice, by `{list}` and by `{of_grid}`");
        let remedy = "keep the grid, whose fixed nodes `pin` names, or the lists `nodes`, `fixed` and `springs`";
        row.report_fault(row.span(of_grid), what, remedy);
        return None;
    }
    let (form, spans) = if list.is_some() {
        let mut read = (Lists::default(), Spans::default());
        Key::read_all(&LIST_KEYS, &mut read, row);
        (NetLayout::Lists(read.0), read.1)
    } else {
        let mut grid = Grid { columns: 1, rows: 1, spacing: 1.0, shear: false, pin: None };
        Key::read_all(&GRID_KEYS, &mut grid, row);
        (NetLayout::Grid(grid), Spans::default())
    };
    let plan = NetPlan { form, kicked: row.whole::<u32>(&KICKED).map(index) };
    if !row.is_faultless() {
        return None;
    }
    match net_kind(plan) {
        Ok(kind) => Some(kind),
        Err(faults) => {
            faults.into_iter().for_each(|fault| report_fault(row, &spans, list.is_some(), fault));
            None
        }
    }
}

fn read_pin(row: &mut Table<'_>, field: &Field) -> Option<Pin> {
    let written = row.text(field)?;
    let pin = Pin::ALL.into_iter().find(|pin| pin.id() == written);
    if pin.is_none() {
        let known = Pin::ALL.map(Pin::id);
        let what = format!("unknown `pin` {written:?}");
        let remedy = match nearest(&written, known.into_iter().map(|id| (id, id))) {
            Some(id) => format!("did you mean {id:?}?"),
            None => format!("write {}, or remove it and no node is fixed", Wanted::Pin),
        };
        row.report_fault(row.span(field.key), what, remedy);
    }
    pin
}

fn read_ends(spring: &mut Table<'_>, field: &Field) -> Option<[usize; 2]> {
    if let [(_, a), (_, b)] = spring.node_numbers(field)?[..] {
        return Some([a, b]);
    }
    let what = "`between` does not name two nodes";
    spring.report_fault(spring.span(field.key), what, field.wanted.remedy());
    None
}

/// Reports a fault of the plan at its place in the file.
fn report_fault(row: &mut Table<'_>, spans: &Spans, are_lists: bool, fault: NetFault) {
    let NetFault { part, what, remedy } = fault;
    let at = match part {
        NetPart::Nodes if are_lists => row.span(NODES.key),
        NetPart::Nodes => row.span(COLUMNS.key),
        NetPart::Spacing => row.span(SPACING.key),
        NetPart::Springs if are_lists => row.span(SPRINGS.key),
        NetPart::Springs => row.span(COLUMNS.key),
        NetPart::Fixed(index) => spans.fixed.get(index).cloned().unwrap_or(row.span(PIN.key)),
        NetPart::Spring(index) => {
            spans.springs.get(index).cloned().unwrap_or(row.span(COLUMNS.key))
        }
        NetPart::Kicked => row.span(KICKED.key),
    };
    row.report_fault(at, what, remedy);
}
