//! The settings of tabs, overlaps, thread holes, entries and steps, checked against the contours while they are drawn.

use super::job::Job;
use super::leads::finding;
use super::milling::swept_length;
use super::standing::holds;
use super::{Refusal, StartHole, WirePath, lengths, plan};
use crate::drawing::{Drawing, Outline};
use crate::finding::{Finding, Place, Rule, Severity};
use crate::geometry::Segment;
use crate::settings::{Compensation, Effective, Electrode, LengthSetting};

/// A lead of up to this many mm is usual, however small the part.
const USUAL_LEAD: f64 = 3.0;

/// In drawings of more segments these are only reported when a path is requested.
const MOST_SEGMENTS: usize = 2_000;

/// The obstacles to a path under the settings, for the contours whose side is known.
pub(crate) fn stated_faults(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
) -> Vec<Finding> {
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    if segments > MOST_SEGMENTS {
        return Vec::new();
    }
    let milled = match settings.mills {
        true => settings.milled().ok(),
        false => None,
    };
    let settings = milled.as_ref().unwrap_or(settings);
    let is_known = |outline: &&Outline| {
        outline.contour.double_of.is_none()
            && (outline.wire_side().is_some() || settings.runs_on(outline))
    };
    let firsts = outlines.iter().filter(is_known).filter_map(|outline| {
        let first = outline.contour.pieces.first()?;
        Some(drawing.get(first.entity)?.handle.to_string())
    });
    let handles: Vec<String> = firsts.collect();
    if handles.is_empty() {
        return Vec::new();
    }
    match plan(drawing, outlines, settings, Some(&handles)) {
        Ok(paths) => {
            let job = Job::of(drawing, outlines, settings);
            let mut found = job.short_layers(&paths);
            found.extend(job.worn_layers(&paths));
            let of_tabs = holds(drawing, outlines, settings, &paths).into_iter();
            found.extend(of_tabs.filter(|one| one.severity <= Severity::Warning));
            found.extend(long_leads(drawing, outlines, settings, &paths));
            found
        }
        Err(Refusal::Findings(mut found)) => {
            found.retain(|found| found.rule == Rule::LeadIn);
            found
        }
        Err(Refusal::Sentence(sentence)) => {
            let severity = settings.severity_over(Rule::Settings, Severity::Warning);
            let said = severity.map(|own| finding(Rule::Settings, own, None, sentence, None));
            said.into_iter().collect()
        }
        Err(Refusal::Cancelled) => Vec::new(),
    }
}

/// Whether the settings give more of a path than its side.
pub(crate) fn is_stated(settings: &Effective) -> bool {
    if settings.compensation == Compensation::None {
        return false;
    }
    if settings.mills {
        let wears = settings.milling.wear.is_some_and(|wear| wear > 0.0);
        return wears || settings.milling.step.is_some();
    }
    let keeps_tabs = match &settings.tab {
        LengthSetting::One(length) => *length > 0.0,
        LengthSetting::ByHandle(lengths) => !lengths.is_empty(),
    };
    let mut own = settings.own.values();
    keeps_tabs
        || settings.closing_overlap > 0.0
        || settings.thread.is_some()
        || settings.entry.is_some()
        || own.any(|own| own.thread.is_some() || own.entry.is_some())
}

/// The leads that are shorter than their setting for lack of room.
pub(crate) fn shortened_leads(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
    holes: &[StartHole],
) -> Vec<Finding> {
    let Some(wanted) = settings.stated_lead_in else {
        return Vec::new();
    };
    let job = Job::of(drawing, outlines, settings);
    let firsts = paths.iter().filter(|path| path.is_first());
    let shortened = firsts.zip(holes).filter_map(|(path, hole)| {
        let mut pieces = path.segments.iter();
        let begin = pieces.find(|piece| piece.source.place().is_some())?;
        // Where the control offsets, the lead ends at the contour, and is that much longer.
        let beside = if path.side.is_some() {
            settings.correction
        } else {
            0.0
        };
        let length = (begin.geometry.start() - hole.at).norm() * job.unit_mm - beside;
        // A wire that only stands, or that has no room beside its path, has no lead.
        let is_shortened = !hole.is_given && length > 0.0 && length < 0.9 * wanted;
        let severity = settings.severity_over(Rule::LeadIn, Severity::Warning)?;
        let sentence = || {
            say!(
                the_lead_is_shortened,
                job.name(path.outline),
                wanted,
                length
            )
        };
        let place = begin.source.place();
        is_shortened.then(|| finding(Rule::LeadIn, severity, place, sentence(), None))
    });
    shortened.collect()
}

/// The leads that are longer than the part that they lead to: a thread hole in another unit, or one of another part.
pub(crate) fn long_leads(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
) -> Vec<Finding> {
    let Some(severity) = settings.severity_over(Rule::LeadIn, Severity::Warning) else {
        return Vec::new();
    };
    let job = Job::of(drawing, outlines, settings);
    let long = paths
        .iter()
        .filter(|path| path.is_first())
        .filter_map(|path| {
            let mut pieces = path.segments.iter();
            let begin = pieces.find(|piece| piece.source.place().is_some())?;
            let thread = path.segments.first()?.geometry.start();
            let length = (begin.geometry.start() - thread).norm() * job.unit_mm;
            let bounds = outlines.get(path.outline)?.contour.bounds(drawing);
            let size = bounds.width().max(bounds.height()) * job.unit_mm;
            let is_long = length > size.max(USUAL_LEAD);
            let sentence = || {
                say!(
                    the_lead_is_longer_than_the_part,
                    job.name(path.outline),
                    length,
                    size
                )
            };
            let place = begin.source.place();
            is_long.then(|| finding(Rule::LeadIn, severity, place, sentence(), None))
        });
    long.collect()
}

/// The contours with a layer that is shorter than the step of linear compensation.
pub(crate) fn short_layers(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    paths: &[WirePath],
) -> Vec<Finding> {
    Job::of(drawing, outlines, settings).short_layers(paths)
}

/// A finding for a path of this many mm, by the electrode that mills it.
type Said<'a> = &'a dyn Fn(&Electrode, &WirePath, f64) -> Option<(Severity, String)>;

impl Job<'_> {
    fn short_layers(&self, paths: &[WirePath]) -> Vec<Finding> {
        self.of_layers(paths, &|electrode, _, length| {
            let sentence = || say!(the_step_is_longer, electrode.step, length);
            (electrode.step > length).then(|| (Severity::Error, sentence()))
        })
    }

    /// The contours along which the electrode loses more than a layer in each layer.
    fn worn_layers(&self, paths: &[WirePath]) -> Vec<Finding> {
        self.of_layers(paths, &|electrode, path, _| {
            let pieces: Vec<Segment> = path.segments.iter().map(|it| it.geometry).collect();
            let is_closed = path.counter_clockwise.is_some();
            let width = self.units(electrode.width());
            let swept = swept_length(&pieces, is_closed, width) * self.unit_mm;
            let wear = electrode.wear_of_layer(swept, is_closed);
            let severity = self
                .settings
                .severity_over(Rule::Settings, Severity::Warning)?;
            (wear > 1.0).then(|| (severity, say!(the_electrode_wears_more_than_a_layer, wear)))
        })
    }

    /// Findings for paths, by the electrode that mills them.
    fn of_layers(&self, paths: &[WirePath], said: Said) -> Vec<Finding> {
        let electrode = self.settings.electrode().ok();
        let Some(electrode) = electrode.filter(|_| self.settings.mills) else {
            return Vec::new();
        };
        let of_path = |path: &WirePath| {
            let length = lengths(std::slice::from_ref(path)).0 * self.unit_mm;
            let (severity, sentence) = said(&electrode, path, length)?;
            let outline = self.outlines.get(path.outline)?;
            let entity = outline.contour.pieces.first()?.entity;
            let place = Some(Place::Entity { entity });
            Some(finding(Rule::Settings, severity, place, sentence, None))
        };
        paths.iter().filter_map(of_path).collect()
    }
}
