//! A program compared with our own program for its drawing, block by block.
//!
//! The drawing's program is written again under the same settings (`reference`), or under inferred ones (`guess`). Where
//! that has the same blocks except a few, somebody has changed those: each of them is named, however many they are, and
//! nothing else. Other programs are not judged here.

use super::begun::begun_elsewhere;
use super::comparison::FEW;
use super::difference::{Comparison, Difference};
use super::displaced::displaced;
use super::drawn::Drawn;
use super::pairs::{Pair, Pairs};
use super::placed::{ALIKE, ROUNDED, SLIP};
use super::reference::Under;
use super::said::said;
use super::sides::Sides;
use super::traced::{Block, Motion, Traced};
use super::walk::Kind;
use crate::geometry::{Arc, Segment, Vector};
use std::cell::LazyCell;

/// Where the mean deviation of a program's blocks is below this, µm, it was written with just these settings.
const SAME: f64 = 1e-2;
/// For each differing block this many others must be as expected; with fewer, the settings are not known.
const LIKE: usize = 4;

/// The verdict on a program from a rewritten one.
#[derive(Clone, Debug)]
pub(super) struct Told {
    pub(crate) comparison: Comparison,
    /// The mean deviation of the unnamed blocks, µm.
    pub mean: f64,
    /// Blocks are lost or superfluous.
    pub(crate) has_gap: bool,
    /// Words without coordinates that differ.
    pub(crate) words: Vec<Difference>,
    /// Ways in and out that are moved so far that this is intended.
    pub elsewhere: usize,
    /// One of the named blocks ends further from its place than [`SLIP`], and on a wall, where another tab may begin.
    pub strays: bool,
    /// Ways in and out that differ from the expected ones.
    pub ways: usize,
    /// The same for blocks of contours, and the number of both.
    unlike: [usize; 2],
    /// Blocks whose words differ from the expected ones.
    changed: usize,
}

impl Told {
    /// It was written with just these settings.
    pub(crate) fn is_exact(&self) -> bool {
        self.mean < SAME
    }

    /// Hardly more blocks are as expected than differ.
    pub(crate) fn is_mostly_unlike(&self) -> bool {
        let [unlike, all] = self.unlike;
        LIKE * unlike >= all
    }

    /// Everything is as expected to the last digit except one block, which differs, is lost or is repeated: other settings
    /// would change more than that.
    pub(crate) fn is_one_change(&self) -> bool {
        let all = &self.comparison.differences;
        self.is_exact()
            && self.elsewhere == 0
            && matches!(&all[..], [one] if one.kind != Kind::Moved)
            && self.changed + usize::from(self.has_gap) == 1
    }

    /// Several moved ways in and out come from another setting, whether or not they are one change, and so does one
    /// that is moved by so many mm that `is_slip` does not hold; any other was changed by somebody.
    pub(crate) fn without_leads(mut self, is_slip: impl Fn(f64) -> bool) -> Told {
        let is_lead = |one: &Difference| one.kind == Kind::Lead;
        let all = &mut self.comparison.differences;
        let leads = || all.iter().filter(|one| is_lead(one));
        if self.ways > 1 || leads().any(|one| !is_slip(one.off)) {
            self.elsewhere += leads().count();
            all.retain(|one| !is_lead(one));
        }
        self
    }

    /// Words contradict the side of the wire that it is compared under.
    pub(crate) fn has_other_side(&self) -> bool {
        self.words.iter().any(Difference::is_of_side)
    }

    /// Of a side that was guessed, no word is wrong.
    pub(crate) fn under(mut self, guess: &Under) -> Told {
        let is_set = guess.sides == Sides::AsSet;
        self.words.retain(|word| is_set || !word.is_of_side());
        self
    }

    /// The evidence against the verdict; the least evidence sorts first.
    pub(crate) fn doubt(&self) -> (bool, usize, bool, usize, u64) {
        // A contour that is out of place does not count here.
        let all = self.comparison.differences.iter();
        let off = all.filter(|one| one.kind != Kind::Moved).map(|one| one.off);
        let off = (off.sum::<f64>() * 1e3).round() as u64;
        let many = self.comparison.differences.len().min(2) + self.elsewhere.min(2);
        (
            !self.is_exact(),
            many,
            self.has_gap || self.strays,
            self.words.len(),
            off,
        )
    }

    /// A contour of it lies elsewhere than the others.
    pub(crate) fn has_moved(&self) -> bool {
        let mut all = self.comparison.differences.iter();
        all.any(|one| one.kind == Kind::Moved)
    }

    /// All that differs.
    pub(crate) fn whole(self) -> Comparison {
        let Told {
            mut comparison,
            words,
            ..
        } = self;
        comparison.differences.extend(words);
        comparison.differences.sort_by_key(|one| one.range.start);
        comparison
    }
}

/// The changes in a program that we would write under these settings; `None` where we would not.
pub(super) fn against_reference(drawn: &Drawn, traced: &Traced, under: &Under) -> Option<Told> {
    let reference = &*drawn.reference(traced, under)?;
    let pairs = Pairs::of(traced, reference)?;
    // Placed as the drawing is, or anywhere: by its start, or by most of it.
    let anywhere = traced.begin()? - reference.traced.begin()?;
    let as_drawn = traced.is_placed.then_some(reference.shift);
    let mut best: Option<Told> = None;
    let many = |told: &Option<Told>| match told {
        Some(told) => told.comparison.differences.len(),
        None => usize::MAX,
    };
    for (nth, enough) in [0, 0, 1].into_iter().enumerate() {
        // Where the wire is threaded elsewhere, a program that says no place lies where most of it does; and so does one
        // of which some contours lie elsewhere than the others.
        let all =
            |told: &Told, is: fn(&Difference) -> bool| told.comparison.differences.iter().all(is);
        let is_moved = best
            .as_ref()
            .is_some_and(|told| traced.counts && told.elsewhere > 0 || told.has_moved());
        let enough = if is_moved { 0 } else { enough };
        // Where the program says where it lies, blocks are compared there: placed elsewhere, a few micrometres would hide in its datum.
        let is_slight = |told: &Told| as_drawn.is_some() && all(told, |one| one.off * 1e3 <= SLIP);
        if many(&best) <= enough || nth == 2 && best.as_ref().is_some_and(is_slight) {
            break;
        }
        let from = match nth {
            0 => as_drawn,
            1 => Some(anywhere),
            _ => Some(pairs.away()),
        };
        let told = from.and_then(|from| pairs.told(from, as_drawn == Some(from)));
        // Where it lies elsewhere, a vertex that has moved changes both of its blocks.
        let changed = |told: &Option<Told>| told.as_ref().map_or(0, |told| told.changed);
        if (many(&told), changed(&told)) < (many(&best), changed(&best)) {
            best = told;
        }
    }
    if let Some(told) = &mut best {
        let is_set = under.handles.is_none() && under.settings == *drawn.settings;
        told.words = said(&pairs, is_set);
    }
    best
}

impl Pairs<'_> {
    /// The differences of a program at this distance from the rewritten one.
    fn told(&self, from: Vector, is_as_drawn: bool) -> Option<Told> {
        let (traced, reference) = (self.traced, self.reference);
        let is_offset = |of: &Traced| of.blocks.iter().any(Block::is_offset);
        if is_offset(traced) && !is_offset(&reference.traced) {
            return None;
        }
        let rewritten = self
            .pairs
            .iter()
            .filter(|pair| !pair.words.are_same)
            .count();
        let is_in_our_words = 2 * rewritten <= traced.blocks.len();
        let displaced = displaced(self, from, SLIP);
        let (mut before, mut beside, mut all) = (false, 0.0, Vec::new());
        let mut contours = displaced.iter().peekable();
        for (number, pair) in self.pairs.iter().enumerate() {
            while contours.next_if(|it| it.contour.end <= number).is_some() {}
            let elsewhere = contours.peek().filter(|it| it.contour.contains(&number));
            let (own, meant, words) = (pair.own, pair.meant, pair.words);
            let is_behind = before || pair.behind_gap;
            let away = match words.apart {
                // The control makes no arc of it: its numbers are all there is.
                Some(apart) if own.is_lost && is_in_our_words => Some(apart),
                _ => own.motion.away_from(&meant.motion, from, is_behind),
            };
            let by_contour = elsewhere
                .and_then(|it| own.motion.away_from(&meant.motion, from + it.by, is_behind));
            let away = away.map(|away| away.min(by_contour.unwrap_or(away)));
            // After a block that is lost or superfluous the next one may be of another kind.
            let away = away.or(pair.behind_gap.then_some(0.0))?;
            // J of a circle is off by four times what its radius is; where it is wrong, so is the end.
            let arc = meant.segment().and_then(Segment::as_arc);
            let is_circle = !traced.four_b && arc.is_some_and(Arc::is_full_turn);
            // The same arc, whose centre an ISO program counts from another place.
            let is_said_otherwise =
                |apart: f64| !traced.counts && arc.is_some() && apart > SLIP && away <= ALIKE;
            // Coordinates of a contour elsewhere differ, each by as much.
            let apart = words.apart.filter(|_| elsewhere.is_none() || traced.counts);
            let off = match apart {
                Some(apart) if is_in_our_words && !is_circle && !is_said_otherwise(apart) => {
                    away.max(apart)
                }
                // From wherever it is begun, a circle of another size is another one.
                Some(_) if is_circle && !words.are_same => {
                    let both = own.segment().and_then(Segment::as_arc).zip(arc);
                    let radii = both.map_or(0.0, |(own, meant)| (own.radius - meant.radius).abs());
                    away.max(radii)
                }
                _ => away,
            };
            beside += if off <= ALIKE { away } else { 0.0 };
            before = off > ROUNDED && !(is_behind && words.are_same);
            all.push((off, is_behind));
        }
        let mean = beside / traced.blocks.len() as f64;
        let alike = if mean < SAME { ALIKE } else { ROUNDED };
        // In a program that is ours most blocks are just as we write them.
        let moves = |pair: &&Pair| pair.own.motion != Motion::Stop;
        let moving = self.pairs.iter().filter(moves).count();
        if 2 * all.iter().filter(|(off, _)| *off > alike).count() > moving {
            return None;
        }
        let is_changed =
            |(pair, (off, _)): &(&Pair, &(f64, bool))| *off > alike && !pair.words.are_same;
        let changed = self.pairs.iter().zip(&all).filter(is_changed).count();
        let most = FEW.min(traced.blocks.len() / 3);
        let (mut found, mut stated) = (Vec::new(), Vec::new());
        let (mut elsewhere, mut ways, mut unlike, mut strays) = (0, 0, 0, false);
        let is_located = LazyCell::new(|| self.has_placed_contour(from));
        let mut displaced = displaced.into_iter().peekable();
        // The last named block: its number, whether the program has been elsewhere since, and whether the block is a way to
        // another hole.
        let mut run: Option<(usize, bool, bool)> = None;
        for (number, (pair, (off, is_behind))) in self.pairs.iter().zip(&all).enumerate() {
            let (own, meant, words) = (pair.own, pair.meant, pair.words);
            // Its contour lies elsewhere than the others, since this way or the first of it leads there.
            while displaced.next_if(|it| it.ways.end < number).is_some() {}
            if let Some(contour) = displaced.peek()
                && number >= contour.ways.start
            {
                if number == contour.way && !contour.is_behind_one {
                    let (segment, off) = (contour.segment, contour.off);
                    found.push(Difference::of(own, segment, off, Kind::Moved));
                }
                if number < contour.ways.end {
                    continue;
                }
            }
            if let Some((_, is_elsewhere, _)) = &mut run {
                *is_elsewhere &= *off > alike || !self.is_placed(number, from);
            }
            if *off <= alike {
                let off = words.stated;
                stated.extend((off > alike).then(|| Difference::of(own, None, off, Kind::Stated)));
                continue;
            }
            if words.are_same {
                // The same words mean something else after a block that ends elsewhere, or under another mode.
                if !is_behind {
                    return None;
                }
                continue;
            }
            let source = reference.source_of(&meant.motion);
            ways += usize::from(source.is_none());
            let is_of_contour = source.is_some();
            unlike += usize::from(is_of_contour && !is_as_drawn);
            let goes_on = run.is_some_and(|(last, is_elsewhere, is_aside)| {
                if is_aside && is_of_contour {
                    return false;
                }
                number - last <= FEW && is_elsewhere
                    || last + 1 == number && self.are_exchanged(last)
            });
            // Where a way is moved by more or by less than what lies after it, the hole is another one and no contour has changed.
            let is_aside = !is_of_contour && !self.moves_on(number, from, *off);
            run = Some((number, !self.is_placed(number, from), is_aside));
            // A move and its return are one change, and so are two exchanged blocks.
            if goes_on && self.comes_back(number, from) {
                // Where a vertex is elsewhere, the neighbour that is hardly longer is not the one.
                if let Some(last) = found.last_mut()
                    && last.kind == Kind::Block
                    && is_of_contour
                    && last.off < *off / 2.0
                {
                    *last = Difference::of(own, source, *off, Kind::Block);
                }
                continue;
            }
            unlike += usize::from(is_of_contour && is_as_drawn);
            // The wire is threaded elsewhere, and the contour begins and closes where it comes from there.
            if elsewhere > 0 && *off > SLIP && self.is_at_its_entry(number, from) {
                run = None;
                continue;
            }
            let (segment, kind) = match source {
                // Whatever the hole is, the way in ends where the contour is cut.
                None if mean < SAME && self.ends_astray(number, from) => {
                    run = None;
                    (None, Kind::Astray)
                }
                Some(segment) => (Some(segment), Kind::Block),
                None if *off <= SLIP || *is_located && self.leads_astray(number, from) => {
                    (None, Kind::Lead)
                }
                // The hole is elsewhere, and so is how the wire comes from it.
                None => {
                    (run, elsewhere) = (None, elsewhere + 1);
                    continue;
                }
            };
            if found.len() == most {
                return None;
            }
            strays |= !self.ends_near(number, from, SLIP)
                && (!is_as_drawn || self.lies_on_wall(number, from));
            found.push(Difference::of(own, segment, *off, kind));
        }
        if stated.len() <= FEW {
            found.append(&mut stated);
        }
        if let Some((place, of)) = self.gap {
            let segment = reference.source_of(&of.motion);
            let length = of
                .motion
                .ends()
                .map_or(0.0, |[start, end]| (end - start).norm());
            let kind = if segment.is_some() {
                Kind::Block
            } else {
                Kind::Lead
            };
            found.push(Difference::of(place, segment, length, kind));
        }
        found.extend(begun_elsewhere(
            traced,
            &reference.traced,
            from,
            ALIKE..=SLIP,
        ));
        found.sort_by_key(|difference| difference.range.start);
        let contours = reference
            .traced
            .cuts
            .iter()
            .flat_map(|[_, contour]| contour.clone());
        let cut = contours.filter_map(|index| traced.blocks.get(index));
        let follows = cut.filter(|block| matches!(block.motion, Motion::Cut(_)));
        Some(Told {
            comparison: Comparison {
                follows: follows.map(|block| block.range.clone()).collect(),
                differences: found,
            },
            mean,
            has_gap: self.gap.is_some(),
            elsewhere,
            strays,
            ways,
            words: Vec::new(),
            unlike: [unlike, moving],
            changed,
        })
    }

    /// Two consecutive blocks that have changed places.
    fn are_exchanged(&self, first: usize) -> bool {
        let [one, two] = [first, first + 1].map(|number| self.pairs.get(number));
        let (Some(one), Some(two)) = (one, two) else {
            return false;
        };
        let is = |own: &Block, meant: &Block| {
            self.traced
                .said(own)
                .is_like(&self.reference.traced.said(meant))
        };
        is(one.own, two.meant) && is(two.own, one.meant)
    }
}
