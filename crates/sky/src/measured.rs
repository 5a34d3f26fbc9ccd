//! Luminances of the sky as measured.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::Vec3;

/// Luminances by altitude and azimuth, bilinear in between.
#[derive(Clone, Debug, PartialEq)]
pub struct LuminanceTable {
    /// Rising, within \[0, 90\] \[degrees\].
    altitudes: Vec<f32>,
    /// Rising, within \[0, 360\) \[degrees\], clockwise from north.
    azimuths: Vec<f32>,
    /// By altitude, then azimuth \[cd/m²\].
    luminances: Vec<f32>,
}

/// Why luminances make no table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableError {
    /// Altitudes must rise strictly within 0° to 90°, and there must be one.
    Altitudes,
    /// Azimuths must rise strictly, from 0° on and below 360°, and there must be one.
    Azimuths,
    /// There must be as many luminances as altitudes times azimuths.
    Count,
    /// This luminance (by its place in the list) is negative or not a finite number.
    Luminance(usize),
}

impl std::fmt::Display for TableError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Altitudes => f.write_str("altitudes must rise strictly within 0° to 90°"),
            Self::Azimuths => f.write_str("azimuths must rise strictly from 0° on, below 360°"),
            Self::Count => f.write_str("there must be one luminance for each altitude and azimuth"),
            Self::Luminance(at) => write!(f, "luminance {} is no finite number ≥ 0", at + 1),
        }
    }
}

impl std::error::Error for TableError {}

impl LuminanceTable {
    /// `altitudes` and `azimuths` (clockwise from north, −Z) rise, in degrees; `luminances` \[cd/m²\] belong to the
    /// first altitude and all azimuths, then to the second, and so on.
    ///
    /// Below the lowest altitude the lowest row goes on; above the highest its mean is reached at the zenith.
    ///
    /// # Errors
    ///
    /// When the three lists do not make a table.
    pub fn new(altitudes: Vec<f32>, azimuths: Vec<f32>, luminances: Vec<f32>) -> Result<Self, TableError> {
        let rising = |list: &[f32]| !list.is_empty() && list.windows(2).all(|pair| pair[0] < pair[1]);
        let within = |list: &[f32], high: f32| list.iter().all(|x| (0.0..=high).contains(x));
        if !rising(&altitudes) || !within(&altitudes, 90.0) {
            return Err(TableError::Altitudes);
        }
        if !rising(&azimuths) || !within(&azimuths, 360.0_f32.next_down()) {
            return Err(TableError::Azimuths);
        }
        if luminances.len() != altitudes.len() * azimuths.len() {
            return Err(TableError::Count);
        }
        match luminances.iter().position(|l| !(l.is_finite() && *l >= 0.0)) {
            Some(at) => Err(TableError::Luminance(at)),
            None => Ok(Self { altitudes, azimuths, luminances }),
        }
    }

    /// Luminance from the unit vector `direction`, y ≥ 0 \[cd/m²\].
    pub fn luminance(&self, direction: Vec3) -> f32 {
        let altitude = (direction.y.clamp(-1.0, 1.0).asin() * (90.0 / FRAC_PI_2)).clamp(0.0, 90.0);
        let turn = direction.x.atan2(-direction.z) * (360.0 / TAU);
        let azimuth = if turn < 0.0 { turn + 360.0 } else { turn };
        let after = self.altitudes.partition_point(|&row| row <= altitude);
        match (after.checked_sub(1), self.altitudes.get(after)) {
            (None, _) => self.around(0, azimuth),
            (Some(below), Some(&high)) => {
                let low = self.altitudes[below];
                let (a, b) = (self.around(below, azimuth), self.around(after, azimuth));
                a + (b - a) * ((altitude - low) / (high - low))
            }
            (Some(top), None) => {
                let (low, row) = (self.altitudes[top], self.row(top));
                let mean = row.iter().sum::<f32>() / row.len() as f32;
                let up = if low < 90.0 { (altitude - low) / (90.0 - low) } else { 1.0 };
                let a = self.around(top, azimuth);
                a + (mean - a) * up
            }
        }
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.luminances[row * self.azimuths.len()..(row + 1) * self.azimuths.len()]
    }

    /// Along one row, all the way round.
    fn around(&self, row: usize, azimuth: f32) -> f32 {
        let (row, count) = (self.row(row), self.azimuths.len());
        let after = self.azimuths.partition_point(|&at| at <= azimuth);
        let (before, after) = ((after + count - 1) % count, after % count);
        let span = (self.azimuths[after] - self.azimuths[before]).rem_euclid(360.0);
        let into = (azimuth - self.azimuths[before]).rem_euclid(360.0);
        if span > 0.0 { row[before] + (row[after] - row[before]) * (into / span) } else { row[before] }
    }

    /// Where the largest luminance was measured.
    pub(crate) fn brightest(&self) -> Vec3 {
        let largest =
            (0..self.luminances.len()).max_by(|&a, &b| self.luminances[a].total_cmp(&self.luminances[b]));
        let at = largest.unwrap_or(0);
        let (row, column) = (at / self.azimuths.len(), at % self.azimuths.len());
        let (h, a) = (self.altitudes[row].to_radians(), self.azimuths[column].to_radians());
        Vec3::new(h.cos() * a.sin(), h.sin().max(0.0), -h.cos() * a.cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(altitude: f32, azimuth: f32) -> Vec3 {
        let (h, a) = (altitude.to_radians(), azimuth.to_radians());
        Vec3::new(h.cos() * a.sin(), h.sin(), -h.cos() * a.cos())
    }

    fn table() -> LuminanceTable {
        let luminances = vec![100.0, 200.0, 300.0, 400.0, 1000.0, 1100.0, 1200.0, 1300.0];
        LuminanceTable::new(vec![10.0, 50.0], vec![0.0, 90.0, 180.0, 270.0], luminances).expect("a table")
    }

    #[test]
    fn measured_values_come_back_and_others_lie_between() {
        let table = table();
        // Degrees → vector → degrees in f32: 1e-5 of a turn times the slope of 1.1 to 22 cd/m² per degree.
        for (altitude, azimuth, expected) in [
            (10.0, 90.0, 200.0),
            (50.0, 270.0, 1300.0),
            (30.0, 0.0, 550.0),
            (10.0, 45.0, 150.0),
            (10.0, 315.0, 250.0), // from 400 in the west to 100 in the north
            (3.0, 180.0, 300.0),
            (90.0, 77.0, 1150.0),
            (70.0, 0.0, 1075.0),
        ] {
            let value = table.luminance(direction(altitude, azimuth));
            assert!((value - expected).abs() < 0.02, "{altitude} {azimuth}: {value}");
        }
        assert!(table.brightest().distance(direction(50.0, 270.0)) < 1e-6, "rounding");
    }

    #[test]
    fn lists_that_make_no_table_are_refused() {
        let new = LuminanceTable::new;
        assert_eq!(new(vec![], vec![0.0], vec![]), Err(TableError::Altitudes));
        assert_eq!(new(vec![10.0, 10.0], vec![0.0], vec![1.0, 1.0]), Err(TableError::Altitudes));
        assert_eq!(new(vec![91.0], vec![0.0], vec![1.0]), Err(TableError::Altitudes));
        assert_eq!(new(vec![10.0], vec![0.0, 360.0], vec![1.0, 1.0]), Err(TableError::Azimuths));
        assert_eq!(new(vec![f32::NAN], vec![0.0], vec![1.0]), Err(TableError::Altitudes));
        assert_eq!(new(vec![10.0], vec![0.0], vec![1.0, 1.0]), Err(TableError::Count));
        assert_eq!(new(vec![10.0], vec![0.0, 9.0], vec![1.0, -1.0]), Err(TableError::Luminance(1)));
        assert_eq!(new(vec![10.0], vec![0.0], vec![f32::NAN]), Err(TableError::Luminance(0)));
        assert!(new(vec![90.0], vec![0.0], vec![5.0]).is_ok_and(|t| t.luminance(Vec3::X) == 5.0));
    }
}
