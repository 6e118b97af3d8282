//! Repairs of findings of which each stands for several places.

use super::{CAD, actions, argument, everywhere, on_line};
use crate::support::{Client, capabilities};
use serde_json::{Value, json};

/// In a drawing without text, one finding that stands for several corners offers the repair of each.
#[test]
fn a_finding_that_stands_for_several_is_repaired_place_by_place() {
    let mut client = Client::start_with(capabilities(), json!({ "side": "opening" }));
    let corners = [[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]];
    let plate = json!({ "handle": "2A", "layer": "DIE", "type": "polyline", "closed": true, "vertices": corners });
    let found = client.open_drawing(CAD, json!([plate]));
    let merged: Vec<&Value> = found
        .iter()
        .filter(|one| one["code"] == "sharp-corner")
        .collect();
    assert_eq!(merged.len(), 1, "{found:?}");
    assert_eq!(merged[0]["data"]["count"], 4);
    assert_eq!(merged[0]["data"]["related"].as_array().unwrap().len(), 3);
    let at = |segment: u64| {
        let mut one = merged[0].clone();
        one["data"]["segment"] = json!(segment);
        vec![one]
    };
    let own = merged[0]["data"]["segment"].as_u64().unwrap();
    // By range, by the finding itself, and by one of the places that it stands for.
    let asked = [
        (everywhere(), Vec::new(), vec![0, 1, 2, 3]),
        (on_line(2), Vec::new(), vec![2]),
        (everywhere(), at(own), vec![0, 1, 2, 3]),
        (on_line(1), at(1), vec![1]),
        (on_line(3), at(3), vec![3]),
    ];
    for (range, diagnostics, expected) in asked {
        let offered = actions(&mut client, CAD, range, &diagnostics, Some("quickfix"));
        let mut places: Vec<u64> = offered
            .iter()
            .map(|action| {
                let data = &action["diagnostics"][0]["data"];
                assert!(!argument(action)["changes"].as_array().unwrap().is_empty());
                data["segment"].as_u64().unwrap()
            })
            .collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places, expected, "{offered:?}");
    }
    client.shut_down();
}
