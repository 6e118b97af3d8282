//! A finding of a cut, kept by places that no edit elsewhere moves, in any language.

use super::by_chunk::Begun;
use super::chunks::Chunks;
use super::contours::{Contours, PartAt};
use super::followed::Followed;
use super::work::{self, Work};
use crate::finding::{Detail, Fault, Finding, Place, Rule, Severity};
use crate::text::SourceText;
use std::ops::Range;

/// How many findings there are of a rule, in a severity as the rule sees it.
pub(super) type Counted = (Rule, Severity, usize);

/// Counts one more.
pub(super) fn count(counts: &mut Vec<Counted>, rule: Rule, severity: Severity) {
    let own = counts
        .iter_mut()
        .find(|one| (one.0, one.1) == (rule, severity));
    match own {
        Some((.., count)) => *count += 1,
        None => counts.push((rule, severity, 1)),
    }
}

/// Some bytes of a chunk.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Local {
    chunk: u32,
    bytes: (u32, u32),
}

impl Local {
    fn of<C>(chunks: &Chunks<C>, place: &Place) -> Option<Local> {
        let range = place.in_text()?;
        let chunk = chunks.at(range.start);
        let byte = chunks.byte(chunk);
        Some(Local {
            chunk: chunk as u32,
            bytes: ((range.start - byte) as u32, (range.end - byte) as u32),
        })
    }

    fn range(&self, byte_of: impl Fn(usize) -> usize) -> Range<usize> {
        let byte = byte_of(self.chunk as usize);
        byte + self.bytes.0 as usize..byte + self.bytes.1 as usize
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        self.chunk = moved(self.chunk as usize) as u32;
    }
}

/// A finding of a cut.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::program) struct OfCut {
    begin: (u32, u32),
    pub(in crate::program) rule: Rule,
    pub(in crate::program) severity: Severity,
    place: Local,
    /// The other place that is concerned.
    other: Option<Local>,
    pub(in crate::program) detail: Detail,
}

/// What is found of the cuts that begin in a chunk.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::program) struct Tally {
    counts: Vec<Counted>,
    /// Where the first of them stands, by the chunk and the byte in there.
    first: (u32, u32),
}

impl Tally {
    /// A byte that none of them stands before, and how many there are of each kind.
    pub(crate) fn told(&self, byte_of: impl Fn(usize) -> usize) -> (usize, &[Counted]) {
        let (chunk, byte) = self.first;
        (byte_of(chunk as usize) + byte as usize, &self.counts)
    }
}

impl Begun for OfCut {
    type Sum = Tally;

    fn begin(&self) -> PartAt {
        (self.begin.0 as usize, self.begin.1 as usize)
    }

    fn renumber(&mut self, moved: &dyn Fn(usize) -> usize) {
        self.begin.0 = moved(self.begin.0 as usize) as u32;
        self.place.renumber(moved);
        self.other
            .iter_mut()
            .for_each(|other| other.renumber(moved));
    }

    fn sum(list: &[OfCut]) -> Tally {
        let mut tally = Tally::default();
        for one in list {
            let place = (one.place.chunk, one.place.bytes.0);
            tally.first = match tally.counts.is_empty() {
                true => place,
                false => tally.first.min(place),
            };
            count(&mut tally.counts, one.rule, one.severity);
        }
        tally
    }
}

impl OfCut {
    /// Of the cut that begins at a part; `None` where it is not about bytes of the text.
    pub(crate) fn new<C>(chunks: &Chunks<C>, begin: PartAt, finding: Finding) -> Option<OfCut> {
        let local = |place: &Place| Local::of(chunks, place);
        Some(OfCut {
            begin: (begin.0 as u32, begin.1 as u32),
            rule: finding.rule,
            severity: finding.severity,
            place: local(&finding.place)?,
            other: finding.related.first().and_then(local),
            detail: finding.detail,
        })
    }

    /// Its bytes in the text; `byte_of` is the first byte of a chunk.
    pub(crate) fn range(&self, byte_of: impl Fn(usize) -> usize) -> Range<usize> {
        self.place.range(byte_of)
    }

    /// The finding at its present place.
    pub(crate) fn finding(&self, byte_of: impl Fn(usize) -> usize, text: &SourceText) -> Finding {
        let mut detail = self.detail.clone();
        let related = self.other.map(|other| other.range(&byte_of));
        if let (Some(range), Detail::Program(fault)) = (&related, &mut detail)
            && let Fault::PathCrossesItself { other, .. } = &mut **fault
        {
            *other = text.line_of(range.start);
        }
        let related = related.into_iter().map(|range| Place::Text { range });
        Finding {
            related: related.collect(),
            ..Finding::in_text(self.rule, self.range(&byte_of), detail).with(self.severity)
        }
    }

    /// What is said of the contours that begin from one place up to another, in the order in which they begin: of those
    /// that a language has `judged` by itself, and of those that cross themselves, where that is to be said.
    pub(crate) fn all<D: Followed, C>(
        document: &D,
        (chunks, contours): (&Chunks<C>, &Contours<D::Cut>),
        places: Range<PartAt>,
        judged: impl Iterator<Item = (PartAt, Vec<Finding>)>,
        is_said: impl Fn(&D::Cut) -> bool,
    ) -> Vec<OfCut> {
        let crossing = contours.crossing_within(places).map(|(cut, found)| {
            let said = is_said(cut).then(|| document.crosses_itself(cut, found, document.text()));
            (cut.begin(), said.unwrap_or_default())
        });
        let mut all = Vec::new();
        for (begin, findings) in judged.chain(crossing) {
            work::add(Work::Contours, 1);
            let of_cut = |finding| OfCut::new(chunks, begin, finding);
            all.extend(findings.into_iter().filter_map(of_cut));
        }
        all.sort_by_key(OfCut::begin);
        all
    }
}
