//! What is known of a body of one's own beside its motion.

use std::any::Any;

use crate::sim::law::shown_unit;

/// What is known of a body of one's own beside its motion.
#[derive(Debug)]
pub struct OwnSheet {
    /// The name and the unit of each coordinate.
    pub coordinates: Vec<[&'static str; 2]>,
    /// The coordinates that are x and y of a plane, if it is drawn in one.
    pub plane: Option<[usize; 2]>,
    /// How it is drawn, for a layer that knows the type; `None` for the usual look.
    pub drawing: Option<&'static (dyn Any + Send + Sync)>,
}

impl OwnSheet {
    /// The unit of what is drawn in its own scale, for people: of the plane, or of the first coordinate.
    pub fn drawn_unit(&self) -> &'static str {
        let [_, unit] = self.coordinates[self.plane.map_or(0, |[x, _]| x)];
        shown_unit(unit)
    }
}
