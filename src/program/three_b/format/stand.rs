//! The machine on its way through a program that is formatted, and the verdict on its stated end points.

use super::Ends;
use super::chunk::{Chunk, Line, Stated, Travel, count_blocks, has_end};
use crate::geometry::Point;
use crate::program::three_b::around::StatedPoint;
use crate::program::three_b::block::Node;
use crate::program::three_b::encode::{point_of, snap as node_of};
use crate::program::three_b::parse::Item;
use crate::program::three_b::words::Word;
use crate::settings::Layout;

/// The tolerance for a stated end point, µm: 2, and 1 for each arc since the last one.
const STATED_TOLERANCE: f64 = 2.0;

/// The way through a program, line by line.
pub(super) struct Walk {
    layout: Layout,
    ends: Ends,
    /// Blocks so far.
    ordinal: u64,
    stand: Stand,
    /// The end word has come: nothing after it is formatted.
    is_over: bool,
}

impl Walk {
    pub(crate) fn new(layout: Layout, ends: Ends) -> Walk {
        Walk {
            layout,
            ends,
            ordinal: 0,
            stand: Stand {
                at: Point::origin(),
                trust: Trust::Known,
                arcs: 0.0,
            },
            is_over: false,
        }
    }

    /// Follows the machine through some lines.
    pub(crate) fn go_through(&mut self, chunk: &mut Chunk) {
        (chunk.ordinal, chunk.is_over) = (self.ordinal, self.is_over);
        let mut first = 0;
        for Line { end, is_sound } in &chunk.lines {
            if !is_sound {
                self.stand.trust = Trust::Lost;
            }
            for (item, way) in chunk.items[first..*end]
                .iter()
                .zip(&chunk.ways[first..*end])
            {
                let stand = &mut self.stand;
                let mut stated = Stated::Absent(None);
                match item {
                    Item::Block { stated_end, .. } => {
                        stated = stand.go_on(*stated_end, *way, self.layout);
                        if self.ends == Ends::Kept {
                            stated = match stated_end {
                                Some(_) => Stated::AsItStands,
                                None => Stated::Absent(None),
                            };
                        }
                    }
                    Item::Word {
                        word: Word::Pause, ..
                    } if stand.trust == Trust::Known => stand.trust = Trust::UnlessStated,
                    Item::StartPoint { at: [x, y], .. } => {
                        *stand = Stand {
                            at: Point::new(x * 1000.0, y * 1000.0),
                            trust: Trust::Known,
                            arcs: 0.0,
                        };
                    }
                    Item::Word { .. }
                    | Item::Text { .. }
                    | Item::CommentedBlock { .. }
                    | Item::Fault(_) => {}
                }
                chunk.stated.push(stated);
            }
            first = *end;
        }
        self.ordinal += count_blocks(&chunk.items);
        self.is_over |= has_end(&chunk.items);
    }
}

/// Where the machine stands.
#[derive(Clone, Copy)]
struct Stand {
    /// µm.
    at: Point,
    trust: Trust,
    /// Arcs since the last stated place that was taken over.
    arcs: f64,
}

impl Stand {
    /// Moves on to a block's end, and judges its stated end point.
    ///
    /// Where stated points stay in the text, later ones are compared with them; where they are
    /// dropped, later ones are compared with the blocks alone, so that formatting again finds the
    /// same.
    fn go_on(
        &mut self,
        stated: Option<StatedPoint>,
        way: Option<Travel>,
        layout: Layout,
    ) -> Stated {
        let stated = stated
            .and_then(|StatedPoint { at: [x, y], .. }| node_of(Point::new(x * 1000.0, y * 1000.0)));
        let told = if layout == Layout::Checking {
            stated
        } else {
            None
        };
        match way {
            Some(Travel { by, is_arc }) => {
                self.arcs += f64::from(u8::from(is_arc));
                self.at += by;
            }
            // The block means nothing: from here on only a stated point gives the position.
            None => self.trust = Trust::Lost,
        }
        if let Some(node) = told
            && (self.trust != Trust::Known || self.is_near(node))
        {
            *self = Stand {
                at: point_of(node),
                trust: Trust::Known,
                arcs: 0.0,
            };
            return Stated::Right(node);
        }
        match (stated, self.trust) {
            (Some(node), Trust::Known | Trust::UnlessStated) if self.is_near(node) => {
                Stated::Right(node)
            }
            (Some(_), _) => Stated::AsItStands,
            (None, Trust::Lost) => Stated::Absent(None),
            (None, _) => Stated::Absent(node_of(self.at)),
        }
    }

    fn is_near(&self, node: Node) -> bool {
        (point_of(node) - self.at).norm() <= STATED_TOLERANCE + self.arcs
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Trust {
    Known,
    /// The table may have been moved by hand while the wire was out: a stated point gives its place.
    UnlessStated,
    /// After something damaged.
    Lost,
}
