//! The committed JSON Schema of the protocol is that of the program's types.

use std::path::Path;

#[test]
fn the_committed_schema_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/protocol.schema.json");
    let schema = format!("{:#}\n", wedm::protocol::schema());
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &schema).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == schema,
        "docs/protocol.schema.json is out of date; update it with: UPDATE_EXPECT=1 cargo test --test command_line schema"
    );
}
