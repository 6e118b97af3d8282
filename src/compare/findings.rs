//! The findings of a comparison, at the program and at the drawing.

use super::{Comparison, Difference, DifferenceKind, Drawn, Traced, compare};
use crate::finding::{Detail, Finding, Place, Rule, Severity, Unlike};
use crate::geometry::Side;
use crate::settings::Effective;
use std::sync::Arc;

/// What lies beside a document.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Beside {
    #[default]
    Nothing,
    /// The drawing of a program, and the names of other candidates.
    Drawing(Partner<Drawn>, Vec<Arc<str>>),
    /// The programs of a drawing.
    Programs(Vec<Partner<Traced>>),
}

/// The other document: its name, and its content or why it has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Partner<T> {
    pub name: Arc<str>,
    pub made: Result<Arc<T>, String>,
}

/// The data by which a document is compared.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form {
    Drawn(Arc<Drawn>),
    Traced(Arc<Traced>),
}

/// A document by its name, and its data or why there are none.
pub(super) type Other = (Arc<str>, Result<Form, String>);

impl Beside {
    /// What lies beside a program: its drawing, and the names of other candidates.
    pub(crate) fn of_program((name, form): Other, others: Vec<Arc<str>>) -> Beside {
        let made = form.and_then(|form| match form {
            Form::Drawn(drawn) => Ok(drawn),
            Form::Traced(_) => Err(say!(a_program_is_no_drawing).into()),
        });
        Beside::Drawing(Partner { name, made }, others)
    }

    /// What lies beside a drawing: its programs.
    pub(crate) fn of_drawing(programs: impl IntoIterator<Item = Other>) -> Beside {
        let partner = |(name, form): Other| {
            let made = form.and_then(|form| match form {
                Form::Traced(traced) => Ok(traced),
                Form::Drawn(_) => Err(say!(a_drawing_is_no_program).into()),
            });
            Partner { name, made }
        };
        let partners: Vec<_> = programs.into_iter().map(partner).collect();
        match partners.is_empty() {
            true => Beside::Nothing,
            false => Beside::Programs(partners),
        }
    }
}

/// The findings at a program.
pub(crate) fn of_program(
    traced: &Traced,
    drawing: &Partner<Drawn>,
    others: &[Arc<str>],
    settings: &Effective,
) -> Vec<Finding> {
    let other = || drawing.name.clone();
    let mut found = Vec::new();
    if !others.is_empty() {
        let more = Unlike::Several {
            other: other(),
            more: others.join(", "),
        };
        found.extend(finding(more, Place::Document, settings));
    }
    let drawn = match &drawing.made {
        Ok(drawn) => drawn,
        Err(reason) => {
            let unreadable = Unlike::Unreadable {
                other: other(),
                reason: reason.clone(),
            };
            found.extend(finding(unreadable, Place::Document, settings));
            return found;
        }
    };
    if traced.is_empty() {
        return found;
    }
    let Some(Comparison { differences, .. }) = compare(drawn, traced) else {
        let other = other();
        let nothing = match traced.mills {
            true => Unlike::Milled { other },
            false => Unlike::Nothing { other },
        };
        found.extend(finding(nothing, Place::Document, settings));
        return found;
    };
    found.extend(differences.into_iter().filter_map(|difference| {
        let Difference {
            range,
            segment,
            off,
            kind,
            ..
        } = difference;
        let handle = segment.map_or_else(String::new, |(entity, _)| drawn.handle(entity).into());
        let number = segment.map_or(0, |(_, number)| number);
        let unlike = match kind {
            DifferenceKind::Block => Unlike::Block {
                other: other(),
                handle,
                segment: number,
                off,
            },
            DifferenceKind::Moved => Unlike::Moved {
                other: other(),
                handle,
                off,
            },
            DifferenceKind::Unfinished => Unlike::Unfinished {
                other: other(),
                handle,
                segment: number,
            },
            DifferenceKind::Foreign => Unlike::Foreign { other: other() },
            DifferenceKind::Lead => Unlike::Lead {
                other: other(),
                off,
            },
            DifferenceKind::Stated => Unlike::Stated {
                other: other(),
                off,
            },
            DifferenceKind::Side { stated, ideal } => Unlike::Side {
                other: other(),
                said: switch(stated),
                meant: switch(ideal),
            },
            DifferenceKind::Register { stated, ideal } => Unlike::Register {
                other: other(),
                said: stated,
                meant: ideal,
            },
            DifferenceKind::Correction { stated, ideal } => Unlike::Correction {
                other: other(),
                handle,
                said: f64::from(stated) / 1e6,
                meant: f64::from(ideal) / 1e6,
            },
            DifferenceKind::Unstopped => Unlike::Unstopped { other: other() },
            DifferenceKind::Turned { inside } => Unlike::Turned {
                other: other(),
                said: if inside { "D" } else { "DD" }.into(),
                meant: if inside { "DD" } else { "D" }.into(),
            },
            DifferenceKind::Astray => Unlike::Astray {
                other: other(),
                off,
            },
            DifferenceKind::OtherSide => Unlike::OtherSide { other: other() },
            DifferenceKind::Beyond => Unlike::Beyond { other: other() },
        };
        finding(unlike, Place::Text { range }, settings)
    }));
    found
}

/// The word that switches the correction.
fn switch(side: Option<Side>) -> String {
    let word = match side {
        Some(Side::Left) => "G41",
        Some(Side::Right) => "G42",
        None => "G40",
    };
    word.into()
}

/// The findings at a drawing.
pub fn of_drawing(
    drawn: &Drawn,
    programs: &[Partner<Traced>],
    settings: &Effective,
) -> Vec<Finding> {
    let of_one = |program: &Partner<Traced>| {
        let other = || program.name.clone();
        let whole = |unlike| Vec::from_iter(finding(unlike, Place::Document, settings));
        let traced = match &program.made {
            Ok(traced) => traced,
            Err(reason) => {
                return whole(Unlike::Unreadable {
                    other: other(),
                    reason: reason.clone(),
                });
            }
        };
        if traced.is_empty() {
            return Vec::new();
        }
        let Some(Comparison { differences, .. }) = compare(drawn, traced) else {
            // The program has the finding.
            return match traced.mills {
                true => Vec::new(),
                false => whole(Unlike::Nothing { other: other() }),
            };
        };
        let said = differences.into_iter().filter_map(|difference| {
            let (entity, segment) = difference.segment?;
            let (line, off) = (difference.line + 1, difference.off / drawn.unit_mm);
            let unlike = match difference.kind {
                DifferenceKind::Block => Unlike::Segment {
                    other: other(),
                    line,
                    off,
                },
                DifferenceKind::Moved => Unlike::Begin {
                    other: other(),
                    line,
                    off,
                },
                DifferenceKind::Unfinished => Unlike::Left {
                    other: other(),
                    line,
                },
                _ => return None,
            };
            finding(unlike, Place::Segment { entity, segment }, settings)
        });
        said.collect()
    };
    programs.iter().flat_map(of_one).collect()
}

fn finding(unlike: Unlike, place: Place, settings: &Effective) -> Option<Finding> {
    let rule = Rule::NotTheDrawing;
    let severity = if unlike.is_of_whole() {
        settings.severity_over(rule, Severity::Information)
    } else {
        settings.severity(rule)
    };
    Some(Finding {
        rule,
        severity: severity?,
        place,
        detail: Detail::NotTheDrawing(Box::new(unlike)),
        related: Vec::new(),
    })
}
