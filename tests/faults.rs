//! Faults put into sound programs: what is found, at which line, and what the repairs make of it.
//!
//! The table in `docs/programs.md` and `docs/zh/programs.md` is made by
//!
//! ```text
//! cargo test --release --test core faults table -- --ignored --nocapture
//! ```
//!
//! `WEDM_FAULTS=SEED,PROGRAMS` takes other programs, or more of them; `WEDM_FAULTS_SHOW=TEXT` shows each fault whose group, kind or
//! outcome holds the text and that is not set right.

#[path = "faults/alone.rs"]
mod alone;
#[path = "faults/chance.rs"]
pub mod chance;
#[path = "faults/contours.rs"]
mod contours;
#[path = "faults/inject/mod.rs"]
mod inject;
#[path = "faults/judge.rs"]
mod judge;
#[path = "faults/known.rs"]
mod known;
#[path = "faults/properties.rs"]
mod properties;
#[path = "faults/rivals.rs"]
mod rivals;

use crate::size::by_day;
use chance::Chance;
use contours::{Group, program};
use inject::{Faulty, inject, is_one_slip, kinds, more_kinds};
use judge::{Outcome, Verdict, judge};
use std::collections::BTreeMap;

/// How the faults of one kind came out.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    faults: usize,
    found: usize,
    right_line: usize,
    first_fix: usize,
    right: usize,
    untouched: usize,
    plausible: usize,
    wrong: usize,
}

impl Tally {
    fn take(&mut self, verdict: &Verdict) {
        self.faults += 1;
        self.found += usize::from(verdict.found);
        self.right_line += usize::from(verdict.right_line);
        self.first_fix += usize::from(verdict.first_fix);
        match verdict.outcome {
            Outcome::Right => self.right += 1,
            Outcome::Untouched => self.untouched += 1,
            Outcome::Plausible => self.plausible += 1,
            Outcome::Wrong => self.wrong += 1,
        }
    }

    fn row(&self, name: &str) -> String {
        let share =
            |count: usize| format!("{} %", (100 * count + self.faults / 2) / self.faults.max(1));
        let Tally {
            faults,
            right,
            untouched,
            plausible,
            wrong,
            ..
        } = self;
        let shares = [self.found, self.right_line, self.first_fix]
            .map(share)
            .join(" | ");
        format!("| {name} | {faults} | {shares} | {right} | {untouched} | {plausible} | {wrong} |")
    }
}

fn all_kinds(group: Group) -> Vec<&'static str> {
    [kinds(group), more_kinds(group)].concat()
}

/// Puts every kind of fault into this many programs of a group, and hands out how each came out.
fn run(group: Group, seed: u64, programs: usize, each: &mut dyn FnMut(&str, &Faulty, &Verdict)) {
    let mut chance = Chance::of_seed(seed);
    let mut taken = 0;
    for _ in 0..4 * programs {
        if taken == programs {
            break;
        }
        let Some(sound) = program(group, &mut chance) else {
            continue;
        };
        let findings = judge::findings(&mut judge::read(group, &sound));
        if !findings.is_empty() {
            continue;
        }
        taken += 1;
        for kind in all_kinds(group) {
            let Some(faulty) = inject(group, kind, &sound, &mut chance) else {
                continue;
            };
            if let Some(verdict) = judge(group, &sound, &faulty) {
                each(&sound, &faulty, &verdict);
            }
        }
    }
    assert!(
        taken > programs / 2,
        "{}: {taken} of {programs} programs are sound",
        group.name()
    );
}

fn shown(group: Group, sound: &str, faulty: &Faulty, verdict: &Verdict) -> String {
    let lines: Vec<usize> = faulty.lines.iter().map(|line| line + 1).collect();
    let Verdict {
        outcome,
        said,
        first,
        left,
        ..
    } = verdict;
    format!(
        "--- {}: {}, line {lines:?}: {outcome:?}\nsaid {said:#?}\nfirst fix {first:?}\n{}\n--- left\n{left}\n--- of\n{sound}",
        group.name(),
        faulty.kind,
        faulty.text
    )
}

/// Whatever is wrong with a program, what fix-all makes of it is what it was, or what stood there. In ISO a line that is typed like
/// the one before may still be taken for a copy.
#[test]
fn fix_all_spoils_no_program() {
    let mut failures = Vec::new();
    for group in Group::ALL {
        let programs = by_day(1, 6);
        run(group, 1, programs, &mut |sound, faulty, verdict| {
            let is_plausible = verdict.outcome == Outcome::Plausible && is_one_slip(faulty.kind);
            if verdict.outcome == Outcome::Wrong || is_plausible && group != Group::Iso {
                failures.push(shown(group, sound, faulty, verdict));
            }
        });
    }
    assert!(
        failures.is_empty(),
        "{} faults were made worse:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

#[test]
#[ignore = "makes the table of docs/programs.md and docs/zh/programs.md"]
fn table() {
    let wanted = std::env::var("WEDM_FAULTS").unwrap_or_default();
    let mut wanted = wanted
        .split(',')
        .map(|number| number.trim().parse::<u64>().ok());
    let seed = wanted.next().flatten().unwrap_or(2026);
    let programs = wanted.next().flatten().map_or(40, |count| count as usize);
    let show = std::env::var("WEDM_FAULTS_SHOW").ok();
    let groups = std::env::var("WEDM_FAULTS_GROUP").ok();
    println!(
        "| program | faults | found | right line | first fix right | fix all: right | untouched | closes, nothing against it | wrong |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut details = String::new();
    let mut cases = String::new();
    for group in Group::ALL {
        if groups
            .as_ref()
            .is_some_and(|wanted| !group.name().contains(wanted.as_str()))
        {
            continue;
        }
        let mut all = Tally::default();
        let mut by_kind: BTreeMap<&str, Tally> = BTreeMap::new();
        run(group, seed, programs, &mut |sound, faulty, verdict| {
            all.take(verdict);
            by_kind.entry(faulty.kind).or_default().take(verdict);
            let label = format!(
                "{}: {}: {:?}: {}",
                group.name(),
                faulty.kind,
                verdict.outcome,
                if verdict.first_fix {
                    "first"
                } else {
                    "not first"
                }
            );
            if show
                .as_ref()
                .is_some_and(|show| label.contains(show.as_str()))
            {
                cases += &format!("{label}\n{}\n", shown(group, sound, faulty, verdict));
            }
        });
        println!("{}", all.row(group.name()));
        for kind in all_kinds(group) {
            details += &by_kind.get(kind).map_or_else(String::new, |tally| {
                format!("{}\n", tally.row(&format!("{}: {kind}", group.name())))
            });
        }
    }
    println!("\n{details}\n{cases}");
}
