//! A model-based soak: random edits of many documents of all kinds against the real server, every offered action and refactoring
//! applied. Whatever happens, no answer is an internal error, the finding of a fix goes, no fix brings an error, memory and latency stay
//! flat, and in the end the server says what one says that is opened from scratch.
//!
//! A seed makes one sequence of steps; how far it goes depends on the time. For hours, with other seeds:
//! `WEDM_SOAK_SEED=7 WEDM_SOAK_SECONDS=3600 cargo test --test server soak -- --nocapture`.

#[path = "soak/model.rs"]
mod model;
#[path = "soak/process.rs"]
mod process;
#[path = "soak/seeds.rs"]
mod seeds;

use crate::support::{Client, capabilities};
use model::{Model, Random};
use process::{resident, worked};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// What the tests of the project take: this long, or this many steps.
const SECONDS: u64 = 60;
const STEPS: u64 = 1_300;

/// No further action of one document is tried after this time.
const ACTING: Duration = Duration::from_secs(10);

/// Findings of one document, one above the other, and where they came from.
#[derive(Clone, Debug, PartialEq)]
struct Told(Vec<Value>);

impl Told {
    fn errors(&self) -> u64 {
        self.count(|finding| finding["severity"] == 1)
    }

    fn of_rule(&self, code: &Value) -> u64 {
        self.count(|finding| finding["code"] == *code)
    }

    /// How much is found: a finding may stand for several places.
    fn count(&self, is_counted: impl Fn(&Value) -> bool) -> u64 {
        let counted = self.0.iter().filter(|finding| is_counted(finding));
        counted
            .map(|finding| finding["data"]["count"].as_u64().unwrap_or(1))
            .sum()
    }

    fn alike(&self, finding: &Value) -> usize {
        self.0
            .iter()
            .filter(|other| {
                other["code"] == finding["code"] && other["message"] == finding["message"]
            })
            .count()
    }
}

fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name)
        .ok()
        .and_then(|number| number.parse().ok())
        .unwrap_or(usual)
}

#[test]
fn whatever_is_edited_and_repaired_the_server_stays_right_and_small() {
    let seed = number("WEDM_SOAK_SEED", 20_261_122);
    let seconds = number("WEDM_SOAK_SECONDS", SECONDS);
    let steps = if std::env::var("WEDM_SOAK_SECONDS").is_ok() {
        u64::MAX
    } else {
        STEPS
    } as usize;
    println!("WEDM_SOAK_SEED={seed} WEDM_SOAK_SECONDS={seconds}");
    let mut soak = Soak::new(seed);
    let until = Instant::now() + Duration::from_secs(seconds);
    let half = Instant::now() + Duration::from_secs(seconds / 2);
    let half_steps = steps / 2;
    let (mut early, mut early_memory) = (0, 0);
    while Instant::now() < until && soak.steps < steps {
        soak.step();
        if early == 0 && (Instant::now() > half || soak.steps > half_steps) {
            (early, early_memory) = (soak.edits.len(), resident(&soak.client));
        }
    }
    soak.compare_all();
    let late_memory = resident(&soak.client);
    let (first, second) = soak.edits.split_at(early.max(1));
    println!(
        "{} steps, {} actions applied, edits {:?} then {:?} of the processor, memory {} then {} MiB",
        soak.steps,
        soak.applied,
        mean(first),
        mean(second),
        early_memory / 1024,
        late_memory / 1024
    );
    // Flat, by the processor: others may use the machine as well.
    assert!(
        mean(second) <= mean(first) * 4 + Duration::from_millis(50),
        "edits take longer: {:?}, {:?}",
        mean(first),
        mean(second)
    );
    assert!(
        late_memory <= early_memory + early_memory / 2 + 64 * 1024,
        "memory grows: {early_memory} kB, {late_memory} kB"
    );
    soak.client.shut_down();
}

/// The ticks in which processor time is counted are longer than most edits: only many together say something.
fn mean(times: &[Duration]) -> Duration {
    times.iter().sum::<Duration>() / times.len().max(1) as u32
}

struct Soak {
    seed: u64,
    random: Random,
    client: Client,
    /// Another server, to which each document is as new.
    fresh: Client,
    models: Vec<Model>,
    told: Vec<Told>,
    /// The changes of each document since it was opened.
    history: Vec<Vec<Value>>,
    steps: usize,
    applied: usize,
    /// What each edit took of the processor.
    edits: Vec<Duration>,
}

fn start() -> Client {
    let mut able = capabilities();
    able["textDocument"] = json!({ "codeAction": { "disabledSupport": true } });
    Client::start_with(able, json!({}))
}

impl Soak {
    fn new(seed: u64) -> Soak {
        let mut client = start();
        let models = seeds::models();
        let told = models
            .iter()
            .map(|model| Told(open(&mut client, model, model.uri())))
            .collect();
        let random = Random::new(seed);
        let history = models.iter().map(|_| Vec::new()).collect();
        Soak {
            seed,
            random,
            client,
            fresh: start(),
            models,
            told,
            history,
            steps: 0,
            applied: 0,
            edits: Vec::new(),
        }
    }

    fn step(&mut self) {
        self.steps += 1;
        let at = self.random.below(self.models.len());
        match self.random.below(12) {
            0..=5 => self.edit(at),
            6..=8 => self.act(at),
            9 => self.ask(at),
            10 => self.compare(at),
            _ if self.random.below(3) == 0 => self.restore(at),
            _ => self.reopen(at),
        }
        self.client.seen.clear();
        self.fresh.seen.clear();
    }

    /// What a person types.
    fn edit(&mut self, at: usize) {
        let changes = self.models[at].random_change(&mut self.random);
        let before = worked(&self.client);
        self.told[at] = self.changed(at, &changes);
        self.edits.push(worked(&self.client).saturating_sub(before));
    }

    /// Brings a document back to where it began: what is broken everywhere tells little.
    fn restore(&mut self, at: usize) {
        let changes = self.models[at].restored();
        self.told[at] = self.changed(at, &changes);
    }

    fn reopen(&mut self, at: usize) {
        let model = &mut self.models[at];
        let uri = model.uri().to_owned();
        let (method, params) = model.closing();
        self.client.notify(method, params);
        model.version = 1;
        self.history[at].clear();
        self.client.seen.clear();
        self.told[at] = Told(open(&mut self.client, &self.models[at], &uri));
    }

    /// Makes changes in the model and in the server's document.
    fn changed(&mut self, at: usize, changes: &Value) -> Told {
        let model = &mut self.models[at];
        let (method, params) = model.change(changes);
        self.history[at].push(changes.clone());
        let (uri, version) = (model.uri().to_owned(), model.version);
        self.client.notify(method, params);
        Told(self.client.diagnostics(&uri, version))
    }

    /// Asks for all actions, and applies each of them to the document as it is.
    fn act(&mut self, at: usize) {
        let uri = self.models[at].uri().to_owned();
        let range = if self.random.below(3) == 0 {
            self.models[at].random_line(&mut self.random)
        } else {
            everywhere()
        };
        let mut context = json!({ "diagnostics": [] });
        match self.random.below(4) {
            0 => context["only"] = json!(["source.fixAll.wedm"]),
            1 => context["only"] = json!(["quickfix"]),
            _ => {}
        }
        let params = json!({ "textDocument": { "uri": uri }, "range": range, "context": context });
        let offered = self
            .request("textDocument/codeAction", params, at)
            .as_array()
            .cloned()
            .unwrap_or_default();
        let (before, asked) = (self.told[at].clone(), self.models[at].version);
        let offered: Vec<Value> = offered
            .into_iter()
            .filter(|action| action.get("disabled").is_none())
            .collect();
        // All of a few; of many some, so that no document takes all the time.
        let first = if offered.len() > 12 {
            self.random.below(offered.len() - 12)
        } else {
            0
        };
        let began = Instant::now();
        for action in offered.iter().skip(first).take(12) {
            if began.elapsed() > ACTING {
                break;
            }
            let kept = self.models[at].clone();
            let Some(changes) = self.models[at].changes_of(action, asked) else {
                self.fail(at, &kept, action, "its edit cannot be made")
            };
            let after = self.changed(at, &changes);
            self.applied += 1;
            self.judge(at, &kept, action, &before, &after);
            // Now and then the document goes on as it is then.
            if self.random.below(8) == 0 {
                self.told[at] = after;
                return;
            }
            let back = kept.restoring(&self.models[at]);
            let again = self.changed(at, &back);
            if again != before {
                self.fail(
                    at,
                    &kept,
                    action,
                    &format!(
                        "taken back, other things are said:\n{:#?}\nbefore:\n{:#?}",
                        again.0, before.0
                    ),
                );
            }
        }
    }

    fn judge(&self, at: usize, kept: &Model, action: &Value, before: &Told, after: &Told) {
        // What was not judged may have hidden something: a line that could not be read, what stood behind the end of the program, a contour
        // of which only was told that it is open.
        // What is only written otherwise or turned brings nothing to a sound program; in another one the likeliest fault may come to lie
        // elsewhere. In the mirror it is the same one.
        let is_sound = before
            .0
            .iter()
            .all(|finding| finding["severity"].as_u64() > Some(2));
        let is_refactoring = action["kind"]
            .as_str()
            .is_some_and(|kind| kind.starts_with("refactor"));
        let is_proved = if is_refactoring {
            let mirrors = action["kind"]
                .as_str()
                .is_some_and(|kind| kind.contains("mirror"));
            is_sound || mirrors
        } else {
            const HIDING: [&str; 3] = ["syntax", "text-after-end", "open-contour"];
            !HIDING.contains(
                &action["diagnostics"][0]["code"]
                    .as_str()
                    .unwrap_or_default(),
            )
        };
        if is_proved && after.errors() > before.errors() {
            self.fail(
                at,
                kept,
                action,
                &format!(
                    "it brings an error:\n{:#?}\nbefore:\n{:#?}",
                    after.0, before.0
                ),
            );
        }
        if action["kind"] == "quickfix" {
            let finding = &action["diagnostics"][0];
            // Where several say the same, one of them goes.
            let is_gone = after.alike(finding) < before.alike(finding)
                || after.of_rule(&finding["code"]) < before.of_rule(&finding["code"]);
            if !is_gone {
                self.fail(
                    at,
                    kept,
                    action,
                    &format!("its finding stays:\n{:#?}", after.0),
                );
            }
        }
    }

    /// Questions that an editor asks, each answered by whatever but an internal error.
    fn ask(&mut self, at: usize) {
        let uri = self.models[at].uri().to_owned();
        let document = json!({ "uri": uri });
        let position = self.models[at].random_line(&mut self.random)["start"].clone();
        let there = json!({ "textDocument": document, "position": position });
        let of_text = [
            ("textDocument/hover", there.clone()),
            ("textDocument/completion", there.clone()),
            ("textDocument/signatureHelp", there.clone()),
            ("textDocument/definition", there.clone()),
            ("textDocument/documentHighlight", there.clone()),
            ("textDocument/prepareRename", there.clone()),
            ("textDocument/rename", with(&there, "newName", json!("N7"))),
            (
                "textDocument/references",
                with(&there, "context", json!({ "includeDeclaration": true })),
            ),
            (
                "textDocument/onTypeFormatting",
                with(&with(&there, "ch", json!("\n")), "options", options()),
            ),
            ("textDocument/codeLens", json!({ "textDocument": document })),
            (
                "textDocument/semanticTokens/range",
                json!({ "textDocument": document, "range": everywhere() }),
            ),
            (
                "textDocument/semanticTokens/full/delta",
                json!({ "textDocument": document, "previousResultId": "1" }),
            ),
            (
                "textDocument/rangeFormatting",
                json!({ "textDocument": document, "range": everywhere(), "options": options() }),
            ),
            ("wedm/locate", json!({ "uri": uri, "position": position })),
            (
                "textDocument/documentSymbol",
                json!({ "textDocument": document }),
            ),
            (
                "textDocument/foldingRange",
                json!({ "textDocument": document }),
            ),
            (
                "textDocument/semanticTokens/full",
                json!({ "textDocument": document }),
            ),
            (
                "textDocument/inlayHint",
                json!({ "textDocument": document, "range": everywhere() }),
            ),
            (
                "textDocument/selectionRange",
                json!({ "textDocument": document, "positions": [position] }),
            ),
            (
                "textDocument/formatting",
                json!({ "textDocument": document, "options": options() }),
            ),
        ];
        let of_all = [
            ("wedm/inspect", json!({ "uri": uri })),
            ("wedm/contours", json!({ "uri": uri })),
            ("wedm/picture", json!({ "uri": uri })),
            ("wedm/toolpath", json!({ "uri": uri })),
            ("wedm/simulate", json!({ "uri": uri })),
            ("wedm/settings", json!({ "uri": uri })),
            ("wedm/generate", json!({ "uri": uri, "format": "3b" })),
            (
                "wedm/generate",
                json!({ "uri": uri, "format": "iso", "force": true, "options": { "side": "opening" } }),
            ),
        ];
        let of_text = if self.models[at].is_text() {
            &of_text[..]
        } else {
            &[]
        };
        for (method, params) in of_text.iter().chain(&of_all) {
            self.request(method, params.clone(), at);
        }
    }

    /// The answer, null for an error that is no internal one.
    fn request(&mut self, method: &str, params: Value, at: usize) -> Value {
        match self.client.request(method, params.clone()) {
            Ok(answer) => answer,
            Err(error) if error["code"] == -32603 => {
                let model = self.models[at].clone();
                self.fail(
                    at,
                    &model,
                    &params,
                    &format!("{method} is answered {error}"),
                )
            }
            Err(_) => Value::Null,
        }
    }

    /// What is said of a document is what is said of it where it is opened from scratch.
    fn compare(&mut self, at: usize) {
        let mut model = self.models[at].clone();
        model.version = 1;
        let afresh = Told(open(&mut self.fresh, &model, model.uri()));
        let (method, params) = model.closing();
        self.fresh.notify(method, params);
        self.fresh.published(model.uri());
        if afresh != self.told[at] {
            self.fail(
                at,
                &model,
                &Value::Null,
                &format!("afresh:\n{:#?}\nedited:\n{:#?}", afresh.0, self.told[at].0),
            );
        }
    }

    fn compare_all(&mut self) {
        self.fresh = start();
        for at in 0..self.models.len() {
            self.compare(at);
        }
    }

    fn fail(&self, at: usize, model: &Model, action: &Value, what: &str) -> ! {
        panic!(
            "WEDM_SOAK_SEED={} step {}: {}: {what}\n\naction: {action:#}\n\ndocument before:\n{}\nits last changes:\n{}",
            self.seed,
            self.steps,
            self.models[at].uri(),
            model.shown(),
            self.history[at]
                .iter()
                .rev()
                .take(12)
                .map(|change| format!("{change}\n"))
                .collect::<String>()
        )
    }
}

fn open(client: &mut Client, model: &Model, uri: &str) -> Vec<Value> {
    let (method, params) = model.opening();
    client.notify(method, params);
    client.diagnostics(uri, model.version)
}

fn options() -> Value {
    json!({ "tabSize": 4, "insertSpaces": true })
}

fn with(params: &Value, key: &str, value: Value) -> Value {
    let mut params = params.clone();
    params[key] = value;
    params
}

fn everywhere() -> Value {
    json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 1_000_000, "character": 0 } })
}
