//! The colours of the night chart and the day chart, and the dash patterns that also distinguish the methods.
//!
//! The first method colours are those of Okabe and Ito, which people with any kind of colour vision can distinguish.
//! They are lighter on the dark stage and darker on the light one.

use std::sync::LazyLock;

use crate::measure::Severity;
use crate::scene::LaneSpec;
use crate::sim::integrators::{METHODS, Method};

/// A colour: red, green, blue and alpha in sRGB, where alpha is not premultiplied.
pub type Rgba = [u8; 4];

/// Opaque white.
pub const WHITE: Rgba = [255; 4];
/// Opaque black.
pub const BLACK: Rgba = [0, 0, 0, 255];

/// A dark or a light chart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// A sea chart by night.
    #[default]
    Dark,
    /// A paper chart by day.
    Light,
}

impl Theme {
    /// Returns the colours of the theme.
    pub fn palette(self) -> &'static Palette {
        match self {
            Theme::Dark => &DARK,
            Theme::Light => &LIGHT,
        }
    }

    /// Returns the opposite theme: light for dark, dark for light.
    pub fn other(self) -> Self {
        match self {
            Theme::Dark => Theme::Light,
            Theme::Light => Theme::Dark,
        }
    }

    /// Returns the colour of the `number`th force evaluation of a step, counted from 0.
    pub fn evaluation(self, number: usize) -> Rgba {
        let [orange, blue, pink, yellow, green, amber, violet] = self.palette().methods;
        [green, blue, yellow, pink, orange, violet, amber][number % 7]
    }

    /// Returns the colour and the dash pattern of a method. The pattern is the length of a dash and of a gap in points;
    /// a gap of 0 is solid.
    pub fn style(self, method: &Method) -> (Rgba, [f32; 2]) {
        self.resolve_style(indices(method))
    }

    /// Returns the colour and the dash pattern of a lane among `lanes`. The first lane of a method has the method's
    /// style; each further lane of that method has another colour and dash.
    ///
    /// Among the first nine lanes, two lanes with the same dash never have colours that some people confuse. A lane
    /// whose colour is taken gets a free colour while there is one. Only explicit Euler has explicit Euler's colour.
    pub fn lane_style(self, lanes: &[LaneSpec], lane: &LaneSpec) -> (Rgba, [f32; 2]) {
        self.resolve_style(lane_places(lanes, lane))
    }

    fn resolve_style(self, (colour, dash): (usize, usize)) -> (Rgba, [f32; 2]) {
        (self.palette().methods[colour], DASHES[dash])
    }

    /// Returns the colour and the dash pattern of the game loop with this index in
    /// `POLICIES`. Any seven neighbours differ in colour, and none has a method's colour.
    pub fn loop_style(self, index: usize) -> (Rgba, [f32; 2]) {
        let loops = &self.palette().loops;
        (loops[index % loops.len()], DASHES[index % FIRST_DASHES])
    }
}

/// Colours of a theme, for drawing and for text.
#[derive(Debug)]
pub struct Palette {
    /// Background of the window.
    pub background: Rgba,
    /// Background of a panel.
    pub panel: Rgba,
    /// Background of a control or a selected row.
    pub raised: Rgba,
    /// Line between panels, or border of a control.
    pub line: Rgba,
    /// Background of a plot.
    pub plot: Rgba,
    /// Grid of a plot.
    pub grid: Rgba,
    /// Colour of text.
    pub text: Rgba,
    /// Colour of quiet text.
    pub dim: Rgba,
    /// Colour of hover, of focus, of a kick, and of a draggable cross.
    pub accent: Rgba,
    /// Colour of text on the accent colour.
    pub on_accent: Rgba,
    /// Colours of the sea at the top and at the bottom of the stage.
    pub sea: [Rgba; 2],
    /// Colour of waves, depth contours and distance marks.
    pub chart: Rgba,
    /// Colours of the quay and its edge.
    pub quay: [Rgba; 2],
    /// Colours of the wire of a coil spring: its edge, and the metal in shade, in light and at the highlight.
    pub wire: [Rgba; 4],
    /// Colour of the exact solution.
    pub exact: Rgba,
    /// Colour of errors and bad verdicts.
    pub bad: Rgba,
    /// Colour of warnings and doubtful verdicts.
    pub warn: Rgba,
    /// Colour of good verdicts.
    pub good: Rgba,
    /// Colour of fair verdicts.
    pub fair: Rgba,
    methods: [Rgba; 7],
    loops: [Rgba; 7],
}

impl Palette {
    /// Returns the colour of a verdict of this severity.
    pub fn of_severity(&self, severity: Severity) -> Rgba {
        match severity {
            Severity::Fine => self.good,
            Severity::Fair => self.fair,
            Severity::Doubtful => self.warn,
            Severity::Bad => self.bad,
            Severity::Unknown => self.dim,
        }
    }
}

/// Whether black text is more legible on this colour than white text.
pub fn is_bright([r, g, b, _]: Rgba) -> bool {
    let [r, g, b] = [r, g, b].map(u32::from);
    2 * r + 5 * g + b > 8 * 112
}

const fn rgb(hex: u32) -> Rgba {
    [(hex >> 16) as u8, (hex >> 8) as u8, hex as u8, 255]
}

static DARK: Palette = Palette {
    background: rgb(0x0A1119),
    panel: rgb(0x0E1823),
    raised: rgb(0x182635),
    line: rgb(0x24364A),
    plot: rgb(0x0A131D),
    grid: rgb(0x1A2A3A),
    text: rgb(0xE8EEF4),
    dim: rgb(0xA3B4C4),
    accent: rgb(0xE8BC6A),
    on_accent: rgb(0x0E1823),
    sea: [rgb(0x0F2536), rgb(0x0A1825)],
    chart: rgb(0x8FB2CC),
    quay: [rgb(0x1B2530), rgb(0x4A5B6B)],
    wire: [rgb(0x0A1119), rgb(0x6F8496), rgb(0xB9C7D3), rgb(0xF0F6FA)],
    exact: rgb(0xFFFFFF),
    bad: rgb(0xFF7A70),
    warn: rgb(0xF0C050),
    good: rgb(0x5FD6A4),
    fair: rgb(0xB9EFD6),
    methods: [
        rgb(0xFF8242),
        rgb(0x5BB8F0),
        rgb(0xD58CC0),
        rgb(0xF2E24B),
        rgb(0x2BCB9B),
        rgb(0xE69F00),
        rgb(0xADA4FF),
    ],
    loops: [
        rgb(0xBBA56B),
        rgb(0xFF62C4),
        rgb(0x9DF04E),
        rgb(0xDDF5B4),
        rgb(0xE86BFF),
        rgb(0x74B33C),
        rgb(0x8FFFF0),
    ],
};

static LIGHT: Palette = Palette {
    background: rgb(0xE9E3D4),
    panel: rgb(0xF8F4E9),
    raised: rgb(0xEAE3D0),
    line: rgb(0xC9BFA6),
    plot: rgb(0xFDFBF4),
    grid: rgb(0xDED6C2),
    text: rgb(0x1B2733),
    dim: rgb(0x4E5B66),
    accent: rgb(0x7A4F00),
    on_accent: rgb(0xFFFFFF),
    sea: [rgb(0xE3EFF2), rgb(0xCFE2E9)],
    chart: rgb(0x3F6C86),
    quay: [rgb(0xD9D0BB), rgb(0x8C8270)],
    wire: [rgb(0x24323F), rgb(0x4A5D6D), rgb(0x7F93A3), rgb(0xDCE6EC)],
    exact: rgb(0x0B1016),
    bad: rgb(0xA8221B),
    warn: rgb(0x7A5200),
    good: rgb(0x00663F),
    fair: rgb(0x2C7A55),
    methods: [
        rgb(0xAE3800),
        rgb(0x085A93),
        rgb(0x923570),
        rgb(0x5B6000),
        rgb(0x00694A),
        rgb(0x4A2000),
        rgb(0x4A3FA8),
    ],
    loops: [
        rgb(0x695E5F),
        rgb(0x9412BC),
        rgb(0x146A0C),
        rgb(0x3A1E5E),
        rgb(0x2222EE),
        rgb(0x334010),
        rgb(0x1450DC),
    ],
};

/// Lengths of dash and gap in points. With six patterns and seven colours, any two of the first 42 methods differ in
/// colour or in dash.
const DASHES: [[f32; 2]; 6] =
    [[9.0, 4.0], [16.0, 4.0], [5.0, 4.0], [2.5, 3.5], [1.0, 0.0], [12.0, 9.0]];

/// Number of dash patterns that are used first; the others resemble these.
const FIRST_DASHES: usize = 5;

/// Indices of the dashes of engines, which race among themselves: those that are used first, and the others.
const ENGINE_DASHES: [usize; 3] = [4, 1, 2];
const MORE_ENGINE_DASHES: [usize; 2] = [3, 5];

/// Hue of each colour as a deuteranope sees it: 0 yellow, 1 blue, 2 grey.
const HUES: [usize; 7] = [0, 1, 2, 0, 2, 0, 1];

/// Number of lanes at the head of a list that have keys. No two of them share both hue and dash.
const DISTINCT_LANES: usize = 9;

/// The methods in the races of the chapter and its scenes, with the indices of their colours and dashes.
const CLASSICS: [(&str, usize, usize); 6] = [
    ("explicit-euler", 0, 0),
    ("semi-implicit-euler", 1, 1),
    ("implicit-euler", 2, 2),
    ("improved-euler", 3, 3),
    ("rk4", 4, 4),
    ("adaptive-euler", 5, 0),
];

/// Index of the colour that only explicit Euler has.
const EULER: usize = 0;

/// Indices of the warm colours, which look alike on the light chart.
const WARM: [usize; 3] = [0, 3, 5];

/// Whether a person could confuse two colours.
fn are_alike(a: usize, b: usize) -> bool {
    a == b || WARM.contains(&a) && WARM.contains(&b)
}

/// Returns the indices of a method's colour and dash.
fn indices(method: &Method) -> (usize, usize) {
    let listed = METHODS.iter().position(|listed| listed == method);
    listed.map_or_else(|| own_style(method.id), |index| STYLES[index])
}

/// Returns the indices of the colour and dash of a method that has the same style in every scene.
fn classic(method: &Method) -> Option<(usize, usize)> {
    let found = CLASSICS.iter().find(|(id, ..)| *id == method.id);
    found.map(|&(_, colour, dash)| (colour, dash))
}

/// Returns the indices of a lane's colour and dash. A further lane of a method gets a colour unlike all earlier ones
/// while there is one, and after that at least an unused pair of colour and dash.
fn lane_places(lanes: &[LaneSpec], lane: &LaneSpec) -> (usize, usize) {
    let is_first = |end: usize| lanes[..end].iter().all(|other| other.method != lanes[end].method);
    let end = match lanes.iter().position(|other| other == lane) {
        Some(end) if end < DISTINCT_LANES || !is_first(end) => end,
        _ => return indices(lane.method),
    };
    let (colours, dashes) = (DARK.methods.len(), DASHES.len());
    let kept = lanes.iter().take(DISTINCT_LANES).filter_map(|lane| classic(lane.method));
    let mut taken: Vec<(usize, usize)> = Vec::new();
    for (i, next) in lanes[..=end].iter().enumerate() {
        let (colour, dash) = indices(next.method);
        let pairs = (1..colours * dashes).map(|n| ((colour + n) % colours, (dash + n) % dashes));
        let pairs = pairs.filter(|pair| pair.0 != EULER);
        let others = || taken.iter().copied().chain(kept.clone());
        let unlike = |pair: &(usize, usize)| others().all(|other| !are_alike(other.0, pair.0));
        let unshared = |pair: &(usize, usize)| others().all(|other| other.0 != pair.0);
        let unused = |pair: &(usize, usize)| !taken.contains(pair);
        let own = || pairs.clone().find(unlike).or_else(|| pairs.clone().find(unshared));
        let is_shared = i < DISTINCT_LANES && !unshared(&(colour, dash));
        let other = match classic(next.method) {
            _ if !is_first(i) => own().or_else(|| pairs.clone().find(unused)),
            None if is_shared => own(),
            _ => None,
        };
        let wanted = other.unwrap_or((colour, dash));
        // First the other dashes are tried, then other colours too.
        let dashed = (0..dashes).map(|n| (wanted.0, (wanted.1 + n) % dashes));
        let is_told = |pair: &(usize, usize)| {
            let looks = |of: (usize, usize)| (HUES[of.0], of.1);
            taken.iter().all(|other| looks(*other) != looks(*pair))
        };
        let told = dashed.chain(pairs.clone()).find(is_told).filter(|_| i < DISTINCT_LANES);
        taken.push(told.unwrap_or(wanted));
    }
    taken[end]
}

/// Returns the indices of the colour and dash of a method outside the table. They are derived from the method's id, so
/// that they never change. The first colour and the first dash are excluded, because they belong to explicit Euler.
fn own_style(id: &str) -> (usize, usize) {
    let sum = id.bytes().fold(0, |sum: usize, byte| (31 * sum + usize::from(byte)) % 9973);
    (1 + sum % (DARK.methods.len() - 1), 1 + sum % (FIRST_DASHES - 1))
}

/// Indices of each method's colour and dash. Neighbours in the table differ in colour.
static STYLES: LazyLock<Vec<(usize, usize)>> = LazyLock::new(|| {
    let colours = DARK.methods.len();
    let first = (0..colours * FIRST_DASHES).map(|n| (n % colours, n % FIRST_DASHES));
    let more = (FIRST_DASHES..DASHES.len()).flat_map(|dash| (0..colours).map(move |n| (n, dash)));
    // The methods of a free spin, and those of interfaces, have the styles of others, which they seldom meet.
    let mut of_spins: Vec<(usize, usize)> =
        first.clone().filter(|style| style.0 != EULER).collect();
    let mut of_interfaces = of_spins.clone();
    let mut free: Vec<(usize, usize)> = first.chain(more).collect();
    let of_engines = (0..colours * ENGINE_DASHES.len())
        .map(|n| (n % colours, ENGINE_DASHES[n % ENGINE_DASHES.len()]));
    let more_of_engines =
        MORE_ENGINE_DASHES.into_iter().flat_map(|dash| (0..colours).map(move |n| (n, dash)));
    let of_engines = of_engines.chain(more_of_engines).filter(|style| style.0 != EULER);
    let mut of_engines: Vec<(usize, usize)> = of_engines.collect();
    free.retain(|style| {
        style.0 != EULER && !METHODS.iter().filter_map(classic).any(|taken| taken == *style)
    });
    let mut styles: Vec<(usize, usize)> = Vec::new();
    for (i, method) in METHODS.iter().enumerate() {
        let beside = [styles.last().copied(), METHODS.get(i + 1).and_then(classic)];
        let differs = |style: &(usize, usize)| {
            beside.iter().flatten().all(|other| !are_alike(other.0, style.0))
        };
        let style = classic(method).unwrap_or_else(|| {
            let free = match method.is_engine() {
                true => &mut of_engines,
                false if method.is_for_spin() => &mut of_spins,
                false if method.is_of_library() => &mut of_interfaces,
                false => &mut free,
            };
            let index = free.iter().position(differs).unwrap_or(0);
            free.remove(index)
        });
        styles.push(style);
    }
    styles
});

/// Returns the opaque colour at the fraction `part` of the way from the first colour to the second.
pub fn mix(from: Rgba, to: Rgba, part: f32) -> Rgba {
    let mix = |i: usize| {
        f32::from(from[i]) + part.clamp(0.0, 1.0) * (f32::from(to[i]) - f32::from(from[i]))
    };
    [mix(0) as u8, mix(1) as u8, mix(2) as u8, 255]
}

/// Opacity of the sign of a verdict at a former tick rate.
pub const STALE: f32 = 0.35;

/// Returns the same colour with its alpha scaled by `part`.
pub fn fade([r, g, b, a]: Rgba, part: f32) -> Rgba {
    [r, g, b, (f32::from(a) * part.clamp(0.0, 1.0)) as u8]
}

#[cfg(test)]
mod tests;
