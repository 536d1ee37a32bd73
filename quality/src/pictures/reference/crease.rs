//! Two planes at a right angle, column by column.

use super::GAUSS;
use crate::gather::gathered::Gathered;
use crate::gather::point::Point;
use crate::optics::ChannelOptics;
use crate::optics::line_spread::edge_spread;

/// Share of the light beyond which columns are left out. It is renormalized, as all is that a crease rejects.
const LAST_SHARE: f64 = 0.9999;

/// Most columns on each side.
const MOST_COLUMNS: f64 = 400.0;

/// Columns from the pixel within which the spread of a line is too steep for one point.
const STEEP: i32 = 4;

/// One channel of a crease that is lit on the side of column 0.
pub(crate) struct Crease<'a> {
    channel: &'a ChannelOptics,
    pixel: f64,
    returned: bool,
    /// Columns that count on each side of a pixel.
    reach: i32,
    /// Light from the columns of the pixel's own plane on one side, up to each: both ways are alike.
    along: Vec<f64>,
}

impl<'a> Crease<'a> {
    pub(crate) fn new(point: &Point<'a>, channel: usize) -> Self {
        let channel = &point.optics.channels[channel];
        let reach = (channel.profile.sample_radius(LAST_SHARE) / point.pixel).ceil().min(MOST_COLUMNS) as i32;
        let mut crease =
            Self { channel, pixel: point.pixel, returned: point.returned, reach, along: vec![0.0] };
        let mut sum = 0.0;
        for apart in 1..=reach {
            // The slope is 45°: as deep as far.
            sum += crease.share(apart, f64::from(apart));
            crease.along.push(sum);
        }
        crease
    }

    /// The columns from `first` to `last`.
    pub(crate) fn columns(&self, first: i32, last: i32) -> Vec<f64> {
        // Both planes are alike but for the light, so a pixel and its mirror image have the same shares.
        let farthest = last.max(-1 - first);
        let shares: Vec<[f64; 2]> = (0..=farthest).map(|place| self.shares(place)).collect();
        let column = |x: i32| {
            let is_lit = x >= 0;
            let [own_plane, other] = shares[(if is_lit { x } else { -1 - x }) as usize];
            let [own, other_light] = if is_lit { [1.0, 0.0] } else { [0.0, 1.0] };
            let mut gathered = Gathered::default();
            gathered.add([own_plane; 3], [own; 3]);
            gathered.add([other; 3], [other_light; 3]);
            gathered.diffused([own; 3], self.returned)[0]
        };
        (first..=last).map(column).collect()
    }

    /// Light from the pixel's own plane and from the other one, `place` columns from the crease.
    fn shares(&self, place: i32) -> [f64; 2] {
        let centre = 2.0 * edge_spread(&*self.channel.profile, 0.5 * self.pixel) - 1.0;
        let towards = self.along[place.min(self.reach) as usize];
        let own_plane = centre + towards + self.along[self.reach as usize];
        // Column b of the other plane is place + b + 1 columns away, and |place - b| deeper.
        let other = (0..self.reach - place).map(|b| self.share(place + b + 1, f64::from(place - b)));
        [own_plane, other.sum()]
    }

    /// Light from a column `apart` > 0 and `depth` pixels deeper.
    fn share(&self, apart: i32, depth: f64) -> f64 {
        let spread = |across: f64| self.channel.line_spread.at(across.hypot(depth) * self.pixel);
        let across = f64::from(apart);
        if apart > STEEP {
            return self.pixel * spread(across);
        }
        let at = |(place, weight): (f64, f64)| weight * spread(across + place);
        self.pixel * GAUSS.into_iter().map(at).sum::<f64>()
    }
}
