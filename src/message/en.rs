//! English.

use super::readable;
use crate::drawing::Visibility;
use crate::finding::{
    CenterFix, Detail, Finding, FixKind, IsoFault, NoFix, NotJudged, ProgramFault, Side,
    SmallRadius,
};

/// What a finding says, for a person: lower-case, no final dot. `unit_mm` is the drawing's unit in mm.
///
/// Names out of the drawing that stand in it are [`readable`].
pub fn sentence(finding: &Finding, unit_mm: f64) -> String {
    readable(&said(finding, unit_mm)).into_owned()
}

fn said(finding: &Finding, unit_mm: f64) -> String {
    match &finding.detail {
        Detail::SmallRadius(numbers) => small_radius(numbers, unit_mm),
        Detail::UnsupportedEntity { kind, count: 1, why } => format!("{kind} is not cut: {why}"),
        Detail::UnsupportedEntity { kind, count, why } => format!("{kind} ({count} of them) is not cut: {why}"),
        Detail::Unseen { layer, visibility, count } => unseen(layer, *visibility, *count),
        Detail::SharpCorner { turn, radius, uncut, count: None } => format!(
            "corner of {:.1}° is left with R {} mm: {} mm of it stay uncut",
            turn.abs().to_degrees(),
            mm(radius * unit_mm),
            mm(uncut * unit_mm)
        ),
        Detail::SharpCorner { turn, radius, count: Some(1), .. } => format!(
            "sharp corner of {:.1}°: where the wire runs inside of it, it is left with R {} mm",
            turn.abs().to_degrees(),
            mm(radius * unit_mm)
        ),
        Detail::SharpCorner { radius, count: Some(count), .. } => {
            format!("{count} sharp corners: those that the wire runs inside of are left with R {} mm", mm(radius * unit_mm))
        }
        Detail::NarrowSlot { width, required } => {
            let (width, required) = told_apart(width * unit_mm, required * unit_mm);
            format!("slot is {width} mm wide, the wire needs {required} mm: it cannot pass without cutting the walls")
        }
        Detail::LostPocket { .. } => "the offset loses this part of the outline: the wire does not reach it".into(),
        Detail::DeadEnd { uncut, .. } => {
            format!("the wire does not reach this part of the outline: {} mm stay uncut", mm(uncut * unit_mm))
        }
        Detail::OffsetCollapse { required, point: true } => format!(
            "at a correction of {} mm a point is left of the outline: the wire is threaded there and cuts nothing more",
            mm(required * unit_mm)
        ),
        Detail::UnprovedPath { .. } => {
            "no path of the wire along this contour holds its proof here: the contour is drawn finer than the path can be told".into()
        }
        Detail::OffsetCollapse { required, point: false } => {
            format!("nothing is left of the outline at a correction of {} mm: the wire does not fit in", mm(required * unit_mm))
        }
        Detail::OpenContour { distance } => format!("contour is open: its ends are {} mm apart", mm(distance * unit_mm)),
        Detail::Gap { distance } => format!("ends do not meet: they are {} mm apart, within the join tolerance", mm(distance * unit_mm)),
        Detail::DuplicateEntity => "entity lies in the same place as another: the wire would cut it twice".into(),
        Detail::Overlap { length } => format!("segment runs on another one over {} mm", mm(length * unit_mm)),
        Detail::NotJudged(what) => not_judged(what),
        Detail::ShortSegment { length: 0.0 } => "segment has no length: it is a point, and is not cut".into(),
        Detail::ShortSegment { length } => format!("segment is only {} mm long: controllers stumble over it", mm(length * unit_mm)),
        Detail::NearTangent { turn } => {
            format!("contour kinks by {:.2}° where it looks tangent: the wire leaves a mark", turn.abs().to_degrees())
        }
        Detail::SelfIntersection { touches, .. } => {
            format!(
                "contour {} here: the wire would cut into the part",
                if *touches { "touches itself or another" } else { "crosses itself or another" }
            )
        }
        Detail::ArcAsChords { chords, radius, deviation, .. } => {
            // Less than a nanometre is rounding.
            let within = if deviation * unit_mm < 1e-6 { String::new() } else { format!(", within {} mm", mm(deviation * unit_mm)) };
            format!("{chords} chords lie on one arc of R {} mm{within}: the wire leaves facets", mm(radius * unit_mm))
        }
        Detail::Size { size } => {
            let what = if size * unit_mm > 1.0 { "more than any machine travels" } else { "less than a wire is thick" };
            format!(
                "the largest contour is {} mm long or wide, {what}: the unit is another one, or the drawing is no part",
                mm(size * unit_mm)
            )
        }
        Detail::Iso(fault) => iso(fault),
        Detail::Program(fault) => program(fault),
        Detail::More { count } => format!("{count} more findings are not shown"),
        Detail::OnePass { passes, correction } => {
            format!("the program holds one of {passes} passes, that of correction {} mm: the others are not written", mm(*correction))
        }
        Detail::LeadIn(sentence) | Detail::Units(sentence) | Detail::Syntax(sentence) | Detail::Settings(sentence) => sentence.clone(),
    }
}

fn unseen(layer: &str, visibility: Visibility, count: usize) -> String {
    let (entities, are) = if count == 1 {
        ("1 entity".to_string(), "is")
    } else {
        (format!("{count} entities"), "are")
    };
    let of_layer = |what: &str| {
        format!(
            "layer {layer} is {what}: {entities} on it {are} not cut, unless the layer has a role ([layers])"
        )
    };
    match visibility {
        Visibility::Frozen => of_layer("frozen"),
        Visibility::Off => of_layer("switched off"),
        Visibility::Invisible => format!("{entities} {are} invisible (group code 60): not cut"),
        Visibility::Unplotted | Visibility::Shown => {
            format!(
                "layer {layer} is not plotted: {entities} on it {are} cut all the same, unless its role is ignore ([layers])"
            )
        }
    }
}

/// What the other place of a finding is, for a person.
pub fn related(finding: &Finding, handle: &str, segment: Option<usize>) -> String {
    let handle = readable(handle);
    let place = segment.map_or_else(
        || handle.to_string(),
        |segment| format!("{handle}, segment {segment}"),
    );
    match finding.detail {
        Detail::NarrowSlot { .. } => format!("the facing wall: {place}"),
        Detail::DeadEnd { .. } => format!("the wire comes no further than here: {place}"),
        Detail::DuplicateEntity => format!("the same place: {place}"),
        Detail::Overlap { .. } => format!("runs on this one: {place}"),
        Detail::LeadIn(_) => format!("what is in the way: {place}"),
        Detail::SelfIntersection { touches: true, .. } => format!("touches this one: {place}"),
        Detail::SelfIntersection { .. } => format!("crosses this one: {place}"),
        Detail::SharpCorner { .. } | Detail::NearTangent { .. } => {
            format!("meets this one: {place}")
        }
        _ => format!("the other one: {place}"),
    }
}

/// What a fix does, as the title of its code action.
pub fn title(kind: &FixKind, unit_mm: f64) -> String {
    match kind {
        FixKind::Refillet {
            radius,
            arcs,
            moved,
        } => {
            let what = if *arcs == 1 {
                "arc".to_string()
            } else {
                format!("{arcs} arcs")
            };
            format!(
                "Replace the {what} by one of R {} mm (moves the contour by {} mm)",
                mm(radius * unit_mm),
                mm(moved * unit_mm)
            )
        }
        FixKind::KeepEndPoints { radius, kink } => format!(
            "Keep the end points, change only the bulge to R {} mm (kinks the contour by {:.1}° at each end, does not reduce the overcut)",
            mm(radius * unit_mm),
            kink.to_degrees()
        ),
        FixKind::Fillet { radius } => {
            format!("Round the corner with R {} mm", mm(radius * unit_mm))
        }
        FixKind::Close { length: 0.0 } => "Close the contour".into(),
        FixKind::Close { length } => format!(
            "Close the contour with a line of {} mm",
            mm(length * unit_mm)
        ),
        FixKind::Snap { distance } => format!(
            "Snap the ends together (moves them by {} mm)",
            mm(distance * unit_mm)
        ),
        FixKind::DeleteDouble => "Delete the double".into(),
        FixKind::DeletePoint => "Delete what has no length".into(),
        FixKind::Merge => "Remove the short segment, its neighbours meet".into(),
        FixKind::MakeTangent { moved } => format!(
            "Make the segments tangent (moves the contour by {} mm)",
            mm(moved * unit_mm)
        ),
        FixKind::SetJ { j } => format!("Set J to {j}"),
        FixKind::SetEnd { axis, value } => format!("Set {} to {value}", axis.letter()),
        FixKind::SetAxis { axis, j: None } => format!("Count G{}", axis.letter()),
        FixKind::SetAxis { axis, j: Some(j) } => format!("Count G{}, J {j}", axis.letter()),
        FixKind::SetMotion { name } => format!("Set Z to {name}"),
        FixKind::SetCoordinates { at: [x, y] } => {
            format!("Set the coordinates to where the block ends ({x:.3}, {y:.3})")
        }
        FixKind::FollowCoordinates => "Change the block to end at its coordinates".into(),
        FixKind::ExchangeXAndY => "Exchange X and Y".into(),
        FixKind::RestoreBlock { block } => {
            format!(
                "Write the block as {}",
                block.split_whitespace().collect::<String>()
            )
        }
        FixKind::DeleteTwin => "Delete the block, which stands twice".into(),
        FixKind::ExchangeBlocks => "Exchange the two blocks".into(),
        FixKind::InsertBlock { length, is_arc } => {
            format!(
                "Put the lost {} of {} mm in",
                if *is_arc { "arc" } else { "line" },
                mm(*length)
            )
        }
        FixKind::InsertB => "Put the lost B back".into(),
        FixKind::NumberWithN => "Write the block number with N".into(),
        FixKind::PlainLetters => "Write plain letters and digits".into(),
        FixKind::DecimalPoints => "Write decimal points".into(),
        FixKind::ZeroForO => "Write a zero for the letter O".into(),
        FixKind::DeleteBlock => "Delete the block".into(),
        FixKind::SplitBlock { pieces } => format!("Split the block into {pieces} that fit"),
        FixKind::SetNumber { number } => format!("Number the block N{number}"),
        FixKind::Renumber { first, step: 1 } => format!("Number all blocks from N{first} on"),
        FixKind::Renumber { first, step } => {
            format!("Number all blocks from N{first} on, in steps of {step}")
        }
        FixKind::AddEnd { word } => format!("End the program with {word}"),
        FixKind::DeleteBehindEnd => "Delete what stands behind the end".into(),
        FixKind::CutRapid => "Cut there (G01) instead of the rapid".into(),
        FixKind::SetCenter { radius, how } => match how {
            CenterFix::OtherConvention => {
                format!(
                    "Take I and J as other controls do, and write them as this program does (R {} mm)",
                    mm(*radius)
                )
            }
            CenterFix::Sign => format!("Put the sign of I and J right (R {} mm)", mm(*radius)),
            CenterFix::Swap => format!("Swap I and J (R {} mm)", mm(*radius)),
            CenterFix::Nearest { moved } => format!(
                "Move the centre by {} mm to where both ends fit (R {} mm)",
                mm(*moved),
                mm(*radius)
            ),
        },
        FixKind::Rewrite { found, meant } if meant.is_empty() => format!("Delete {found}"),
        FixKind::Rewrite { found, meant } if found.is_empty() => format!("Write {meant}"),
        FixKind::Rewrite { found, meant } => format!("Write {meant} for {found}"),
        FixKind::InsertLine { block } => format!("Insert the block {block}"),
        FixKind::SwapSide => "Let the wire run on the other side (swap G41 and G42)".into(),
        FixKind::OneArc { chords, radius } => format!(
            "Replace the {chords} chords by one arc of R {} mm",
            mm(radius * unit_mm)
        ),
    }
}

/// Title of the action that makes every safe fix.
pub fn fix_all_title() -> &'static str {
    "Fix all that can be fixed safely"
}

/// A field that keeps a contour open, as far as can be known from the contour alone.
fn keeps_open(found: &str, meant: &str, is_sure: bool) -> String {
    if is_sure {
        return format!("{found} keeps the contour open: with {meant} it closes");
    }
    format!(
        "{found} may be wrong: the contour does not close, and with {meant} here, and nothing else changed, it would"
    )
}

/// What is wrong in a 3B program, in µm as its blocks count, and what comes of it at the machine.
fn program(fault: &ProgramFault) -> String {
    match fault {
        ProgramFault::MissingB => {
            "a B of the block is missing: the controller takes its numbers for others, or stops"
                .into()
        }
        ProgramFault::BlockNumberAsB { number } => {
            format!(
                "B{number} stands where the block number N{number} was meant: the controller takes {number} for X"
            )
        }
        ProgramFault::LengthInJ {
            j,
            projection,
            axis,
        } => format!(
            "J {j} is the length of the line, the controller counts its projection on {}, {projection} µm: the wire runs too far",
            axis.letter()
        ),
        ProgramFault::WrongJ {
            j: 0,
            projection,
            axis,
        } => {
            format!(
                "J is 0, the line's projection on {} is {projection} µm: the wire does not move",
                axis.letter()
            )
        }
        ProgramFault::WrongJ {
            j,
            projection,
            axis,
        } => format!(
            "J {j} is not the line's projection on {}, {projection} µm: the wire ends {} µm {}",
            axis.letter(),
            (j - projection).abs(),
            if j > projection {
                "too far"
            } else {
                "too early"
            }
        ),
        ProgramFault::JKeepsOpen { j, meant, is_sure } => {
            keeps_open(&format!("J {j}"), &format!("J {meant}"), *is_sure)
        }
        ProgramFault::JOverTurn { j, turn } => {
            format!(
                "J {j} is more than one turn counts, {turn} µm: the wire goes on past its start"
            )
        }
        ProgramFault::SmallerProjection {
            axis,
            counted,
            larger,
        } => {
            format!(
                "G{} counts the smaller projection, {counted} of {larger} units: expected G{}",
                axis.letter(),
                axis.other().letter()
            )
        }
        ProgramFault::ArcEndAxis { axis, x, y } => format!(
            "G{} does not fit the arc's end at ({:.0}, {:.0}) µm from its centre, where it hardly moves on {}: expected G{}",
            axis.letter(),
            x,
            y,
            axis.letter(),
            axis.other().letter()
        ),
        ProgramFault::AxisKeepsOpen { axis, is_sure } => keeps_open(
            &format!("G{}", axis.letter()),
            &format!("G{}", axis.other().letter()),
            *is_sure,
        ),
        ProgramFault::UnusualQuadrant {
            found,
            expected: [one, other],
            axis,
        } => format!(
            "{found} is unusual for a line along {}, where {one} or {other} is written: a controller takes it as it closes the contour, \
             or is 1 µm beside",
            axis.letter()
        ),
        ProgramFault::AxisQuadrant {
            found,
            expected: [one, other],
            axis,
        } => {
            format!(
                "{found} contradicts a line along {}: expected {one} or {other}",
                axis.letter()
            )
        }
        ProgramFault::QuadrantKeepsOpen {
            found,
            meant,
            is_sure,
        } => keeps_open(found, meant, *is_sure),
        ProgramFault::NumberKeepsOpen { axis, value, meant } => {
            let letter = axis.letter();
            keeps_open(
                &format!("{letter} {value}"),
                &format!("{letter} {meant}"),
                true,
            )
        }
        ProgramFault::ExchangedKeepsOpen => {
            "X and Y stand for each other: exchanged, the contour closes".into()
        }
        ProgramFault::TwinKeepsOpen => {
            "the block stands twice: without it the contour closes".into()
        }
        ProgramFault::ZeroBlock => "the block moves nothing: its J is 0".into(),
        ProgramFault::ArcWithoutRadius => {
            "the arc has no radius: X and Y are 0, its start is its centre".into()
        }
        ProgramFault::TooManyDigits {
            field,
            value,
            digits,
        } => {
            format!(
                "{field} {value} has more than the {digits} digits that the controller takes: it cuts digits off, or stops"
            )
        }
        ProgramFault::NotClosed { x, y, .. } => format!(
            "the contour does not close: it ends {} mm beside its beginning (X {:+.3}, Y {:+.3})",
            mm(x.hypot(*y) / 1000.0),
            x / 1000.0,
            y / 1000.0
        ),
        ProgramFault::MissingEnd { word } => {
            format!(
                "the program has no end, expected {word}: the machine waits, or runs what it held before"
            )
        }
        ProgramFault::TextAfterEnd { word } => {
            format!("text behind {word}, which ends the program: the machine does not run it")
        }
        ProgramFault::DoubledNumber { number } => format!("block number N{number} stands twice"),
        ProgramFault::NumberOutOfOrder { expected, number } => {
            format!("block number N{number} is out of turn, expected N{expected}")
        }
        ProgramFault::Unnumbered { expected } => {
            format!("the block has no number, expected N{expected}")
        }
        ProgramFault::PositionMismatch { x, y } => format!(
            "the coordinates behind the block are {} mm from where it ends (X {:+.3}, Y {:+.3})",
            mm(x.hypot(*y) / 1000.0),
            x / 1000.0,
            y / 1000.0
        ),
        ProgramFault::PathCrossesItself { at: [x, y], other } => format!(
            "the wire crosses its own path of line {} here, at ({x:.3}, {y:.3}) mm from the contour's start: it cuts the part in two",
            other + 1
        ),
    }
}

/// What was left out, and why.
fn not_judged(what: &NotJudged) -> String {
    match what {
        NotJudged::Pairs { count } => format!(
            "thousands of entities lie on or across each other: {count} stretches of contours from here on were not compared with what is near them"
        ),
        NotJudged::Crossings { blocks } => {
            format!(
                "so much of the way of these {blocks} blocks lies on one place that crossings were not looked for in all of it"
            )
        }
        NotJudged::Reference {
            copies,
            segments,
            most,
        } => format!(
            "this INSERT draws {copies} copies, {segments} segments in all, more than the {most} that the references of a file may come to: nothing is drawn for it"
        ),
        NotJudged::Calls { lines, calls } => {
            format!(
                "the calls of subprograms come to more than {lines} lines or {calls} calls: what would run from here on is not judged"
            )
        }
    }
}

/// What is wrong in an ISO program. Its lengths are µm.
fn iso(fault: &IsoFault) -> String {
    let side_word = |side: &Side| match side {
        Side::Left => "G41 lets the wire run on the left",
        Side::Right => "G42 lets the wire run on the right",
    };
    match fault {
        IsoFault::OffRadius { start, end } => {
            let (near, far) = told_apart(start / 1e3, end / 1e3);
            format!(
                "the ends of the arc are not on one circle: the start is {near} mm from the centre, the end {far} mm; the control stops here, or cuts another arc"
            )
        }
        IsoFault::NoRadius => "arc without a radius: I, J or R are missing, or the centre is one of its ends".into(),
        IsoFault::Switch { on: true, arc: true } => {
            "the correction is switched on by an arc: controls refuse that, expected a straight cut (G01) to the contour".into()
        }
        IsoFault::Switch { on: false, arc: true } => {
            "the correction is switched off by an arc: controls refuse that, expected a straight cut (G01) off the contour".into()
        }
        IsoFault::Switch { .. } => "the correction is switched on by a rapid: expected a straight cut (G01) to the contour".into(),
        IsoFault::RoleSide { side, punch } => {
            let (is, wanted) = if *punch { ("outside", "opening") } else { ("inside", "punch") };
            format!("{}, which is {is} this contour: the settings say {wanted}, the wire cuts into the part", side_word(side))
        }
        IsoFault::EntrySide { side } => {
            format!("{} of this contour, but it comes to it from the other side: it crosses the part's edge", side_word(side))
        }
        IsoFault::NotClosed { distance } => {
            format!("the cut does not close: it ends {} mm from where it began", mm(distance / 1e3))
        }
        IsoFault::NoEnd { word } => format!("the program has no end, expected {word}: the machine waits for more"),
        IsoFault::BehindEnd => "text behind the end of the program: the machine does not run it".into(),
        IsoFault::NumberTwice { number } => format!("block number N{number} stands twice"),
        IsoFault::Unnumbered { expected } => format!("the block has no number, expected N{expected}"),
        IsoFault::Foreign { word, count: 1 } => format!("{word} is a matter of the machine: it is kept, not followed"),
        IsoFault::Foreign { word, count } => format!("{word} ({count} times) is a matter of the machine: it is kept, not followed"),
        IsoFault::NoSubprogram { number } => format!("subprogram {number} does not stand in this text: it is not followed"),
        IsoFault::EndlessCalls => "the subprograms call each other without end, or too deep: they are not followed further".into(),
        IsoFault::CenterOnLine => "I and J stand beside a straight cut: the control leaves them out, or stops; an arc (G02, G03) may be meant".into(),
        IsoFault::WordTwice { letter } => format!("{letter} stands twice in this line: the control takes the last one, or stops"),
        IsoFault::ReversedArc { is_sure: true } => {
            "the arc runs the wrong way round: the wire turns back on itself here, and with G02 and G03 exchanged it runs on without a corner".into()
        }
        IsoFault::ReversedArc { is_sure: false } => {
            "the arc may run the wrong way round: with G02 and G03 exchanged it goes on without a corner at both ends".into()
        }
        IsoFault::Spur { length } => format!("the wire goes out {} mm and back on the same way", mm(length / 1e3)),
        IsoFault::DoubledBlock { arc: true } => "the block stands twice: the wire goes round a whole circle".into(),
        IsoFault::DoubledBlock { arc: false } => "the block stands twice: the wire is there already".into(),
        IsoFault::NoOffset { side } => {
            format!("{}, and nothing says by how much: expected the place of the correction, such as D1", side_word(side))
        }
        IsoFault::SideChange { side } => {
            format!("{} from here on, in the middle of the cut: it crosses the contour", side_word(side))
        }
        IsoFault::StillOn => "the program ends with the correction on: expected G40 before the way out".into(),
        IsoFault::NoReturn { number } => {
            format!("subprogram {number} has no M99: the control runs on into what stands behind it, or stops")
        }
        IsoFault::NoCorner => "the word for a corner finds none here, or no room for it: the corner stays sharp, or the control stops".into(),
        IsoFault::Bare { word, count: 1 } => {
            format!("{word} has no decimal point, the other numbers have: it is read in whole units, a control may read it in its finest steps")
        }
        IsoFault::Bare { word, count } => format!(
            "{word} and others ({count} in all) have no decimal point, the rest have: they are read in whole units, a control may read them in its finest steps"
        ),
        IsoFault::Pointed { word } => {
            format!("{word} has a decimal point, the other numbers have none: it is read in whole units, they in the finest steps")
        }
        IsoFault::Places { word, usual } => {
            format!("{word} has not {usual} decimals as all other numbers have: a digit may be lost, or one too many")
        }
        IsoFault::LooksLikeInches { size } => format!(
            "the program does not say its unit (G20, G21) and is read in mm: then the part is {} mm long or wide, which speaks for inches (program.units)",
            mm(*size)
        ),
        IsoFault::UnknownValue { word } => {
            format!("{word} hangs on a place of the control's table that the program does not fill: it is not followed")
        }
        IsoFault::Suspect { found, meant, closes } => {
            let comes_of_it = if *closes { "the cut does not close, and it would" } else { "the cut would be sound" };
            match (found.is_empty(), meant.is_empty()) {
                (true, _) => format!("{meant} may be missing here: {comes_of_it} with it, and nothing else changed"),
                (_, true) => format!("{found} may be one too many: {comes_of_it} without it, and nothing else changed"),
                _ => format!("{found} may be wrong: {comes_of_it} with {meant} here, and nothing else changed"),
            }
        }
        IsoFault::OpenCenters => {
            "full circles alone do not tell how I and J are meant: they are taken as leading from the start to the centre".into()
        }
    }
}

fn small_radius(numbers: &SmallRadius, unit_mm: f64) -> String {
    let (radius, required) = told_apart(numbers.radius * unit_mm, numbers.required * unit_mm);
    let pass = numbers
        .pass
        .map_or(String::new(), |pass| format!(" of pass {pass}"));
    let mut text = format!("arc R {radius} mm is below the correction {required} mm{pass}");
    if numbers.overcut * unit_mm >= 0.5e-6 {
        text += &format!(
            ": the wire overcuts the contour by {} mm",
            mm(numbers.overcut * unit_mm)
        );
        if numbers.stock_left.is_finite() {
            text += &format!(
                ", or leaves {} mm where the control trims",
                mm(numbers.stock_left * unit_mm)
            );
        }
    } else {
        text += ": the control loses the arc";
    }
    match numbers.no_fix {
        None => {}
        Some(NoFix::NarrowSlot) => {
            text += &format!(
                "; no arc of the required radius fits here (narrow-slot: the wire needs {} mm)",
                mm(2.0 * numbers.required * unit_mm)
            );
        }
        Some(NoFix::SealsContour) => {
            text += "; the arc that fits would seal the slot (narrow-slot)"
        }
        Some(NoFix::ShortSegment) => {
            text += "; the arc that fits would leave a segment too short to cut (short-segment)"
        }
        Some(NoFix::Spoils) => text += "; the arc that fits here would bring another fault",
        Some(NoFix::NoNeighbour) => {
            text += "; there is no neighbour on both sides that a larger arc could be tangent to"
        }
        Some(NoFix::Program) => text += "; repair it in the drawing, and make the program again",
        Some(NoFix::NotEditable) => text += "; it is part of an entity that cannot be edited here",
    }
    text
}

/// A length in mm with three decimals, or with as many as its first digit needs.
fn mm(length: f64) -> String {
    let places = if length != 0.0 && length.abs() < 0.0005 {
        6
    } else {
        3
    };
    format!("{length:.places$}")
}

/// Two lengths in mm with as many decimals as it takes to tell them apart, at least three.
fn told_apart(one: f64, other: f64) -> (String, String) {
    let digits = |places: usize| (format!("{one:.places$}"), format!("{other:.places$}"));
    (3..=9)
        .map(digits)
        .find(|(a, b)| a != b)
        .unwrap_or_else(|| digits(3))
}
