//! An edit within the vertices of a LWPOLYLINE: a run of them is read again, however many there are.
//!
//! Where they are damaged now, as while somebody types, the polyline is suspended: it will soon be
//! whole again, so what was read of it is kept aside. The polyline must have no fault elsewhere:
//! the findings are then those of the run alone, as in a fresh reading.

use super::Document;
use super::edit::{LOOKBACK, shift};
use super::entities::{self, mirror};
use super::entity::VertexLines;
use super::lines::Lines;
use super::reader::range_key;
use super::table::{Became, NO_ITEM, Named};
use crate::drawing::{
    Appearance, Delta, Entity, EntityId, Geometry, Touched, Vertex, Visibility, differing,
};
use crate::finding::Finding;
use std::ops::Range;
use std::sync::Arc;

/// The most vertices after those that an edit touches that are read until the lines are in step again.
const MOST_BEHIND: usize = 64;

/// The vertices that an edit touches, before it is made.
pub(super) struct VertexRun {
    item: usize,
    id: EntityId,
    /// By their indices before the edit.
    vertices: Range<usize>,
    suspended: Option<Box<Suspended>>,
}

/// A polyline that is damaged now, as it was before.
#[derive(Clone, Debug)]
pub(super) struct Suspended {
    item: usize,
    id: EntityId,
    entity: Arc<Entity>,
    appearance: Appearance,
    vertices: Box<VertexLines>,
    /// The vertices that have changed, and by how many lines those after them have moved.
    changed: Range<usize>,
    moved: i64,
}

impl Document {
    /// The vertices that an edit of these bytes touches, if it leaves everything else of the polyline alone.
    pub(super) fn vertex_run(&mut self, range: &Range<usize>) -> Option<VertexRun> {
        let suspended = self.suspended.take();
        let (line, last) = (self.text.line_of(range.start), self.text.line_of(range.end));
        let item = self.table.item_at(line)?;
        let of_item = self.table.lines_of(item, self.text.line_count());
        // After the last record the text may end anywhere.
        let is_last = item + 1 >= self.table.items.len();
        if is_last || last >= of_item.end {
            return None;
        }
        let suspended = suspended.filter(|it| it.item == item);
        let (line, last) = ((line - of_item.start) as i64, (last - of_item.start) as i64);
        let begun_by =
            |lines: &[u32], line: i64| lines.partition_point(|&vertex| i64::from(vertex) <= line);
        let (id, known, changed, moved) = match &suspended {
            Some(it) => (it.id, &it.vertices, it.changed.clone(), it.moved),
            None => {
                let id = self.table.items.get(item)?.entity()?;
                let known = self.table.vertices.get(&id)?;
                let at = begun_by(&known.lines, line - 1).checked_sub(1)?;
                (id, known, at..at, 0)
            }
        };
        // What begins in the first line of the edit may become a part of the vertex before.
        let from = begun_by(known.lines.get(..=changed.start)?, line - 1).checked_sub(1)?;
        let to = changed.end + begun_by(known.lines.get(changed.end..)?, last - moved);
        let byte_of = |line: i64| self.text.line_start(of_item.start + line.max(0) as usize);
        let first = i64::from(*known.lines.get(from)?);
        // A decision there, or in what stands before the polyline, may have looked at the edited lines.
        let near = byte_of(line - LOOKBACK as i64)..byte_of(first);
        let edited = of_item.start + line.max(0) as usize;
        let is_at_fault = self.is_at_fault(edited, of_item.start)
            || self.is_at_fault_in(near, &self.bytes_of_tag(known.count_line(of_item.start)));
        (to <= known.own as usize && !is_at_fault).then_some(VertexRun {
            item,
            id,
            vertices: from..to,
            suspended,
        })
    }

    /// Reads again what an edit has touched, which has moved what is after it by some lines and bytes. `None` where
    /// more has to be read.
    pub(super) fn reread_run(&mut self, run: VertexRun, lines: i64, bytes: i64) -> Option<Delta> {
        let VertexRun {
            item,
            id,
            vertices,
            suspended,
        } = run;
        let text = Lines::new(&self.text);
        let moved = lines + suspended.as_ref().map_or(0, |it| it.moved);
        let known = match &suspended {
            Some(it) => &it.vertices,
            None => self.table.vertices.get(&id)?,
        };
        let of_item = self.table.lines_of(item, text.count());
        // Where a vertex begins that is not touched, or where the polyline ends.
        let place = |vertex: usize| match known.lines.get(vertex) {
            Some(&line) => of_item.start as i64 + i64::from(line) + moved,
            None => of_item.end as i64 + lines,
        };
        let mut end = vertices.end;
        let last = (known.own as usize).min(end + MOST_BEHIND);
        let ends_at = |at: usize| {
            while place(end) < at as i64 && end < last {
                end += 1;
            }
            (place(end) >= at as i64).then(|| place(end) == at as i64)
        };
        let first = of_item.start + *known.lines.get(vertices.start)? as usize;
        let read = entities::read_run(text, of_item.start, (vertices.start, first), ends_at)?;
        let vertices = vertices.start..end;
        let found = known.lines.len() - vertices.len() + read.vertices.len();
        if found < 2 || !read.vertices.iter().all(Vertex::is_finite) {
            return None;
        }
        // The bytes before the edit, as the findings have them.
        let byte_of = |line: i64| self.text.line_start(line as usize);
        let old_byte_of = |line: i64| (byte_of(line) as i64 - bytes) as usize;
        let run = byte_of(first as i64)..old_byte_of(place(end));
        let whole = byte_of(of_item.start as i64)..old_byte_of(of_item.end as i64 + lines);
        let count = known.count_line(of_item.start);
        let tag = self.bytes_of_tag(count);
        let said = match count {
            Some(line) if !read.is_damaged => entities::count_finding(text, line, found),
            _ => Vec::new(),
        };
        let delta = if read.is_damaged {
            let (mut suspended, delta) = match suspended {
                Some(suspended) => (suspended, Delta::default()),
                None => {
                    let elsewhere = [whole.start..run.start, run.end..whole.end];
                    if elsewhere
                        .into_iter()
                        .any(|it| self.is_at_fault_in(it, &tag))
                    {
                        return None;
                    }
                    let touched = vec![Touched::Removed { entity: id }];
                    (self.suspend(item, id)?, Delta { touched })
                }
            };
            (suspended.changed, suspended.moved) = (vertices, moved);
            self.suspended = Some(suspended);
            delta
        } else {
            self.replace_run(
                (item, id),
                suspended,
                vertices,
                moved,
                (read.vertices, read.lines),
            )?
        };
        shift(&mut self.table.lines, item + 1, lines);
        self.splice_findings(run, bytes, read.findings);
        if count.is_some() {
            self.splice_findings(tag, 0, said);
        }
        Some(delta)
    }

    /// Takes the polyline out of the drawing. `None` where other entities would have to be read
    /// again, too.
    fn suspend(&mut self, item: usize, id: EntityId) -> Option<Box<Suspended>> {
        let is_named = self.table.items.get(item)?.named == Named::ByText;
        // What is hidden is counted.
        let is_shown = self.drawing.visibility(id) == Visibility::Shown;
        if !is_named || !is_shown || self.table.named_anew > 0 || !self.drawing.is_editable(id) {
            return None;
        }
        let appearance = self.drawing.appearance(id);
        let vertices = self.table.vertices.remove(&id)?;
        let entity = Arc::make_mut(&mut self.drawing).remove(id)?;
        self.table.set_item_of(id, NO_ITEM);
        self.table.items.get_mut(item)?.became = Became::Damaged;
        Some(Box::new(Suspended {
            item,
            id,
            entity,
            appearance,
            vertices,
            changed: 0..0,
            moved: 0,
        }))
    }

    /// Replaces some vertices by what was read of a run, with its lines, after a suspended polyline
    /// has come back.
    fn replace_run(
        &mut self,
        (item, id): (usize, EntityId),
        suspended: Option<Box<Suspended>>,
        run: Range<usize>,
        moved: i64,
        (mut vertices, lines): (Vec<Vertex>, Vec<u32>),
    ) -> Option<Delta> {
        let drawing = Arc::make_mut(&mut self.drawing);
        let comes_back = suspended.is_some();
        if let Some(it) = suspended {
            if !drawing.put_back(id, it.entity) {
                return None;
            }
            drawing.set_appearance(id, it.appearance);
            self.table.items.get_mut(item)?.became = Became::Entity(id);
            self.table.set_item_of(id, item as u32);
            self.table.vertices.insert(id, it.vertices);
        }
        let known = self.table.vertices.get_mut(&id)?;
        shift(&mut known.lines, run.end, moved);
        known.own = known.own - run.len() as u32 + lines.len() as u32;
        known.lines.splice(run.clone(), lines);
        if known.mirrored {
            vertices.iter_mut().for_each(mirror);
        }
        let Geometry::Polyline { vertices: all, .. } = &drawing.get(id)?.geometry else {
            return None;
        };
        let old = all.get(run.clone())?;
        // Those that were told of its removal have to be told of its return.
        let (start, removed, inserted) = match differing(old, &vertices) {
            (_, 0, 0) if !comes_back => return Some(Delta::default()),
            (_, 0, 0) => (0, 0, 0),
            differing => differing,
        };
        let new = vertices.get(start..start + inserted)?;
        let touched = drawing.splice(id, run.start + start, removed, new).ok()?;
        Some(Delta {
            touched: vec![touched],
        })
    }

    /// True where there is a finding in `bytes` that does not lie in `but`.
    fn is_at_fault_in(&self, bytes: Range<usize>, but: &Range<usize>) -> bool {
        let key = |finding: &Finding| range_key(finding).0;
        let first = self.findings.partition_point(|it| key(it) < bytes.start);
        let here = self.findings.iter().skip(first).map(key);
        here.take_while(|&at| at < bytes.end)
            .any(|at| !but.contains(&at))
    }

    /// The bytes of the tag that begins in a line.
    fn bytes_of_tag(&self, line: Option<usize>) -> Range<usize> {
        let byte_of = |line| self.text.line_start(line);
        line.map_or(0..0, |line| byte_of(line)..byte_of(line + 2))
    }
}
