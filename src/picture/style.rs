//! Colours of light and dark viewers, the legend and the scale bar.

use super::numbers::number;
use super::sheet::{MARGIN, SHEET_WIDTH, Sheet, escaped};
use crate::finding::Severity;
use crate::message::columns;
use std::collections::BTreeSet;

const STYLE: &str = "\
text{font-family:system-ui,'Segoe UI',Helvetica,Arial,'DejaVu Sans',sans-serif;font-size:12px;fill:#24292f}
.heading{font-size:17px;font-weight:600}
.note,.place{fill:#57606a}
.place{font-size:11px}
.figures{font-size:13px;font-weight:600}
.radius{font-weight:600}
.count{font-size:11px;font-weight:700;fill:#fff;text-anchor:middle}
.annotation{font-size:11px;fill:#8c959f}
.start,.order{font-weight:700;fill:#1a7f37}
.sheet{fill:#fff}
.part{fill:#dfe5ec}
.void{fill:#fff}
.ground{fill:#dfe5ec}
.contour,.aside,.wire,.lead,.jump,.fault,.other,.leader,.correction,.spoke,.window{fill:none;stroke-linecap:round;stroke-linejoin:round}
.contour{stroke:#24292f;stroke-width:1.4}
.aside{stroke:#afb8c1;stroke-width:1}
.wire{stroke:#0969da;stroke-width:1.4}
.wire.tab{stroke:#bf3989;stroke-width:2.4}
.upper{fill:none;stroke:#8250df;stroke-width:1.2}
.kerf{fill:none;stroke:#cfe4fb;stroke-linecap:round;stroke-linejoin:round}
.lost{fill:#f2a33a}
.lead{stroke:#0969da;stroke-width:1.2;stroke-dasharray:5 4}
.lead.back{stroke:none}
.jump{stroke:#57606a;stroke-width:.7;stroke-dasharray:8 4}
.fault{stroke-width:3.4}
.other{stroke-width:3}
.leader,.spoke{stroke-width:.9}
.fine{display:none}
.correction{stroke:#57606a;stroke-width:1.5;stroke-dasharray:6 4}
.middle{fill:#57606a}
.window{stroke:#d0d7de}
.datum{fill:none;stroke:#8250df;stroke-width:1.6}
.thread,.hole{fill:none;stroke:#1a7f37;stroke-width:1.3}
.hole{stroke-width:.9}
.order{font-size:11px;font-weight:700;fill:#1a7f37}
.arrow{fill:#0969da}
.bar{fill:none;stroke:#57606a;stroke-width:1.4}
.badge,.dot{fill:#cf222e}
.dot.warning,.dot.remark,.dot.hint{fill:none;stroke-width:1.3}
.other.remark,.other.hint{stroke-width:4;stroke-opacity:.45}
.small{font-size:10px;text-anchor:middle}
.electrode{fill:#8250df;fill-opacity:.18;stroke:#8250df;stroke-width:1}
";

const DARK: &str = "\
text{fill:#e6edf3}
.note,.place{fill:#9da7b3}
.count{fill:#1a0806}
.annotation{fill:#768390}
.start,.order{fill:#57d364}
.sheet,.void{fill:#0d1117}
.part,.ground{fill:#262f3a}
.contour{stroke:#e6edf3}
.aside{stroke:#484f58}
.wire,.lead{stroke:#58a6ff}
.wire.tab{stroke:#f778ba}
.upper{stroke:#bc8cff}
.kerf{stroke:#14365c}
.lost{fill:#9e6a03}
.jump,.correction{stroke:#9da7b3}
.middle{fill:#9da7b3}
.window{stroke:#30363d}
.datum{stroke:#bc8cff}
.thread,.hole{stroke:#57d364}
.order{fill:#57d364}
.arrow{fill:#58a6ff}
.bar{stroke:#9da7b3}
.badge,.dot{fill:#ff6b61}
.electrode{fill:#bc8cff;stroke:#bc8cff}
";

/// The start and end of the dark colours in the style.
const DARK_BEGINS: &str = "@media (prefers-color-scheme:dark){\n";
const DARK_ENDS: &str = "}\n</style>";

/// Class of each severity, and its colour in light and in dark viewers.
const SEVERITIES: [(Severity, &str, &str, &str); 4] = [
    (Severity::Error, "error", "#cf222e", "#ff6b61"),
    (Severity::Warning, "warning", "#b26a00", "#e3b341"),
    (Severity::Information, "remark", "#8250df", "#b392f0"),
    (Severity::Hint, "hint", "#8c959f", "#6e7681"),
];

/// The class that colours everything about a finding of a severity.
pub(super) fn class_of(severity: Severity) -> &'static str {
    let of = |it: &&(Severity, &'static str, _, _)| it.0 == severity;
    SEVERITIES.iter().find(of).map_or("hint", |it| it.1)
}

fn in_colour(class: &str, colour: &str) -> String {
    format!(
        ".{class} .leader,.{class} .spoke,.fault.{class},.other.{class},.dot.{class}{{stroke:{colour}}}\n\
         .{class} .badge,.{class} .radius,.alert.{class}{{fill:{colour}}}\n"
    )
}

fn style() -> String {
    let of = |dark: bool| {
        let line =
            |it: &(Severity, &str, &str, &str)| in_colour(it.1, if dark { it.3 } else { it.2 });
        SEVERITIES.iter().map(line).collect::<String>()
    };
    let (light, dark) = (of(false), of(true));
    format!("{STYLE}{light}{DARK_BEGINS}{DARK}{dark}")
}

/// The picture without the dark colours, for programs that cannot tell when to use them.
pub(super) fn without_dark(svg: &str) -> String {
    let dark = svg.split_once(DARK_BEGINS);
    match dark.and_then(|(before, rest)| Some((before, rest.split_once(DARK_ENDS)?.1))) {
        Some((before, behind)) => format!("{before}</style>{behind}"),
        None => svg.into(),
    }
}

/// The head of the file: size, title, colours and the background.
pub(super) fn opening(height: f64, title: &str) -> Sheet {
    let [width, height] = [SHEET_WIDTH, height.ceil()].map(number);
    let (title, style) = (escaped(title), style());
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\">\n\
         <title>{title}</title>\n<style>\n{style}{DARK_ENDS}\n<rect class=\"sheet\" width=\"{width}\" height=\"{height}\"/>\n"
    );
    Sheet { text, pieces: None }
}

/// The picture where there is nothing to draw, and `why`.
pub(super) fn empty(why: &str) -> Sheet {
    let mut sheet = opening(120.0, say!(nothing_to_draw));
    sheet.line(format_args!(
        "<text class=\"note\" x=\"{MARGIN}\" y=\"64\">{why}</text>\n</svg>"
    ));
    sheet
}

/// The kinds of marks in a picture.
#[derive(Default)]
pub(super) struct Shown {
    pub(crate) part: bool,
    pub(crate) faults: bool,
    pub(crate) severities: BTreeSet<Severity>,
    pub(crate) paths: bool,
    /// The paths are those of an electrode, which needs no thread hole.
    pub(crate) mills: bool,
    pub(crate) kerf: bool,
    pub(crate) lost: bool,
    pub(crate) jumps: bool,
    pub(crate) tabs: bool,
    pub(crate) zero: bool,
}

/// A sample of a mark, and its meaning.
pub(super) type Entry = (&'static str, &'static str);

pub(super) const WIRE: &str = r#"<path class="wire" d="M0 0h24"/>"#;
pub(super) const LEAD: &str = r#"<path class="lead" d="M0 0h24"/>"#;
pub(super) const THREAD: &str =
    r#"<g class="thread"><circle cx="12" cy="0" r="5"/><path d="M4 0h16M12 -8v16"/></g>"#;

const ELECTRODE: &str = r#"<circle class="electrode" cx="12" cy="0" r="7"/>"#;

pub(super) const JUMP: &str = r#"<path class="jump" d="M0 0h24"/>"#;

/// The legend for the kinds of lines that occur in the drawing.
pub(super) fn entries(shown: &Shown) -> Vec<Entry> {
    let mut entries = vec![(r#"<path class="contour" d="M0 0h24"/>"#, say!(a_contour))];
    if shown.part {
        let part = r#"<rect class="part" x="2" y="-7" width="20" height="14" rx="2"/>"#;
        entries.push((part, say!(the_material)));
    }
    if shown.zero {
        let zero = r#"<path class="datum" d="M0 4h24M6 8v-16"/>"#;
        entries.push((zero, say!(the_zero)));
    }
    if shown.paths && shown.mills {
        entries.extend([
            (WIRE, say!(the_electrode)),
            (ELECTRODE, say!(start_of_a_contour)),
        ]);
    } else if shown.paths {
        entries.extend([
            (WIRE, say!(the_wire)),
            (LEAD, say!(the_lead)),
            (THREAD, say!(thread_hole)),
        ]);
    }
    if shown.tabs {
        let tab = r#"<path class="wire tab" d="M0 0h24"/>"#;
        entries.push((tab, say!(the_tab)));
    }
    if shown.jumps {
        entries.push((JUMP, say!(the_jump)));
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
        let correction = r#"<circle class="correction" cx="12" cy="0" r="8"/>"#;
        entries.push((correction, say!(the_correction)));
    }
    entries.extend(
        shown
            .severities
            .iter()
            .map(|&severity| of_severity(severity)),
    );
    entries
}

/// The appearance of a severity's findings.
pub(super) fn of_severity(severity: Severity) -> Entry {
    match severity {
        Severity::Error => (r#"<path class="fault error" d="M0 0h24"/>"#, say!(error)),
        Severity::Warning => (
            r#"<path class="other warning" d="M0 0h24"/>"#,
            say!(warning),
        ),
        Severity::Information => (
            r#"<path class="other remark" d="M0 0h24"/>"#,
            say!(information),
        ),
        Severity::Hint => (r#"<path class="other hint" d="M0 0h24"/>"#, say!(hint)),
    }
}

/// Height of a row of the legend.
const ROW: f64 = 22.0;
/// The width without the scale bar.
const LEGEND_WIDTH: f64 = SHEET_WIDTH - MARGIN - 180.0;

/// The place of each entry: from the left, and in which row.
fn places(entries: &[Entry]) -> Vec<(f64, usize)> {
    let (mut x, mut row) = (MARGIN, 0);
    let place = |(_, text): &Entry| {
        let width = 32.0 + columns(text) as f64 * 6.6 + 18.0;
        if x + width > LEGEND_WIDTH && x > MARGIN {
            (x, row) = (MARGIN, row + 1);
        }
        let place = (x, row);
        x += width;
        place
    };
    entries.iter().map(place).collect()
}

/// Height of the foot of the sheet with this legend.
pub(super) fn height_of(entries: &[Entry]) -> f64 {
    let rows = places(entries).last().map_or(0, |place| place.1);
    48.0 + rows as f64 * ROW
}

pub(super) fn legend(sheet: &mut Sheet, top: f64, entries: &[Entry]) {
    for ((sample, text), (x, row)) in entries.iter().zip(places(entries)) {
        let [x, y] = [x, top + 8.0 + row as f64 * ROW].map(number);
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
