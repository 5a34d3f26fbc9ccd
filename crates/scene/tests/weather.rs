//! Weather files: what is read, what it becomes at a time, what errors say.

use std::path::{Path, PathBuf};

use keikan_scene::{Error, Scene, load, weather};

const HEAD: &str = "LOCATION,SOMEWHERE,-,NLD,Test,062400,52.30,4.77,1.0,-2.0\n";
const PERIODS: &str = "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";

/// A row of all 35 columns.
fn row(month: u32, day: u32, hour: u32, direct: &str, diffuse: &str) -> String {
    format!(
        "1995,{month},{day},{hour},60,C9C9*0?9,5.1,1.8,79,100100,0,1415,288,0,{direct},{diffuse},0,0,0,0,340,6.7,6,6,20.0,420,9,999999999,0,0.0500,0,88,0.000,0.0,0.0\n"
    )
}

/// The rows of the months `from` to `to` of a common year.
fn rows(from: u32, to: u32, direct: &str) -> String {
    let days = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut text = String::new();
    for month in from..=to {
        for day in 1..=days[month as usize - 1] {
            (1..=24).for_each(|hour| text += &row(month, day, hour, direct, "100"));
        }
    }
    text
}

fn parse(text: &str) -> Result<weather::Year, Error> {
    weather::parse(text.as_bytes(), Path::new("a.epw"))
}

fn complaint(text: &str) -> String {
    parse(text).map_or_else(|error| error.to_string(), |_| panic!("accepted: {text:.200}"))
}

/// A scene file beside a weather file, in a folder of this test's own.
fn beside(test: &str, epw: &[u8], text: &str) -> (PathBuf, Result<Scene, Error>) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("w.epw"), epw).unwrap();
    std::fs::write(folder.join("a.toml"), text).unwrap();
    (folder.clone(), load(&folder.join("a.toml")))
}

#[test]
fn a_whole_year_is_read_with_its_station() {
    let year = parse(&format!("\u{feff}{HEAD}COMMENTS 1,\"a, b\n{PERIODS}{}", rows(1, 12, "300"))).unwrap();
    assert_eq!(year.warnings, []);
    let station = &year.station;
    assert_eq!(station.name, "SOMEWHERE");
    assert_eq!(
        (station.latitude, station.longitude, station.offset, station.elevation),
        (52.3, 4.77, 3600, -2.0)
    );
    // The same with the line ends of other systems, empty lines, and commas that spreadsheets append.
    let other =
        format!("{}{PERIODS}{}\n\n", HEAD.replace('\n', ",,,\n"), rows(1, 12, "300")).replace('\n', "\r\n");
    assert_eq!(parse(&other).unwrap(), year);
}

#[test]
fn half_hour_zones_and_latin_1_are_read() {
    let head = b"LOCATION,Z\xfcrich \"Nord\", Kt. ZH,-,CHE,Test,0,28.6,77.2,5.5,216\n";
    let bytes = [&head[..], PERIODS.as_bytes(), row(6, 1, 12, "5", "5").as_bytes()].concat();
    let year = weather::parse(&bytes, Path::new("a.epw")).unwrap();
    assert_eq!((year.station.name.as_str(), year.station.offset), ("Zürich \"Nord", 19_800));
}

#[test]
fn what_is_missing_is_said_and_matters_only_where_it_is_asked_for() {
    let mut text = format!("{HEAD}{PERIODS}{}", rows(7, 12, "300"));
    text += &rows(1, 1, "9999");
    let year = parse(&text).unwrap();
    let said: Vec<_> = year.warnings.iter().map(ToString::to_string).collect();
    // 184 days of July to December and 31 of January; January begins after 2 lines of head and 184 · 24 rows.
    assert_eq!(said[0], "a.epw: has 5160 hours; a whole year has 8760 or 8784");
    assert_eq!(said[1], "a.epw: line 4419: irradiance is missing in 744 hours (here first)");
    let at = |time: &str| {
        let site = keikan_scene::Site {
            latitude: 52.3,
            longitude: 4.77,
            time: time.parse().unwrap(),
            ..Default::default()
        };
        year.at(&site)
    };
    assert!(at("2031-08-01T11:30:00Z").is_ok_and(|w| w.direct_normal == 300.0));
    assert!(
        at("2031-01-20T11:30:00Z")
            .is_err_and(|what| what.contains("no direct normal irradiance for 01-20 12:30"))
    );
    assert!(at("2031-04-01T11:30:00Z").is_err_and(|what| what.contains("04-01 12:30")));
}

#[test]
fn aerosol_depths_in_thousandths_are_recognised() {
    let row = row(6, 1, 12, "5", "5");
    let depth = |text: &str| {
        let text = format!("{HEAD}{PERIODS}{}", row.replace("0.0500", text));
        let site = keikan_scene::Site { time: "2026-06-01T10:30:00Z".parse().unwrap(), ..Default::default() };
        parse(&text).unwrap().at(&site).unwrap().aerosol_depth
    };
    assert_eq!(depth("0.0500"), Some(0.05));
    assert_eq!(depth("50"), Some(0.05));
    assert_eq!(depth(".999"), None);
    assert_eq!(depth("0"), None);
}

#[test]
fn errors_name_the_line() {
    let begin = format!("{HEAD}{PERIODS}");
    let with = |row: String| format!("{begin}{row}");
    for (text, expected) in [
        (String::new(), "a.epw: does not begin with LOCATION"),
        ("\n\nsite,1,2\n".to_owned(), "a.epw: line 3: does not begin with LOCATION"),
        (HEAD.to_owned(), "has no line that begins with DATA PERIODS"),
        (begin.clone(), "has no row of data"),
        (HEAD.replace("52.30", "91"), "line 1: latitude: 91 is not within [-90, 90]"),
        (HEAD.replace("1.0", "x"), "line 1: time zone: \"x\" is not a number"),
        ("LOCATION,a,1".to_owned(), "line 1: LOCATION needs"),
        (begin.replace("DATA PERIODS,1,1", "DATA PERIODS,1,4"), "line 2: \"4\" records an hour"),
        (with(row(2, 30, 1, "0", "0")), "line 3: there is no day 30 in month 2"),
        (with(row(13, 1, 1, "0", "0")), "line 3: month: 13 is not within [1, 12]"),
        (with(row(1, 1, 0, "0", "0")), "line 3: hour: 0 is not within [1, 24]"),
        (
            with(row(1, 1, 1, "0", "0") + &row(1, 1, 1, "0", "0")),
            "line 4: this hour stands in line 3 already",
        ),
        (
            with(row(1, 1, 1, "12000", "3000")),
            "line 3: diffuse horizontal irradiance: 3000 W/m² is not within",
        ),
        (with(row(1, 1, 1, "abc", "0")), "line 3: direct normal irradiance: \"abc\" is not a number"),
        (with("1995,1,1,1,60\n".to_owned()), "line 3: has 5 columns"),
    ] {
        let said = complaint(&text);
        assert!(said.contains(expected), "{said}\n  expected {expected}");
    }
}

#[test]
fn a_scene_takes_place_and_weather_from_the_file() {
    let epw = format!("{HEAD}{PERIODS}{}", rows(1, 12, "300"));
    let site = "[site]\ntime = 2026-06-21T12:30:00+02:00\n[sky]\nweather = 'w.epw'\n[[model]]\nbox = { size = [1, 1, 1] }\n";
    let (_, scene) = beside("weather-place", epw.as_bytes(), site);
    let scene = scene.unwrap();
    assert_eq!((scene.site.latitude, scene.site.longitude, scene.site.elevation), (52.3, 4.77, -2.0));
    let sky = scene.sky.as_ref().unwrap();
    let now = sky.weather.as_ref().unwrap();
    assert_eq!((&*now.station, now.dew_point, now.aerosol_depth), ("SOMEWHERE", Some(1.8), Some(0.05)));
    // The middle of the row of 12:00 (11:30 in winter time): the sun is up all the hour, its altitude is not even.
    assert_eq!(now.direct_normal, 300.0);
    assert!((now.diffuse_horizontal - 100.0).abs() < 1.0, "{}", now.diffuse_horizontal);
    assert_eq!(scene.warnings, []);

    // Another time: sun and weather follow, nothing is read, the meshes are the same ones.
    assert!(scene.follows_time());
    let evening = scene.at_time(scene.site.at_local(22.5 * 3600.0).unwrap()).unwrap();
    assert!(std::sync::Arc::ptr_eq(&scene.geometry, &evening.geometry));
    let dark = evening.sky.unwrap().weather.unwrap();
    assert_eq!((dark.direct_normal, dark.diffuse_horizontal), (0.0, 0.0));
    assert!(evening.sun.unwrap().altitude < 0.0);
    assert!(
        evening.warnings[0].what.contains("below the horizon at 2026-06-21 20:30 UTC"),
        "{:?}",
        evening.warnings
    );

    // A site of its own, 1° of latitude away.
    let own = site.replace("[site]", "[site]\nlatitude = 53.3\nlongitude = 4.77");
    let (_, scene) = beside("weather-far", epw.as_bytes(), &own);
    let scene = scene.unwrap();
    assert_eq!(scene.site.elevation, 0.0);
    assert!(scene.warnings[0].what.contains("SOMEWHERE is 111 km away"), "{:?}", scene.warnings);
    assert!(
        scene.warnings[0].place.contains("line 6, column 11, [sky], key \"weather\""),
        "{:?}",
        scene.warnings
    );
    let half = site.replace("[site]", "[site]\nlatitude = 53.3");
    let (_, scene) = beside("weather-half", epw.as_bytes(), &half);
    assert!(scene.unwrap_err().to_string().contains("[site], key \"longitude\": is required"));
}

#[test]
fn a_missing_or_broken_weather_file_is_named() {
    let text = "[site]\ntime = 2026-06-21T12:30:00+02:00\n[sky]\nweather = 'w.epw'\n";
    let (_, scene) = beside("weather-broken", b"PK\x03\x04\xff\xfe", text);
    let said = scene.unwrap_err().to_string();
    assert!(said.contains("w.epw: line 1: does not begin with LOCATION"), "{said}");
    let (folder, _) = beside("weather-gone", b"", text);
    std::fs::remove_file(folder.join("w.epw")).unwrap();
    let said = load(&folder.join("a.toml")).unwrap_err();
    assert!(
        matches!(said, Error::Io { .. }) && said.to_string().contains("[sky], key \"weather\""),
        "{said}"
    );
    // A sky that is off asks for no weather.
    let off = text.replace("[sky]\n", "[sky]\noff = true\n");
    std::fs::write(folder.join("a.toml"), off).unwrap();
    assert!(load(&folder.join("a.toml")).is_err_and(|error| error.to_string().contains("latitude")));
}

#[test]
fn a_sun_that_is_put_by_hand_stays() {
    let text = "[site]\nlatitude = 52\nlongitude = 5\ntime = 2026-06-21T12:30:00+02:00\n[sun]\n";
    let read = |more: &str| {
        keikan_scene::parse(&format!("{text}{more}"), Path::new(""), Path::new("a.toml")).unwrap()
    };
    let put = read("altitude = 30\nazimuth = 200");
    assert!(!put.follows_time());
    let later = put.at_time(put.site.at_local(3600.0).unwrap()).unwrap();
    assert_eq!(later.sun, put.sun);
    assert!(!read("off = true").follows_time());
    // One that follows keeps what the file says about it.
    let dim = read("illuminance = 1234\ndiameter = 0");
    let later = dim.at_time(dim.site.at_local(8.0 * 3600.0).unwrap()).unwrap().sun.unwrap();
    assert_eq!((later.illuminance, later.diameter), (Some(1234.0), 0.0));
    assert!(later.altitude < dim.sun.unwrap().altitude);
}

/// Mutated files are read or refused, never a panic.
#[test]
fn mutations_never_panic() {
    let whole = format!("{HEAD}{PERIODS}{}{}", row(1, 1, 1, "0", "0"), row(1, 1, 2, "20", "50"));
    let odd = ["", ",", "\n", "nan", "-1e999", "9999999999999999999999", "\"", "ä", "\0", "24.5", "-0"];
    for at in (0..whole.len()).filter(|at| whole.is_char_boundary(*at)) {
        for insert in odd {
            for cut in [0, 1, 7] {
                let end = (at + cut).min(whole.len());
                let _ = parse(&format!("{}{insert}{}", &whole[..at], &whole[end..]));
            }
        }
    }
}

/// The sum of a year's moments is the sum of its rows: interpolation moves energy, it hardly makes any.
#[test]
fn a_real_year_keeps_its_energy() {
    let Some(assets) = std::env::var_os("KEIKAN_ASSETS") else {
        println!("skipped: KEIKAN_ASSETS is not set");
        return;
    };
    let path = Path::new(&assets).join("weather/amsterdam.epw");
    let start = std::time::Instant::now();
    let year = weather::read(&path).unwrap();
    println!(
        "read in {:.1} ms, {:?}, {:?}",
        start.elapsed().as_secs_f64() * 1e3,
        year.station,
        year.warnings
    );
    let text = std::fs::read_to_string(&path).unwrap();
    // Every ninth day, whole: nothing crosses midnight there.
    let rows = text.lines().skip(8).enumerate().filter(|(i, _)| i / 24 % 9 == 0);
    let rows: Vec<Vec<&str>> = rows.map(|(_, line)| line.split(',').collect()).collect();
    let of_rows = |column: usize| -> f64 { rows.iter().map(|row| row[column].parse::<f64>().unwrap()).sum() };
    let (mut direct, mut diffuse, mut brightest) = (0.0, 0.0, 0.0f64);
    for part in 0..144 * i64::from(365_u32.div_ceil(9)) {
        // From 1 January 2027, local time, the middles of ten minutes.
        let second = 1_798_761_600 - 3600 + 86_400 * 9 * (part / 144) + 600 * (part % 144) + 300;
        let time = jiff::Timestamp::from_second(second).unwrap();
        let weather::Station { latitude, longitude, elevation, .. } = year.station;
        let site = keikan_scene::Site { latitude, longitude, elevation, time, ..Default::default() };
        let now = year.at(&site).unwrap();
        direct += now.direct_normal / 6.0;
        diffuse += now.diffuse_horizontal / 6.0;
        brightest = brightest.max(now.direct_normal);
    }
    println!(
        "direct {direct:.0} of {:.0}, diffuse {diffuse:.0} of {:.0} Wh/m², brightest {brightest:.0} W/m²",
        of_rows(14),
        of_rows(15)
    );
    // Weights of neighbours sum to 1, so all that is kept but in the hours of sunrise and sunset and, for the sky, by
    // the bend of sin(altitude) within an hour: cos 7.5° = 0.991.
    assert!((direct / of_rows(14) - 1.0).abs() < 0.01);
    assert!((diffuse / of_rows(15) - 1.0).abs() < 0.01);
}
