//! Finds the part of the phase plane to show for a run of clouds. A few points run ahead to find this part.

use super::{Cloud, CloudBody, CloudBorder, CloudStart, NoCloud, PlaneView};
use crate::scene::LaneSpec;
use crate::sim::TickRate;

/// Number of points of each method that run ahead, and number of points of the exact border.
const SCOUTS: usize = 100;
const BORDER_SCOUTS: usize = 90;

/// Minimum width of the axes at any moment, relative to the exact cloud at its widest.
const NARROWEST: f64 = 0.25;

/// Number of moments that the axes take into account, spread evenly over the ticks.
const MOMENTS: u64 = 60;
/// Maximum time (s) and number of ticks that the axes take into account, which is at most a second of work.
const MAX_S: f64 = 30.0;
const MAX_TICKS: u64 = 3000;
/// Growth of the exact cloud up to which the axes show it. On larger axes, the initial cloud would be a speck.
const SPREAD: f64 = 10.0;
/// Maximum distance of a point of a lone cloud beyond the cloud's middle half, in widths of that half.
const MAX_STRAY_WIDTHS: f64 = 3.0;
/// Largest widths by which other clouds may widen the axes of a run, and the axes at one moment, relative to the width
/// of the exact cloud.
const MAX_WIDENING: f64 = 0.1;
const MAX_WIDENING_AT_ONCE: f64 = 0.25;

/// The axes of a run of clouds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CloudAxes {
    /// The region that contains the exact cloud and others near it.
    pub(super) whole: PlaneView,
    /// Largest width and height of the exact cloud.
    widest: [f64; 2],
}

impl CloudAxes {
    /// Finds the axes for these lanes in a run of this many seconds.
    ///
    /// # Errors
    /// Fails as [`Cloud::new`] does.
    pub(super) fn of_run(
        of: CloudBody<'_>,
        start: CloudStart,
        specs: &[LaneSpec],
        tick_hz: TickRate,
        seconds: f64,
    ) -> Result<Self, NoCloud> {
        let mut border = CloudBorder::exact_of_points(BORDER_SCOUTS, of, start, tick_hz)?;
        let scouts = specs.iter().map(|spec| Cloud::new(of, spec, start, SCOUTS, tick_hz));
        let mut scouts = scouts.collect::<Result<Vec<_>, _>>()?;
        let is_angle = of.body.is_angle(0);
        let at_start = border.lines().concat();
        let largest = [0, 1].map(|i| SPREAD * PlaneView::width(&at_start, i));
        let (mut exact, mut others) = (Vec::new(), Vec::new());
        let mut widest = [0.0_f64; 2];
        let ticks = ((seconds.min(MAX_S) * f64::from(tick_hz)) as u64).clamp(1, MAX_TICKS);
        let moments = ticks.min(MOMENTS);
        for moment in 1..=moments {
            let tick = ticks * moment / moments;
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
        let whole = PlaneView::around(&exact, &others, MAX_WIDENING, is_angle);
        Ok(Self { whole, widest })
    }

    /// Returns the view at one moment, given the exact border and some points of each cloud. With one cloud, the view
    /// shows all points that stay together. With several clouds, it fits the exact cloud, with a little room for the
    /// others, on axes no larger than the whole region.
    pub(super) fn around(&self, border: &[[f64; 2]], clouds: &[Vec<[f64; 2]>]) -> PlaneView {
        let mut view = self.whole;
        let is_alone = clouds.len() == 1;
        let is_in_whole = |[q, v]: &[f64; 2]| {
            self.whole.place(*q, *v).iter().all(|part| (0.0..=1.0).contains(part))
        };
        let seen: Vec<_> = match clouds {
            [cloud] => without_strays(cloud),
            _ => clouds.concat().into_iter().filter(is_in_whole).collect(),
        };
        let widening = if is_alone { f64::INFINITY } else { MAX_WIDENING_AT_ONCE };
        // A cloud that mostly stays in the region stays in view: the corners of its middle half are.
        let stays = |cloud: &&Vec<[f64; 2]>| {
            !is_alone && 2 * cloud.iter().filter(|point| is_in_whole(point)).count() >= cloud.len()
        };
        let middles = clouds.iter().filter(stays).map(|cloud| quartiles(cloud));
        let corners = middles.flat_map(|[q, v]| [[q[0], v[0]], [q[1], v[1]]]);
        let fitted: Vec<_> = border.iter().copied().chain(corners).collect();
        let near = PlaneView::around(&fitted, &seen, widening, false);
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

/// Returns the points within a few widths of the cloud's middle half. The other points fly off.
fn without_strays(cloud: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let ranges = quartiles(cloud).map(|[low, high]| {
        let wide = MAX_STRAY_WIDTHS * (high - low);
        low - wide..=high + wide
    });
    let keeps = |point: &&[f64; 2]| (0..2).all(|i| ranges[i].contains(&point[i]));
    cloud.iter().filter(keeps).copied().collect()
}

/// Returns the first and the third quartile of a cloud along each axis.
fn quartiles(cloud: &[[f64; 2]]) -> [[f64; 2]; 2] {
    [0, 1].map(|i| {
        let mut values: Vec<f64> = cloud.iter().map(|point| point[i]).collect();
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        [1, 3].map(|part| values.get(part * values.len() / 4).copied().unwrap_or_default())
    })
}
