//! The order in which methods that meet a criterion are recommended, shared by command, library and window.
//!
//! The lowest [cost](CriterionMet::cost_per_s) comes first. Of equal costs a [last resort](is_last_resort) comes last;
//! other ties go to the larger [reserve](CriterionMet::reserve), then to a symplectic method, then to the fewest
//! substeps, then to the place in the table of methods. A method with a reserve below [`LITTLE_RESERVE`] is passed over
//! if another method has a larger reserve at up to [`TIMES_ITS_COST`] times the cost.

use super::criterion::CriterionMet;
use crate::sim::integrators::{Family, METHODS, Method};

/// Reserve below which it counts as little, because a designer may well multiply the stiffness of a body by 1.5 in an
/// afternoon.
const LITTLE_RESERVE: f64 = 1.5;

/// Maximum cost of a method with a larger reserve, as a multiple of the cost of the method with little reserve. For
/// most methods, one more substep multiplies the cost by this.
const TIMES_ITS_COST: f64 = 2.0;

/// Whether a method makes an undamped swing grow in the first order of the step, so that only damping holds it.
fn is_last_resort(method: &Method) -> bool {
    method.order == 1 && method.stability_limit == Some(0.0)
}

/// The methods that meet a criterion, in order. A margin that is not searched counts as no reserve.
pub(super) struct Ranking<'a> {
    all: Vec<Ranked<'a>>,
}

struct Ranked<'a> {
    index: usize,
    met: &'a CriterionMet,
    reserve: f64,
    is_last_resort: bool,
    /// Key for equal costs and reserves, which says whether the method is not symplectic, and has the substeps, the
    /// place in the table and the index.
    ties: (bool, u32, usize, usize),
}

impl Ranked<'_> {
    /// Whether this is a last resort, and `other` is none at the same cost.
    fn is_replaced_by(&self, other: &Self) -> bool {
        self.is_last_resort && !other.is_last_resort && other.met.cost_per_s <= self.met.cost_per_s
    }

    /// Whether `other` has a larger reserve at little more cost.
    fn loses_to(&self, other: &Self) -> bool {
        self.reserve < LITTLE_RESERVE
            && other.reserve > self.reserve
            && (self.is_last_resort || !other.is_last_resort)
            && other.met.cost_per_s <= TIMES_ITS_COST * self.met.cost_per_s
    }
}

impl<'a> Ranking<'a> {
    /// Ranks these methods, each given with its index and how it meets the criterion.
    pub(super) fn new(
        methods: impl Iterator<Item = (usize, (&'static Method, &'a CriterionMet))>,
    ) -> Self {
        let place = |method: &Method| METHODS.iter().position(|one| one == method);
        let mut all: Vec<_> = methods
            .filter(|(_, (method, _))| !method.is_as_printed())
            .map(|(index, (method, met))| Ranked {
                index,
                met,
                reserve: met.reserve().unwrap_or(0.0),
                is_last_resort: is_last_resort(method),
                ties: (
                    method.family != Family::Symplectic,
                    met.substeps,
                    place(method).unwrap_or(METHODS.len()),
                    index,
                ),
            })
            .collect();
        all.sort_by(|a, b| {
            let by_cost = a.met.cost_per_s.total_cmp(&b.met.cost_per_s);
            let by_reserve = b.reserve.total_cmp(&a.reserve);
            let by_resort = a.is_last_resort.cmp(&b.is_last_resort);
            by_cost.then(by_resort).then(by_reserve).then(a.ties.cmp(&b.ties))
        });
        Self { all }
    }

    pub(super) fn least_cost(&self) -> Option<f64> {
        Some(self.all.first()?.met.cost_per_s)
    }

    /// Returns the index of the recommended method.
    pub(super) fn recommended_index(&self) -> Option<usize> {
        let is_outdone = |one: &Ranked| {
            self.all.iter().any(|other| one.loses_to(other) || one.is_replaced_by(other))
        };
        self.all.iter().find(|one| !is_outdone(one)).map(|one| one.index)
    }

    /// Returns all indices, with the recommended method first and then the others in order.
    pub(super) fn indices(&self) -> Vec<usize> {
        let first = self.recommended_index();
        let rest = self.all.iter().map(|it| it.index).filter(|&index| Some(index) != first);
        first.into_iter().chain(rest).collect()
    }

    /// Returns the index of the cheapest method, if this method is passed over.
    pub(super) fn passed_over(&self) -> Option<usize> {
        let cheapest = self.all.first()?.index;
        (self.recommended_index() != Some(cheapest)).then_some(cheapest)
    }

    /// Returns the highest cost at which another method could still become the recommended one.
    pub(super) fn most_cost_of_a_rival(&self) -> f64 {
        let first = self.recommended_index();
        let taken = self.all.iter().find(|it| Some(it.index) == first);
        taken.map_or(f64::INFINITY, |taken| {
            let is_little = taken.reserve < LITTLE_RESERVE;
            if is_little { TIMES_ITS_COST * taken.met.cost_per_s } else { taken.met.cost_per_s }
        })
    }

    /// Returns the indices of the methods whose margins to search next; empty once the recommendation is certain. All
    /// of these methods cost the same, because more expensive ones follow only if the reserve of these is little.
    pub(super) fn undecided(&self) -> Vec<usize> {
        let is_open = |it: &&Ranked| !it.met.are_margins_searched;
        let cost = |it: &Ranked| it.met.cost_per_s;
        for alike in self.all.chunk_by(|a, b| cost(a) == cost(b)) {
            let best = &alike[0];
            let may_win = |it: &&Ranked| it.is_last_resort == best.is_last_resort;
            let mut open: Vec<usize> =
                alike.iter().filter(is_open).filter(may_win).map(|it| it.index).collect();
            if alike.iter().all(|it| is_open(&it)) {
                open.truncate(1);
            }
            if !open.is_empty() {
                return open;
            }
            if best.reserve >= LITTLE_RESERVE {
                return Vec::new();
            }
            let rivals = || {
                let most = TIMES_ITS_COST * cost(best);
                self.all.iter().filter(move |it| cost(it) > cost(best) && cost(it) <= most)
            };
            if rivals().any(|rival| best.loses_to(rival)) {
                continue;
            }
            let Some(next) = rivals().find(is_open).map(cost) else { return Vec::new() };
            return rivals()
                .filter(is_open)
                .filter(|it| cost(it) == next)
                .map(|it| it.index)
                .collect();
        }
        Vec::new()
    }
}

#[cfg(test)]
mod tests;
