//! The findings of a comparison, at the program and at the drawing.

use super::{Difference, Drawn, Traced, compare};
use crate::drawing::EntityId;
use crate::finding::{Detail, DifferenceKind, Finding, Place, Rule, Severity, Unlike};
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

impl<T> Partner<T> {
    fn read(&self) -> Result<&T, DifferenceKind> {
        let made = self.made.as_deref();
        made.map_err(|reason| DifferenceKind::Unreadable {
            reason: reason.clone(),
        })
    }
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
    let whole = |kind| whole(&drawing.name, kind, settings);
    let mut found = Vec::new();
    if !others.is_empty() {
        let more = others.join(", ");
        found.extend(whole(DifferenceKind::Several { more }));
    }
    let compared = drawing.read();
    let compared = compared.and_then(|drawn| Ok((drawn, differences(drawn, traced)?)));
    let (drawn, differences) = match compared {
        Ok(compared) => compared,
        Err(kind) => {
            found.extend(whole(kind));
            return found;
        }
    };
    found.extend(differences.into_iter().filter_map(|difference| {
        let handle = |(entity, _): (EntityId, usize)| drawn.handle(entity).into();
        let unlike = Unlike {
            other: drawing.name.clone(),
            line: None,
            segment: difference.segment.map_or(0, |(_, number)| number),
            handle: difference.segment.map_or_else(String::new, handle),
            off: difference.off,
            kind: difference.kind,
        };
        let range = difference.range;
        finding(unlike, Place::Text { range }, settings)
    }));
    found
}

/// The findings at a drawing.
pub fn of_drawing(
    drawn: &Drawn,
    programs: &[Partner<Traced>],
    settings: &Effective,
) -> Vec<Finding> {
    let of_one = |program: &Partner<Traced>| {
        let whole = |kind| Vec::from_iter(whole(&program.name, kind, settings));
        let compared = program.read().and_then(|traced| differences(drawn, traced));
        let differences = match compared {
            Ok(differences) => differences,
            // The program has the finding.
            Err(DifferenceKind::Milled) => return Vec::new(),
            Err(kind) => return whole(kind),
        };
        let said = differences.into_iter().filter_map(|difference| {
            use DifferenceKind::{Block, Moved, Unfinished};
            let (entity, segment) = difference.segment?;
            let is_said = matches!(difference.kind, Block | Moved | Unfinished);
            let unlike = is_said.then(|| Unlike {
                other: program.name.clone(),
                line: Some(difference.line + 1),
                segment: 0,
                handle: String::new(),
                off: difference.off / drawn.unit_mm,
                kind: difference.kind,
            })?;
            finding(unlike, Place::Segment { entity, segment }, settings)
        });
        said.collect()
    };
    programs.iter().flat_map(of_one).collect()
}

/// The differences of a program from a drawing; an error where there is only one thing to say of both as a whole.
fn differences(drawn: &Drawn, traced: &Traced) -> Result<Vec<Difference>, DifferenceKind> {
    if traced.is_empty() {
        return Ok(Vec::new());
    }
    match compare(drawn, traced) {
        Some(compared) => Ok(compared.differences),
        None if traced.mills => Err(DifferenceKind::Milled),
        None => Err(DifferenceKind::Nothing),
    }
}

/// The finding about both documents as a whole.
fn whole(other: &Arc<str>, kind: DifferenceKind, settings: &Effective) -> Option<Finding> {
    let unlike = Unlike {
        other: other.clone(),
        line: None,
        segment: 0,
        handle: String::new(),
        off: 0.0,
        kind,
    };
    finding(unlike, Place::Document, settings)
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
