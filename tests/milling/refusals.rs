//! What is said of a drawing, of the settings and of a program.

use super::*;
use crate::size::by_day;

fn refused(drawing: &Drawing, text: &str, format: Format) -> Refusal {
    match generated(drawing, text, format) {
        Ok(made) => panic!("{text}: {}", made.program.text),
        Err(refusal) => refusal,
    }
}

#[test]
fn what_is_missing_or_contradicts_itself_is_said_where_it_stands() {
    for (text, place, says) in [
        (
            "[milling]\ntool-diameter = 1\n",
            "milling",
            "expected milling.gap, milling.layer, milling.depth, milling.wear to be set",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\n",
            "milling",
            "expected milling.wear to be set",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0.1\nwear-compensation = \"linear\"\n",
            "milling",
            "expected milling.step to be set",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.3\ndepth = 0.2\nwear = 0.1\n",
            "layer",
            "milling.layer is 0.3, expected at most milling.depth 0.2",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.000001\ndepth = 2\nwear = 0.1\n",
            "layer",
            "2000000 layers",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = -0.1\n",
            "-0.1",
            "milling.wear is -0.1, expected a number from 0 to 100",
        ),
        (
            "[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 1e9\n",
            "1e9",
            "expected a number from 0 to 100",
        ),
        (
            "[milling]\ntool-diameter = 0\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0\n",
            "0\ngap",
            "milling.tool-diameter is 0, expected a number above 0",
        ),
        (
            "[milling]\nwear-compensation = \"uni\"\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0\n",
            "\"uni\"",
            "none, uniform, linear",
        ),
    ] {
        let (set, errors) = from_toml(text);
        let error = errors
            .iter()
            .find(|error| error.message.contains(says))
            .unwrap_or_else(|| panic!("{text}: {errors:?}"));
        let range = error
            .range
            .clone()
            .unwrap_or_else(|| panic!("{text}: no place"));
        assert!(text[range.start..].starts_with(place), "{text}: {range:?}");
        // And nothing is made with it.
        let Err(sentence) = Effective::of(&set).electrode() else {
            continue;
        };
        let drawing = drawing(&[(false, SLOT)]);
        let source = Source::Cad(Arc::new(drawing));
        let document = Document::new(source, Arc::new(Effective::of(&set)));
        let refusal = generate(&document, Format::Milling, true);
        assert!(
            matches!(refusal, Err(Refusal::Sentence(said)) if said == sentence),
            "{text}"
        );
    }
    assert!(Effective::default().electrode().is_err());
}

fn rules(findings: &[Finding]) -> Vec<Rule> {
    let mut rules: Vec<Rule> = findings.iter().map(|finding| finding.rule).collect();
    rules.dedup();
    rules
}

#[test]
fn what_cannot_be_milled_is_refused_at_its_place() {
    // An electrode that is larger than its slot, whatever the wire beside it is.
    let narrow: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 0.8, 0.0],
        [0.0, 0.8, 0.0],
    ];
    for text in [
        ELECTRODE.to_owned(),
        format!("correction = 0.1\n{ELECTRODE}"),
    ] {
        match refused(&drawing(&[(true, narrow)]), &text, Format::Milling) {
            Refusal::Errors(found) => {
                assert!(rules(&found).contains(&Rule::NarrowSlot), "{found:?}");
                assert!(rules(&found).contains(&Rule::OffsetCollapse), "{found:?}");
            }
            other => panic!("{other:?}"),
        }
    }
    let small = ring(0.3);
    let refusal = refused(&drawing(&[(true, &small)]), ELECTRODE, Format::Milling);
    assert!(matches!(refusal, Refusal::Errors(_)), "{refusal:?}");
    // Steps that are longer than the way.
    let text = format!("{ELECTRODE}wear-compensation = \"linear\"\nstep = 12\n");
    match refused(&drawing(&[(false, SLOT)]), &text, Format::Milling) {
        Refusal::Findings(found) => {
            assert_eq!(rules(&found), [Rule::Settings]);
            assert_eq!(found[0].severity, Severity::Error);
        }
        other => panic!("{other:?}"),
    }
    // A contour that was most likely meant to be closed is not milled along its line.
    let nearly: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
        [0.0, 0.5, 0.0],
    ];
    match refused(&drawing(&[(false, nearly)]), ELECTRODE, Format::Milling) {
        Refusal::Errors(found) => assert_eq!(rules(&found), [Rule::OpenContour]),
        other => panic!("{other:?}"),
    }
    // Layers finer than the numbers of the program.
    let text = ELECTRODE.replace("layer = 0.010", "layer = 0.0005");
    let refusal = refused(&drawing(&[(false, SLOT)]), &text, Format::Milling);
    assert!(matches!(refusal, Refusal::Sentence(_)), "{refusal:?}");
    // Where only an electrode is known no wire cuts, and a program of heights becomes no other.
    for format in [Format::ThreeB, Format::FourB, Format::Iso] {
        let refusal = refused(&drawing(&[(true, &ring(3.0))]), ELECTRODE, format);
        assert!(matches!(refusal, Refusal::Sentence(_)), "{refusal:?}");
        let text = format!("correction = 0.1\n{ELECTRODE}");
        assert!(generated(&drawing(&[(true, &ring(3.0))]), &text, format).is_ok());
    }
}

/// What a drawing says while one draws it for an electrode.
#[test]
fn a_drawing_is_judged_for_the_electrode_where_nothing_is_said_of_a_wire() {
    let judged = |contours: &[(bool, &[[f64; 3]])], text: &str| {
        let source = Source::Cad(Arc::new(drawing(contours)));
        let document = Document::new(source, Arc::new(settings(text)));
        rules(&document.all_findings())
    };
    // A radius below that of the electrode's path in a pocket; along a slot it is as it is drawn.
    let rounded: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [9.7, 0.0, 0.41421356],
        [10.0, 0.3, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    assert!(judged(&[(true, rounded)], ELECTRODE).contains(&Rule::SmallRadius));
    assert!(
        !judged(
            &[(true, rounded)],
            &format!("correction = 0.1\n{ELECTRODE}")
        )
        .contains(&Rule::SmallRadius)
    );
    let open: &[[f64; 3]] = &rounded[..4];
    let beside: &[[f64; 3]] = &[[0.0, -1.2, 0.0], [9.0, -1.2, 0.0]];
    assert_eq!(
        judged(&[(false, open), (false, beside)], ELECTRODE),
        [Rule::OpenContour]
    );
}

/// A milling program follows its drawing as it was written, and one whose numbers were changed by 3 µm is told at its line; one that was
/// written under other settings is not compared, and nothing in it is named.
#[test]
fn a_milling_program_is_held_against_its_drawing() {
    let ring = ring(1.27);
    for (contours, way) in [
        (vec![(false, SLOT)], "none"),
        (vec![(true, &ring[..])], "uniform"),
        (vec![(true, &ring[..]), (false, SLOT)], "linear"),
    ] {
        let of = |depth: f64| {
            format!(
                "side = \"opening\"\n[milling]\ntool-diameter = 0.5\ngap = 0.02\nlayer = 0.05\ndepth = {depth}\nwear = 0.02\n\
                 wear-compensation = \"{way}\"\nstep = 0.5\n"
            )
        };
        let (text, drawing) = (of(0.2), drawing(&contours));
        let program = milled(&drawing, &text).program.text;
        let told = |program: &str, text: &str| {
            let settings = Arc::new(settings(text));
            let source = Source::Cad(Arc::new(drawing.clone()));
            let drawn = Document::new(source, settings.clone()).drawn().unwrap();
            let read = wedm::program::Document::read(Language::Iso, program.into(), &settings);
            let found = compare(&drawn, &Traced::of(&read))?.differences;
            Some(found.iter().map(|one| one.line).collect::<Vec<_>>())
        };
        assert_eq!(told(&program, &text), Some(Vec::new()), "{way}\n{program}");
        assert_eq!(told(&program, &of(0.3)), None, "{way}");
        let mut changed = 0;
        for (line, own) in program.lines().enumerate() {
            for letter in ['X', 'Y', 'I', 'J'] {
                let Some(at) = own
                    .find(letter)
                    .filter(|_| own.starts_with("G01") || own.starts_with("G03"))
                else {
                    continue;
                };
                let end = own[at..].find(' ').map_or(own.len(), |end| at + end);
                let number: f64 = own[at + 1..end].parse().unwrap();
                changed += 1;
                if changed % by_day(15, 5) != 0 {
                    continue;
                }
                let new = format!("{}{:.3}{}", &own[..=at], number + 0.003, &own[end..]);
                let mut lines: Vec<&str> = program.lines().collect();
                lines[line] = &new;
                let found = told(&(lines.join("\n") + "\n"), &text);
                assert_eq!(
                    found,
                    Some(vec![line]),
                    "{way}: line {}: {own} {new}",
                    line + 1
                );
            }
        }
        assert!(changed > 7, "{way}");
    }
}
