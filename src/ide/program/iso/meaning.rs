//! What a word of a line says to the machine: what every control takes alike, and what is a matter of the machine said to be so.

use crate::program::iso::block::{Offset, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::machine::{CenterRule, Machine};
use crate::program::iso::word::{Number, Token, words};
use std::ops::Range;

/// What the word at a range of bytes says in its line, in Markdown; `None` for what means nothing.
pub fn meaning(document: &Document, word: Range<usize>) -> Option<String> {
    let text = document.text();
    let line = text.line_of(word.start);
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone())?;
    let mut found = None;
    words(bytes, range.start, |token| {
        if range_of(&token).start == word.start {
            found = Some(token);
        }
    });
    let before = document.machine_before(line).unwrap_or_default();
    let shown = String::from_utf8_lossy(text.bytes().get(word)?).to_ascii_uppercase();
    match found? {
        Token::Word { letter, number, .. } => Some(About { document, bytes, before }.word(letter, number, &shown)),
        Token::Definition { letter: letter @ (b'D' | b'H'), value: Some(value), .. } => {
            let length = mm(document.reading().length(value, before.inch));
            let letter = letter as char;
            Some(format!("**{shown}** value for the control's table: where {letter} names this place, the correction is {length} mm"))
        }
        Token::Sum { letter: letter @ (b'D' | b'H'), index, .. } => {
            let index = index.whole().and_then(|whole| u32::try_from(whole).ok())?;
            let holds = document.table_value(Offset { letter, index }).map_or_else(
                || "what it comes to hangs on places that the program does not fill".to_owned(),
                |value| format!("it comes to {} mm", mm(value)),
            );
            Some(format!("**{shown}** value for the control's table, reckoned from others of it: {holds}"))
        }
        Token::Corner { round, number, .. } => {
            let length = mm(document.reading().length(number, before.inch));
            let what = if round { "rounded with R" } else { "chamfered, from each of its walls" };
            Some(format!("**{shown}** the corner at the end of this cut is {what} {length} mm"))
        }
        Token::Definition { .. } | Token::Sum { .. } | Token::Foreign { .. } => {
            Some(format!("**{shown}** a matter of the machine: it is kept, not followed"))
        }
        Token::Tape { .. } => Some("**%** where the program begins and ends on tape".into()),
        Token::Skip { .. } => Some("**/** the block is left out where the operator has switched that on: a matter of the machine".into()),
        Token::Comment { .. } | Token::Fault { .. } => None,
    }
}

fn range_of(token: &Token) -> Range<usize> {
    match token {
        Token::Word { range, .. }
        | Token::Definition { range, .. }
        | Token::Sum { range, .. }
        | Token::Corner { range, .. }
        | Token::Foreign { range }
        | Token::Comment { range }
        | Token::Tape { range }
        | Token::Skip { range }
        | Token::Fault { range, .. } => range.clone(),
    }
}

/// nm as mm, with as many decimals as say something, at least three.
fn mm(length: i64) -> String {
    let text = format!("{:.6}", length as f64 / 1e6);
    let kept = text.find('.').map_or(text.len(), |point| point + 4);
    let (head, tail) = text.split_at(kept.min(text.len()));
    let text = format!("{head}{}", tail.trim_end_matches('0'));
    if text == "-0.000" {
        "0.000".into()
    } else {
        text
    }
}

struct About<'a> {
    document: &'a Document,
    /// The line.
    bytes: &'a [u8],
    /// What is in force before the line.
    before: Machine,
}

impl About<'_> {
    fn word(&self, letter: u8, number: Number, shown: &str) -> String {
        let foreign = |usual: Option<&str>| match usual {
            Some(usual) => {
                format!("**{shown}** a matter of the machine: {usual}. It is kept, not followed")
            }
            None => format!("**{shown}** a matter of the machine: it is kept, not followed"),
        };
        match letter {
            b'G' => known_g(number).map_or_else(
                || foreign(usual_g(number)),
                |about| format!("**{shown}** {about}"),
            ),
            b'M' => known_m(number).map_or_else(
                || foreign(usual_m(number)),
                |about| format!("**{shown}** {about}"),
            ),
            b'N' => format!(
                "**{shown}** block number: it has no meaning for the path, but a call (`M98 P…`) may name it"
            ),
            b'O' => {
                format!("**{shown}** number of a program, or of a subprogram that `M98 P…` calls")
            }
            b'X' | b'Y' => format!("**{shown}** {}", self.coordinate(letter, number)),
            b'I' | b'J' => format!("**{shown}** {}", self.center(letter, number)),
            b'R' => format!(
                "**{shown}** radius of the arc, {} mm; a negative one turns by more than 180°",
                self.length(number)
            ),
            b'D' | b'H' => format!("**{shown}** {}", self.offset(letter, number)),
            b'F' => format!("**{shown}** feed; its unit is a matter of the machine"),
            b'P' => self.subprogram(shown),
            b'L' => format!("**{shown}** how often the subprogram that `M98` calls is run"),
            b'U' | b'V' => foreign(Some("the upper guide's way along X or Y, or the taper's")),
            b'Z' => foreign(Some("a height: of the guides, or of the part")),
            b'A' => foreign(Some("an angle, mostly the taper's")),
            b'C' | b'E' | b'S' => foreign(Some("a cutting condition: generator and flushing")),
            b'T' => foreign(Some("a switch, such as pump and wire feed")),
            b'Q' | b'K' => foreign(Some("a parameter of a cycle")),
            _ => foreign(None),
        }
    }

    fn length(&self, number: Number) -> String {
        mm(self.document.reading().length(number, self.inch()))
    }

    fn inch(&self) -> bool {
        self.in_force().inch
    }

    /// What is in force behind the line's own words.
    fn in_force(&self) -> Machine {
        let mut machine = self.before;
        let block = read_line(self.bytes, 1, |_| {});
        machine.incremental = block.incremental.unwrap_or(machine.incremental);
        machine.inch = block.inch.unwrap_or(machine.inch);
        machine
    }

    fn coordinate(&self, letter: u8, number: Number) -> String {
        let (letter, length) = (letter as char, self.length(number));
        let block = read_line(self.bytes, 1, |_| {});
        if block.sets_position {
            return format!("G92: the wire stands at {letter} {length} mm");
        }
        if block.takes_coordinates {
            return format!("{length} mm along {letter}, for the word of this line that takes it");
        }
        match self.in_force().incremental {
            true => format!("{length} mm along {letter} from where the wire stands (G91)"),
            false => format!("to {letter} {length} mm from the program's zero (G90)"),
        }
    }

    fn center(&self, letter: u8, number: Number) -> String {
        let axis = if letter == b'I' { 'X' } else { 'Y' };
        let length = self.length(number);
        let meant = match self.document.reading().rule(self.in_force().incremental) {
            CenterRule::StartToCenter => {
                format!("{length} mm along {axis} from the arc's start to its centre")
            }
            CenterRule::CenterToStart => {
                format!("{length} mm along {axis} from the arc's centre to its start")
            }
            CenterRule::Absolute => {
                format!("the arc's centre lies at {axis} {length} mm from the program's zero")
            }
        };
        let known = if self.document.evidence().leaves_centers_open() {
            "full circles leave that open, so it is taken as the profile has it"
        } else {
            "found from the arcs of this program, machines differ in it"
        };
        format!("{meant} ({known})")
    }

    fn offset(&self, letter: u8, number: Number) -> String {
        let index = number
            .whole()
            .and_then(|whole| u32::try_from(whole).ok())
            .unwrap_or(u32::MAX);
        let place = format!("place {index} of the control's table of corrections");
        match self.document.table_value(Offset { letter, index }) {
            Some(value) => format!("{place}: {} mm, as this program sets it", mm(value)),
            None => format!(
                "{place}, not a length. What it holds is a matter of the machine: arcs are held against the setting, {} mm",
                mm((self.document.limits.correction * 1e6).round() as i64)
            ),
        }
    }

    fn subprogram(&self, shown: &str) -> String {
        let block = read_line(self.bytes, 1, |_| {});
        match (block.call, block.takes_coordinates) {
            (Some(number), _) => {
                format!("**{shown}** runs the subprogram that begins at N{number} or O{number}")
            }
            (None, true) => format!(
                "**{shown}** how long the machine waits; its unit is a matter of the machine"
            ),
            (None, false) => {
                format!("**{shown}** a matter of the machine: it is kept, not followed")
            }
        }
    }
}

/// G words that every control takes alike.
pub(super) fn known_g(number: Number) -> Option<&'static str> {
    Some(match (number.mantissa, number.decimals) {
        (0, 0) => "rapid: moves without cutting; in force until another of G00 to G03",
        (1, 0) => "cuts along a straight line; in force until another of G00 to G03",
        (2, 0) => {
            "cuts along an arc clockwise, about I and J or with R; in force until another of G00 to G03"
        }
        (3, 0) => {
            "cuts along an arc counter-clockwise, about I and J or with R; in force until another of G00 to G03"
        }
        (4, 0) => "waits, for as long as P or X says",
        (17, 0) => "arcs lie in the plane of X and Y",
        (20 | 70, 0) => "lengths are inches",
        (21 | 71, 0) => "lengths are millimetres",
        (40, 0) => {
            "ends the correction: from the next straight cut on the wire runs on the contour"
        }
        (41, 0) => {
            "correction: the control lets the wire run on the left of the contour, as far as D or H says"
        }
        (42, 0) => {
            "correction: the control lets the wire run on the right of the contour, as far as D or H says"
        }
        (90, 0) => "coordinates are absolute, counted from the program's zero",
        (91, 0) => "coordinates count from where the wire stands",
        (92, 0) => "says where the wire stands: X and Y of this line",
        (901 | 911, 1) => "says how I and J are meant, which is found from the arcs themselves",
        _ => return None,
    })
}

/// What a G word that is a matter of the machine mostly means on machines that cut with a wire.
fn usual_g(number: Number) -> Option<&'static str> {
    if number.decimals > 0 {
        return None;
    }
    Some(match number.mantissa {
        5..=12 => "on fast-wire controls it mirrors or swaps the axes, G12 ends that",
        22 | 23 => "a limit of travel, or a mode of corners",
        28..=30 => "goes to a place that the machine knows",
        38 | 39 => "how the correction is switched, or what is done at corners",
        48 | 49 => "whether corners are rounded",
        50 => "ends the taper",
        51 | 52 => "taper: the wire leans to the left (G51) or to the right (G52) of the way",
        54..=59 => "chooses a system of coordinates",
        60 | 61 => "how exactly a corner is run to, or what the taper does there",
        80..=82 => "moves until the wire touches",
        84 => "aligns the wire",
        93 => "shifts the zero",
        94 | 95 => "how the feed is controlled",
        _ => return None,
    })
}

/// M words that every control takes alike.
pub(super) fn known_m(number: Number) -> Option<&'static str> {
    Some(match number.whole()? {
        0 => "stop: the machine waits for the operator, as to thread the wire",
        1 => "stop, where the operator has switched that on",
        2 => "end of the program",
        30 => "end of the program, back to its begin",
        98 => "runs the subprogram that P names, as often as L says",
        99 => "end of a subprogram: goes on behind the call",
        _ => return None,
    })
}

/// What an M word that is a matter of the machine mostly means on machines that cut with a wire.
fn usual_m(number: Number) -> Option<&'static str> {
    Some(match number.whole()? {
        5 => "on fast-wire controls the next move ignores that the wire touches",
        6 | 20 | 60 => "threads the wire",
        21 | 50 => "cuts the wire off",
        17 => "end of a subprogram",
        80..=89 => "switches the generator, the water, the wire's feed or tension",
        96 | 97 => "calls a subprogram or ends it",
        _ => return None,
    })
}
