//! Laws of the interpolation: what is proportional to the sun comes back, nothing shines at night.

use jiff::civil::date;
use proptest::prelude::*;

use super::super::SLOTS;
use super::*;

fn station(offset: i32) -> Station {
    Station { name: "Here".into(), latitude: 28.6, longitude: 77.2, offset, elevation: 200.0 }
}

/// A year whose rows are made by `hour` from the moment at which each begins.
fn year(offset: i32, leap_day: bool, hour: impl Fn(Timestamp) -> Option<Hour>) -> Year {
    let station = station(offset);
    let mut hours = vec![None; SLOTS];
    let days = date(2024, 1, 1).series(jiff::Span::new().days(1)).take(366);
    for day in days.filter(|day| leap_day || (day.month(), day.day()) != (2, 29)) {
        for i in 0..24 {
            let start = station.offset().to_timestamp(day.at(i, 0, 0, 0)).unwrap();
            hours[slot(day.month(), day.day(), i).unwrap()] = hour(start);
        }
    }
    Year { station, warnings: Vec::new(), hours }
}

fn site(time: &str) -> Site {
    let Station { latitude, longitude, elevation, .. } = station(0);
    Site { latitude, longitude, elevation, time: time.parse().unwrap(), ..Site::default() }
}

const EVEN: Hour = Hour {
    direct_normal: Some(700.0),
    diffuse_horizontal: Some(90.0),
    dew_point: Some(11.0),
    aerosol_depth: Some(0.1),
};

/// A row that holds `of` sunshine: 800 W/m² facing the sun and 120 W/m² · sin(altitude) from the sky, both as means.
fn proportional(station: &Station, start: Timestamp) -> Option<Hour> {
    let [direct, sky] = station.sunshine(start);
    Some(Hour { direct_normal: Some(800.0 * direct), diffuse_horizontal: Some(120.0 * sky), ..EVEN })
}

proptest! {
    /// E = c e comes back as c e at every moment: the sum of the rows divides out.
    #[test]
    fn what_is_proportional_to_the_sun_comes_back(second in 0i64..31_536_000) {
        let here = station(19_800);
        let time = Timestamp::from_second(1_704_067_200 + second).unwrap();
        // The rows about the moment are enough.
        let near = |start: Timestamp| (start.as_second() - time.as_second()).abs() < 2 * 3600;
        let year = year(19_800, true, |start| near(start).then(|| proportional(&here, start))?);
        let site = Site { time, ..site("2024-01-01T00:00:00Z") };
        let [direct, sky] = sunshine(&site);
        // The last hours of 2024 there have no rows after them: the list above ends.
        if let Ok(now) = year.at(&site) {
            // Of the sun's first and last five minutes the twelve moments of an hour may see nothing: then
            // nothing comes back. In five minutes it rises by 1.25° at most, sin 1.25° = 0.022.
            let (a, b) = (now.direct_normal - 800.0 * direct, now.diffuse_horizontal - 120.0 * sky);
            // A handful of roundings of numbers up to 800.
            prop_assert!(a.abs() < 1e-9 || sky < 0.022 && now.direct_normal == 0.0, "{now:?}");
            prop_assert!(b.abs() < 1e-9 || sky < 0.022 && now.diffuse_horizontal == 0.0, "{now:?}");
            prop_assert!(sky > 0.0 || (now.direct_normal, now.diffuse_horizontal) == (0.0, 0.0));
        }
    }

    /// Rows of nonsense give no more than the sun does, and no less than nothing.
    #[test]
    fn no_moment_is_brighter_than_the_sun(second in 0i64..31_536_000, direct in 0.0..1500.0f64, sky in 0.0..1500.0f64) {
        let hour = Hour { direct_normal: Some(direct), diffuse_horizontal: Some(sky), ..EVEN };
        let site = Site { time: Timestamp::from_second(1_704_067_200 + second).unwrap(), ..site("2024-01-01T00:00:00Z") };
        let now = year(19_800, true, |_| Some(hour)).at(&site).unwrap();
        prop_assert!((0.0..=SOLAR).contains(&now.direct_normal) && (0.0..=SOLAR).contains(&now.diffuse_horizontal));
    }
}

/// India is half an hour off: row 13, the hour to 13:00, has its middle at 12:30 there, which is 07:00 UTC.
#[test]
fn rows_belong_to_the_middle_of_the_hour_before_their_time() {
    let noon: Timestamp = "2024-05-10T07:00:00Z".parse().unwrap();
    let start: Timestamp = "2024-05-10T06:30:00Z".parse().unwrap();
    let lone =
        |at: Timestamp| Some(if at == start { EVEN } else { Hour { direct_normal: Some(0.0), ..EVEN } });
    let year = year(19_800, false, lone);
    let at = |minutes: i64| {
        let time = Timestamp::from_second(noon.as_second() + 60 * minutes).unwrap();
        year.at(&Site { time, ..site("2024-05-10T07:00:00Z") }).unwrap().direct_normal
    };
    // The sun is up all the time: means are 1, and the row rises and falls along straight lines.
    assert_eq!((at(0), at(60), at(-60)), (700.0, 0.0, 0.0));
    assert!((at(30) - 350.0).abs() < 1e-9 && (at(-15) - 525.0).abs() < 1e-9);
    // The year does not matter, nor does the clock of the site.
    let other = Site { offset: Offset::constant(-3), ..site("1999-05-10T07:00:00Z") };
    assert_eq!(year.at(&other).unwrap().direct_normal, 700.0);
}

#[test]
fn a_file_without_a_leap_day_has_its_twenty_eighth_twice() {
    let feb_28: Timestamp = "2024-02-28T06:30:00Z".parse().unwrap();
    let hour = |at: Timestamp| Some(Hour { dew_point: Some(if at == feb_28 { -5.0 } else { 5.0 }), ..EVEN });
    let at = |leap_day| year(19_800, leap_day, hour).at(&site("2024-02-29T07:00:00Z")).unwrap().dew_point;
    assert_eq!((at(false), at(true)), (Some(-5.0), Some(5.0)));
}

#[test]
fn what_is_missing_is_taken_from_the_other_hour_or_named() {
    let start: Timestamp = "2024-05-10T06:30:00Z".parse().unwrap();
    let without = Hour { direct_normal: None, dew_point: None, ..EVEN };
    let lacking = year(19_800, false, |at| Some(if at == start { without } else { EVEN }));
    // Also in the very middle of the hour that lacks it, where the other one has no weight.
    for time in ["2024-05-10T07:00:00Z", "2024-05-10T07:20:00Z"] {
        let now = lacking.at(&site(time)).unwrap();
        assert_eq!((now.direct_normal, now.dew_point), (700.0, Some(11.0)), "{time}");
    }
    let summer = year(19_800, false, |at| (at.as_second() < 1_715_000_000).then_some(EVEN));
    let error = summer.at(&site("2024-07-10T07:00:00Z")).unwrap_err();
    assert!(error.contains("no direct normal irradiance for 07-10 12:30"), "{error}");
}

#[test]
fn nothing_shines_at_night_whatever_the_rows_say() {
    let now = year(19_800, true, |_| Some(EVEN)).at(&site("2024-06-10T19:00:00Z")).unwrap();
    assert_eq!((now.direct_normal, now.diffuse_horizontal, now.dew_point), (0.0, 0.0, Some(11.0)));
}

#[test]
fn distances_are_those_of_a_sphere() {
    // A degree of a meridian is π/180 · 6371 km = 111.195 km.
    let here = station(0);
    assert!((here.distance(29.6, 77.2) - 111_195.0).abs() < 1.0);
    assert_eq!(here.distance(28.6, 77.2), 0.0);
}
