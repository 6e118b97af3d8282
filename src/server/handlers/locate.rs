//! `wedm/locate`: the segment at a position, and the position of a segment.

use super::no_entity;
use crate::drawing::EntityId;
use crate::dxf;
use crate::finding::Place;
use crate::protocol::{Locate, Located, Position};
use crate::server::context::RequestContext;
use crate::server::convert::range_of;
use crate::server::errors::refused;
use crate::text::Encoding;
use tower_lsp::jsonrpc::{Error, Result};

pub(in crate::server) fn locate(
    context: &RequestContext,
    params: Locate,
) -> Result<Option<Located>> {
    let encoding = context.encoding;
    let text = context
        .dxf()
        .ok_or_else(|| refused(say!(is_no_dxf_text, context.uri)))?;
    match (params.position, &params.handle) {
        (Some(position), None) => Ok(at_position(text, position, encoding)),
        (None, Some(handle)) => at_segment(text, handle, params.segment, encoding).map(Some),
        _ => Err(Error::invalid_params(say!(
            expected_either_position_or_handle
        ))),
    }
}

fn at_position(text: &dxf::Document, position: Position, encoding: Encoding) -> Option<Located> {
    let offset = text.text().offset_of(
        position.line as usize,
        position.character as usize,
        encoding,
    );
    match text.segments_at(offset..offset).first() {
        Some(&(entity, segment)) => located(text, entity, Some(segment), encoding),
        None => located(text, text.entity_at(offset)?, None, encoding),
    }
}

fn at_segment(
    text: &dxf::Document,
    handle: &str,
    segment: Option<usize>,
    encoding: Encoding,
) -> Result<Located> {
    let drawing = text.drawing();
    let entity = drawing.find(handle).ok_or_else(|| no_entity(handle))?;
    let count = drawing
        .get(entity)
        .map_or(0, |entity| entity.geometry.segment_count());
    if let Some(segment) = segment.filter(|&segment| segment >= count) {
        return Err(Error::invalid_params(say!(
            there_is_no_segment_in,
            segment,
            handle,
            count.saturating_sub(1)
        )));
    }
    located(text, entity, segment, encoding).ok_or_else(|| no_entity(handle))
}

fn located(
    text: &dxf::Document,
    entity: EntityId,
    segment: Option<usize>,
    encoding: Encoding,
) -> Option<Located> {
    let handle = text.drawing().get(entity)?.handle.to_string();
    let place = match segment {
        Some(segment) => Place::Segment { entity, segment },
        None => Place::Entity { entity },
    };
    Some(Located {
        handle,
        segment,
        range: range_of(text.text(), text.range_of(&place), encoding),
    })
}
