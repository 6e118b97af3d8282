//! The drawing in numbers: what a viewer paints by itself where there are too many elements for its tree.

use super::numbers::{push_thousandths, thousandths};
use super::reach::{Reach, each_part};
use crate::geometry::{Point, Segment};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// From this many elements on a picture can be had in pieces.
pub(super) const MANY: usize = 2_000;

/// A line or an area of the drawing.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Piece {
    /// As the element of the SVG has it.
    pub(crate) class: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) handle: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
    /// In the picture of a program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) line: Option<usize>,
    /// The width of the kerf that the wire cuts along it, thousandths of the local coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) width: Option<i64>,
    /// The number of a contour in the order of the cuts, at its thread hole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) order: Option<usize>,
    /// `x, y` where it begins, then `x, y, radius` of each line and arc of it: where that ends, 0 for a line, and below 0 for an arc
    /// that runs clockwise; an arc is less than a half turn. Thousandths of the local coordinates, y upwards.
    pub(crate) at: Vec<i64>,
}

impl Piece {
    /// A thread hole at a place in thousandths.
    pub(super) fn thread(at: [i64; 2], order: Option<usize>) -> Piece {
        let at = at.to_vec();
        Piece {
            order,
            ..What::of("thread").piece(at)
        }
    }
}

/// What an element of the drawing is, and what it stands for.
#[derive(Clone, Copy, Default)]
pub(super) struct What<'a> {
    pub(super) class: &'a str,
    pub(super) handle: Option<&'a str>,
    pub(super) segment: Option<usize>,
    pub(super) pass: Option<usize>,
    pub(super) line: Option<usize>,
    /// The width of a kerf, in local coordinates.
    pub(super) width: Option<f64>,
}

impl<'a> What<'a> {
    pub(super) fn of(class: &'a str) -> What<'a> {
        What {
            class,
            ..What::default()
        }
    }

    pub(super) fn piece(&self, at: Vec<i64>) -> Piece {
        Piece {
            class: self.class.into(),
            handle: self.handle.map(Into::into),
            segment: self.segment,
            line: self.line,
            width: self.width.map(thousandths),
            order: None,
            at,
        }
    }
}

/// Where the local coordinates of a drawing begin, and how many of theirs are one of its units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    pub(super) origin: Point,
    pub(super) scale: f64,
}

impl Local {
    /// A place in thousandths.
    pub(super) fn place(self, point: Point) -> [i64; 2] {
        let at = (point - self.origin) * self.scale;
        [at.x, at.y].map(thousandths)
    }
}

/// The segments as runs that are drawn without lifting the pen, in the numbers of [`Piece::at`]. What lies farther away than
/// `FARTHEST` is left out; of an `area` the edge there takes its place.
///
/// An arc is split into pieces of less than a half turn, so that a full circle is drawn, and so that no viewer has to
/// guess which of two arcs is meant.
pub(super) fn runs(
    local: Local,
    segments: impl IntoIterator<Item = Segment>,
    area: bool,
) -> Vec<Vec<i64>> {
    let mut runs = Vec::new();
    let mut is_lifted = true;
    for segment in segments {
        each_part(local.origin, local.scale, segment, &mut |part| match part {
            Reach::Near(segment) => push(local, &mut runs, &mut is_lifted, &segment),
            Reach::Far(along) if area => push(local, &mut runs, &mut is_lifted, &along),
            // A line that leaves the sheet comes back to it in another place.
            Reach::Far(_) => is_lifted = true,
        });
    }
    runs
}

fn push(local: Local, runs: &mut Vec<Vec<i64>>, is_lifted: &mut bool, segment: &Segment) {
    let start = local.place(segment.start());
    if std::mem::take(is_lifted) {
        runs.push(start.to_vec());
    }
    let Some(run) = runs.last_mut() else { return };
    let stands = match run[..] {
        [x, y] | [.., x, y, _] => [x, y],
        _ => start,
    };
    if stands != start {
        run.extend([start[0], start[1], 0]);
    }
    let mut to = |[x, y]: [i64; 2], radius| run.extend([x, y, radius]);
    match segment {
        Segment::Line(_) => to(local.place(segment.end()), 0),
        Segment::Arc(arc) => {
            let pieces = (arc.sweep.abs() / (0.9 * PI)).ceil().max(1.0);
            let radius = thousandths(arc.radius * local.scale);
            let radius = if arc.sweep > 0.0 { radius } else { -radius };
            for piece in 1..pieces as u32 {
                to(local.place(arc.point_at(f64::from(piece) / pieces)), radius);
            }
            to(local.place(segment.end()), radius);
        }
    }
}

/// Runs as path data.
pub(super) fn data_of_runs(runs: &[Vec<i64>], close: bool) -> String {
    let mut data = String::new();
    for run in runs {
        let [x, y, rest @ ..] = &run[..] else {
            continue;
        };
        push_place(&mut data, 'M', [*x, *y]);
        for part in rest.chunks_exact(3) {
            let [x, y, radius] = *part else { continue };
            if radius == 0 {
                push_place(&mut data, 'L', [x, y]);
                continue;
            }
            data.push('A');
            push_thousandths(&mut data, radius.abs());
            data.push(' ');
            push_thousandths(&mut data, radius.abs());
            data.push_str(if radius > 0 { " 0 0 1" } else { " 0 0 0" });
            push_place(&mut data, ' ', [x, y]);
        }
    }
    if close && !data.is_empty() {
        data.push('Z');
    }
    data
}

fn push_place(data: &mut String, before: char, [x, y]: [i64; 2]) {
    data.push(before);
    push_thousandths(data, x);
    data.push(' ');
    push_thousandths(data, y);
}
