//! How the engine of all languages reads ISO text.

use super::corner;
use super::machine::Machine;
use super::moves::{Reading, apart};
use super::stretch::{Pathless, Stretch};
use crate::program::chunks::ChunkReader;
use crate::text::SourceText;
use std::ops::Range;

/// How ISO text is read: the effect of a line depends on those before it.
pub(super) struct Control {
    /// The state before the first line.
    pub(crate) begin: Machine,
    pub(crate) reading: Reading,
    /// The first lines, which are not read.
    pub(crate) leader: usize,
}

impl ChunkReader for Control {
    type State = Machine;
    type Begun = Pathless;
    type Chunk = Stretch;

    // Unit tests have short texts.
    const LINES: usize = if cfg!(test) { 24 } else { 192 };

    fn begin(&self) -> Machine {
        self.begin
    }

    fn run(&self, text: &SourceText, lines: Range<usize>, before: Machine) -> (Pathless, Machine) {
        let pathless = Stretch::run(
            lines_from(text, self.leader, lines.start),
            lines.len(),
            text.line_start(lines.start),
            before,
            self.reading,
        );
        let after = pathless.after();
        (pathless, after)
    }

    /// How the moves of a part lie relative to each other depends on nothing else.
    fn finish(&self, _: &SourceText, pathless: Pathless, old: &[Stretch]) -> Stretch {
        pathless.with_paths(old)
    }

    fn before(stretch: &Stretch) -> Machine {
        stretch.before
    }

    fn after(stretch: &Stretch) -> Machine {
        stretch.after
    }

    const REACH: usize = corner::REACH;

    fn ahead(stretch: &Stretch) -> usize {
        stretch.ahead as usize
    }

    fn take_on(stretch: &mut Stretch, before: Machine) -> bool {
        let old = stretch.before;
        let Machine { at, torn, .. } = before;
        let is_moved = Machine {
            at: old.at,
            torn: old.torn,
            ..before
        } == old
            && (at == old.at || stretch.is_loose())
            && stretch.tear(torn);
        if is_moved {
            stretch.shift(apart(at, old.at));
        }
        is_moved
    }
}

/// The lines of a text from one on, each with the byte at which it begins; those of its `leader` are empty.
pub(super) fn lines_from(
    text: &SourceText,
    leader: usize,
    first: usize,
) -> impl Iterator<Item = (usize, &[u8])> + Clone {
    (first..text.line_count()).map(move |line| {
        let read = (line >= leader).then(|| text.line(line));
        (text.line_start(line), read.unwrap_or_default())
    })
}
