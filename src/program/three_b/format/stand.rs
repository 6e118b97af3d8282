//! The machine on its way through a program that is formatted, and the verdict on its stated end points.

use super::Ends;
use super::line::{Line, Part, Stated, What};
use crate::geometry::Point;
use crate::program::three_b::block::Node;
use crate::program::three_b::encode::{point_of, snap as node_of};
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
    /// The end word has come: nothing after it is formatted.
    is_over: bool,
    /// Where the machine stands, µm.
    at: Point,
    trust: Trust,
    /// Arcs since the last stated place that was taken over.
    arcs: f64,
}

impl Walk {
    pub(crate) fn new(layout: Layout, ends: Ends) -> Walk {
        Walk {
            layout,
            ends,
            ordinal: 0,
            is_over: false,
            at: Point::origin(),
            trust: Trust::Known,
            arcs: 0.0,
        }
    }

    /// Follows the machine through a line.
    pub(crate) fn go_through(&mut self, line: &mut Line) {
        (line.ordinal, line.is_over) = (self.ordinal, self.is_over);
        if !line.is_sound {
            self.trust = Trust::Lost;
        }
        for part in &mut line.parts {
            match part.what {
                What::Block(..) => {
                    self.ordinal += 1;
                    let stated = self.go_on(part);
                    part.stated = match (self.ends, part.stated_end) {
                        (Ends::OfLayout, _) => stated,
                        (Ends::Kept, Some(_)) => Stated::AsItStands,
                        (Ends::Kept, None) => Stated::Absent(None),
                    };
                }
                What::Word(Word::Pause) if self.trust == Trust::Known => {
                    self.trust = Trust::UnlessStated
                }
                What::Word(word) => self.is_over |= word == Word::End,
                What::StartPoint([x, y]) => self.stand_at(Point::new(x * 1000.0, y * 1000.0)),
            }
        }
    }

    fn stand_at(&mut self, place: Point) {
        (self.at, self.trust, self.arcs) = (place, Trust::Known, 0.0);
    }

    /// Moves on to a block's end, and judges its stated end point.
    ///
    /// Where stated points stay in the text, later ones are compared with them; where they are
    /// dropped, later ones are compared with the blocks alone, so that formatting again finds the
    /// same.
    fn go_on(&mut self, block: &Part) -> Stated {
        let place = |[x, y]: [f64; 2]| node_of(Point::new(x * 1000.0, y * 1000.0));
        let stated = block.stated_end.and_then(|stated| place(stated.at));
        match &block.way {
            Some(way) => {
                self.arcs += f64::from(u8::from(way.as_arc().is_some()));
                self.at += way.end().coords;
            }
            // The block means nothing: from here on only a stated point gives the position.
            None => self.trust = Trust::Lost,
        }
        match stated {
            Some(node)
                if self.layout == Layout::Checking
                    && (self.trust != Trust::Known || self.is_near(node)) =>
            {
                self.stand_at(point_of(node));
                Stated::Right(node)
            }
            Some(node) if self.trust != Trust::Lost && self.is_near(node) => Stated::Right(node),
            Some(_) => Stated::AsItStands,
            None if self.trust == Trust::Lost => Stated::Absent(None),
            None => Stated::Absent(node_of(self.at)),
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
