//! `wedm/toolpath`: the path of the wire's centre; `wedm/holes`: the thread holes as a file for the drill.

use super::Task;
use crate::document::Snapshot;
use crate::job::{Cut, drill};
use crate::protocol::{Exported, HoleForm, Holes, OptionsOf, Toolpath};
use crate::server::config::name_of;
use crate::server::context::RequestContext;
use crate::server::errors::refused;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn toolpath(context: &RequestContext, _: OptionsOf) -> Result<Toolpath> {
    let task = Task::of(context)?;
    let cuts = task.cuts(context)?;
    let of_cut = |cut: &Cut| {
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = &cut.snapshot;
        let toolpath = Toolpath::new(drawing, outlines, settings, &cut.planned);
        match &cut.part {
            None => toolpath,
            Some(part) => {
                let (name, is_other) = (&part.name, part.is_other_side);
                toolpath.of_part(name, &part.corrections, is_other, &cut.places)
            }
        }
    };
    Toolpath::together(cuts.iter().map(of_cut)).ok_or_else(|| refused(say!(no_path_can_be_made)))
}

pub(in crate::server) fn holes(context: &RequestContext, asked: Holes) -> Result<Exported> {
    let task = Task::of(context)?;
    let cuts = task.cuts(context)?;
    let bytes = match asked.format {
        HoleForm::Dxf => {
            let source = task.subject.source();
            let drawn = drill::as_dxf(source, &task.snapshot, &cuts);
            drawn.map_err(refused)?.bytes
        }
        HoleForm::Csv => {
            let name = name_of(&asked.uri).unwrap_or(asked.uri);
            let mut list = drill::List::default();
            list.add(&name, &cuts);
            list.csv().into_bytes()
        }
    };
    Ok(Exported::new(&bytes))
}
