//! Findings about the words and numbers of a program as a whole.

use super::super::block::{Note, Stop, read_under};
use super::super::evidence::FEW_BARE;
use super::super::moves::{FARTHEST_MM, micrometres};
use super::super::numbers::number_word;
use super::super::order::MOST_CALLS;
use super::super::plain::{word_at, words_at};
use super::super::table::NoValue;
use super::Report;
use super::passes::SWITCH_REACH;
use crate::finding::{Detail, Fault, NotJudged, Rule, Severity};
use crate::program::path::{absurd_size, size_of};
use crate::text::shown;
use rustc_hash::FxHashSet;
use std::ops::Range;

/// A smaller part is not plausible in mm, mm.
const SMALLEST_PART: f64 = 2.0;

/// A smaller part, with numbers as fine as those in inches, suggests inches, mm.
const SMALL_PART: f64 = 12.0;

/// A larger part rules out inches, whatever its corrections are, mm.
const LARGE_PART: f64 = 40.0;

/// The correction of the thinnest wire there is, with its spark gap, is larger, nm.
const THINNEST: i64 = 14_000;

impl Report<'_> {
    pub(super) fn foreign_words(&mut self) {
        let mut words = std::mem::take(&mut self.foreign);
        let taper = self.document.taper();
        let is_followed = taper.is_some_and(|taper| taper.unknown.is_none());
        let mills = self.document.mills();
        words.retain(|code, _| {
            let is_explained = is_followed && code.is_of_taper() || mills && code.is_height();
            !is_explained && !self.control.limits.known.contains(code)
        });
        let mut words: Vec<_> = words.into_values().collect();
        words.sort_by_key(|(range, _)| range.start);
        for (range, count) in words {
            let word: String = self.shown(&range);
            self.add(range, Fault::Foreign { word, count });
        }
    }

    /// The beginning of some bytes of the text.
    pub(super) fn shown(&self, range: &Range<usize>) -> String {
        shown(self.text.bytes().get(range.clone()).unwrap_or_default())
    }

    /// Repeated block numbers, and missing ones of a sequence.
    pub(super) fn block_numbers(&mut self) {
        let cuts = &self.document.cuts;
        let blocks: usize = cuts.iter().map(|cut| cut.blocks as usize).sum();
        let (mut numbers, mut last, mut rising) = (0, None, true);
        for cut in cuts.iter() {
            let own = || cut.numbers.iter().filter_map(|(number, _)| *number);
            if let (Some(first), Some(end)) = (own().next(), own().next_back()) {
                rising &= cut.rise() && last.is_none_or(|last| first > last);
                last = Some(end);
                numbers += own().count();
            }
        }
        if numbers < blocks && numbers * 4 >= blocks * 3 {
            for cut in 0..cuts.len() {
                for (line, expected) in self.document.lacking_numbers(cut) {
                    let words = self.document.words_of(line);
                    self.add(words, Fault::Unnumbered { expected });
                }
            }
        }
        // Those of a text in rising order are unique.
        if !rising {
            self.doubled_numbers();
        }
    }

    /// Subprograms have their numbers where they stand, not where they are called, and once.
    fn doubled_numbers(&mut self) {
        let cuts = self.document.cuts.iter().enumerate();
        let placed = cuts.flat_map(|(index, cut)| {
            let byte = self.document.cuts.byte(index);
            let own = cut.numbers.iter();
            own.map(move |(number, place)| (byte + *place as usize, *number))
        });
        let mut all: Vec<(usize, Option<u32>)> = placed.collect();
        if self.document.order().is_some() {
            all.sort_unstable();
            all.dedup();
        }
        let mut seen: FxHashSet<u32> = FxHashSet::default();
        for (start, number) in all {
            let Some(number) = number else {
                // Another program has its own numbers.
                seen.clear();
                continue;
            };
            if !seen.insert(number) {
                let line = self.text.line_of(start);
                let word = number_word(self.text, line);
                let word = word.unwrap_or_else(|| self.text.line_range(line));
                self.add(word, Fault::DoubledNumber { number });
            }
        }
    }

    pub(super) fn calls(&mut self) {
        let Some(order) = self.document.order() else {
            return;
        };
        for &(line, number) in &order.missing {
            self.add(self.text.line_range(line), Fault::NoSubprogram { number });
        }
        for &(line, number) in &order.unreturned {
            let range = self.document.words_of(line);
            self.add(range, Fault::NoReturn { number });
        }
        if let Some(line) = order.endless {
            let range = self.text.line_range(line);
            self.add(range, Fault::EndlessCalls);
        }
        if let Some(line) = order.left_out {
            let what = NotJudged::Calls {
                lines: order.most_lines,
                calls: MOST_CALLS,
            };
            let range = self.text.line_range(line);
            self.push(Rule::NotJudged, range, Detail::NotJudged(what));
        }
    }

    /// The word that ends the program, where text stands after it.
    pub(super) fn end_before(&self, behind: usize) -> String {
        let lines = (0..self.text.line_of(behind)).rev();
        let ends = |line: &usize| self.document.block(*line).stop == Some(Stop::End);
        let word = lines.take(SWITCH_REACH).find(ends).and_then(|line| {
            word_at(self.text, line, |letter, number| {
                letter == b'M' && matches!(number.whole(), Some(2 | 30))
            })
        });
        word.map_or_else(|| self.control.limits.end.clone(), |word| self.shown(&word))
    }

    /// Values for the table that depend on places which the program does not fill, or are beyond any machine.
    pub(super) fn definitions(&mut self) {
        let document = self.document;
        document.filled_table(|cut, definition, why| {
            let range = document.bytes_in(cut, definition.range);
            let word = self.shown(&range);
            let fault = match why {
                NoValue::Unfilled => Fault::UnknownValue { word },
                NoValue::TooFar => {
                    let sentence = say!(word_beyond_any_machine, word, FARTHEST_MM);
                    Fault::said(Rule::TooManyDigits, sentence)
                }
            };
            self.add(range, fault);
        });
    }

    /// Numbers without a decimal point among numbers with one: each where they are few, else the first.
    pub(super) fn bare_numbers(&mut self) {
        let evidence = self.document.evidence();
        let usual = evidence.pointed();
        let count = if usual == Some(false) {
            evidence.with_point
        } else {
            evidence.bare
        };
        if evidence.with_point == 0 || count == 0 {
            return;
        }
        let is_few = usual.is_some();
        let most = if is_few { FEW_BARE as usize } else { 1 };
        let places = self.odd_lengths(usual == Some(false), most);
        for range in places {
            let word = self.shown(&range);
            let fault = match usual {
                Some(false) => Fault::Pointed { word },
                Some(true) => Fault::Bare { word, count: 1 },
                None => Fault::Bare {
                    word,
                    count: count as usize,
                },
            };
            let severity = if is_few {
                Rule::MixedNumbers.default_severity()
            } else {
                Severity::Information
            };
            self.add_as(severity, range, fault);
        }
    }

    /// The first lengths with a decimal point, or without one.
    fn odd_lengths(&self, pointed: bool, most: usize) -> Vec<Range<usize>> {
        let (document, mut found) = (self.document, Vec::new());
        for (index, cut) in document.cuts.iter().enumerate() {
            let has_some = if pointed {
                cut.has_pointed
            } else {
                cut.has_bare
            };
            if has_some && found.len() < most {
                document.run_lines(index, &mut |ran| {
                    let mut variables = ran.variables;
                    let (bytes, start) = (
                        document.line_bytes(ran.line),
                        self.text.line_start(ran.line),
                    );
                    read_under(&mut variables, bytes, start, |note| match note {
                        Note::Length {
                            pointed: own,
                            range,
                        } if own == pointed => found.push(range),
                        _ => {}
                    });
                });
            }
        }
        found.truncate(most);
        found
    }

    /// The one or two numbers that have other decimals than all the others.
    pub(super) fn odd_places(&mut self) {
        let Some(decimals) = self.document.usual_decimals().filter(|it| it.others > 0) else {
            return;
        };
        let usual = decimals.usual;
        let mut found = Vec::new();
        for (index, cut) in self.document.cuts.iter().enumerate() {
            if cut.places & !(1 << usual) == 0 {
                continue;
            }
            for nth in self.document.cuts.lines(index) {
                let line = self.document.sequence().line(nth);
                // Of a word that is repeated the last one counts, as in the evidence.
                let mut lengths: [Option<Range<usize>>; 5] = Default::default();
                words_at(self.text, line, |letter, number, word| {
                    let own = b"XYIJR".iter().position(|of| *of == letter);
                    if let Some(own) = own.and_then(|own| lengths.get_mut(own)) {
                        *own = decimals.is_odd(number).then_some(word);
                    }
                });
                found.extend(lengths.into_iter().flatten());
            }
        }
        found.sort_by_key(|word| word.start);
        found.dedup();
        for range in found.into_iter().take(decimals.others as usize) {
            let word = self.shown(&range);
            self.add(range, Fault::Places { word, usual });
        }
    }

    /// A program without a stated unit whose size or numbers suggest inches; else a size that no wire cuts.
    pub(super) fn unit(&mut self) {
        let cuts = self.document.cuts.iter().enumerate();
        let placed = cuts.filter_map(|(index, cut)| {
            let at = micrometres(self.document.cuts.state_before(index).at).coords;
            Some(cut.bounds?.moved(at))
        });
        let Some(bounds) = placed.reduce(|one, other| one.merged(&other)) else {
            return;
        };
        let size = size_of(&bounds);
        let is_endless = || {
            self.document
                .order()
                .is_some_and(|order| order.endless.is_some())
        };
        let fault = if self.speaks_for_inches(size) {
            Some(Fault::LooksLikeInches { size })
        } else if self.is_whole() && !is_endless() {
            absurd_size(&bounds, self.steps as usize)
        } else {
            None
        };
        match fault {
            Some(fault) => {
                if let Some(range) = self.first_length() {
                    self.add(range, fault);
                }
            }
            None => self.whole_numbers(size),
        }
    }

    /// What whole numbers are taken for, where neither the text nor the settings say it; the program is so large, mm.
    fn whole_numbers(&mut self, size: f64) {
        let is_said = self.control.limits.settings.whole_numbers.is_some()
            || self.control.limits.writes_micrometres();
        if is_said || !self.document.evidence().may_be_whole_units() {
            return;
        }
        let sentence = match self.control.reading.whole_numbers_are_fine {
            true => say!(whole_numbers_are_read_as_micrometres, size, size * 1e3),
            false => say!(whole_numbers_are_read_as_millimetres, size, size / 1e3),
        };
        if let Some(range) = self.first_length() {
            let fault = Fault::said(Rule::Units, sentence);
            self.add_as(Severity::Information, range, fault);
        }
    }

    /// `size` in mm.
    fn speaks_for_inches(&self, size: f64) -> bool {
        let evidence = self.document.evidence();
        // Millimetres are written to the thousandth; in inches that would be 25 µm.
        let has_micrometres = evidence.places[3] == evidence.with_point;
        let is_said = evidence.units > 0 || self.control.limits.settings.program_units.is_some();
        if is_said || evidence.with_point == 0 || has_micrometres {
            return false;
        }
        // The corrections in the program are too small for any wire, or its numbers are as fine as those in inches.
        let has_thin_wire = self
            .control
            .table
            .values()
            .any(|value| (1..THINNEST).contains(&value.abs()));
        let has_fine_numbers = evidence.fine * 4 >= evidence.with_point;
        let is_small = size < SMALLEST_PART || (has_fine_numbers && size < SMALL_PART);
        size > 0.0 && (is_small || (has_thin_wire && size < LARGE_PART))
    }

    /// The first line with a length.
    fn first_length(&self) -> Option<Range<usize>> {
        let has_length = |line: &usize| {
            let block = self.document.block(*line);
            [block.x, block.y]
                .into_iter()
                .flatten()
                .any(|number| number.mantissa != 0)
        };
        (0..self.text.line_count())
            .find(has_length)
            .map(|line| self.document.words_of(line))
    }

    /// The centre of the first arc that could have told how I and J are meant.
    pub(super) fn first_center(&self) -> Option<Range<usize>> {
        let mut arcs = self
            .document
            .cuts
            .iter()
            .enumerate()
            .filter_map(|(index, cut)| {
                let (first, _) = cut.rare().first_center?;
                Some(self.document.cuts.byte(index) + first as usize)
            });
        let line = self.text.line_of(arcs.next()?);
        let word = word_at(self.text, line, |letter, _| matches!(letter, b'I' | b'J'));
        // Of a variable only the line is known.
        word.or_else(|| Some(self.document.words_of(line)))
    }
}
