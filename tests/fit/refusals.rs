//! Settings of which something is missing for a fit, or that contradict each other.

use super::{circle, document};
use wedm::job;
use wedm::settings::{Effective, from_toml};

#[test]
fn what_is_missing_for_a_fit_is_named() {
    let check = |text: &str, expected: &str| {
        let (read, _) = from_toml(text);
        let own = Effective::of(&read);
        let document = document(&circle(5.0), &own);
        let snapshot = document.snapshot().expect("a drawing");
        let refusal = job::fit(&document, &snapshot, &()).unwrap_err();
        assert!(
            refusal.sentence(1.0).contains(expected),
            "{text}: {}",
            refusal.sentence(1.0)
        );
    };
    check(
        "",
        "set pair.drawn-as, pair.clearance, wire-diameter and gap",
    );
    check(
        "gap = 0.01\n[pair]\nclearance = 0.01\ndrawn-as = \"punch\"",
        "set wire-diameter",
    );
    check(
        "wire-diameter = 0.2\n[pair]\nclearance = 0.01\ndrawn-as = \"punch\"",
        "set gap",
    );
    check(
        "wire-diameter = 0.2\ngap = 0.01\n[pair]\nclearance = 0.01",
        "set pair.drawn-as",
    );
}

#[test]
fn settings_that_contradict_each_other_are_named_at_their_key() {
    let check = |text: &str, at: &str, expected: &str| {
        let (_, errors) = from_toml(text);
        let found: Vec<_> = errors
            .iter()
            .map(|error| {
                (
                    error.range.clone().map_or("", |range| &text[range]),
                    error.message.as_str(),
                )
            })
            .collect();
        assert!(
            found
                .iter()
                .any(|(place, message)| *place == at && message.contains(expected)),
            "{text}: {found:?}"
        );
    };
    check(
        "[pair]\ndrawn-as = \"punch\"\nclearance = 0.01\n",
        "clearance",
        "expected wire-diameter and gap as well",
    );
    check(
        "wire-diameter = 0.2\ngap = 0.01\n[pair]\nclearance = 0.01\n",
        "clearance",
        "has no pair",
    );
    check(
        "[pair]\ndrawn-as = \"plate\"\n",
        "drawn-as",
        "has no effect without pair.clearance",
    );
    check(
        "side = \"auto\"\n[pair]\ndrawn-as = \"plate\"\n",
        "drawn-as",
        "side is \"auto\" in the settings that apply here (wedm.toml, client, command line or request), and pair.drawn-as",
    );
    check(
        "[pair]\ndrawn-as = \"plate\"\n[workpieces]\nA = [\"A\"]\nB = [\"B\"]\n",
        "drawn-as",
        "expected one of the two",
    );
    check(
        "[pair]\nholder = 0.01\n",
        "holder",
        "expected pair.drawn-as as well",
    );
    check(
        "[workpieces]\nA = [\"X\"]\nB = [\"X\"]\n",
        "workpieces",
        "the layer X belongs to the workpieces A and B",
    );
}
