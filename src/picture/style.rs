//! Colours of light and dark viewers, the legend and the scale bar.

use super::sheet::{MARGIN, SHEET_WIDTH, Sheet, escaped, number};
use crate::message::columns;

const STYLE: &str = "\
text{font-family:system-ui,'Segoe UI',Helvetica,Arial,'DejaVu Sans',sans-serif;font-size:12px;fill:#24292f}
.heading{font-size:17px;font-weight:600}
.note,.place{fill:#57606a}
.place{font-size:11px}
.figures{font-size:13px;font-weight:600}
.radius{font-weight:600;fill:#b3261e}
.count{font-size:11px;font-weight:700;fill:#fff;text-anchor:middle}
.annotation{font-size:11px;fill:#8c959f}
.start{font-weight:700;fill:#1a7f37}
.sheet,.void{fill:#fff}
.part{fill:#eef1f4}
.ground{fill:#e3e8ed}
.contour,.aside,.wire,.lead,.fault,.other,.leader,.correction,.spoke,.window{fill:none;stroke-linecap:round;stroke-linejoin:round}
.contour{stroke:#24292f;stroke-width:1.4}
.aside{stroke:#afb8c1;stroke-width:1}
.wire{stroke:#0969da;stroke-width:1.4}
.kerf{fill:none;stroke:#cfe4fb;stroke-linecap:round;stroke-linejoin:round}
.lost{fill:#f2a33a}
.lead{stroke:#0969da;stroke-width:1.2;stroke-dasharray:5 4}
.fault{stroke:#d1242f;stroke-width:3.4}
.other{stroke:#bf8700;stroke-width:3}
.leader,.spoke{stroke:#d1242f;stroke-width:.9}
.fine{display:none}
.correction{stroke:#bf8700;stroke-width:1.5;stroke-dasharray:6 4}
.dot{fill:#bf8700}
.badge{fill:#d1242f}
.window{stroke:#d0d7de}
.thread,.hole{fill:none;stroke:#1a7f37;stroke-width:1.3}
.hole{stroke-width:.9}
.order{font-size:11px;font-weight:700;fill:#1a7f37}
.arrow{fill:#0969da}
.bar{fill:none;stroke:#57606a;stroke-width:1.4}
@media (prefers-color-scheme:dark){
text{fill:#e6edf3}
.note,.place{fill:#9da7b3}
.radius{fill:#ff8a82}
.count{fill:#1a0806}
.annotation{fill:#768390}
.start{fill:#57d364}
.sheet,.void{fill:#0d1117}
.part{fill:#1a2028}
.ground{fill:#252d37}
.contour{stroke:#e6edf3}
.aside{stroke:#484f58}
.wire,.lead{stroke:#58a6ff}
.kerf{stroke:#14365c}
.lost{fill:#9e6a03}
.fault,.leader,.spoke{stroke:#ff6b61}
.other,.correction{stroke:#e3b341}
.dot{fill:#e3b341}
.badge{fill:#ff6b61}
.window{stroke:#30363d}
.thread,.hole{stroke:#57d364}
.order{fill:#57d364}
.arrow{fill:#58a6ff}
.bar{stroke:#9da7b3}
}
";

/// The head of the file: size, title, colours and the ground.
pub(super) fn opening(height: f64, title: &str) -> Sheet {
    let [width, height] = [SHEET_WIDTH, height.ceil()].map(number);
    let title = escaped(title);
    Sheet(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n<rect class=\"sheet\" width=\"{width}\" height=\"{height}\"/>\n"
    ))
}

/// What is shown where there is nothing to draw, and `why`.
pub(super) fn empty(why: &str) -> String {
    let mut sheet = opening(120.0, say!(nothing_to_draw));
    sheet.line(format_args!(
        "<text class=\"note\" x=\"{MARGIN}\" y=\"64\">{why}</text>\n</svg>"
    ));
    sheet.0
}

/// What occurs in a picture.
pub(super) struct Shown {
    pub(crate) faults: bool,
    pub(crate) others: bool,
    pub(crate) paths: bool,
    pub(crate) kerf: bool,
    pub(crate) lost: bool,
}

/// A sample of what is drawn, and what it means.
pub(super) type Entry = (&'static str, &'static str);

pub(super) const WIRE: &str = r#"<path class="wire" d="M0 0h24"/>"#;
pub(super) const LEAD: &str = r#"<path class="lead" d="M0 0h24"/>"#;
pub(super) const THREAD: &str =
    r#"<g class="thread"><circle cx="12" cy="0" r="5"/><path d="M4 0h16M12 -8v16"/></g>"#;

/// What the lines of a drawing mean, as far as they occur.
pub(super) fn entries(shown: &Shown) -> Vec<Entry> {
    let mut entries = vec![(r#"<path class="contour" d="M0 0h24"/>"#, say!(a_contour))];
    if shown.paths {
        entries.extend([
            (WIRE, say!(the_wire)),
            (LEAD, say!(the_lead)),
            (THREAD, say!(thread_hole)),
        ]);
    }
    if shown.kerf {
        let band = r#"<path class="kerf" stroke-width="10" d="M4 0h16"/>"#;
        entries.push((band, say!(what_the_wire_cuts)));
        if shown.lost {
            let area = r#"<rect class="lost" x="4" y="-5" width="16" height="10"/>"#;
            entries.push((area, say!(what_stays_uncut)));
        }
    }
    if shown.faults {
        let tight = r#"<path class="fault" d="M2 4A14 14 0 0 1 22 4"/>"#;
        let correction = r#"<circle class="correction" cx="12" cy="0" r="8"/>"#;
        entries.extend([(tight, say!(too_tight)), (correction, say!(the_correction))]);
    }
    if shown.others {
        let dot = r#"<circle class="dot" cx="16" cy="0" r="4.5"/>"#;
        entries.push((dot, say!(other_finding)));
    }
    entries
}

/// Between two rows of the legend, and what its end leaves free for the scale bar.
const ROW: f64 = 22.0;
const OF_BAR: f64 = 190.0;

/// Where each entry of a legend stands, from its left and from its first row.
fn places(entries: &[Entry]) -> Vec<(f64, f64)> {
    let (mut x, mut y) = (MARGIN, 0.0);
    let place = |(_, text): &Entry| {
        let width = 32.0 + columns(text) as f64 * 6.6 + 22.0;
        if x > MARGIN && x + width > SHEET_WIDTH - OF_BAR {
            (x, y) = (MARGIN, y + ROW);
        }
        let at = (x, y);
        x += width;
        at
    };
    entries.iter().map(place).collect()
}

/// How much a legend needs below its first row.
pub(super) fn height_of_legend(entries: &[Entry]) -> f64 {
    places(entries).last().map_or(0.0, |(_, y)| *y)
}

pub(super) fn legend(sheet: &mut Sheet, top: f64, entries: &[Entry]) {
    for ((sample, text), (x, y)) in entries.iter().zip(places(entries)) {
        let [x, y] = [x, top + 8.0 + y].map(number);
        sheet.line(format_args!(
            r#"<g transform="translate({x} {y})">{sample}<text class="note" x="32" y="4">{text}</text></g>"#
        ));
    }
}

/// A bar of a round length whose right end is at `right`; `scale` is sheet units in 1 mm.
pub(super) fn scale_bar(sheet: &mut Sheet, right: f64, top: f64, scale: f64) {
    let Some(length) = round_length(140.0 / scale) else {
        return;
    };
    let left = right - length * scale;
    let [x, width, middle, y] = [left, length * scale, (left + right) / 2.0, top + 8.0].map(number);
    let length = plain(length);
    sheet.line(format_args!(
        r#"<path class="bar" d="M{x} {y}v8h{width}v-8"/><text class="note" text-anchor="middle" x="{middle}" y="{y}">{length} mm</text>"#
    ));
}

/// The largest of 1, 2, 5 × 10ⁿ that is not above `length`; `None` where there is none.
fn round_length(length: f64) -> Option<f64> {
    let decade = 10f64.powf(length.log10().floor());
    let step = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|step| step * decade <= length)
        .unwrap_or(1.0);
    Some(step * decade).filter(|length| length.is_finite() && *length > 0.0)
}

fn plain(length: f64) -> String {
    if length >= 1e6 {
        format!("{length:e}")
    } else if length >= 1.0 {
        format!("{length:.0}")
    } else {
        format!("{length:.6}").trim_end_matches('0').into()
    }
}
