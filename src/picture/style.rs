//! Colours of light and dark viewers, the legend and the scale bar.

use super::figure::{escaped, number};
use super::{MARGIN, SHEET_WIDTH};
use std::fmt::Write;

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
.lead{stroke:#0969da;stroke-width:1.2;stroke-dasharray:5 4}
.fault{stroke:#d1242f;stroke-width:3.4}
.other{stroke:#bf8700;stroke-width:3}
.leader,.spoke{stroke:#d1242f;stroke-width:.9}
.fine{display:none}
.correction{stroke:#bf8700;stroke-width:1.5;stroke-dasharray:6 4}
.dot{fill:#bf8700}
.badge{fill:#d1242f}
.window{stroke:#d0d7de}
.thread{fill:none;stroke:#1a7f37;stroke-width:1.3}
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
.fault,.leader,.spoke{stroke:#ff6b61}
.other,.correction{stroke:#e3b341}
.dot{fill:#e3b341}
.badge{fill:#ff6b61}
.window{stroke:#30363d}
.thread{stroke:#57d364}
.arrow{fill:#58a6ff}
.bar{stroke:#9da7b3}
}
";

/// The head of the file: size, title, colours and the ground.
pub(super) fn opening(width: f64, height: f64, title: &str) -> String {
    let (width, height) = (number(width), number(height.ceil()));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n<rect class=\"sheet\" width=\"{width}\" height=\"{height}\"/>\n",
        escaped(title)
    )
}

/// What is shown of a drawing without geometry.
pub(super) fn empty_sheet() -> String {
    let mut sheet = opening(SHEET_WIDTH, 120.0, "Nothing to draw");
    let _ = writeln!(
        sheet,
        r#"<text class="note" x="{MARGIN}" y="64">the drawing has no lines, arcs or circles</text>"#
    );
    sheet.push_str("</svg>\n");
    sheet
}

/// What is shown of a program that moves nothing.
pub(super) fn empty_program() -> String {
    let mut sheet = opening(SHEET_WIDTH, 120.0, "Nothing to draw");
    let _ = writeln!(
        sheet,
        r#"<text class="note" x="{MARGIN}" y="64">the program moves nothing</text>"#
    );
    sheet.push_str("</svg>\n");
    sheet
}

/// What the lines of a program mean, as far as they occur.
pub(super) fn program_legend(sheet: &mut String, top: f64, has_ways: bool, has_faults: bool) {
    let mut entries = vec![
        (r#"<path class="wire" d="M0 0h24"/>"#, "wire"),
        (
            r#"<g class="thread"><circle cx="12" cy="0" r="5"/><path d="M4 0h16M12 -8v16"/></g>"#,
            "start of a contour",
        ),
    ];
    if has_ways {
        entries.push((r#"<path class="lead" d="M0 0h24"/>"#, "way without a cut"));
    }
    if has_faults {
        entries.push((r#"<path class="fault" d="M0 0h24"/>"#, "error"));
        entries.push((r#"<path class="other" d="M0 0h24"/>"#, "warning"));
    }
    let mut x = MARGIN;
    let _ = writeln!(sheet, r#"<g class="chrome">"#);
    for (sample, text) in entries {
        let (left, y) = (number(x), number(top + 8.0));
        let _ = writeln!(
            sheet,
            r#"<g transform="translate({left} {y})">{sample}<text class="note" x="32" y="4">{text}</text></g>"#
        );
        x += 32.0 + text.chars().count() as f64 * 6.6 + 22.0;
    }
    sheet.push_str("</g>\n");
}

/// What occurs in a picture.
pub(super) struct Shown {
    pub faults: bool,
    pub others: bool,
    pub paths: bool,
}

/// What the lines mean, as far as they occur.
pub(super) fn legend(sheet: &mut String, top: f64, shown: Shown) {
    let y = top + 8.0;
    let mut x = MARGIN;
    let mut entry = |sample: &str, text: &str| {
        let _ = writeln!(
            sheet,
            r#"<g transform="translate({} {})">{sample}<text class="note" x="32" y="4">{}</text></g>"#,
            number(x),
            number(y),
            escaped(text)
        );
        x += 32.0 + text.chars().count() as f64 * 6.6 + 22.0;
    };
    entry(r#"<path class="contour" d="M0 0h24"/>"#, "contour");
    if shown.paths {
        entry(r#"<path class="wire" d="M0 0h24"/>"#, "wire");
        entry(r#"<path class="lead" d="M0 0h24"/>"#, "lead");
        entry(
            r#"<g class="thread"><circle cx="12" cy="0" r="5"/><path d="M4 0h16M12 -8v16"/></g>"#,
            "thread hole",
        );
    }
    if shown.faults {
        entry(
            r#"<path class="fault" d="M2 4A14 14 0 0 1 22 4"/>"#,
            "too tight",
        );
        entry(
            r#"<circle class="correction" cx="12" cy="0" r="8"/>"#,
            "correction",
        );
    }
    if shown.others {
        entry(
            r#"<circle class="dot" cx="16" cy="0" r="4.5"/>"#,
            "other finding",
        );
    }
}

/// A bar of a round length whose right end is at `right`; `scale` is sheet units in 1 mm.
pub(super) fn scale_bar(sheet: &mut String, right: f64, top: f64, scale: f64) {
    let Some(length) = round_length(140.0 / scale) else {
        return;
    };
    let (left, y) = (right - length * scale, top + 8.0);
    let _ = writeln!(
        sheet,
        r#"<path class="bar" d="M{} {}v8h{}v-8"/><text class="note" text-anchor="middle" x="{}" y="{}">{} mm</text>"#,
        number(left),
        number(y),
        number(length * scale),
        number((left + right) / 2.0),
        number(y),
        plain(length)
    );
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
