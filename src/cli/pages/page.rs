//! The content of a drawing's page, and of the index.

use super::super::contours;
use super::super::files::Opened;
use super::super::report::{self, Row};
use super::super::{Failure, output};
use super::INDEX;
use super::head::{extents, head, stem_of, titled};
use super::html::{self, Cell, cell, more, number, section, table, text};
use super::index::{Line, counts, span};
use super::job as of_job;
use super::share::PageShare;
use crate::document::Snapshot;
use crate::finding::{Finding, Rule, Severity};
use crate::job::{self, Wanted};
use crate::message::spoken;
use crate::picture::mark_numbers;
use crate::program::Format;
use crate::protocol::{Contours, Fit, Inspection, Milling, SegmentKind};
use crate::settings::Effective;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::Arc;

/// The most arcs of the radius list, and findings of one rule, on a page: other commands list them all.
const MOST_ARCS: usize = 100;
const MOST_OF_A_RULE: usize = 50;
const MOST_CONTOURS: usize = 500;
/// The most bytes of a picture: no browser shows more at ease.
const LARGEST_PICTURE: usize = 4 * 1024 * 1024;
/// The same for milled contours.
const MOST_MILLED: usize = 500;

/// The content of a page.
pub(super) struct Page {
    /// Its line of the index.
    pub(super) line: Line,
    unit_mm: f64,
    title: String,
    /// The fields of the head, by their names.
    head: Vec<(&'static str, String)>,
    /// The version, and what decides where the wire runs.
    made_with: String,
    /// Where the contours lie.
    extents: String,
    picture: String,
    contours: Contours,
    arcs: Vec<ListedArc>,
    /// What small radii cost, where the shop's wires are known.
    prices: String,
    /// Findings, each with the number of its mark in the picture.
    rows: Vec<(Option<usize>, Row)>,
    /// The parts of a pair; else all as one.
    parts: Vec<PageShare>,
    /// The fit, if a clearance is set, or why it is unknown.
    fit: Option<Result<Fit, String>>,
    /// The layers of an electrode, and their results.
    milling: Vec<String>,
    format: Format,
}

/// An arc of the radius list.
struct ListedArc {
    handle: String,
    segment: usize,
    radius_mm: f64,
    degrees: f64,
    verdict: String,
}

/// A row of the findings, with the number of its mark in the picture.
type Marked<'a> = &'a (Option<usize>, Row);

impl Page {
    pub(super) fn of(mut opened: Opened, format: Format) -> Result<Page, Failure> {
        // Where a wire is set, too, a page of milling is about the electrode alone.
        if format == Format::Milling
            && let Ok(milled) = opened.document.settings().milled()
        {
            opened.document.set_settings(Arc::new(milled));
        }
        let snapshot = opened.snapshot()?;
        // The marks of the picture have the numbers of the list.
        let (listed, _) = job::check(&mut opened.document, report::MOST);
        let numbers = mark_numbers(&listed);
        let unit_mm = opened.document.unit_mm();
        let findings = opened.document.all_findings();
        let (cuts, picture) = job::picture(&snapshot, &listed, &());
        let arcs = arcs_of(Inspection::of(&opened.document, None), unit_mm);
        let wanted = Wanted {
            format,
            handles: None,
            layers: None,
            force: false,
        };
        let telling = opened.document.telling();
        let parts = PageShare::all(&snapshot, cuts, &findings, &wanted, telling);
        let warnings = parts.iter().filter_map(|part| part.program.as_ref().ok());
        let warnings: Vec<Finding> = warnings.flat_map(|made| made.warnings.clone()).collect();
        let of_findings =
            |findings: &[Finding]| report::rows_of(&opened.path, &opened.document, findings);
        let mut rows: Vec<(Option<usize>, Row)> =
            numbers.into_iter().zip(of_findings(&listed)).collect();
        for row in opened
            .settings_rows
            .iter()
            .cloned()
            .chain(of_findings(&warnings))
        {
            let is_known =
                |(_, known): &(_, Row)| (known.rule, &known.message) == (row.rule, &row.message);
            if !rows.iter().any(is_known) {
                rows.push((None, row));
            }
        }
        let count = |severity| {
            rows.iter()
                .map(|(_, row)| row)
                .filter(|row| row.severity == severity)
                .count()
        };
        let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
        let Snapshot {
            drawing,
            outlines,
            settings,
            ..
        } = &snapshot;
        let made = || parts.iter().filter_map(|part| part.program.as_ref().ok());
        let mut milled = made().filter_map(|made| made.program.milled.as_ref());
        let milling = milled.next();
        let milling = milling.map(|milled| Milling::new(&snapshot, milled).told(MOST_MILLED));
        let refusal = parts.iter().find_map(PageShare::refusal).map(str::to_owned);
        let missing = parts.iter().filter_map(|part| part.work.as_ref());
        let mut missing: Vec<String> = missing.flat_map(|work| work.missing.clone()).collect();
        missing.dedup();
        missing.retain(|key| ["job.thickness", "passes.rates"].contains(&key.as_str()));
        let minutes = |part: &PageShare| part.work.as_ref()?.minutes;
        // Of a pair whose parts do not all have a program no sum is told.
        let blocks: Option<usize> = parts.iter().map(|part| part.blocks()).sum();
        Ok(Page {
            line: Line {
                minutes: parts.iter().map(minutes).sum(),
                name: output::name(&opened.path),
                contours: outlines.len(),
                smallest_mm: arcs.first().map(|arc| arc.radius_mm),
                errors,
                warnings,
                notes: rows.len() - errors - warnings,
                blocks,
                refusal,
                missing,
            },
            unit_mm,
            head: head(settings, format, &opened.path),
            title: titled(settings, &opened.path),
            made_with: made_with(settings, format),
            extents: extents(&snapshot),
            picture,
            contours: Contours::new(drawing, outlines, settings),
            arcs,
            prices: of_job::prices(&snapshot),
            rows,
            fit: of_job::fit(&opened.document, &snapshot, unit_mm),
            milling: milling.unwrap_or_default(),
            parts,
            format,
        })
    }

    pub(super) fn has_errors(&self) -> bool {
        self.line.errors > 0
    }

    /// `is_among` where an index beside it lists all pages.
    pub(super) fn html(&self, is_among: bool) -> String {
        let index = match is_among {
            true => format!(
                "<span class=\"screen\"> · <a href=\"{INDEX}\">{}</a></span>",
                text(say!(all_drawings))
            ),
            false => String::new(),
        };
        let (name, stem) = (&self.line.name, stem_of(&self.line.name));
        let parts = [
            format!(
                "<h1>{}</h1>\n{}{}<p class=\"faint\">{}{index}</p>\n",
                text(&self.title),
                self.verdict(),
                html::fields(&self.head),
                text(&self.made_with),
            ),
            self.picture(),
            of_job::facts(std::slice::from_ref(&self.extents)),
            section(say!(head_findings), self.findings()),
            self.of_all(|part| part.way(self.format, self.unit_mm)),
            section(
                say!(head_fit),
                self.fit.as_ref().map(of_job::fit_part).unwrap_or_default(),
            ),
            section(say!(head_milling), of_job::facts(&self.milling)),
            section(say!(head_contours), self.contour_table()),
            section(say!(head_radius_list), self.radius_list()),
            section(say!(head_prices), self.prices.clone()),
            self.of_all(|part| part.text(self.format, self.unit_mm, &stem)),
            self.parts
                .iter()
                .map(|part| part.of_part(self.format, self.unit_mm, &stem))
                .collect(),
        ];
        let title = match self.title == *name {
            true => name.clone(),
            false => format!("{} · {name}", self.title),
        };
        html::page(spoken().tag(), &title, &parts.concat())
    }

    /// What all sections below come to.
    fn verdict(&self) -> String {
        let does_not_fit = |fit: &Result<Fit, String>| !fit.as_ref().is_ok_and(|fit| fit.fits);
        let fails = [
            self.line.refusal.is_some().then(|| say!(no_program)),
            self.fit
                .as_ref()
                .is_some_and(does_not_fit)
                .then(|| say!(do_not_fit)),
        ];
        let fails: Vec<&str> = fails.into_iter().flatten().collect();
        let (class, verdict) = if self.line.errors > 0 || !fails.is_empty() {
            ("error", say!(not_ready_to_be_cut))
        } else if self.line.warnings > 0 {
            ("warning", say!(to_be_looked_at_before_the_cut))
        } else {
            ("good", say!(ready_to_be_cut))
        };
        let all = [verdict].into_iter().chain(fails);
        let all: Vec<String> = all
            .map(|one| span(class, one))
            .chain([counts(&self.line)])
            .collect();
        format!("<p class=\"verdict\">{}</p>\n", all.join(" · "))
    }

    /// A section of a drawing that is no pair. The parts of a pair have theirs after all other sections.
    fn of_all(&self, html: impl Fn(&PageShare) -> String) -> String {
        let all = self.parts.iter().filter(|part| !part.is_part());
        all.map(html).collect()
    }

    /// The picture, unless no page could hold it.
    fn picture(&self) -> String {
        match self.picture.len() {
            0..=LARGEST_PICTURE => self.picture.clone(),
            _ => {
                let sentence = say!(
                    the_picture_is_too_large,
                    output::word(Path::new(&self.line.name))
                );
                format!("<p class=\"faint\">{}</p>\n", text(sentence))
            }
        }
    }

    fn contour_table(&self) -> String {
        let heads = [
            say!(column_number),
            say!(column_contour),
            say!(column_kind),
            say!(column_role),
            say!(column_length),
            say!(column_area),
            say!(column_order),
        ];
        let row = |(index, contour): (usize, &crate::protocol::ContoursContour)| {
            let kind = if contour.closed {
                say!(closed)
            } else {
                say!(open)
            };
            let role = contours::role(contour.role);
            let area = contour
                .area
                .map(|area| format!("{:.3}", area * self.unit_mm * self.unit_mm));
            let order = contour.order.map(|order| (order + 1).to_string());
            vec![
                number(index + 1),
                cell(contour.segments.first().map_or("", |first| &first.handle)),
                cell(kind),
                cell(role),
                number(format!("{:.3}", contour.length * self.unit_mm)),
                number(area.unwrap_or_default()),
                number(order.unwrap_or_default()),
            ]
        };
        let contours = &self.contours.contours;
        let shown = contours.iter().enumerate().take(MOST_CONTOURS);
        table(&heads, shown.map(row)) + &more(contours.len(), MOST_CONTOURS)
    }

    fn findings(&self) -> String {
        let mut by_rule: BTreeMap<(Severity, Rule), Vec<Marked<'_>>> = BTreeMap::new();
        for numbered in &self.rows {
            let (_, row) = numbered;
            by_rule
                .entry((row.severity, row.rule))
                .or_default()
                .push(numbered);
        }
        let group = |(severity, rule): (Severity, Rule), rows: Vec<Marked<'_>>| {
            let shown = rows.iter().take(MOST_OF_A_RULE).map(|(mark, row)| {
                let place = row.whereabouts().unwrap_or_default();
                let mark = mark.map(|mark| mark.to_string()).unwrap_or_default();
                vec![number(mark), cell(&row.message), cell(place)]
            });
            let head = span(
                class_of(severity),
                format!("{} · {}", rule.name(), rows.len()),
            );
            let more = more(rows.len(), MOST_OF_A_RULE);
            let table = table(
                &[say!(column_number), say!(column_found), say!(column_place)],
                shown,
            );
            format!("<h3>{head}</h3>\n{table}{more}")
        };
        by_rule
            .into_iter()
            .map(|(of_rule, rows)| group(of_rule, rows))
            .collect()
    }

    fn radius_list(&self) -> String {
        let heads = [
            "R mm",
            say!(column_turn),
            say!(column_entity),
            say!(column_segment),
            say!(column_verdict),
        ];
        let severities: HashMap<(&str, usize, &str), Severity> = self
            .rows
            .iter()
            .filter_map(|(_, row)| {
                let data = &row.data;
                let place = (data.handle.as_deref()?, data.segment?, row.rule.name());
                Some((place, row.severity))
            })
            .collect();
        let row = |arc: &ListedArc| {
            let verdict: Cell = match arc.verdict.as_str() {
                "ok" => ("good", "ok".into()),
                verdict => {
                    let found = severities.get(&(arc.handle.as_str(), arc.segment, verdict));
                    (found.copied().map_or("error", class_of), text(verdict))
                }
            };
            vec![
                number(format!("{:.4}", arc.radius_mm)),
                number(format!("{:.1}", arc.degrees)),
                cell(&arc.handle),
                number(arc.segment),
                verdict,
            ]
        };
        let (ok, others): (Vec<&ListedArc>, Vec<&ListedArc>) =
            self.arcs.iter().partition(|arc| arc.verdict == "ok");
        let listed = |arcs: &[&ListedArc]| {
            let shown = arcs.iter().take(MOST_ARCS).map(|arc| row(arc));
            table(&heads, shown) + &more(arcs.len(), MOST_ARCS)
        };
        let summary = match ok.first() {
            Some(smallest) => say!(arcs_that_are_ok, say!(arcs, ok.len()), smallest.radius_mm),
            None => String::new(),
        };
        listed(&others) + &html::folded(&summary, &listed(&ok))
    }
}

/// The version that made a page, and the settings that decide where the wire runs.
fn made_with(settings: &Effective, format: Format) -> String {
    let parts = [
        Some(format!("wedm {}", env!("CARGO_PKG_VERSION"))),
        settings.wire_diameter.map(|mm| say!(wire_of_mm, mm)),
        settings.gap.map(|mm| say!(gap_of_mm, mm)),
        (format == Format::Iso).then(|| say!(profile_of_name, settings.profile_name)),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}

/// Every arc, the smallest first.
fn arcs_of(inspection: Option<Inspection>, unit_mm: f64) -> Vec<ListedArc> {
    let entities = inspection.map(|inspection| inspection.entities);
    let mut arcs: Vec<ListedArc> = Vec::new();
    for entity in entities.into_iter().flatten().filter(|entity| entity.cut) {
        let of_entity = entity.segments.into_iter().filter_map(|segment| {
            let radius = segment.shape.radius?;
            (segment.shape.kind != SegmentKind::Line).then(|| ListedArc {
                handle: entity.handle.clone(),
                segment: segment.index,
                radius_mm: radius * unit_mm,
                degrees: segment.shape.sweep.map_or(360.0, f64::abs),
                verdict: segment.verdict,
            })
        });
        arcs.extend(of_entity);
    }
    arcs.sort_by(|one, other| one.radius_mm.total_cmp(&other.radius_mm));
    arcs
}

fn class_of(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Information | Severity::Hint => "faint",
    }
}
