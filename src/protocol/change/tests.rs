use super::*;
use serde_json::{Value, json};

fn drawing() -> core::Drawing {
    let drawing: super::super::Drawing = serde_json::from_value(json!({ "uri": "cad:///1", "version": 1, "entities": [
            { "handle": "A", "type": "polyline", "closed": true, "vertices": [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0.5]] },
            { "handle": "B", "type": "line", "start": [0, 0], "end": [1, 0] },
        ] }))
        .unwrap();
    drawing.into_core().unwrap()
}

fn try_apply(changes: Value) -> Result<core::Drawing, String> {
    let changes: Vec<DrawingChange> =
        serde_json::from_value(changes).map_err(|error| error.to_string())?;
    let mut result = drawing();
    apply(&mut result, changes).map(|_| result)
}

#[test]
fn what_cannot_apply_is_refused_whole_and_named() {
    let check = |changes: Value, expected: &str| {
        let error = try_apply(changes).expect_err(expected);
        assert!(error.contains(expected), "{error}");
    };
    let splice = |handle: &str, start: u64, delete: u64, insert: Value| json!({ "handle": handle, "vertices": { "start": start, "deleteCount": delete, "insert": insert } });
    check(
        json!([splice("Z", 0, 1, json!([]))]),
        "change 0: there is no entity Z",
    );
    check(
        json!([splice("B", 0, 1, json!([]))]),
        "entity B is not a polyline",
    );
    check(
        json!([splice("A", 4, 2, json!([]))]),
        "vertices 4 + 2 are out of range, polyline A has 5",
    );
    check(json!([splice("A", u64::MAX, 2, json!([]))]), "out of range");
    check(
        json!([splice("A", 0, 1, json!([[0, null]]))]),
        "vertex 0 to insert in A",
    );
    check(
        json!([splice("A", 0, 4, json!([])), splice("A", 1, 1, json!([]))]),
        "change 1: vertices 1 + 1 are out of range, polyline A has 1",
    );
    check(
        json!([{ "handle": "Z", "entity": null }]),
        "no entity Z to delete",
    );
    check(json!([{ "handle": "Z" }]), "both or neither");
    check(
        json!([{ "handle": "B", "entity": null }, splice("B", 0, 0, json!([]))]),
        "change 1: there is no entity B",
    );
    let line = json!({ "handle": "C", "type": "line", "start": [0, 0], "end": [1, 0] });
    check(
        json!([{ "handle": "C", "entity": line, "before": "Z" }]),
        "no entity Z to put C before",
    );
    check(
        json!([{ "handle": "D", "entity": line }]),
        "the entity's handle is C, expected D",
    );
}

#[test]
fn changes_apply_one_after_another() {
    let line = json!({ "handle": "C", "type": "line", "start": [5, 5], "end": [1, 0] });
    let result = try_apply(json!([
        { "handle": "C", "entity": line, "before": "B" },
        { "handle": "B", "entity": null },
        { "handle": "A", "vertices": { "start": 1, "deleteCount": 2, "insert": [[9, 9, 0.5]] } },
        { "handle": "A", "vertices": { "start": 1, "deleteCount": 0, "insert": [[8, 8]] } },
        { "handle": "C", "entity": line, "before": "A" },
    ]))
    .unwrap();
    let handles: Vec<_> = result
        .entities()
        .map(|(_, entity)| entity.handle.to_string())
        .collect();
    assert_eq!(handles, ["C", "A"]);
    let id = result.find("A").unwrap();
    let core::Geometry::Polyline { vertices, .. } = &result.get(id).unwrap().geometry else {
        panic!("a polyline")
    };
    let expected = [
        (0.0, 0.0, 0.0),
        (8.0, 8.0, 0.0),
        (9.0, 9.0, 0.5),
        (0.0, 1.0, 0.0),
        (0.0, 0.5, 0.0),
    ];
    assert_eq!(
        *vertices,
        expected.map(|(x, y, bulge)| core::Vertex::new(x, y, bulge))
    );
}

#[test]
fn a_fix_becomes_splices_with_the_same_outcome_as_the_edit() {
    let before = drawing();
    let entity = before.find("A").unwrap();
    let edit = core::DrawingEdit {
        changes: vec![
            Change::SetVertex {
                entity,
                index: 0,
                vertex: core::Vertex::new(7.0, 0.0, 0.0),
            },
            Change::RemoveVertex { entity, index: 2 },
            Change::SetVertex {
                entity,
                index: 3,
                vertex: core::Vertex::new(7.0, 3.0, 0.1),
            },
            Change::RemoveVertex { entity, index: 4 },
        ],
    };
    let changes = changes_of(&before, &edit);
    let expected = json!([
        { "handle": "A", "vertices": { "start": 2, "deleteCount": 3, "insert": [[7.0, 3.0, 0.1]] } },
        { "handle": "A", "vertices": { "start": 0, "deleteCount": 1, "insert": [[7.0, 0.0, 0.0]] } },
    ]);
    assert_eq!(serde_json::to_value(&changes).unwrap(), expected);
    let (mut spliced, mut edited) = (before.clone(), before);
    apply(&mut spliced, changes).unwrap();
    edited.apply(&edit).unwrap();
    assert_eq!(spliced.get(entity), edited.get(entity));
}
