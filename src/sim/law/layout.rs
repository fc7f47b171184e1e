//! Where the coordinates of a law are in space, for whoever draws them.

/// How the first coordinates of a law lie in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Each on a line of its own, to the right.
    #[default]
    Beads,
    /// Heights above 0.
    Vertical,
    /// The heights of a carriage and of its wheel, each from its rest.
    Carriage,
    /// A place to the right, and the place that it follows, if the second has the same unit.
    Follower,
}

impl Layout {
    /// Every layout with its name.
    pub const ALL: [(&str, Layout); 4] = [
        ("beads", Layout::Beads),
        ("vertical", Layout::Vertical),
        ("carriage", Layout::Carriage),
        ("follower", Layout::Follower),
    ];

    /// Its name.
    pub fn id(self) -> &'static str {
        let named = Self::ALL.iter().find(|(_, layout)| *layout == self);
        named.expect("every layout is in the table").0
    }
}
