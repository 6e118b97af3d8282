//! `textDocument/codeLens`: actions for a program above its first block, and the totals of a drawing's cuts. For
//! clients that have the commands.

use super::Task;
use crate::analysis::largest_wire;
use crate::document::Snapshot;
use crate::ide::SymbolKind;
use crate::ide::program::symbols;
use crate::job::{self, Cut};
use crate::message::duration;
use crate::program::Format;
use crate::server::context::RequestContext;
use crate::settings::part_title;
use crate::toolpath;
use ls_types::{CodeLens, CodeLensParams, Command};
use serde_json::json;
use tower_lsp::jsonrpc::Result;

/// Contours that get a lens of their own.
const LENSES: usize = 500;

pub(in crate::server) fn code_lens(
    context: &RequestContext,
    _: CodeLensParams,
) -> Result<Option<Vec<CodeLens>>> {
    if !context.abilities.code_lens {
        return Ok(None);
    }
    let Some(program) = context.program() else {
        return Ok(of_drawing(context));
    };
    let lens = |range, title: String, command: &str, arguments| CodeLens {
        range: context.range(program.text(), range),
        command: Some(Command {
            title,
            command: command.into(),
            arguments,
        }),
        data: None,
    };
    let tree = symbols(program);
    let contours = || tree.iter().filter(|symbol| symbol.kind == SymbolKind::Cut);
    let of_program = contours().take(1).flat_map(|first| {
        // Commands of the client, each with the document's URI as its argument.
        [
            (say!(simulate), "wedm.simulate"),
            (say!(open_picture), "wedm.openPicture"),
            (say!(convert_to_dxf), "wedm.convertToDxf"),
        ]
        .map(|(title, command)| {
            let arguments = Some(vec![json!(*context.uri)]);
            lens(first.selection.clone(), title.into(), command, arguments)
        })
    });
    // A lens whose command has no name is only shown.
    let of_contours = contours().take(LENSES).map(|symbol| {
        let title = say!(says, symbol.name, symbol.detail);
        lens(symbol.selection.clone(), title, "", None)
    });
    Ok(Some(of_program.chain(of_contours).collect()))
}

/// Segments of a drawing beyond which no path is planned for a lens, and no narrow place looked for.
const LAID: usize = 5_000;

/// The totals of a drawing's cuts and the largest wire, above its first line; nothing without a text, or where neither
/// is known.
fn of_drawing(context: &RequestContext) -> Option<Vec<CodeLens>> {
    let (document, text) = context.document_and_text()?;
    document.drawing()?;
    let task = Task::of(context).ok()?;
    let (drawing, outlines) = (&task.snapshot.drawing, &task.snapshot.outlines);
    let settings = &task.snapshot.settings;
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    let cuts = (segments <= LAID).then(|| task.cuts(context).ok());
    let told = |cut: Cut| {
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = &cut.snapshot;
        let work = toolpath::work(drawing, outlines, settings, &cut.planned.paths);
        let minutes = work.minutes.map(|minutes| say!(and_minutes, minutes));
        let format = settings.format.unwrap_or(Format::ThreeB);
        let night = job::night(&cut.snapshot, &cut.planned.paths, &work, format);
        let alone = job::alone(&night).filter(|(_, is_end)| !is_end);
        let alone = alone.map(|(minutes, _)| say!(and_alone, duration(minutes)));
        let told = say!(
            cut_of,
            say!(contours, cut.planned.holes.len()),
            work.length,
            match work.jumps > 0.0 {
                true => say!(and_jumps, work.jumps),
                false => String::new(),
            },
            minutes.unwrap_or_default() + &alone.unwrap_or_default()
        );
        match cut.name() {
            Some(name) => say!(of_a_part, part_title(name), told),
            None => told,
        }
    };
    let cuts = cuts.flatten().into_iter().flatten().map(told);
    let wire = (segments <= LAID).then(|| largest_wire(drawing, outlines, settings, &|_| true));
    let wire = wire.flatten().map(|largest| match largest.facing {
        Some(_) => say!(
            largest_wire_by_a_narrow_place,
            largest.diameter,
            2.0 * largest.radius
        ),
        None => say!(largest_wire, largest.diameter, largest.radius),
    });
    let title = cuts.chain(wire).collect::<Vec<_>>().join("; ");
    (!title.is_empty()).then(|| {
        let command = Command {
            title,
            command: String::new(),
            arguments: None,
        };
        vec![CodeLens {
            range: context.range(text, 0..0),
            command: Some(command),
            data: None,
        }]
    })
}
