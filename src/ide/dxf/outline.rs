//! The whole text as a tree: sections, tables and their entries, blocks, entities. Folding and symbols use it.

use super::spot::text_of;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::lines::Lines;
use crate::ide::{Stop, Symbol, SymbolKind};
use crate::text::SourceText;

/// Calls `visit` for each tag of the text; false when it was stopped.
pub(super) fn walk(lines: Lines<'_>, stop: Stop<'_>, mut visit: impl FnMut(Tag)) -> bool {
    let mut lexer = Lexer::new(lines, 0);
    let mut until_asked = 0;
    while let Some(tag) = lexer.next() {
        lexer.findings.clear();
        until_asked += 1;
        if until_asked == 4096 {
            until_asked = 0;
            if stop() {
                return false;
            }
        }
        visit(tag);
        if tag.code == 0 && lines.trimmed(tag.value_line()) == b"EOF" {
            break;
        }
    }
    true
}

/// The tree of a text; `None` when it was stopped.
pub fn outline(text: &SourceText, stop: Stop<'_>) -> Option<Vec<Symbol>> {
    let lines = Lines::new(text);
    let mut builder = Builder {
        lines,
        open: Vec::new(),
        done: Vec::new(),
        record: None,
        vertices: 0,
    };
    let mut end = 0;
    let whole = walk(lines, stop, |tag| {
        if tag.code == 0 {
            builder.begin(tag);
        } else {
            builder.take(tag);
        }
        end = tag.line + 2;
    });
    builder.finish_record(end);
    while !builder.open.is_empty() {
        builder.close(end);
    }
    whole.then_some(builder.done)
}

struct Builder<'a> {
    lines: Lines<'a>,
    /// Section, table or block, POLYLINE: each holds the next.
    open: Vec<Symbol>,
    done: Vec<Symbol>,
    /// The record being read, when it is not one that holds others.
    record: Option<Symbol>,
    /// Vertices of the record or of the open POLYLINE.
    vertices: usize,
}

impl Builder<'_> {
    fn begin(&mut self, tag: Tag) {
        let line = tag.line;
        let name = self.lines.trimmed(tag.value_line());
        if let Some(holder) = self.open.last()
            && matches!(&*holder.record, "POLYLINE" | "INSERT")
        {
            match name {
                b"VERTEX" | b"ATTRIB" => {
                    self.vertices += usize::from(name == b"VERTEX");
                    self.record = None;
                    return self.hold_to(line + 2);
                }
                b"SEQEND" => {
                    self.record = None;
                    self.hold_to(line + 2);
                    return;
                }
                _ => self.close(line),
            }
        }
        self.finish_record(line);
        match name {
            b"SECTION" => {
                while !self.open.is_empty() {
                    self.close(line);
                }
                self.open.push(self.node(SymbolKind::Section, tag));
            }
            b"ENDSEC" | b"EOF" => {
                while !self.open.is_empty() {
                    self.close(if name == b"ENDSEC" { line + 2 } else { line });
                }
            }
            b"TABLE" | b"BLOCK" => {
                self.close_to_section(line);
                let kind = if name == b"TABLE" {
                    SymbolKind::Table
                } else {
                    SymbolKind::Block
                };
                self.open.push(self.node(kind, tag));
            }
            b"ENDTAB" => self.close_to_section(line + 2),
            b"ENDBLK" => {
                // Its own tags come before the next record.
                self.record = Some(self.node(SymbolKind::Record, tag));
            }
            b"POLYLINE" => {
                self.vertices = 0;
                self.open.push(self.node(SymbolKind::Entity, tag));
            }
            _ => {
                let kind = match self
                    .open
                    .iter()
                    .rev()
                    .find(|node| node.kind != SymbolKind::Entity)
                    .map(|node| (node.kind, node.name.as_str()))
                {
                    Some((SymbolKind::Table, _)) => SymbolKind::Entry,
                    Some((SymbolKind::Block, _) | (SymbolKind::Section, "ENTITIES" | "BLOCKS")) => {
                        SymbolKind::Entity
                    }
                    _ => SymbolKind::Record,
                };
                self.vertices = 0;
                let node = self.node(kind, tag);
                if name == b"INSERT" {
                    self.open.push(node)
                } else {
                    self.record = Some(node)
                }
            }
        }
    }

    /// A tag that does not begin a record.
    fn take(&mut self, tag: Tag) {
        let in_holder = self.record.is_none();
        let Some(node) = self.record.as_mut().or(self.open.last_mut()) else {
            return;
        };
        // Vertices and attributes of a holder have codes of their own.
        if in_holder && node.lines.end > node.lines.start {
            return self.hold_to(tag.line + 2);
        }
        let value = self.lines.trimmed(tag.value_line());
        match tag.code {
            2 if matches!(
                node.kind,
                SymbolKind::Section | SymbolKind::Table | SymbolKind::Entry | SymbolKind::Block
            ) && node.name.is_empty() =>
            {
                node.name = text_of(value);
            }
            5 | 105
                if matches!(node.kind, SymbolKind::Entity | SymbolKind::Record)
                    && node.name.is_empty() =>
            {
                node.name = text_of(value)
            }
            8 if node.kind == SymbolKind::Entity && node.detail.is_empty() => {
                node.detail = text_of(value)
            }
            10 if &*node.record == "LWPOLYLINE" => self.vertices += 1,
            2 if &*node.record == "INSERT" => {
                node.detail = say!(on_layer_block, node.detail, text_of(value))
            }
            1 if matches!(&*node.record, "TEXT" | "MTEXT") => {
                node.detail = format!("{}, \"{}\"", node.detail, text_of(value))
            }
            _ => {}
        }
    }

    fn node(&self, kind: SymbolKind, tag: Tag) -> Symbol {
        let selection = self.lines.trimmed_range(tag.value_line());
        let start = self.lines.range(tag.line).start;
        Symbol {
            kind,
            record: text_of(self.lines.trimmed(tag.value_line())).into(),
            name: String::new(),
            detail: String::new(),
            range: start..selection.end,
            selection,
            lines: tag.line..tag.line,
            children: Vec::new(),
        }
    }

    /// Extends the innermost holder to `line`.
    fn hold_to(&mut self, line: usize) {
        if let Some(holder) = self.open.last_mut() {
            holder.lines.end = line;
        }
    }

    fn ended(&self, mut node: Symbol, end: usize) -> Symbol {
        node.lines.end = end.max(node.lines.start + 1);
        node.range.end = self
            .lines
            .range(node.lines.end - 1)
            .end
            .max(node.selection.end);
        if matches!(&*node.record, "LWPOLYLINE" | "POLYLINE") {
            node.detail = say!(
                on_layer_vertices,
                node.detail,
                say!(vertices, self.vertices)
            );
        }
        node
    }

    fn finish_record(&mut self, end: usize) {
        let Some(node) = self.record.take() else {
            return;
        };
        if &*node.record == "ENDBLK" {
            return self.close_to_section(end);
        }
        let node = self.ended(node, end);
        self.put(node);
    }

    fn close(&mut self, end: usize) {
        self.finish_record(end);
        if let Some(node) = self.open.pop() {
            let node = self.ended(node, end);
            self.put(node);
        }
    }

    fn close_to_section(&mut self, end: usize) {
        while self
            .open
            .last()
            .is_some_and(|node| node.kind != SymbolKind::Section)
        {
            self.close(end);
        }
    }

    fn put(&mut self, node: Symbol) {
        match self.open.last_mut() {
            Some(holder) => holder.children.push(node),
            None => self.done.push(node),
        }
    }
}
