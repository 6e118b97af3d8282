//! Every contradiction is published while the drawing is open, at the drawing or in its `wedm.toml`.

use crate::support::Client;
use serde_json::json;

#[path = "../support/contradictions.rs"]
mod rows;

use rows::CONTRADICTIONS;

#[test]
fn contradictions_are_published() {
    for row in CONTRADICTIONS {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("wedm.toml"), row.settings).unwrap();
        let uri = format!("file://{}", folder.path().join("x.dxf").display());
        let mut client = Client::start();
        client.notify(
            "textDocument/didOpen",
            json!({ "textDocument": { "uri": uri, "languageId": "dxf", "version": 1, "text": row.dxf() } }),
        );
        client.wait_for(row.settings, |message| {
            let found = message["params"]["diagnostics"].as_array();
            found.into_iter().flatten().any(|found| {
                let said = found["message"].as_str().unwrap_or_default();
                found["code"] == row.rule && said.contains(row.says)
            })
        });
        client.shut_down();
    }
}
