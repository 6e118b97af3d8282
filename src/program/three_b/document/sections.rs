//! Where a program falls into contours and the ways between them: the blocks from one word to the next.

use super::super::run::{Run, Sum, is_jump};
use super::{At, Document, PartAt, Section, View};

impl Document {
    /// The word that ends the program: the first of the controller's own, else the last that ends programs elsewhere, else a pause
    /// with no block behind it.
    pub(super) fn end_word(&self) -> Option<At> {
        let place = |run: usize, entry: Option<usize>| entry.map(|entry| At { run, entry });
        let mut runs = self.runs.iter().enumerate();
        let own = runs.find_map(|(run, of)| place(run, of.own_end));
        let back = || self.runs.iter().enumerate().rev();
        let foreign = || back().find_map(|(run, of)| place(run, of.last_end));
        let pause = || {
            let last = back().find_map(|(run, of)| place(run, of.last_word))?;
            self.last_block(None)
                .filter(|block| *block < last)
                .map(|_| last)
        };
        own.or_else(foreign).or_else(pause)
    }

    pub(super) fn last_block(&self, end: Option<At>) -> Option<At> {
        let runs = self
            .runs
            .iter()
            .enumerate()
            .rev()
            .filter(|(_, run)| run.blocks > 0);
        let mut blocks = runs.flat_map(|(run, of)| {
            of.entries
                .iter()
                .enumerate()
                .rev()
                .filter(|(_, entry)| entry.block().is_some())
                .map(move |(entry, _)| At { run, entry })
        });
        blocks.find(|at| end.is_none_or(|end| *at < end))
    }

    /// The blocks from a part on, up to the next word; `None` behind the end of the program.
    pub(super) fn section_from(&self, start: PartAt, end: Option<At>) -> Option<Section> {
        let mut section: Option<Section> = None;
        let (mut run, mut index) = start;
        while let Some(of) = self.runs.get(run) {
            for (nth, part) in of.parts.iter().enumerate().skip(index) {
                if end.is_some_and(|end| {
                    end < At {
                        run,
                        entry: part.entries.start,
                    }
                }) {
                    return section;
                }
                let own = section.get_or_insert(Section {
                    parts: [(run, nth); 2],
                    sum: Sum::default(),
                    is_jump: false,
                });
                own.parts[1] = (run, nth);
                own.sum = own.sum.then(&part.sum);
                if part.word.is_some() {
                    let is_end = end
                        == Some(At {
                            run,
                            entry: part.entries.end,
                        });
                    own.is_jump = start != (0, 0)
                        && self.is_behind_word(start)
                        && !is_end
                        && is_jump(&own.sum);
                    return section;
                }
            }
            (run, index) = (run + 1, 0);
        }
        section
    }

    /// Whether a word stands somewhere before a part at which a section begins.
    fn is_behind_word(&self, (run, part): PartAt) -> bool {
        part > 0
            || self.runs[..run.min(self.runs.len())]
                .iter()
                .rev()
                .any(|run| run.words > 0)
    }

    /// The part behind another one.
    pub(super) fn part_behind(&self, (run, part): PartAt) -> PartAt {
        if self
            .runs
            .get(run)
            .is_some_and(|of| part + 1 < of.parts.len())
        {
            (run, part + 1)
        } else {
            (run + 1, 0)
        }
    }

    /// The sections that are not parts of one run.
    pub(super) fn outer_sections(&self, end: Option<At>) -> Vec<Section> {
        let mut sections = Vec::new();
        let mut next = Some((0, 0));
        while let Some(section) = next.and_then(|start| self.section_from(start, end)) {
            let (run, _) = section.parts[1];
            let ends_text = self
                .runs
                .get(run)
                .is_none_or(|of| section.parts[1].1 + 1 >= of.parts.len());
            next = self
                .runs
                .get(run)
                .filter(|_| !ends_text)
                .map(|of| (run, of.parts.len() - 1));
            sections.push(section);
        }
        sections
    }

    /// The contour that a part belongs to, or the way between two: its section, and those before and behind at its tabs.
    pub(super) fn section_of_part(&self, view: &View, part: PartAt) -> Option<Section> {
        let mut section = self.own_section_of_part(view, part)?;
        while view.tabs.binary_search(&section.parts[0]).is_ok() {
            let (run, part) = section.parts[0];
            // Its word stands at the end of the part before.
            let Some(before) = part
                .checked_sub(1)
                .and_then(|part| self.own_section_of_part(view, (run, part)))
            else {
                break;
            };
            section = joined(before, &section);
        }
        loop {
            let next = self.part_behind(section.parts[1]);
            let Some(behind) = view
                .tabs
                .binary_search(&next)
                .ok()
                .and_then(|_| self.section_from(next, view.end))
            else {
                break;
            };
            section = joined(section, &behind);
        }
        Some(section)
    }

    /// The section that a part belongs to.
    fn own_section_of_part(&self, view: &View, (run, part): PartAt) -> Option<Section> {
        let of = self.runs.get(run)?;
        if part > 0 && part + 1 < of.parts.len() {
            return self.section_from((run, part), view.end);
        }
        let index = view
            .outer
            .partition_point(|section| section.parts[1] < (run, part));
        view.outer.get(index).cloned()
    }

    pub(super) fn is_jump(&self, part: PartAt) -> bool {
        self.section_of_part(&self.view, part)
            .is_some_and(|section| section.is_jump)
    }

    /// Whether what begins with a part goes on with the contour before it.
    pub(super) fn is_tab(&self, part: PartAt) -> bool {
        self.view.tabs.binary_search(&part).is_ok()
    }

    pub(super) fn closes(&self, view: &View, section: &Section) -> bool {
        view.open.binary_search(&section.parts[0]).is_err()
    }

    /// Sections within one run, of those that it names, up to the end of the program.
    pub(super) fn inner_sections<'a>(
        &'a self,
        end: Option<At>,
        named: fn(&Run) -> &[usize],
    ) -> impl Iterator<Item = Section> + 'a {
        let up_to = end.map_or(usize::MAX, |end| end.run);
        let runs = self
            .runs
            .iter()
            .enumerate()
            .take_while(move |(run, _)| *run <= up_to);
        runs.flat_map(move |(run, of)| {
            named(of)
                .iter()
                .filter_map(move |part| self.section_from((run, *part), end))
        })
    }

    /// The entries of a section in their order.
    pub(super) fn entries_of(&self, section: &Section) -> impl Iterator<Item = At> + '_ {
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        (first_run..=last_run).flat_map(move |run| {
            let entries = self.runs.get(run).map(|of| {
                let from = if run == first_run {
                    of.parts
                        .get(first_part)
                        .map_or(0, |part| part.entries.start)
                } else {
                    0
                };
                let to = if run == last_run {
                    of.parts.get(last_part).map_or(0, |part| part.entries.end)
                } else {
                    of.entries.len()
                };
                from..to
            });
            entries
                .into_iter()
                .flatten()
                .map(move |entry| At { run, entry })
        })
    }

    /// The blocks of a section in their order.
    pub(super) fn blocks_of(&self, section: &Section) -> impl Iterator<Item = At> + '_ {
        let is_block = |at: &At| self.entry(*at).is_some_and(|entry| entry.block().is_some());
        self.entries_of(section).filter(is_block)
    }

    pub(super) fn last_block_of(&self, section: &Section) -> Option<At> {
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        (first_run..=last_run).rev().find_map(|run| {
            let of = self.runs.get(run)?;
            let from = if run == first_run {
                of.parts.get(first_part)?.entries.start
            } else {
                0
            };
            let to = if run == last_run {
                of.parts.get(last_part)?.entries.end
            } else {
                of.entries.len()
            };
            let entry = (from..to).rev().find(|entry| {
                of.entries
                    .get(*entry)
                    .is_some_and(|entry| entry.block().is_some())
            })?;
            Some(At { run, entry })
        })
    }

    pub(super) fn section_of(&self, at: At) -> Option<Section> {
        let part = self
            .runs
            .get(at.run)?
            .parts
            .partition_point(|part| part.entries.end <= at.entry);
        self.section_of_part(&self.view, (at.run, part))
    }
}

/// A section and the one behind it as one contour.
pub(super) fn joined(section: Section, behind: &Section) -> Section {
    Section {
        parts: [section.parts[0], behind.parts[1]],
        sum: section.sum.then(&behind.sum),
        is_jump: false,
    }
}
