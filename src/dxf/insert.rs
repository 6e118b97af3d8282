//! INSERT: which block it draws, where, how often, and how it is stretched.

use super::entity::{Common, Insert, Plane, Refused, pass_over_followers, value_line_of};
use super::fault::quoted;
use super::layers::Layers;
use super::lexer::{Lexer, Tag};
use super::numbers::{Numbers, missing};
use super::space::{Space, Vector3, in_space};
use crate::geometry::{Vector, direction, left_normal};

/// Block names ignore case.
pub(super) fn block_key(name: &[u8]) -> String {
    match std::str::from_utf8(name) {
        Ok(name) => name.to_lowercase(),
        Err(_) => name
            .iter()
            .map(|&byte| char::from(byte.to_ascii_lowercase()))
            .collect(),
    }
}

pub(super) fn read(start: Tag, lexer: &mut Lexer, layers: &mut Layers) -> Result<Insert, Refused> {
    let mut numbers = Numbers::new([10, 20, 41, 42, 50, 44, 45, 30, 43]);
    let (mut name, mut columns, mut rows) = (None, None, None);
    let mut common = numbers.gather(lexer, |_, tag| match tag.code {
        2 => name = Some(tag),
        70 => columns = Some(tag),
        71 => rows = Some(tag),
        _ => {}
    });
    let count = |tag: Option<Tag>, common: &mut Common, lexer: &mut Lexer| match tag {
        Some(tag) if Common::whole(lexer, tag).is_none() => {
            common.bad = true;
            let found = quoted(lexer.lines.trimmed(tag.value_line()));
            let sentence = say!(
                group_code_of_insert_is_expected_a_whole_number,
                tag.code,
                found
            );
            lexer.damage(tag.value_line(), sentence);
            1
        }
        Some(tag) => Common::whole(lexer, tag)
            .and_then(|count| u64::try_from(count).ok())
            .unwrap_or(1)
            .max(1),
        None => 1,
    };
    let columns = if lexer.out_of_step {
        1
    } else {
        count(columns, &mut common, lexer)
    };
    let rows = if lexer.out_of_step {
        1
    } else {
        count(rows, &mut common, lexer)
    };
    pass_over_followers(lexer, &[b"ATTRIB", b"SEQEND"]);
    let [x, y] = numbers.required(start, lexer, &common)?;
    let Some(name) = name else {
        missing(start, lexer, &[(2, false)]);
        return Err(Refused::Damaged);
    };
    common.is_in_the_model()?;
    let system = match common.plane() {
        Plane::Normal => Some(Space::IDENTITY),
        Plane::Mirrored => Some(Space {
            x: -Vector3::x(),
            z: -Vector3::z(),
            ..Space::IDENTITY
        }),
        Plane::Tilted => Space::of_extrusion(common.normal()),
    };
    let Some(system) = system else {
        return Err(Refused::Unsupported(say!(its_plane_is_tilted)));
    };
    let [
        _,
        _,
        x_scale,
        y_scale,
        rotation,
        column_step,
        row_step,
        height,
        z_scale,
    ] = numbers.values;
    // A scale of 0 would flatten the block; programs write it for an unset scale.
    for (code, axis, value) in [(41, 'x', x_scale), (42, 'y', y_scale), (43, 'z', z_scale)] {
        if value == Some(0.0) {
            let place = lexer.lines.trimmed_range(value_line_of(start, lexer, code));
            let sentence = say!(a_scale_of_insert_is_0, code, axis);
            lexer.oddity_in(place, sentence);
        }
    }
    let scale = |value: Option<f64>| value.filter(|&value| value != 0.0).unwrap_or(1.0);
    let along = turned(rotation.unwrap_or(0.0));
    let across = left_normal(along);
    let seen = |vector: Vector| system.vector(in_space(vector, 0.0));
    let map = Space {
        x: seen(along * scale(x_scale)),
        y: seen(across * scale(y_scale)),
        z: system.z * scale(z_scale),
        origin: system.vector(Vector3::new(x, y, height.unwrap_or(0.0))),
    };
    Ok(Insert {
        block: block_key(lexer.lines.trimmed(name.value_line())),
        name_line: name.value_line(),
        map,
        columns: (columns, seen(along * column_step.unwrap_or(0.0))),
        rows: (rows, seen(across * row_step.unwrap_or(0.0))),
        handle: common.handle(lexer),
        appearance: common.appearance(lexer, layers),
        layer: common.layer(lexer, layers),
    })
}

/// The direction of an angle in degrees, exact at quarter turns.
fn turned(degrees: f64) -> Vector {
    match degrees.rem_euclid(360.0) {
        0.0 => Vector::new(1.0, 0.0),
        90.0 => Vector::new(0.0, 1.0),
        180.0 => Vector::new(-1.0, 0.0),
        270.0 => Vector::new(0.0, -1.0),
        angle => direction(angle.to_radians()),
    }
}
