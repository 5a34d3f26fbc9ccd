//! Error against time, as SVG.

use plotters::prelude::*;

use super::table::Row;

/// Where nothing is off, or nobody can say by how much.
const NOTHING: &str = "<svg width=\"760\" height=\"40\" xmlns=\"http://www.w3.org/2000/svg\"><text x=\"10\" y=\"25\">no setting has an error to draw</text></svg>\n";

const BLUE: RGBColor = RGBColor(30, 90, 160);
const PALE: RGBColor = RGBColor(160, 160, 160);

/// The plot, logarithmic both ways, with the front as a line and its settings named; what has no error, being the measure, has no
/// place on it. An empty one says that there is nothing to show.
///
/// # Errors
/// What the drawing library says.
pub(super) fn svg(rows: &[Row]) -> Result<String, String> {
    let points: Vec<(f64, f64, &Row)> = rows
        .iter()
        .filter_map(|row| row.point().map(|[seconds, error]| (seconds.max(1e-4), error, row)))
        .filter(|(_, error, _)| error.is_finite() && *error > 0.0)
        .collect();
    if points.is_empty() {
        return Ok(NOTHING.to_owned());
    }
    let span = |value: fn(&(f64, f64, &Row)) -> f64| {
        // Whole decades, which have numbers at their ends.
        let values = || points.iter().map(|point| value(point).log10());
        let (low, high) = (
            values().fold(f64::INFINITY, f64::min).floor(),
            values().fold(f64::NEG_INFINITY, f64::max).ceil(),
        );
        10f64.powf(low)..10f64.powf(high.max(low + 1.0))
    };
    let mut text = String::new();
    let mut draw = || -> Result<(), Box<dyn std::error::Error>> {
        let root = SVGBackend::with_string(&mut text, (760, 460)).into_drawing_area();
        let mut chart = ChartBuilder::on(&root)
            .margin(16)
            .x_label_area_size(42)
            .y_label_area_size(70)
            .build_cartesian_2d(span(|p| p.0).log_scale(), span(|p| p.1).log_scale())?;
        let number = |value: &f64| format!("{}", (value * 1e6).round() / 1e6);
        chart
            .configure_mesh()
            .x_desc("seconds")
            .y_desc("error (share)")
            .x_label_formatter(&number)
            .y_label_formatter(&number)
            .light_line_style(RGBColor(235, 235, 235))
            .draw()?;
        let mut front: Vec<(f64, f64)> =
            points.iter().filter(|(.., row)| row.best_of_its_time).map(|(x, y, _)| (*x, *y)).collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        chart.draw_series(LineSeries::new(front, BLUE.stroke_width(2)))?;
        for (x, y, row) in &points {
            let colour = if row.best_of_its_time { BLUE } else { PALE };
            chart.draw_series([Circle::new((*x, *y), 4, colour.filled())])?;
            if row.best_of_its_time {
                let style = ("sans-serif", 13).into_font().color(&BLACK);
                chart.draw_series([Text::new(format!(" {}", row.setting), (*x, *y), style)])?;
            }
        }
        root.present()?;
        Ok(())
    };
    let drawn = draw().map_err(|error| error.to_string());
    drawn.map(|()| text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(seconds: f64, error: f64) -> Row {
        Row { seconds: Some(seconds), relative_rmse: Some(error), ..Row::default() }
    }

    #[test]
    fn what_cannot_be_drawn_is_not() {
        for rows in [vec![], vec![row(1.0, 0.0)], vec![row(1.0, f64::INFINITY), row(2.0, f64::NAN)]] {
            assert_eq!(svg(&rows).unwrap(), NOTHING);
        }
        let drawn = svg(&[row(1.0, 0.1), row(2.0, f64::INFINITY), row(40.0, 0.001)]).unwrap();
        assert_eq!(drawn.matches("<circle").count(), 2);
    }
}
