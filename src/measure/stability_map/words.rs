//! A stability map in words.

use std::fmt;

use super::{Coverage, PointStability, StabilityMap};
use crate::duration;
use crate::scene::LaneSpec;
use crate::sim::number::counted;

/// Writes the stability as `bounded`, `grows ×2 in 3.1 s` or `fails at once`.
impl fmt::Display for PointStability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            PointStability::Stable => f.write_str("bounded"),
            PointStability::Doubles(seconds) if seconds > 0.0 => {
                write!(f, "grows ×2 in {}", duration(seconds))
            }
            PointStability::Doubles(_) => f.write_str("fails at once"),
            PointStability::OwnSteps => f.write_str("chooses its own steps"),
        }
    }
}

impl StabilityMap {
    /// Returns distinct names of the request's methods, in the order of the request.
    pub fn method_names(&self) -> Vec<String> {
        let specs: Vec<LaneSpec> = self.request.specs.iter().map(|(_, spec)| *spec).collect();
        specs.iter().map(|spec| spec.distinct_name(spec.method.name, &specs)).collect()
    }

    /// Lists the stability of each method at the current point, line by line.
    pub fn each_here(&self) -> String {
        let lines = self.method_names().into_iter().zip(&self.here);
        lines.map(|(name, here)| format!("{name}: {here}")).collect::<Vec<_>>().join("\n")
    }

    /// Describes the number of methods that are bounded at the current point, and the method that grows fastest.
    pub fn stable_here(&self) -> String {
        let of = |kind: PointStability| self.here.iter().filter(|here| **here == kind).count();
        let (all, stable, own) =
            (self.here.len(), of(PointStability::Stable), of(PointStability::OwnSteps));
        if stable == all && all > 1 {
            return format!("all {all} methods are bounded.");
        }
        let verb = if stable == 1 { "is" } else { "are" };
        let growing = self.method_names().into_iter().zip(&self.here);
        let growing = growing.filter_map(|(name, here)| match here {
            PointStability::Doubles(seconds) => Some((name, here, *seconds)),
            PointStability::Stable | PointStability::OwnSteps => None,
        });
        let fastest = growing.min_by(|a, b| a.2.total_cmp(&b.2));
        let fastest = fastest.map(|(name, here, _)| format!(" {name} {here}."));
        let own = match own {
            0 => String::new(),
            1 => ", 1 chooses its own steps".into(),
            _ => format!(", {own} choose their own steps"),
        };
        let all = counted(all, "method");
        format!("{stable} of {all} {verb} bounded{own}.{}", fastest.unwrap_or_default())
    }

    /// Returns notes on methods and growth that the map does not draw, as sentences with a space before each.
    pub fn not_drawn(&self) -> String {
        let named = |coverage: Coverage| {
            let found = self.regions.iter().zip(self.method_names());
            let of = found.filter(|(region, _)| region.coverage == coverage);
            of.map(|(_, name)| name).collect::<Vec<_>>()
        };
        let (nowhere, own) = (named(Coverage::Nowhere), named(Coverage::OwnSteps));
        let mut notes = String::new();
        if !nowhere.is_empty() {
            let verb = if nowhere.len() == 1 { "is" } else { "are" };
            notes += &format!(" {} {verb} bounded nowhere on this map.", nowhere.join(", "));
        }
        if !own.is_empty() {
            let verb = if own.len() == 1 { "chooses its" } else { "choose their" };
            notes += &format!(" {} {verb} own steps.", own.join(", "));
        }
        if !self.is_linear {
            notes += " The map holds for small motions about rest.";
        }
        if self.truth_grows {
            notes += " The true motion grows too; only growth beyond that counts.";
        }
        notes
    }
}
