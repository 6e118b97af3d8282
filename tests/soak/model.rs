//! A document as its client knows it.

use serde_json::{Value, json};

/// Numbers out of a seed (SplitMix64).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

#[derive(Clone, Debug)]
pub struct Model {
    uri: String,
    pub version: i64,
    content: Content,
    /// As it was in the beginning.
    first: Content,
}

#[derive(Clone, Debug)]
enum Content {
    /// ASCII.
    Text {
        language: String,
        text: String,
    },
    Drawing(Vec<Value>),
}

/// What is typed.
const TYPED: [&str; 24] = [
    "0",
    "1",
    "5",
    "9",
    ".",
    "-",
    "B",
    "G",
    "X",
    "Y",
    "L",
    "N",
    "S",
    "R",
    "D",
    "I",
    "J",
    ";",
    " ",
    "\n",
    "O",
    "M98P1L3\n",
    "0\nLINE\n",
    "E",
];

impl Model {
    pub fn text(uri: &str, language: &str, text: &str) -> Model {
        let text = text
            .replace('\r', "")
            .chars()
            .filter(char::is_ascii)
            .collect();
        let content = Content::Text {
            language: language.into(),
            text,
        };
        Model {
            uri: uri.into(),
            version: 1,
            first: content.clone(),
            content,
        }
    }

    pub fn drawing(uri: &str, entities: Vec<Value>) -> Model {
        let content = Content::Drawing(entities);
        Model {
            uri: uri.into(),
            version: 1,
            first: content.clone(),
            content,
        }
    }

    pub fn uri(&self) -> &str {
        &self.uri
    }

    pub fn is_text(&self) -> bool {
        matches!(self.content, Content::Text { .. })
    }

    pub fn shown(&self) -> String {
        match &self.content {
            Content::Text { text, .. } => text.clone(),
            Content::Drawing(entities) => json!(entities).to_string(),
        }
    }

    pub fn opening(&self) -> (&'static str, Value) {
        match &self.content {
            Content::Text { language, text } => (
                "textDocument/didOpen",
                json!({ "textDocument": { "uri": self.uri, "languageId": language, "version": self.version, "text": text } }),
            ),
            Content::Drawing(entities) => (
                "wedm/didOpenDrawing",
                json!({ "drawing": { "uri": self.uri, "version": self.version, "units": "mm", "entities": entities } }),
            ),
        }
    }

    pub fn closing(&self) -> (&'static str, Value) {
        match self.content {
            Content::Text { .. } => (
                "textDocument/didClose",
                json!({ "textDocument": { "uri": self.uri } }),
            ),
            Content::Drawing(_) => (
                "wedm/didCloseDrawing",
                json!({ "drawing": { "uri": self.uri } }),
            ),
        }
    }

    /// Makes changes and gives back the message that tells the server.
    pub fn change(&mut self, changes: &Value) -> (&'static str, Value) {
        self.version += 1;
        for change in changes.as_array().into_iter().flatten() {
            match &mut self.content {
                Content::Text { text, .. } => {
                    let range = match change.get("range") {
                        Some(range) => offset(text, &range["start"])..offset(text, &range["end"]),
                        None => 0..text.len(),
                    };
                    text.replace_range(range, change["text"].as_str().expect("a text"));
                }
                Content::Drawing(entities) => change_entity(entities, change),
            }
        }
        match self.content {
            Content::Text { .. } => (
                "textDocument/didChange",
                json!({ "textDocument": { "uri": self.uri, "version": self.version }, "contentChanges": changes }),
            ),
            Content::Drawing(_) => (
                "wedm/didChangeDrawing",
                json!({ "drawing": { "uri": self.uri, "version": self.version }, "changes": changes }),
            ),
        }
    }

    /// The changes that an action asks for; `None` where it asks for none, or for those of another document or version.
    pub fn changes_of(&self, action: &Value, version: i64) -> Option<Value> {
        if !self.is_text() {
            let argument = action["command"]["arguments"].get(0)?;
            return (argument["uri"] == self.uri && argument["version"] == version)
                .then(|| argument["changes"].clone());
        }
        let of_document = action["edit"]["documentChanges"].get(0)?;
        if of_document["textDocument"]["uri"] != self.uri
            || of_document["textDocument"]["version"] != version
        {
            return None;
        }
        let mut edits = of_document["edits"].as_array()?.clone();
        // From the last to the first, so that none moves another. Of two at one place the later one is made first.
        let place = |edit: &Value| {
            (
                edit["range"]["start"]["line"].as_u64(),
                edit["range"]["start"]["character"].as_u64(),
            )
        };
        edits.sort_by_key(|edit| place(edit));
        edits.reverse();
        Some(
            edits
                .into_iter()
                .map(|edit| json!({ "range": edit["range"], "text": edit["newText"] }))
                .collect(),
        )
    }

    /// Brings the model back to how it began.
    pub fn restored(&self) -> Value {
        let first = Model {
            content: self.first.clone(),
            ..self.clone()
        };
        first.restoring(self)
    }

    /// What makes `other` this one.
    pub fn restoring(&self, other: &Model) -> Value {
        match (&self.content, &other.content) {
            (Content::Text { text, .. }, _) => json!([{ "text": text }]),
            (Content::Drawing(entities), Content::Drawing(others)) => {
                let gone = others
                    .iter()
                    .map(|entity| json!({ "handle": entity["handle"], "entity": null }));
                let put = entities
                    .iter()
                    .map(|entity| json!({ "handle": entity["handle"], "entity": entity }));
                gone.chain(put).collect()
            }
            (Content::Drawing(_), Content::Text { .. }) => unreachable!("a drawing stays one"),
        }
    }

    /// The range of one line, or segment.
    pub fn random_line(&self, random: &mut Random) -> Value {
        let lines = match &self.content {
            Content::Text { text, .. } => lines(text).len(),
            Content::Drawing(_) => 8,
        };
        let (line, character) = (random.below(lines + 1), random.below(6));
        json!({ "start": { "line": line, "character": character }, "end": { "line": line, "character": character } })
    }

    pub fn random_change(&self, random: &mut Random) -> Value {
        match &self.content {
            Content::Text { text, .. } => change_of_text(text, random),
            Content::Drawing(entities) => change_of_drawing(entities, random),
        }
    }
}

fn change_of_text(text: &str, random: &mut Random) -> Value {
    let lines: Vec<&str> = lines(text)
        .into_iter()
        .map(|(start, length)| &text[start..start + length])
        .collect();
    let at = random.below(lines.len());
    let at_line = |line: usize, character: usize| json!({ "line": line, "character": character });
    let (line, length) = (lines[at], lines[at].len());
    let place = random.below(length + 1);
    let change = |start: Value, end: Value, text: String| json!([{ "range": { "start": start, "end": end }, "text": text }]);
    match random.below(10) {
        // Another digit for one that stands.
        0..=3 => {
            let digits: Vec<usize> = line
                .bytes()
                .enumerate()
                .filter(|(_, byte)| byte.is_ascii_digit())
                .map(|(index, _)| index)
                .collect();
            let place = digits.get(random.below(digits.len())).copied().unwrap_or(0);
            let end = (place + usize::from(!digits.is_empty())).min(length);
            change(
                at_line(at, place),
                at_line(at, end),
                random.below(10).to_string(),
            )
        }
        4..=6 => change(
            at_line(at, place),
            at_line(at, place),
            TYPED[random.below(TYPED.len())].into(),
        ),
        7 => change(
            at_line(at, place),
            at_line(at, (place + 1 + random.below(2)).min(length)),
            String::new(),
        ),
        // A line twice, or gone.
        8 => change(at_line(at, 0), at_line(at, 0), format!("{line}\n")),
        _ => change(at_line(at, 0), at_line(at + 1, 0), String::new()),
    }
}

fn change_of_drawing(entities: &[Value], random: &mut Random) -> Value {
    if entities.is_empty() {
        return json!([{ "handle": "F0", "entity": { "handle": "F0", "type": "circle", "center": [1, 2], "radius": 3 } }]);
    }
    let entity = &entities[random.below(entities.len())];
    let handle = &entity["handle"];
    let shift = |random: &mut Random| {
        (random.below(41) as f64 - 20.0) * [0.001, 0.05, 1.0][random.below(3)]
    };
    match (random.below(8), entity["vertices"].as_array()) {
        (0..=4, Some(vertices)) if !vertices.is_empty() => {
            let at = random.below(vertices.len());
            let number = |vertex: &Value, index: usize| {
                vertex.get(index).and_then(Value::as_f64).unwrap_or(0.0)
            };
            let own = &vertices[at];
            let moved = json!([
                number(own, 0) + shift(random),
                number(own, 1) + shift(random),
                number(own, 2)
            ]);
            let bent = json!([number(own, 0), number(own, 1), shift(random)]);
            let (count, insert) = match random.below(6) {
                0 => (1, json!([])),
                1 => (0, json!([moved])),
                2 => (1, json!([bent])),
                _ => (1, json!([moved])),
            };
            json!([{ "handle": handle, "vertices": { "start": at, "deleteCount": count, "insert": insert } }])
        }
        (5, _) if entities.len() > 1 => json!([{ "handle": handle, "entity": null }]),
        (6, _) if entities.len() < 8 => {
            let mut copy = entity.clone();
            let name = (0..)
                .map(|number| format!("C{number}"))
                .find(|name| entities.iter().all(|other| other["handle"] != **name));
            copy["handle"] = json!(name);
            json!([{ "handle": name, "entity": copy, "before": handle }])
        }
        _ => {
            let mut moved = entity.clone();
            for key in ["start", "end", "center"] {
                if let Some(x) = moved.get(key).and_then(|point| point[0].as_f64()) {
                    moved[key][0] = json!(x + shift(random));
                }
            }
            if let Some(radius) = moved["radius"].as_f64() {
                moved["radius"] = json!((radius + shift(random)).abs().max(0.01));
            }
            json!([{ "handle": handle, "entity": moved }])
        }
    }
}

fn change_entity(entities: &mut Vec<Value>, change: &Value) {
    let at = entities
        .iter()
        .position(|entity| entity["handle"] == change["handle"]);
    if let Some(splice) = change.get("vertices") {
        let vertices = entities[at.expect("it stands")]["vertices"]
            .as_array_mut()
            .expect("a polyline");
        let start = splice["start"].as_u64().expect("a number") as usize;
        let end = start + splice["deleteCount"].as_u64().expect("a number") as usize;
        vertices.splice(
            start..end,
            splice["insert"]
                .as_array()
                .expect("vertices")
                .iter()
                .cloned(),
        );
        return;
    }
    let before = change.get("before").filter(|before| !before.is_null());
    match (&change["entity"], at) {
        (Value::Null, at) => drop(entities.remove(at.expect("it stands"))),
        (entity, Some(at)) if before.is_none() => entities[at] = entity.clone(),
        (entity, at) => {
            if let Some(at) = at {
                entities.remove(at);
            }
            let place = before
                .and_then(|before| entities.iter().position(|other| other["handle"] == *before))
                .unwrap_or(entities.len());
            entities.insert(place, entity.clone());
        }
    }
}

/// The byte of a position, as far into its line as that goes.
fn offset(text: &str, position: &Value) -> usize {
    let (line, character) = (
        position["line"].as_u64().expect("a line") as usize,
        position["character"].as_u64().expect("a place") as usize,
    );
    lines(text)
        .get(line)
        .map_or(text.len(), |(start, length)| start + character.min(*length))
}

/// Where each line begins, and its length without its end: `\n`, `\r\n` or `\r`.
fn lines(text: &str) -> Vec<(usize, usize)> {
    let (mut found, mut start) = (Vec::new(), 0);
    while let Some(length) = text[start..].find(['\n', '\r']) {
        found.push((start, length));
        start += length
            + if text[start + length..].starts_with("\r\n") {
                2
            } else {
                1
            };
    }
    found.push((start, text.len() - start));
    found
}
