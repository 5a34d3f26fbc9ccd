//! The report: one file with everything in it.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::Vec3;
use light::colour::LUMINANCE;

use super::table::{Row, Table, cell};
use super::trial::{Answer, Trial, words};
use crate::args::{Span, Tone};
use crate::output::{self, Exposure, Picture, Scale};

/// What is reported.
pub(super) struct Report<'a> {
    pub(super) title: String,
    /// Facts in words, a paragraph each.
    pub(super) facts: Vec<String>,
    pub(super) rows: &'a [Row],
    pub(super) trials: &'a [Trial],
    pub(super) truth: &'a Answer,
    pub(super) truth_name: String,
    /// The plot, as SVG.
    pub(super) plot: &'a str,
}

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222}\
table{border-collapse:collapse;margin:1rem 0}td,th{padding:.25rem .7rem;text-align:right;border-bottom:1px solid #ddd}\
td:first-child,th:first-child{text-align:left}tr.best td{font-weight:600;background:#eef4fb}\
figure{display:inline-block;margin:.4rem;vertical-align:top}figcaption{font-size:13px;max-width:480px}\
img{max-width:480px;display:block}h1{font-weight:600}svg{max-width:100%}";

impl Report<'_> {
    /// The whole file.
    ///
    /// # Errors
    /// What encoding of a picture says.
    pub(super) fn html(&self) -> Result<String, String> {
        let title = escaped(&self.title);
        let mut page = format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title><style>{STYLE}</style></head><body>\n<h1>{title}</h1>\n"
        );
        for fact in &self.facts {
            page += &format!("<p>{}</p>\n", escaped(fact));
        }
        page += self.plot;
        page += &self.table();
        page += &self.pictures()?;
        page += "</body></html>\n";
        Ok(page)
    }

    fn table(&self) -> String {
        let table = Table(self.rows);
        let head: String = table.columns().map(|(name, ..)| format!("<th>{name}</th>")).collect();
        let mut text = format!("<table><tr><th>setting</th>{head}</tr>\n");
        for row in self.rows {
            let class = if row.best_of_its_time { " class=\"best\"" } else { "" };
            let cells: String = table
                .columns()
                .map(|(_, digits, value)| format!("<td>{}</td>", cell(value(row), *digits)))
                .collect();
            text += &format!("<tr{class}><td>{}</td>{cells}</tr>\n", escaped(&row.setting));
        }
        text + "</table>\n<p>Bold: no other setting is at once as quick and as near.</p>\n"
    }

    /// Every picture beside its difference, all exposed as the truth is, all differences on one scale.
    fn pictures(&self) -> Result<String, String> {
        let Some(truth) = &self.truth.picture else { return Ok(String::new()) };
        let exposure = Exposure::of(truth, None, Tone::default());
        let shown = |picture: &Picture, caption: &str| -> Result<String, String> {
            Ok(figure(&output::encode_png(picture, &exposure)?, caption))
        };
        let apart: Vec<Picture> =
            self.trials.iter().filter_map(|t| t.answer.picture.as_ref()).map(|p| apart(p, truth)).collect();
        let largest = high(&apart);
        let mut text =
            format!("<h2>Pictures</h2>\n{}\n", shown(truth, &format!("{} (the measure)", self.truth_name))?);
        let pictured =
            self.trials.iter().filter_map(|t| t.answer.picture.as_ref().map(|p| (words(&t.setting), p)));
        for ((setting, picture), apart) in pictured.zip(&apart) {
            let scale = Scale::of(apart, Span::Fixed(0.0, largest), true);
            let drawn = output::draw_false_colour(apart, &scale, "cd/m2")?;
            let caption = format!("{setting}: difference of luminance, up to {largest:.3} cd/m²");
            text += &format!("<div>{}{}</div>\n", shown(picture, &setting)?, figure(&drawn, &caption));
        }
        Ok(text)
    }
}

/// |a − b| of luminance, as a picture of luminance alone \[cd/m²\].
fn apart(a: &Picture, b: &Picture) -> Picture {
    let luminance: Vec<f32> = a.rgb.iter().zip(&b.rgb).map(|(a, b)| (*a - *b).dot(LUMINANCE).abs()).collect();
    let rgb = luminance.iter().map(|&y| Vec3::splat(y)).collect();
    Picture { name: String::new(), rgb, luminance, ..*a }
}

/// What all but a hundredth of all differences stay below; 1 where there are none.
fn high(apart: &[Picture]) -> f32 {
    let mut all: Vec<f32> = apart.iter().flat_map(|picture| picture.luminance.iter().copied()).collect();
    all.sort_unstable_by(f32::total_cmp);
    let largest = all.get(all.len() * 99 / 100).copied().unwrap_or(0.0);
    if largest > 0.0 && largest.is_finite() { largest } else { 1.0 }
}

fn figure(png: &[u8], caption: &str) -> String {
    format!(
        "<figure><img alt=\"\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>",
        STANDARD.encode(png),
        escaped(caption)
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_from_outside_is_text() {
        assert_eq!(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    }
}
