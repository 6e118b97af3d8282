//! Reads item by item: sections, the entities of the modelspace; everything else is skipped.

use super::entities;
use super::entity::{self, Outcome};
use super::fault::{self, quoted};
use super::layer_table::{self, LayerEntry};
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::lines::BYTE_ORDER_MARK;
use super::number::{self, Number};
use super::shape::Shape;
use super::space::Lies;
use super::table::{Became, Context};
use super::unit::StatedUnit;
use crate::finding::{Finding, Severity};
use crate::geometry::Unfit;
use crate::text::head;

/// The content of one item of the text.
#[derive(Debug)]
pub(super) enum Said {
    /// Kept, without a meaning here.
    Nothing,
    /// Another section: whether ENTITIES begins, and what a HEADER states of the unit.
    Structure {
        entities: bool,
        unit: StatedUnit,
    },
    Entity(Outcome),
    /// A block of the drawing begins.
    Block,
    /// An entry of the table LAYER.
    Layer(LayerEntry),
}

impl Said {
    /// A section ends, or one begins that states nothing.
    const END: Said = Said::Structure {
        entities: false,
        unit: StatedUnit {
            insunits: None,
            measurement: None,
        },
    };

    pub(super) fn structure(&self) -> Option<Became> {
        match *self {
            Said::Structure { entities, unit } => Some(Became::Structure { entities, unit }),
            _ => None,
        }
    }

    pub(super) fn entity(&self) -> Option<&entity::Read> {
        match self {
            Said::Entity(Outcome::Entity(read)) => Some(read),
            _ => None,
        }
    }
}

pub(super) struct ReadItem {
    pub(super) line: usize,
    pub(super) context: Context,
    pub(super) said: Said,
    /// The section after it.
    pub(super) after: Context,
}

/// Reads the item at which the lexer stands; `None` at the end of the text. Curves of the modelspace become arcs within
/// `tolerance`; those of blocks stay curves until they are placed.
pub(super) fn read_item(
    lexer: &mut Lexer,
    context: Context,
    tolerance: f64,
    layers: &mut Layers,
) -> Option<ReadItem> {
    let line = lexer.at();
    if lexer.at_end() {
        return None;
    }
    lexer.begin_item(line);
    let already = lexer.findings.len();
    if line == 0 && lexer.lines.has_byte_order_mark() {
        fault::push(
            &mut lexer.findings,
            0..BYTE_ORDER_MARK.len(),
            Severity::Hint,
            say!(the_text_begins_with_a_byte_order_mark).into(),
        );
    }
    let item = |(said, after)| ReadItem {
        line,
        context,
        said,
        after,
    };
    let Some(start) = lexer.peek_record() else {
        // Only at the beginning of the text, before its first record.
        entity::pass_over(lexer);
        close(None, already, lexer, context);
        return Some(item((Said::Nothing, context)));
    };
    lexer.pass(start);
    let mut read = item(said_by(start, lexer, context, tolerance, layers));
    let cut = close(Some((start, &read)), already, lexer, read.after);
    if cut {
        read.said = Said::Entity(Outcome::Damaged);
    }
    Some(read)
}

/// What a record says, read to its end, and the context after it.
fn said_by(
    start: Tag,
    lexer: &mut Lexer,
    context: Context,
    tolerance: f64,
    layers: &mut Layers,
) -> (Said, Context) {
    let name = lexer.lines.trimmed(start.value_line());
    match (context, name) {
        (_, b"SECTION") => {
            if context != Context::Outside {
                lexer.oddity(
                    start.value_line(),
                    say!(section_begins_before_endsec_of_the_one_before).into(),
                );
            }
            section(start, lexer)
        }
        (_, b"ENDSEC") => {
            entity::pass_over(lexer);
            (Said::END, Context::Outside)
        }
        (_, b"EOF") => {
            if context != Context::Outside {
                lexer.oddity(
                    start.value_line(),
                    say!(eof_stands_before_endsec_of_the_last_section).into(),
                );
            }
            pass_over_what_follows(lexer);
            (Said::END, Context::Outside)
        }
        (Context::Blocks, b"BLOCK") => {
            entity::pass_over(lexer);
            (Said::Block, context)
        }
        (Context::Blocks, b"ENDBLK") => {
            entity::pass_over(lexer);
            (Said::Nothing, context)
        }
        (Context::Entities | Context::Blocks, b"VERTEX" | b"SEQEND" | b"ATTRIB") => {
            let sentence = say!(
                does_not_follow_an_entity_that_it_is_a_part,
                String::from_utf8_lossy(name)
            );
            lexer.oddity(start.value_line(), sentence);
            entity::pass_over(lexer);
            (Said::Nothing, context)
        }
        (Context::Blocks, _) => (Said::Entity(entities::read(start, lexer, layers)), context),
        (Context::Entities, _) => {
            let outcome = entities::read(start, lexer, layers);
            (
                Said::Entity(drawn(outcome, start, lexer, tolerance)),
                context,
            )
        }
        (Context::Other, b"LAYER") => {
            entity::pass_over(lexer);
            let entry = layer_table::read(lexer.lines, start.line..lexer.at(), |name| {
                layers.name(name)
            });
            (entry.map_or(Said::Nothing, Said::Layer), context)
        }
        (Context::Other, _) => {
            entity::pass_over(lexer);
            (Said::Nothing, context)
        }
        (Context::Outside, _) => {
            let kind = String::from_utf8_lossy(head(name, 64)).into_owned();
            entity::pass_over(lexer);
            (
                Said::Entity(Outcome::Unsupported(
                    kind,
                    say!(it_stands_outside_of_entities),
                )),
                context,
            )
        }
    }
}

/// The entity with its geometry in the modelspace; a fault where its curve has none.
fn drawn(outcome: Outcome, start: Tag, lexer: &mut Lexer, tolerance: f64) -> Outcome {
    let Outcome::Entity(read) = outcome else {
        return outcome;
    };
    if let Lies::Aslant(_, why) = read.lies {
        return Outcome::Unsupported(read.kind.name().into(), why);
    }
    if let Shape::Plain(_) = read.shape {
        return Outcome::Entity(read);
    }
    match read.shape.drawn(tolerance) {
        Ok((geometry, times)) => {
            if times > 1.0 {
                let kind = read.kind;
                let sentence = say!(takes_too_many_arcs_for_its_size, kind, times);
                lexer.oddity(start.value_line(), sentence);
            }
            Outcome::Entity(entity::Read {
                shape: Shape::Plain(geometry),
                ..read
            })
        }
        Err(why) => {
            let sentence = match why {
                Unfit::NoCurve => say!(has_no_length_or_numbers_beyond_all_measure, read.kind),
                Unfit::TooManyArcs(most) => {
                    say!(takes_more_arcs_than_are_drawn, read.kind, most)
                }
            };
            lexer.damage(start.value_line(), sentence);
            Outcome::Damaged
        }
    }
}

/// After EOF nothing is read. Anything there has a finding, except the end mark of old systems (^Z).
fn pass_over_what_follows(lexer: &mut Lexer) {
    let blank = |line: &usize| {
        let content = lexer.lines.content(*line);
        content.iter().all(u8::is_ascii_whitespace)
    };
    let odd = (lexer.at()..lexer.lines.count()).find(|line| !blank(line));
    // Old systems fill the last sector of a file with whatever they have after the mark.
    let is_end_mark = |line: &usize| lexer.lines.content(*line).trim_ascii().starts_with(b"\x1a");
    if let Some(line) = odd.filter(|line| !is_end_mark(line)) {
        lexer.oddity(line, say!(what_stands_behind_eof_is_not_read).into());
    }
    lexer.begin_item(lexer.lines.count());
}

/// The place of a finding of the text, by which findings are sorted.
pub(super) fn range_key(finding: &Finding) -> (usize, usize) {
    match &finding.place {
        crate::finding::Place::Text { range } => (range.start, range.end),
        _ => (0, 0),
    }
}

/// The finding when the text ends with this item. True when the entity in it is cut off and must not be trusted.
fn close(
    read: Option<(Tag, &ReadItem)>,
    already: usize,
    lexer: &mut Lexer,
    after: Context,
) -> bool {
    if !lexer.at_end() {
        return false;
    }
    let open = lexer.lines.last_is_open()
        && !lexer
            .lines
            .trimmed(lexer.lines.count().saturating_sub(1))
            .is_empty();
    let cut = lexer.dangling.is_some() || open;
    if let Some((
        start,
        ReadItem {
            said: Said::Entity(outcome),
            context: Context::Entities,
            ..
        },
    )) = read
    {
        let name = lexer.lines.trimmed_range(start.value_line());
        let is_of_name = |finding: &Finding| range_key(finding) == (name.start, name.end);
        // Here the text ends between two tags: an entity that lacks something and has no other fault was cut off there.
        let lacks = matches!(outcome, Outcome::Damaged)
            && lexer.findings.iter().skip(already).all(is_of_name);
        if !cut && !lacks {
            return end_of_section(already, lexer, after);
        }
        // The missing part of the entity is beyond the end: one fault, one finding.
        lexer.findings.truncate(already);
        let kind = quoted(lexer.lines.trimmed(start.value_line()));
        lexer.damage_in(
            name,
            say!(the_text_ends_inside_this, kind.trim_matches('"')),
        );
        return true;
    }
    if let Some(last) = lexer.dangling {
        lexer.findings.truncate(already);
        let code = quoted(lexer.lines.trimmed(last));
        lexer.damage_in(
            lexer.lines.range(last),
            say!(the_text_ends_after_group_code_expected_its_value, code),
        );
        return false;
    }
    match read {
        Some((start, _)) if lexer.lines.trimmed(start.value_line()) == b"EOF" => false,
        _ => end_of_section(already, lexer, after),
    }
}

/// Reports that the text ends too early, unless its last item has been reported so. False: nothing in it is cut off.
fn end_of_section(already: usize, lexer: &mut Lexer, after: Context) -> bool {
    if lexer.findings.len() == already {
        let sentence = match after {
            Context::Entities | Context::Blocks | Context::Other => {
                say!(the_text_ends_inside_a_section_expected_endsec)
            }
            Context::Outside => say!(the_text_ends_without_eof),
        };
        lexer.oddity_in(
            lexer.lines.range(lexer.lines.count().saturating_sub(1)),
            sentence.into(),
        );
    }
    false
}

/// SECTION, its name and, in HEADER, its variables.
fn section(start: Tag, lexer: &mut Lexer) -> (Said, Context) {
    let mut name: Option<&[u8]> = None;
    let (mut variable, mut unit): (&[u8], _) = (b"", StatedUnit::default());
    while let Some(tag) = lexer.next() {
        let value = lexer.lines.trimmed(tag.value_line());
        match tag.code {
            0 => {
                lexer.back_to(tag);
                break;
            }
            2 if name.is_none() => name = Some(value),
            9 => variable = value,
            70 if name == Some(b"HEADER") => {
                let whole = match number::number(value) {
                    Number::Exact(value) if value.fract() == 0.0 && value.abs() < 1e6 => {
                        Some(value as i32)
                    }
                    _ => None,
                };
                match variable {
                    b"$MEASUREMENT" => unit.measurement = whole,
                    b"$INSUNITS" if whole.is_none() => {
                        let sentence = say!(
                            group_code_70_of_insunits_is_expected_a_whole_number,
                            quoted(value)
                        );
                        lexer.damage_in(lexer.lines.range(tag.value_line()), sentence);
                    }
                    b"$INSUNITS" => unit.insunits = whole,
                    _ => {}
                }
            }
            _ => {}
        }
    }
    match name {
        Some(b"ENTITIES") => (
            Said::Structure {
                entities: true,
                unit: StatedUnit::default(),
            },
            Context::Entities,
        ),
        Some(b"BLOCKS") => (Said::END, Context::Blocks),
        Some(_) => (
            Said::Structure {
                entities: false,
                unit,
            },
            Context::Other,
        ),
        None => {
            let sentence = say!(section_lacks_group_code_2).to_owned();
            if !lexer.out_of_step {
                lexer.damage(start.value_line(), sentence);
            }
            (Said::END, Context::Other)
        }
    }
}
