use super::*;
use proptest::prelude::*;

/// Bytes that come a few at a time, as from a pipe.
struct Trickle<'a>(&'a [u8], usize);

impl Read for Trickle<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let count = self.1.min(self.0.len()).min(into.len());
        into[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        Ok(count)
    }
}

#[test]
fn a_body_over_the_limit_is_passed_over_and_said_by_its_length() {
    let header = |length: u64| format!("Content-Length: {length}\r\n\r\n");
    let input = header(BODY_CAP + 1) + "{}";
    let mut frames = Frames::new(Trickle(input.as_bytes(), 7));
    let expected = say!(a_body_is_over_the_limit, BODY_CAP + 1, BODY_CAP);
    assert_eq!(frames.step(), Frame::Broken(expected));
    // A body as long as the limit is only cut short here.
    let input = header(BODY_CAP) + "{}";
    let next = Frames::new(Trickle(input.as_bytes(), 7)).step();
    let over = say!(a_body_is_over_the_limit, BODY_CAP, BODY_CAP);
    assert_ne!(next, Frame::Broken(over));
}

fn frames(input: &str, broken_bodies: &[&str]) -> Vec<String> {
    let run = |step: usize| {
        let mut frames = Frames::new(Trickle(input.as_bytes(), step));
        let mut seen = Vec::new();
        let mut used = 0;
        loop {
            let next = frames.step();
            assert!(
                frames.position() > used || next == Frame::End,
                "{input:?} in steps of {step}: nothing was used up"
            );
            match next {
                Frame::Body(body) => {
                    let text = String::from_utf8_lossy(&body).into_owned();
                    if broken_bodies.contains(&text.as_str()) {
                        frames.was_broken(&body);
                        seen.push("!".into());
                    } else {
                        seen.push(text);
                    }
                }
                Frame::Broken(_) => seen.push("?".into()),
                Frame::End => return seen,
            }
            assert!(
                frames.position() > used,
                "{input:?} in steps of {step}: a broken body was given back whole"
            );
            used = frames.position();
        }
    };
    let seen = run(usize::MAX);
    for step in [1, 2, 7] {
        assert_eq!(run(step), seen, "{input:?} in steps of {step}");
    }
    seen
}

#[test]
fn a_long_body_is_held_once_and_not_kept() {
    let body = " ".repeat(20 * CHUNK);
    let input = format!("Content-Length: {}\r\n\r\n{body}", body.len());
    let mut frames = Frames::new(input.as_bytes());
    assert_eq!(frames.step(), Frame::Body(body.into_bytes()));
    assert!(frames.buffer.capacity() <= CHUNK);
    assert_eq!(frames.position(), input.len() as i64);
    assert_eq!(frames.step(), Frame::End);
}

#[test]
fn a_broken_frame_costs_itself_alone() {
    let check = |input: &str, broken: &[&str], expected: &[&str]| {
        assert_eq!(frames(input, broken), expected, "{input:?}")
    };
    let good = "Content-Length: 2\r\n\r\n{}";
    check("", &[], &[]);
    check(&format!("{good}{good}"), &[], &["{}", "{}"]);
    check("content-length:2\n\n{}", &[], &["{}"]);
    check(
        "Content-Type: a; charset=utf-8\r\nContent-Length: 2\r\n\r\n{}",
        &[],
        &["{}"],
    );
    check(&format!("\r\n\r\n{good}\r\n{good}"), &[], &["{}", "{}"]);
    check(
        &format!("Content-Length: x\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Length: -5\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Type: x\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(&format!("what is this\r\n{good}"), &[], &["?", "{}"]);
    check(&format!("what is this{good}"), &[], &["?", "{}"]);
    check(
        &format!("Content-Length: 1\r\n\r\n{{}}{good}"),
        &["{"],
        &["!", "{}"],
    );
    check(
        &format!("Content-Length: 8\r\n\r\n{{}}{good}"),
        &["{}Conten"],
        &["!", "{}"],
    );
    check(
        &format!("Content-Length: 100\r\n\r\n{{}}{good}{good}"),
        &[],
        &["?", "{}", "{}"],
    );
    check(
        &format!("Content-Length: 99999999999\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Length: 99999999999999999999999\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check("Content-Length: 10\r\n\r\n{}", &[], &["?"]);
    check("Content-Length: 10", &[], &["?"]);
    check(
        &format!("{}{good}", "\0".repeat(100_000)),
        &[],
        &["?", "{}"],
    );
    // A blank line forgotten, something printed, an invalid header: between frames and within one.
    check("Content-Length: 5\r\nx\r\n", &[], &["?"]);
    check(
        &format!("Content-Length: 5\r\nx\r\n{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Length: 2\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Length: 2\r\n{{}}\n{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Length: 2\r\nContent Type: x\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content Type: x\r\nContent-Length: 2\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}", "{}"],
    );
    check(
        &format!("starting up\nContent-Length: 2\r\nstill starting up\r\n\r\n{{}}{good}"),
        &[],
        &["?", "?", "{}"],
    );
    check(
        &format!("Content-Length: 2\r\nContent-Length: 2\r\n\r\n{{}}{good}"),
        &[],
        &["{}", "{}"],
    );
    check(
        &format!("Content-Length: 2\r\nContent-Length: x\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("A: b\r\nContent-Length: 99999999999999999999999\r\n\r\n{{}}{good}"),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("{}{good}", "Content-Length: 5\r\nx\r\n".repeat(3)),
        &[],
        &["?", "?", "?", "{}"],
    );
    check(&format!("\u{b}{good}"), &[], &["?", "{}"]);
    check(&format!("ready{good}"), &[], &["?", "{}"]);
    check(&format!("state: ready{good}"), &[], &["?", "{}"]);
    check(&format!("Content-Length: 1{good}"), &[], &["?", "{}"]);
    check("Content-Length: 0\r\n\r\n", &[""], &["!"]);
    // Headers without end, in lines and in one.
    check(
        &format!("{}\r\n{good}", "A: b\r\n".repeat(100_000)),
        &[],
        &["?", "{}"],
    );
    check(
        &format!("Content-Length: 2\r\n{}{good}", "a".repeat(100_000)),
        &[],
        &["?", "{}"],
    );
    let long = "7".repeat(200_000);
    check(
        &format!("Content-Length: 200000\r\n\r\n{long}{good}"),
        &[],
        &[&long, "{}"],
    );
}

proptest! {
    /// The pieces of frames, in any order: every step uses up bytes, however few come at a time.
    #[test]
    fn every_step_uses_up_bytes(pieces in prop::collection::vec(0_usize..PIECES.len(), 0..40), broken in any::<bool>()) {
        let input: String = pieces.into_iter().map(|piece| PIECES[piece]).collect();
        frames(&input, if broken { &["{}", "", "C", "{"] } else { &[] });
    }
}

const PIECES: [&str; 24] = [
    "Content-Length: 2\r\n",
    "Content-Length: 0\r\n",
    "Content-Length: 30\r\n",
    "Content-Length: 99999999999\r\n",
    "Content-Length: 99999999999999999999999\r\n",
    "Content-Length: x\r\n",
    "Content-Length:",
    "content-length:1",
    "Content Type: x\r\n",
    "Content-Type: x\r\n",
    "\r\n",
    "\n",
    "\r",
    "{}",
    "{",
    "C",
    "x\r\n",
    ": ",
    " ",
    "5",
    "\0",
    "\u{b}",
    "Content-Length: 2\r\n\r\n{}",
    "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
];
