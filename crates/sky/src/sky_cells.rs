//! Which directions to ask for: by their share of what a plane receives from sky and ground.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::Vec3;
use light::Spectrum;

use crate::Sky;
use crate::sky::lifted;

/// Bands of altitude below the horizon, 5.6° each, where radiance is everywhere the same.
const GROUND_ROWS: usize = 16;
/// Bands of altitude above it, 3.75° each.
const SKY_ROWS: usize = 24;
/// All of them, from the nadir up.
const ROWS: usize = GROUND_ROWS + SKY_ROWS;
/// Sectors of azimuth, 5.6° each; they begin opposite the sun.
const COLUMNS: usize = 64;
/// Points across a cell, in each direction, of the mean of its luminance.
const FINE: usize = 4;
/// Directions are chosen by luminance to this power. Less than 1, since it is the places which the sun's bright
/// surroundings do not reach that show noise: where they do, the sun mostly does as well. 1 is as good in the
/// mean of the example `noise` at 64 directions and more; 0.75 is better by a tenth at 16.
const FLATTEN: f32 = 0.75;

/// What a cell counts at least, as a share of the mean luminance: between the points at which a dark cell was
/// asked there may be light.
const DARKEST: f32 = 1e-3;

/// Sky and ground in cells of nearly even luminance.
///
/// For a plane of normal n a cell of mean luminance L and solid angle Ω is chosen by its weight
///
///   W = L_m (L/L_m)^¾ · Ω · mean cos⁺(n),   L_m = E_horizontal/π,
///
/// and directions lie evenly within it. W is found anew for each plane, by 2560 products without a branch (some
/// 1 µs), so that no table over normals is needed. It need not be exact: it only chooses, and what is chosen
/// counts by true radiance times cosine over the density. But it is positive wherever a plane can receive
/// light, which keeps the sums unbiased.
#[derive(Clone, Debug)]
pub(crate) struct SkyCells {
    /// Unit horizontal vectors towards the sun's azimuth and to the right of it.
    ahead: Vec3,
    side: Vec3,
    /// W without the cosine.
    power: Box<[[f32; COLUMNS]; ROWS]>,
    /// Radiance at FINE × FINE points of each cell of the sky, along fastest, then up.
    radiance: Vec<[[Spectrum; FINE]; FINE]>,
    /// cos and sin of the azimuth at the middle of each column.
    azimuth: [[f32; COLUMNS]; 2],
    rows: [Row; ROWS],
}

/// What the cells of one band of altitude have in common.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// sin of the altitude at the lower edge and at the upper.
    edges: [f32; 2],
    /// cos and sin of the altitude in the middle.
    middle: [f32; 2],
    /// Largest distance between the direction in the middle and any other of the cell: a bound for how far
    /// its cosine to any normal differs from the middle's.
    reach: f32,
    /// Solid angle of one cell \[sr\].
    solid_angle: f32,
}

/// Width of a column \[rad\].
const SECTOR: f32 = TAU / COLUMNS as f32;

impl Row {
    fn new(index: usize) -> Self {
        // How many rows above the horizon (below: negative), and their height.
        let above = index as f32 - GROUND_ROWS as f32;
        let step = FRAC_PI_2 / if above < 0.0 { GROUND_ROWS } else { SKY_ROWS } as f32;
        let [low, middle, high] = [0.0, 0.5, 1.0].map(|at| (above + at) * step);
        let at = |altitude: f32, azimuth: f32| {
            let ((sin, cos), (s, c)) = (altitude.sin_cos(), azimuth.sin_cos());
            Vec3::new(cos * c, sin, cos * s)
        };
        // Along either edge and along any circle of azimuth the distance is largest at the corners.
        let [below, above] = [low, high].map(|h| at(h, 0.5 * SECTOR).distance(at(middle, 0.0)));
        Self {
            edges: [low.sin(), high.sin()],
            middle: [middle.cos(), middle.sin()],
            // Room for the rounding of the cosines themselves.
            reach: below.max(above) + 8.0 * f32::EPSILON,
            solid_angle: (high.sin() - low.sin()) * SECTOR,
        }
    }

    /// sin of the altitude at a share of the row's solid angle.
    fn sin_altitude(&self, share: f32) -> f32 {
        self.edges[0] + share * (self.edges[1] - self.edges[0])
    }
}

impl SkyCells {
    /// `mean` and `ground` are the luminance \[cd/m²\] that, from everywhere, would give the horizontal what the sky
    /// gives it, and that of the ground.
    pub(crate) fn new(sky: &dyn Sky, mean: f32, ground: f32) -> Self {
        let toward = lifted(sky.brightest());
        let ahead = Vec3::new(toward.x, 0.0, toward.z).try_normalize().unwrap_or(Vec3::NEG_Z);
        let middles = std::array::from_fn(|column| bearing(column as f32 + 0.5));
        let mut cells = Self {
            ahead,
            side: ahead.cross(Vec3::Y),
            power: Box::new([[0.0; COLUMNS]; ROWS]),
            radiance: Vec::with_capacity(SKY_ROWS * COLUMNS),
            azimuth: [middles.map(|[cos, _]: [f32; 2]| cos), middles.map(|[_, sin]| sin)],
            rows: std::array::from_fn(Row::new),
        };
        let scale = if mean.is_normal() { 1.0 / mean } else { 0.0 };
        let flat = |radiance: &Spectrum| (radiance.luminance() * scale).max(DARKEST).powf(FLATTEN);
        for row in 0..ROWS {
            let solid_angle = cells.rows[row].solid_angle;
            for column in 0..COLUMNS {
                cells.power[row][column] = solid_angle
                    * if row < GROUND_ROWS {
                        ground
                    } else {
                        let points = cells.points(row, column, sky);
                        cells.radiance.push(points);
                        let sum: f32 = points.as_flattened().iter().map(flat).sum();
                        mean * sum / (FINE * FINE) as f32
                    };
            }
        }
        cells
    }

    /// Radiance in the middles of the FINE × FINE parts of a cell.
    fn points(&self, row: usize, column: usize, sky: &dyn Sky) -> [[Spectrum; FINE]; FINE] {
        let middle = |index: usize| (index as f32 + 0.5) / FINE as f32;
        let at = |up, along| sky.radiance(self.direction(row, column, [middle(along), middle(up)]));
        std::array::from_fn(|up| std::array::from_fn(|along| at(up, along)))
    }

    /// The direction at shares of a cell's azimuths and of its solid angle.
    fn direction(&self, row: usize, column: usize, [along, up]: [f32; 2]) -> Vec3 {
        let [cos, sin] = bearing(column as f32 + along);
        let height = self.rows[row].sin_altitude(up);
        (self.ahead * cos + self.side * sin) * (1.0 - height * height).max(0.0).sqrt() + Vec3::Y * height
    }

    /// Shares for the plane of unit `normal`.
    pub(crate) fn facing(&self, normal: Vec3) -> Shares {
        let [ahead, side] = [self.ahead.dot(normal), self.side.dot(normal)];
        let level: [f32; COLUMNS] =
            std::array::from_fn(|k| self.azimuth[0][k] * ahead + self.azimuth[1][k] * side);
        Shares::new(&self.power, |row, k| {
            let row = &self.rows[row];
            let (cos, reach) = (row.middle[0] * level[k] + row.middle[1] * normal.y, row.reach);
            // cos⁺ averaged over ±reach: the cosine itself, or (cos + reach)²/(4 reach) where the plane
            // cuts through the cell.
            let part = (cos + reach).clamp(0.0, 2.0 * reach);
            part * part / (4.0 * reach) + (cos - reach).max(0.0)
        })
    }

    /// Shares for what receives alike from everywhere.
    pub(crate) fn all_around(&self) -> Shares {
        Shares::new(&self.power, |_, _| 1.0)
    }

    /// The direction that belongs to a point of the unit square; the sky's radiance there, none for the ground; and the
    /// inverse of its density, on one scale for all. None where rounding has met a cell without light.
    ///
    /// The radiance is that in the middle of a part 0.9° × 1.4° wide: to ask the sky itself for each of many directions took
    /// longer than their rays. Radiance changes by some per cent within a part, of which the few that an edge crosses are all
    /// that counts.
    ///
    /// First the azimuth, of sky and ground together, then the altitude: upright edges of what hides them are
    /// straight lines on the square, of which evenly spread points miss one at most.
    pub(crate) fn choose(&self, shares: &Shares, at: [f32; 2]) -> Option<(Vec3, Option<Spectrum>, f32)> {
        let (sums, columns) = (&shares.sums, &shares.columns);
        let target = at[0] * columns[COLUMNS - 1];
        let column = columns.partition_point(|&sum| sum <= target).min(COLUMNS - 1);
        let before = if column == 0 { 0.0 } else { columns[column - 1] };
        let whole = sums[ROWS - 1][column];
        let up = at[1] * whole;
        let row = sums.partition_point(|sums| sums[column] <= up).min(ROWS - 1);
        let below = if row == 0 { 0.0 } else { sums[row - 1][column] };
        let weight = sums[row][column] - below;
        if weight <= 0.0 || whole <= 0.0 {
            return None;
        }
        let within = [(target - before) / whole, (up - below) / weight].map(|share| share.clamp(0.0, 1.0));
        let radiance = row.checked_sub(GROUND_ROWS).map(|row| {
            let [along, up] = within.map(|share| ((share * FINE as f32) as usize).min(FINE - 1));
            self.radiance[row * COLUMNS + column][up][along]
        });
        Some((self.direction(row, column, within), radiance, self.rows[row].solid_angle / weight))
    }
}

/// cos and sin of the azimuth from the sun, so many columns from the seam.
fn bearing(columns: f32) -> [f32; 2] {
    let (sin, cos) = (columns * SECTOR).sin_cos();
    // The seam is opposite the sun: half a turn on.
    [-cos, -sin]
}

/// By what share directions are chosen.
#[derive(Clone, Debug)]
pub(crate) struct Shares {
    /// W of each cell and those below it in its column.
    sums: [[f32; COLUMNS]; ROWS],
    /// W of each column and those before it.
    columns: [f32; COLUMNS],
}

impl Shares {
    /// From W without the cosine, and the cosine by row and column.
    fn new(power: &[[f32; COLUMNS]; ROWS], cosine: impl Fn(usize, usize) -> f32) -> Self {
        let mut sums = [[0.0; COLUMNS]; ROWS];
        let mut below = [0.0; COLUMNS];
        for (row, sum) in sums.iter_mut().enumerate() {
            for k in 0..COLUMNS {
                below[k] += power[row][k] * cosine(row, k);
            }
            *sum = below;
        }
        let mut total = 0.0;
        let columns = below.map(|column| {
            total += column;
            total
        });
        Self { sums, columns }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::luminous::tests::standard;
    use crate::open_sky::OpenSky;
    use crate::sampling::{lattice, shift};

    const NORMALS: [Vec3; 6] =
        [Vec3::Y, Vec3::X, Vec3::NEG_Z, Vec3::NEG_Y, Vec3::new(0.6, 0.8, 0.0), Vec3::new(0.36, -0.8, -0.48)];

    #[test]
    fn what_is_chosen_sums_to_what_an_open_plane_receives() {
        let (count, shifts) = (1 << 11, 64);
        // Points near the edges of sky, ground and plane, some 2 √n of n, lie on either side at random, and those
        // of the ground count twice: 2 n^(−3/4) = 0.7 % of all for each shift, a root of 64 less for their mean;
        // thrice that for the largest of all cases.
        let spread = 3.0 * 0.007 / 8.0;
        for (name, altitude) in [("clear", 5.0), ("clear", 50.0), ("overcast", 30.0), ("uniform", 0.0)] {
            let sky = standard(name, altitude);
            let open = OpenSky::new(&sky);
            let horizontal = open.horizontal().luminance();
            let cells = SkyCells::new(&sky, horizontal / std::f32::consts::PI, 0.5 * horizontal);
            let brightest = open.on_plane(sky.brightest()).luminance().max(horizontal);
            for normal in NORMALS {
                let facing = cells.facing(normal);
                let mut sums = [0.0f64; 2];
                let points =
                    (0..shifts).flat_map(|seed| (0..count).map(move |i| lattice(i, count, shift(seed, 1))));
                for (direction, radiance, per_density) in points.filter_map(|at| cells.choose(&facing, at)) {
                    let luminance = radiance.map_or(1.0, |radiance| radiance.luminance());
                    let part = usize::from(radiance.is_none());
                    sums[part] += f64::from(luminance * direction.dot(normal).max(0.0) * per_density);
                }
                let scale = f64::from(facing.columns[COLUMNS - 1]) / f64::from(count * shifts);
                let [sky, ground] = sums.map(|sum| (sum * scale) as f32);
                // And the table's own stated error.
                let exact = open.on_plane(normal).luminance();
                assert!((sky - exact).abs() <= (1.1e-3 + spread) * brightest, "{normal}: {sky} {exact}");
                let exact = 0.5 * std::f32::consts::PI * (1.0 - normal.y);
                assert!(
                    (ground - exact).abs() <= spread * std::f32::consts::PI * brightest / horizontal,
                    "{normal}: {ground} {exact}"
                );
            }
        }
    }

    #[test]
    fn every_direction_in_front_of_a_plane_can_be_chosen() {
        let cells = SkyCells::new(&standard("clear", 20.0), 1000.0, 500.0);
        for normal in NORMALS {
            let facing = cells.facing(normal);
            for (row, column) in (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (row, column))) {
                let below = if row == 0 { 0.0 } else { facing.sums[row - 1][column] };
                for corner in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
                    // A hundredth of a radian: what a weight of less than an ulp of its column's may hide.
                    if cells.direction(row, column, corner).dot(normal) > 0.01 {
                        assert!(facing.sums[row][column] > below, "{normal} {row} {column}");
                    }
                }
            }
        }
    }

    #[test]
    fn sky_is_above_the_horizon_and_ground_below() {
        let cells = SkyCells::new(&standard("clear", 20.0), 1000.0, 500.0);
        let facing = cells.facing(Vec3::NEG_Z);
        for i in 0..4096 {
            let chosen = cells.choose(&facing, lattice(i, 4096, shift(i, 1)));
            // Within each cell of ground the upper edge is left out, but for rounding.
            assert!(chosen.is_none_or(|(d, sky, _)| if sky.is_some() { d.y >= 0.0 } else { d.y <= 0.0 }));
        }
    }
}
