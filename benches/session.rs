//! Sessions with the real server over its pipes, as an editor or a CAD program sees them: `cargo bench --bench session`.
//!
//! Every figure is printed beside its goal; nothing fails on a slow machine. The clock runs from before the message is
//! written to after the answer has been read and parsed; for what an editor asks, and in rows that say "read", until the answer has been read
//! whole.
//! `-- --quick` makes fewer rounds; `-- NAME …` runs only the sessions whose names hold one of these: "start", "5 MB", "50 MB",
//! "program", "3B", "ISO", "beside", "drawing", "fit", "generate".

mod generated;
#[allow(dead_code)]
#[path = "../tests/support/mod.rs"]
mod support;

use serde_json::{Value, json};
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use support::{Client, capabilities};

/// A text by its name.
type Named = (&'static str, fn() -> String);

fn main() {
    let (options, names): (Vec<String>, Vec<String>) = std::env::args()
        .skip(1)
        .partition(|argument| argument.starts_with("--"));
    let quick = options.iter().any(|option| option == "--quick");
    // Without names, all sessions but the large ones of a quick run.
    let is_chosen = |session: &str| {
        names.iter().any(|name| session.contains(name.as_str())) || names.is_empty()
    };
    let rounds = if quick { 40 } else { 400 };
    println!(
        "{:<58} {:>10} {:>10} {:>10}   goal",
        "", "p50", "p99", "most"
    );
    if is_chosen("start") {
        start(if quick { 5 } else { 30 });
    }
    let texts: [Named; 5] = [
        ("5 MB DXF of LWPOLYLINE", || generated::polylines(5_000_000)),
        ("5 MB DXF of LINE and ARC", || {
            generated::lines_and_arcs(5_000_000)
        }),
        ("5 MB DXF, one LWPOLYLINE", || {
            generated::one_polyline(140_000)
        }),
        ("5 MB DXF, plates of LINE and ARC", || {
            generated::plates(5_000_000)
        }),
        ("5 MB DXF, one fine zigzag", || generated::zigzag(170_000)),
    ];
    for (name, text) in texts.into_iter().filter(|(name, _)| is_chosen(name)) {
        text_session(name, &text(), rounds);
    }
    let large: [Named; 2] = [
        ("50 MB DXF of LWPOLYLINE", || {
            generated::polylines(50_000_000)
        }),
        ("50 MB DXF of LINE and ARC", || {
            generated::lines_and_arcs(50_000_000)
        }),
    ];
    for (name, text) in large
        .into_iter()
        .filter(|(name, _)| is_chosen(name) && !(quick && names.is_empty()))
    {
        large_session(name, &text(), rounds / 4);
    }
    for program in [
        THREE_B,
        ISO,
        THREE_B_ROUND,
        ISO_ROUND,
        ISO_HOLES,
        THREE_B_TABS,
        ISO_TABS,
        THREE_B_OPEN,
        FOUR_B_OPEN,
        ISO_OPEN,
    ] {
        if is_chosen(program.session) || is_chosen(program.name) {
            program_session(&program, rounds);
        }
    }
    if is_chosen("beside") {
        beside_session(rounds);
    }
    if is_chosen("drawing") {
        drawing_session(rounds);
    }
    if is_chosen("fit") {
        fit_session(rounds / 4);
    }
    if is_chosen("generate") {
        generate_session(if quick { 200 } else { 1000 });
    }
}

/// Prints p50, p99 and the largest of some durations.
fn row(name: &str, mut times: Vec<Duration>, goal: &str) {
    times.sort();
    let at = |share: f64| times[((times.len() as f64 * share) as usize).min(times.len() - 1)];
    let ms = |time: Duration| format!("{:.3} ms", time.as_secs_f64() * 1e3);
    println!(
        "{name:<58} {:>10} {:>10} {:>10}   {goal}",
        ms(at(0.5)),
        ms(at(0.99)),
        ms(at(1.0))
    );
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let began = Instant::now();
    let result = work();
    (result, began.elapsed())
}

/// What edits take until their diagnostics have been read whole, and until they have been parsed as well.
#[derive(Default)]
struct Edits {
    read: Vec<Duration>,
    parsed: Vec<Duration>,
}

impl Edits {
    fn time(&mut self, client: &mut Client, uri: &str, edit: impl FnOnce(&mut Client) -> i64) {
        let began = Instant::now();
        let version = edit(client);
        client.diagnostics(uri, version);
        self.parsed.push(began.elapsed());
        let read_at = *client.read_at.lock().expect("the reader does not panic");
        self.read.push(read_at.duration_since(began));
    }

    fn rows(self, name: &str, goal: &str) {
        row(&format!("{name}, edit to diagnostics"), self.parsed, goal);
        row(&format!("{name}, edit to diagnostics read"), self.read, "");
    }
}

/// Memory that the server holds for itself, without the pages of the program file, in bytes; `None` where the system does not
/// tell.
fn resident(client: &Client) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", client.child.id())).ok()?;
    let line = status.lines().find(|line| line.starts_with("RssAnon:"))?;
    line.split_whitespace()
        .nth(1)?
        .parse::<u64>()
        .ok()
        .map(|kibibytes| kibibytes * 1024)
}

/// Right after the opening, and when what the opening left behind has been given back.
fn memory_row(name: &str, client: &Client, length: usize) {
    memory_rows(name, client, |bytes| {
        let times = bytes as f64 / length as f64;
        format!("{times:.1} times the text   goal 10 times")
    });
}

fn memory_rows(name: &str, client: &Client, told: impl Fn(u64) -> String) {
    for (when, pause) in [("", 0), (", a second later", 1000)] {
        std::thread::sleep(Duration::from_millis(pause));
        if let Some(bytes) = resident(client) {
            println!("{name}: resident memory{when} {}", told(bytes));
        }
    }
}

/// An edit of one entity in the middle of a large text.
fn large_session(name: &str, text: &str, rounds: usize) {
    let uri = "file:///bench.dxf";
    let mut client = Client::start();
    let (found, time) = timed(|| client.open_text(uri, "dxf", text));
    row(
        &format!("{name}: open, {} findings", found.len()),
        vec![time],
        "",
    );
    memory_row(name, &client, text.len());
    let middle = text[..text.len() / 2]
        .rfind("\n10\n")
        .map_or(0, |at| at + 4);
    let line = text[..middle].matches('\n').count();
    let dot = text[middle..].find('.').unwrap_or(0);
    let mut version = 1;
    let mut edits = Edits::default();
    for _ in 0..rounds {
        version += 1;
        // A digit after the decimal point: the one entity moves a little.
        let (end, new) = if version % 2 == 0 {
            (dot + 1, "1")
        } else {
            (dot + 2, "")
        };
        let range = json!({ "start": { "line": line, "character": dot + 1 }, "end": { "line": line, "character": end } });
        let changes = json!([{ "range": range, "text": new }]);
        edits.time(&mut client, uri, |client| {
            client
                .notify("textDocument/didChange", json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": changes }));
            version
        });
    }
    edits.rows(&format!("{name}: one digit"), "p99 200 ms");
    client.shut_down();
}

fn start(rounds: usize) {
    let times = (0..rounds)
        .map(|_| timed(|| Client::start_with(capabilities(), json!({}))).1)
        .collect();
    row("start to initialize answered", times, "20 ms");
}

fn text_session(name: &str, text: &str, rounds: usize) {
    let uri = "file:///bench.dxf";
    let mut client = Client::start();
    let (found, time) = timed(|| client.open_text(uri, "dxf", text));
    row(
        &format!("{name}: open, {} findings", found.len()),
        vec![time],
        "250 ms",
    );
    memory_row(name, &client, text.len());
    // A digit of a coordinate in the middle of the file comes and goes.
    let middle = text[..text.len() / 2]
        .rfind("\n10\n")
        .map_or(0, |at| at + 4);
    let line = text[..middle].matches('\n').count();
    let mut version = 1;
    let mut change_in = |client: &mut Client, line: usize, text: &str| {
        version += 1;
        let (end, new) = if version % 2 == 0 { (0, text) } else { (1, "") };
        let range = json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": end } });
        let changes = json!([{ "range": range, "text": new }]);
        client.notify("textDocument/didChange", json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": changes }));
        version
    };
    let mut edits = Edits::default();
    for _ in 0..rounds {
        edits.time(&mut client, uri, |client| change_in(client, line, "1"));
    }
    // A letter before the group code of that coordinate, which is none then.
    let mut of_code = Edits::default();
    for _ in 0..rounds / 4 {
        of_code.time(&mut client, uri, |client| change_in(client, line - 1, "x"));
    }
    of_code.rows(&format!("{name}: one letter at a group code"), "p99 16 ms");
    let mut change = |client: &mut Client| change_in(client, line, "1");
    edits.rows(&format!("{name}: one character"), "p99 16 ms");
    let bursts = (0..if rounds > 100 { 5 } else { 1 }).map(|_| {
        let mut last = 0;
        for _ in 0..30 {
            std::thread::sleep(Duration::from_millis(1000 / 15));
            client.pass_over();
            last = change(&mut client);
        }
        timed(|| client.diagnostics(uri, last)).1
    });
    row(
        &format!("{name}: burst of 30 at 15/s, last answer"),
        bursts.collect(),
        "50 ms",
    );
    language_rows(&mut client, name, uri, line, text.lines().count(), rounds);
    client.shut_down();
}

/// What an editor asks: about the place in the middle, the lines in sight, and the whole text.
fn language_rows(
    client: &mut Client,
    name: &str,
    uri: &str,
    line: usize,
    lines: usize,
    rounds: usize,
) {
    let document = json!({ "uri": uri });
    let at = json!({ "textDocument": document, "position": { "line": line, "character": 0 } });
    let in_sight = |count: usize| {
        let range = json!({ "start": { "line": line, "character": 0 }, "end": { "line": (line + count).min(lines), "character": 0 } });
        json!({ "textDocument": document, "range": range })
    };
    let places =
        json!({ "textDocument": document, "positions": [{ "line": line, "character": 0 }] });
    let whole = json!({ "textDocument": document });
    // To make values of a million tokens takes the client longer than the server takes to find and write them.
    client.skips_results.store(true, Ordering::Release);
    for (what, method, params, rounds, goal) in [
        ("hover", "hover", at.clone(), rounds, "p99 20 ms"),
        ("completion", "completion", at.clone(), rounds, "p99 20 ms"),
        (
            "selection range",
            "selectionRange",
            places,
            rounds,
            "p99 20 ms",
        ),
        (
            "inlay hints of 100 lines",
            "inlayHint",
            in_sight(100),
            rounds,
            "p99 20 ms",
        ),
        (
            "semantic tokens of 100 lines",
            "semanticTokens/range",
            in_sight(100),
            rounds,
            "p99 20 ms",
        ),
        (
            "symbols",
            "documentSymbol",
            whole.clone(),
            rounds / 20,
            "200 ms",
        ),
        (
            "folds",
            "foldingRange",
            whole.clone(),
            rounds / 20,
            "200 ms",
        ),
        (
            "semantic tokens",
            "semanticTokens/full",
            whole,
            rounds / 20,
            "80 ms",
        ),
        ("definition", "definition", at, rounds / 20, "200 ms"),
    ] {
        let times = (0..rounds)
            .map(|_| timed(|| client.request(&format!("textDocument/{method}"), params.clone())).1)
            .collect();
        row(&format!("{name}: {what}"), times, goal);
    }
    client.skips_results.store(false, Ordering::Release);
}

/// A program of 200,000 blocks.
struct Program {
    session: &'static str,
    name: &'static str,
    uri: &'static str,
    language: &'static str,
    text: fn(usize) -> String,
    /// The letters before a number of the block in the middle: a digit in front of the number comes and goes.
    edited: &'static str,
    /// In this layout every line of it is another one.
    layout: &'static str,
    refactorings: &'static [&'static str],
}

const THREE_B: Program = Program {
    session: "program 3B",
    name: "5 MB 3B",
    uri: "file:///bench.3b",
    language: "3b",
    text: generated::three_b,
    edited: "B",
    layout: "checking",
    refactorings: &["reverse", "rotate.left", "merge"],
};

const ISO: Program = Program {
    session: "program ISO",
    name: "5 MB ISO",
    uri: "file:///bench.iso",
    language: "wire-iso",
    text: generated::iso,
    edited: "X",
    layout: "compact",
    refactorings: &[],
};

/// The same squares round and round.
const THREE_B_ROUND: Program = Program {
    name: "5 MB 3B, the same squares round",
    text: generated::three_b_round,
    refactorings: &[],
    ..THREE_B
};

const ISO_ROUND: Program = Program {
    name: "5 MB ISO, the same squares round",
    text: generated::iso_round,
    ..ISO
};

/// Small contours, each of a size of its own, with a way in that the wire runs beside.
const ISO_HOLES: Program = Program {
    name: "5 MB ISO, holes of every size",
    text: generated::iso_holes,
    ..ISO
};

/// Openings with tabs, cut to and fro before them.
const THREE_B_TABS: Program = Program {
    name: "5 MB 3B, passes before tabs",
    text: generated::three_b_tabs,
    refactorings: &[],
    ..THREE_B
};

const ISO_TABS: Program = Program {
    name: "5 MB ISO, passes before tabs",
    text: generated::iso_tabs,
    ..ISO
};

/// Contours that do not close, each of a size of its own.
const THREE_B_OPEN: Program = Program {
    name: "5 MB 3B, contours that stay open",
    text: generated::three_b_open,
    refactorings: &[],
    ..THREE_B
};

const FOUR_B_OPEN: Program = Program {
    name: "5 MB 4B, contours that stay open",
    text: generated::four_b_open,
    refactorings: &[],
    ..THREE_B
};

const ISO_OPEN: Program = Program {
    name: "5 MB ISO, contours that stay open",
    text: generated::iso_open,
    ..ISO
};

/// What an editor asks about it.
fn program_session(program: &Program, rounds: usize) {
    let &Program {
        name,
        uri,
        edited,
        layout,
        ..
    } = program;
    let text = (program.text)(200_000);
    let mut all = capabilities();
    all["textDocument"] =
        json!({ "documentSymbol": { "hierarchicalDocumentSymbolSupport": true } });
    let mut client = Client::start_with(all, json!({}));
    let (found, time) = timed(|| client.open_text(uri, program.language, &text));
    row(
        &format!("{name}: open, {} findings", found.len()),
        vec![time],
        "150 ms",
    );
    memory_rows(name, &client, |bytes| {
        format!("{:.1} MB   goal 25 MB", bytes as f64 / 1e6)
    });
    let half = text.lines().count() / 2;
    let (line, character) = text
        .lines()
        .enumerate()
        .skip(half)
        .find_map(|(line, text)| Some((line, text.find(edited)? + edited.len())))
        .expect("a block in the second half");
    let mut version = 1;
    let mut edits = Edits::default();
    let mut edit = |client: &mut Client, digit: &str| {
        version += 1;
        let comes = version % 2 == 0;
        let end = character + usize::from(!comes);
        let range = json!({ "start": { "line": line, "character": character }, "end": { "line": line, "character": end } });
        let changes = json!([{ "range": range, "text": if comes { digit } else { "" } }]);
        edits.time(client, uri, |client| {
            client
                .notify("textDocument/didChange", json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": changes }));
            version
        });
    };
    for round in 0..rounds {
        edit(
            &mut client,
            ["1", "2", "3", "4", "5", "6", "7", "8", "9"][round / 2 % 9],
        );
    }
    edits.rows(&format!("{name}: one character"), "p99 16 ms");
    let mut edits = Edits::default();
    for _ in 0..(rounds / 40).max(1) {
        version += 1;
        let changes = last_digits(&text);
        edits.time(&mut client, uri, |client| {
            client
                .notify("textDocument/didChange", json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": changes }));
            version
        });
    }
    edits.rows(&format!("{name}: a digit of every line"), "");
    language_rows(&mut client, name, uri, line, text.lines().count(), rounds);
    let whole = json!({ "textDocument": { "uri": uri }, "options": { "tabSize": 4, "insertSpaces": true } });
    let format =
        |client: &mut Client| timed(|| client.request("textDocument/formatting", whole.clone())).1;
    row(
        &format!("{name}: formatting, nothing to change"),
        (0..rounds / 20).map(|_| format(&mut client)).collect(),
        "200 ms",
    );
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": { "wedm": { "program": { "layout": layout } } } }),
    );
    row(
        &format!("{name}: formatting every line"),
        (0..rounds / 20).map(|_| format(&mut client)).collect(),
        "200 ms",
    );
    let place = json!({ "line": line, "character": 0 });
    for kind in program.refactorings {
        let context = json!({ "diagnostics": [], "only": [format!("refactor.rewrite.{kind}")] });
        let params = json!({ "textDocument": { "uri": uri }, "range": { "start": place, "end": place }, "context": context });
        let (_, time) = timed(|| client.request("textDocument/codeAction", params));
        row(&format!("{name}: refactoring {kind}"), vec![time], "");
    }
    client.shut_down();
}

/// The last digit of every line, written again: one change each, from the last line to the first, as an editor sends
/// what a refactoring has changed.
fn last_digits(text: &str) -> Value {
    let change = |(line, text): (usize, &str)| {
        let at = text.rfind(|letter: char| letter.is_ascii_digit())?;
        let place = |character: usize| json!({ "line": line, "character": character });
        let range = json!({ "start": place(at), "end": place(at + 1) });
        Some(json!({ "range": range, "text": &text[at..=at] }))
    };
    let lines: Vec<(usize, &str)> = text.lines().enumerate().collect();
    lines.into_iter().rev().filter_map(change).collect()
}

/// An edit of a small drawing while everything is asked about one place of another document that takes long.
fn beside_session(rounds: usize) {
    let body: String = (0..2_000)
        .map(|number| format!("G01X{}.Y{}.\n", number * 7 % 13, number * 5 % 11))
        .collect();
    let calls = format!("G91\nM98P100L9999\nM02\nO100\n{body}M99\n");
    for (name, text) in [
        ("2,000 blocks called 9,999 times", calls),
        ("5 MB ISO", generated::iso(200_000)),
    ] {
        let (uri, edited) = ("file:///beside.iso", "cad:///edited");
        let mut client = Client::start();
        let plate = support::tight_plate("2A");
        client.open_drawing(edited, json!([plate]));
        client.open_text(uri, "wire-iso", &text);
        let place = json!({ "line": text.lines().count() / 2, "character": 2 });
        let at = json!({ "textDocument": { "uri": uri }, "position": place, "positions": [place], "newName": "7" });
        let methods = [
            "hover",
            "completion",
            "signatureHelp",
            "selectionRange",
            "definition",
            "prepareRename",
            "rename",
        ];
        let edits = (0..rounds / 4).map(|round| {
            let asked = methods.map(|method| {
                let method = format!("textDocument/{method}");
                client.ask(&method, at.clone())
            });
            let version = round as i64 + 2;
            let x = if round % 2 == 0 { 0.0 } else { 0.1 };
            let splice = json!([{ "handle": "2A", "vertices": { "start": 0, "deleteCount": 1, "insert": [[x, 0, 0]] } }]);
            let time = timed(|| {
                client.change_drawing(edited, version, splice);
                client.diagnostics(edited, version)
            })
            .1;
            for id in asked {
                let _ = client.answer(id);
            }
            time
        });
        row(
            &format!("an edit beside questions about {name}"),
            edits.collect(),
            "most 50 ms",
        );
        client.shut_down();
    }
}

fn drawing_session(rounds: usize) {
    let uri = "cad:///bench";
    let mut client = Client::start();
    let entity = json!({ "handle": "2A", "type": "polyline", "closed": true, "vertices": generated::long_outline(1_000_000) });
    let (_, time) = timed(|| client.open_drawing(uri, json!([entity])));
    row("polyline of 1,000,000 vertices: open", vec![time], "");
    let mut version = 1;
    let moves = (0..rounds).map(|round| {
        version += 1;
        let vertex = json!([if round % 2 == 0 { 1.0 } else { 1.5 }, 2.0]);
        let splice = json!([{ "handle": "2A", "vertices": { "start": 500_000, "deleteCount": 1, "insert": [vertex] } }]);
        timed(|| {
            client.change_drawing(uri, version, splice);
            client.diagnostics(uri, version)
        })
        .1
    });
    row(
        "polyline of 1,000,000 vertices: one moves",
        moves.collect(),
        "p99 300 ms",
    );
    client.shut_down();
}

/// A contour of 10,000 segments that is cut twice: whether its parts fit, with the picture of it, and an edit of it.
fn fit_session(rounds: usize) {
    let uri = "cad:///pair";
    let mut client = Client::start_with(
        capabilities(),
        json!({
            "wire-diameter": 0.18,
            "gap": 0.01,
            "pair": { "drawn-as": "punch", "clearance": 0.01 },
        }),
    );
    // The wire rounds its concave corners, but for those of fillets.
    let outline = |count: usize| -> Vec<[f64; 3]> {
        let turn = std::f64::consts::TAU / count as f64;
        let radius = count as f64 * 0.2;
        let vertex = |at: usize| {
            let (sin, cos) = (at as f64 * turn).sin_cos();
            [
                radius * cos,
                radius * sin,
                if at.is_multiple_of(2) { 0.0 } else { 0.3 },
            ]
        };
        (0..count).map(vertex).collect()
    };
    let entity =
        json!({ "handle": "2A", "type": "polyline", "closed": true, "vertices": outline(10_000) });
    client.open_drawing(uri, json!([entity]));
    let request =
        |client: &mut Client| timed(|| client.request("wedm/fit", json!({ "uri": uri }))).1;
    let whole = request(&mut client);
    row("fit of 10,000 segments, first request", vec![whole], "");
    client.skips_results.store(true, Ordering::Release);
    row(
        "fit of 10,000 segments, read",
        (0..rounds).map(|_| request(&mut client)).collect(),
        "p50 20 ms",
    );
    client.skips_results.store(false, Ordering::Release);
    let mut edits = Edits::default();
    let [x, y, _] = outline(10_000)[0];
    for round in 0..rounds {
        let version = round as i64 + 2;
        let vertex = json!([x + if round % 2 == 0 { 0.001 } else { 0.0 }, y]);
        let splice = json!([{ "handle": "2A", "vertices": { "start": 0, "deleteCount": 1, "insert": [vertex] } }]);
        edits.time(&mut client, uri, |client| {
            client.change_drawing(uri, version, splice);
            version
        });
    }
    edits.rows("fit of 10,000 segments: one vertex moves", "p50 5 ms");
    client.shut_down();
}

/// A trivial request while nothing happens, and while a program of 100,000 blocks is written.
fn generate_session(rounds: usize) {
    let (uri, small) = ("cad:///large", "cad:///small");
    let mut client = Client::start_with(
        capabilities(),
        json!({ "correction": 0.03, "side": "opening" }),
    );
    client.open_drawing(
        small,
        json!([{ "handle": "1", "type": "line", "start": [0, 0], "end": [1, 0] }]),
    );
    let ping =
        |client: &mut Client| timed(|| client.request("wedm/inspect", json!({ "uri": small }))).1;
    row(
        "a trivial request, nothing else under way",
        (0..rounds).map(|_| ping(&mut client)).collect(),
        "p99 1 ms",
    );
    // 12,500 openings of eight segments each: a block for each of them.
    let openings: Vec<Value> = (0..12_500)
        .map(|i| {
            let vertices = generated::opening((i % 100) as f64 * 8.0, (i / 100) as f64 * 6.0, 0.3);
            json!({ "handle": format!("{i}"), "type": "polyline", "closed": true, "vertices": vertices })
        })
        .collect();
    client.open_drawing(uri, json!(openings));
    let mut busy = Vec::new();
    let mut programs = Vec::new();
    for _ in 0..if rounds > 500 { 5 } else { 1 } {
        let began = Instant::now();
        let id = client.ask("wedm/generate", json!({ "uri": uri, "format": "3b" }));
        while !client.seen.iter().any(|message| message["id"] == id) {
            busy.push(ping(&mut client));
            assert!(
                began.elapsed() < support::PATIENCE,
                "the program comes in time"
            );
        }
        let program = client.answer(id).unwrap_or_else(|error| panic!("{error}"));
        programs.push((began.elapsed(), program["blocks"].as_u64().unwrap_or(0)));
    }
    row("a trivial request while 3B is generated", busy, "p99 20 ms");
    let blocks = programs.first().map_or(0, |(_, blocks)| *blocks);
    row(
        &format!("3B of {blocks} blocks, proved"),
        programs.into_iter().map(|(time, _)| time).collect(),
        "",
    );
    client.shut_down();
}
