//! What part of the phase plane a run of clouds is shown on: found by a few points that run ahead.

use super::{Cloud, CloudBody, CloudBorder, CloudStart, NoCloud, PlaneView};
use crate::scene::LaneSpec;
use crate::sim::TickRate;

/// The points of each method that run ahead, and those of the exact border.
const SCOUTS: usize = 100;
const BORDER_SCOUTS: usize = 90;

/// How much narrower than the exact cloud at its widest the axes of a moment may be.
const NARROWEST: f64 = 0.25;

/// The moments through which the axes of a studio are found.
const MOMENTS: u64 = 60;
/// The most ticks of a run through which they are found: a second of work or less.
const MAX_TICKS: u64 = 3000;
/// How many widths of its middle half a point of a cloud alone may be away from that.
const TOGETHER: f64 = 3.0;
/// How far other clouds stretch the axes, in widths of what the exact one covers.
const BESIDE: f64 = 0.1;

/// The moments that a picture shows: so many, evenly through the first ticks of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShownTicks {
    /// The last.
    pub(super) ticks: u64,
    /// How many moments.
    pub(super) times: u64,
    /// How many times as wide or as high as at the start the exact cloud is while it is shown.
    pub(super) spread: f64,
}

impl ShownTicks {
    /// The longest run through which axes are found, in seconds.
    pub(super) const MAX_S: f64 = 30.0;
}

impl From<u64> for ShownTicks {
    /// What the axes of the clouds of a studio show, in a run of so many ticks.
    fn from(ticks: u64) -> Self {
        let ticks = ticks.min(MAX_TICKS);
        Self { ticks, times: ticks.min(MOMENTS), spread: f64::INFINITY }
    }
}

/// The axes of a run of clouds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CloudAxes {
    /// Where the exact cloud comes, and the others near it.
    pub(super) whole: PlaneView,
    /// How wide and how high the exact cloud gets.
    widest: [f64; 2],
}

impl CloudAxes {
    /// The axes for these lanes.
    ///
    /// # Errors
    /// As [`Cloud::new`].
    pub(super) fn of_run(
        of: CloudBody<'_>,
        start: CloudStart,
        specs: &[LaneSpec],
        tick_hz: TickRate,
        shown: ShownTicks,
    ) -> Result<Self, NoCloud> {
        let mut border = CloudBorder::exact_of_points(BORDER_SCOUTS, of, start, tick_hz)?;
        let scouts = specs.iter().map(|spec| Cloud::new(of, spec, start, SCOUTS, tick_hz));
        let mut scouts = scouts.collect::<Result<Vec<_>, _>>()?;
        let is_angle = of.body.is_angle(0);
        let at_start = border.lines().concat();
        let largest = [0, 1].map(|i| shown.spread * PlaneView::width(&at_start, i));
        let (mut exact, mut others) = (Vec::new(), Vec::new());
        let mut widest = [0.0_f64; 2];
        for moment in 1..=shown.times {
            let tick = shown.ticks * moment / shown.times;
            border.go_to(tick);
            let now = border.lines().concat();
            let wide = [0, 1].map(|i| PlaneView::width(&now, i));
            let is_spread = |i: usize| wide[i] > largest[i] && !(i == 0 && is_angle);
            if !exact.is_empty() && (is_spread(0) || is_spread(1)) {
                break;
            }
            widest = [0, 1].map(|i| widest[i].max(wide[i]));
            exact.extend(now);
            for scout in &mut scouts {
                scout.go_to(tick);
                others.extend(scout.q().iter().zip(scout.v()).map(|(&q, &v)| [q, v]));
            }
        }
        let whole = PlaneView::around(&exact, &others, BESIDE, is_angle);
        Ok(Self { whole, widest })
    }

    /// The part of the plane that is shown while the exact border and these points of each cloud are there: of a cloud that is
    /// alone all that keep together; of several, the points that the whole has, on axes no wider or higher than that.
    pub(super) fn around(&self, border: &[[f64; 2]], clouds: &[Vec<[f64; 2]>]) -> PlaneView {
        let mut view = self.whole;
        let is_alone = clouds.len() == 1;
        let is_in_whole = |[q, v]: &[f64; 2]| {
            self.whole.place(*q, *v).iter().all(|part| (0.0..=1.0).contains(part))
        };
        let seen: Vec<_> = match clouds {
            [cloud] => together(cloud),
            _ => clouds.concat().into_iter().filter(is_in_whole).collect(),
        };
        let near = PlaneView::around(border, &seen, f64::INFINITY, false);
        for (i, (range, [low, high])) in
            [(&mut view.q, near.q), (&mut view.v, near.v)].into_iter().enumerate()
        {
            let wide = (high - low).max(NARROWEST * self.widest[i]);
            if (is_alone || wide < range[1] - range[0]) && !(i == 0 && self.whole.wraps) {
                let middle = (low + high) / 2.0;
                *range = [middle - wide / 2.0, middle + wide / 2.0];
            }
        }
        view
    }
}

/// The points of a cloud that keep together: those within some widths of its middle half. The others fly off.
fn together(cloud: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let ranges = [0, 1].map(|i| {
        let mut values: Vec<f64> = cloud.iter().map(|point| point[i]).collect();
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        let at = |part: usize| values.get(part * values.len() / 4).copied().unwrap_or_default();
        let (low, high) = (at(1), at(3));
        let wide = TOGETHER * (high - low);
        low - wide..=high + wide
    });
    let keeps = |point: &&[f64; 2]| (0..2).all(|i| ranges[i].contains(&point[i]));
    cloud.iter().filter(keeps).copied().collect()
}
