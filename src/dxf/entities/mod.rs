//! The kinds of entities, one file each, and the choice of the one that reads a record.

mod circle;
mod line;
mod mark;
mod polyline;

pub(in crate::dxf) use circle::mirrored_angles;
pub(in crate::dxf) use polyline::{count_finding, mirror, read_run};

use super::entity::{Outcome, Refused, pass_over};
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::{curve, insert};
use crate::drawing::Kind;
use crate::text::head;

/// Reads the entity whose record begins at `start`; the lexer stands after its name.
pub(in crate::dxf) fn read(start: Tag, lexer: &mut Lexer, layers: &mut Layers) -> Outcome {
    let name = lexer.lines.trimmed(start.value_line());
    let read = match name {
        b"LWPOLYLINE" => polyline::light_polyline(start, lexer, layers),
        b"LINE" => line::line(start, lexer, layers),
        b"ARC" => circle::arc(start, lexer, layers),
        b"CIRCLE" => circle::circle(start, lexer, layers),
        b"TEXT" => mark::text(Kind::Text, start, lexer, layers),
        b"MTEXT" => mark::text(Kind::LongText, start, lexer, layers),
        b"POLYLINE" => polyline::polyline(start, lexer, layers),
        b"ELLIPSE" => curve::read_ellipse(start, lexer, layers),
        b"SPLINE" => curve::read_spline(start, lexer, layers),
        b"POINT" => mark::point(start, lexer, layers),
        b"INSERT" => match insert::read(start, lexer, layers) {
            Ok(insert) => return Outcome::Insert(Box::new(insert)),
            Err(refused) => Err(refused),
        },
        _ if pass_over(lexer) => Err(Refused::Unsupported(say!(it_lies_in_paper_space))),
        b"HATCH" | b"MPOLYGON" => Err(Refused::Unsupported(say!(only_its_boundary_could_be_cut))),
        b"REGION" | b"BODY" | b"3DSOLID" | b"SURFACE" => {
            Err(Refused::Unsupported(say!(its_edges_cannot_be_read)))
        }
        b"SOLID" | b"TRACE" | b"WIPEOUT" => {
            Err(Refused::Unsupported(say!(its_edges_are_no_contour)))
        }
        _ => Err(Refused::Unsupported(say!(this_kind_is_not_cut))),
    };
    match read {
        Ok(read) => Outcome::Entity(read),
        Err(Refused::Damaged) => Outcome::Damaged,
        Err(Refused::Unsupported(why)) => {
            let kind = String::from_utf8_lossy(head(name, 64)).into_owned();
            Outcome::Unsupported(kind, why)
        }
    }
}
