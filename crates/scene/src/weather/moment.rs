//! From hourly means to a moment.

use std::sync::Arc;

use jiff::Timestamp;
use jiff::tz::Offset;

use super::{Hour, Station, Year, slot};
use crate::Site;

/// What sun and sky send at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Weather {
    /// Name of the station.
    pub station: Arc<str>,
    /// Irradiance by the sun on a plane that faces it \[W/m²\]; 0 while the sun is below the horizon.
    pub direct_normal: f64,
    /// Irradiance by the sky on a horizontal plane \[W/m²\]; 0 while the sun is below the horizon.
    pub diffuse_horizontal: f64,
    /// Dew point \[°C\]; none = missing in the file.
    pub dew_point: Option<f64>,
    /// Broadband optical depth of the aerosol (1, not thousandths); none = missing in the file.
    pub aerosol_depth: Option<f64>,
}

/// Seconds of an hour.
const HOUR: f64 = 3600.0;

/// Moments of an hour at which the sun is asked for; every five minutes it moves by 1.25° at most.
const PARTS: u32 = 12;

/// What the sun sends above the air, as shares: (onto a plane that faces it, onto the horizontal).
type Sunshine = [f64; 2];

impl Year {
    /// The weather at the place and moment of `site`.
    ///
    /// A row holds the mean over the hour *before* its time, so it belongs to the middle of that hour. Straight
    /// lines between those middles would shine before sunrise and lose what an hour with a sunrise gives. So means
    /// and what the sun sends above the air, e, are both interpolated, and their ratio is what is kept:
    ///
    /// ```text
    ///   E(t) = e(t) · [(1−w) Eₕ + w Eₕ₊₁] / [(1−w) ēₕ + w ēₕ₊₁],   w = (t − middle of h) / 1 h
    /// ```
    ///
    /// with e = 1 while the sun is up for the direct normal irradiance, e = sin(altitude) for the diffuse horizontal
    /// one, and ē its mean over the hour. It is continuous while the sun is up, nothing at night, and at the
    /// middle of an hour of even sunshine it is the row itself. Dew point and aerosol depth are interpolated as they
    /// are. If one of the two rows is missing, the other one stands for both. The station's clock is that
    /// of its standard time; 29 February is 28 February in a file without it.
    ///
    /// # Errors
    /// What is missing, in words: the file has no rows, or rows without irradiance, about that moment.
    pub fn at(&self, site: &Site) -> Result<Weather, String> {
        let (weight, rows) = self.rows(site.time);
        let used: Vec<(f64, Hour, Sunshine)> = rows
            .into_iter()
            .zip([1.0 - weight, weight])
            .filter_map(|((start, hour), weight)| Some((weight, hour?, self.station.sunshine(start))))
            .collect();
        let now = sunshine(site);
        let irradiance = |lane: usize, of: fn(&Hour) -> Option<f64>| {
            let value = mean(&used, |hour, _| of(hour))?;
            let above = mean(&used, |hour, sunshine| of(hour).map(|_| sunshine[lane]))?;
            let share = if above > 0.0 { (value / above).min(SOLAR) } else { 0.0 };
            Some(now[lane] * share)
        };
        let missing = |what: &str| {
            let local = self.station.offset().to_datetime(site.time).strftime("%m-%d %H:%M");
            format!("the weather file has no {what} for {local} (the station's standard time)")
        };
        Ok(Weather {
            station: self.station.name.as_str().into(),
            direct_normal: irradiance(0, |hour| hour.direct_normal)
                .ok_or_else(|| missing("direct normal irradiance"))?,
            diffuse_horizontal: irradiance(1, |hour| hour.diffuse_horizontal)
                .ok_or_else(|| missing("diffuse horizontal irradiance"))?,
            dew_point: mean(&used, |hour, _| hour.dew_point),
            aerosol_depth: mean(&used, |hour, _| hour.aerosol_depth),
        })
    }

    /// The two rows whose middles lie about `time`, with the moments at which their hours begin, and the weight of
    /// the second.
    fn rows(&self, time: Timestamp) -> (f64, [(Timestamp, Option<Hour>); 2]) {
        let second = time.as_second() + i64::from(self.station.offset);
        let into = (second.rem_euclid(3600)) as f64 + f64::from(time.subsec_nanosecond()) * 1e-9;
        // From the middle of the hour that began last: before it, the hour before is the first of the two.
        let (back, weight) = if into < 0.5 * HOUR { (1, into / HOUR + 0.5) } else { (0, into / HOUR - 0.5) };
        let start = time.as_second() - second.rem_euclid(3600) - 3600 * back;
        let row = |second: i64| {
            let start = Timestamp::from_second(second).unwrap_or(time);
            (start, self.hour(start))
        };
        (weight, [row(start), row(start + 3600)])
    }

    /// The row of the hour that begins at `start`.
    fn hour(&self, start: Timestamp) -> Option<Hour> {
        let local = self.station.offset().to_datetime(start);
        let of = |day: i8| self.hours[slot(local.month(), day, local.hour())?];
        let leap = (local.month(), local.day()) == (2, 29);
        of(local.day()).or_else(|| of(28).filter(|_| leap))
    }
}

/// The solar constant when the earth is nearest to the sun \[W/m²\] (1361 · 1.034): no hour lets more through, and
/// what the roundings of a few seconds of sunshine make of it is cut off here.
const SOLAR: f64 = 1407.0;

/// The weighted mean of what is known of two rows; the only one that is, else none.
fn mean(used: &[(f64, Hour, Sunshine)], of: impl Fn(&Hour, &Sunshine) -> Option<f64>) -> Option<f64> {
    let known: Vec<(f64, f64)> =
        used.iter().filter_map(|(weight, hour, sunshine)| Some((*weight, of(hour, sunshine)?))).collect();
    match known[..] {
        // Not by its weight: that is 0 in the middle of the hour that is missing.
        [(_, value)] => Some(value),
        [(w, first), (v, second)] => Some(w * first + v * second),
        _ => None,
    }
}

/// e at this moment.
fn sunshine(site: &Site) -> Sunshine {
    let up = site.sun().map_or(0.0, |sun| sun.toward.y);
    if up > 0.0 { [1.0, up] } else { [0.0, 0.0] }
}

impl Station {
    fn offset(&self) -> Offset {
        Offset::from_seconds(self.offset).unwrap_or(Offset::UTC)
    }

    /// ē over the hour that begins at `start`.
    fn sunshine(&self, start: Timestamp) -> Sunshine {
        let part = 3600 / i64::from(PARTS);
        let moments = (0..i64::from(PARTS)).map(|i| start.as_second() + part * i + part / 2);
        let sum =
            moments.filter_map(|second| Timestamp::from_second(second).ok()).fold([0.0; 2], |sum, time| {
                let Self { latitude, longitude, elevation, .. } = *self;
                let e = sunshine(&Site { latitude, longitude, elevation, time, ..Site::default() });
                [sum[0] + e[0], sum[1] + e[1]]
            });
        sum.map(|sum| sum / f64::from(PARTS))
    }

    /// Distance to a place along the ground \[m\], on a sphere (good to 0.5 %).
    pub fn distance(&self, latitude: f64, longitude: f64) -> f64 {
        const EARTH: f64 = 6_371_000.0;
        let (a, b) = (self.latitude.to_radians(), latitude.to_radians());
        let half = |x: f64| (0.5 * x).sin().powi(2);
        let h = half(b - a) + a.cos() * b.cos() * half((longitude - self.longitude).to_radians());
        2.0 * EARTH * h.sqrt().min(1.0).asin()
    }
}

#[cfg(test)]
mod tests;
