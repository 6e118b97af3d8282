//! `textDocument/codeAction`: the fixes of findings, one action that makes every safe fix, and the refactorings of programs.

use super::{Errand, SMALL, Subject, Target, run, subject_of, workspace_edit};
use crate::document::{Document, Rounds, Source};
use crate::finding;
use crate::finding::{Edit, Finding, Fix, Place};
use crate::program::language;
use crate::protocol::{self, Diagnostic, FindingData, method};
use crate::server::convert;
use crate::server::state::State;
use crate::text::Encoding;
use ls_types::{
    CodeAction, CodeActionContext, CodeActionDisabled, CodeActionKind, CodeActionOrCommand,
    CodeActionParams, CodeActionResponse, CodeActionTriggerKind, Command, Range,
};
use rustc_hash::FxHashSet;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) const FIX_ALL: &str = "source.fixAll.wedm";

/// More findings than this in one range get their fixes by "fix all" only: nobody picks from a longer list.
const LISTED: usize = 100;

/// Lines of a text, or entities of a drawing, beyond which it costs too much to try a repair behind each repair for no use.
const LONG: usize = 50_000;

pub(in crate::server) fn code_action(
    state: &mut State,
    params: CodeActionParams,
    errand: Errand<Option<CodeActionResponse>>,
) {
    match prepare(state, &params) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        // Nothing can be fixed in a text that is neither drawing nor program.
        Ok(None) => {
            let _ = errand.reply.send(Ok(Some(CodeActionResponse::new())));
        }
        Ok(Some((
            Subject {
                document,
                stamp,
                small,
            },
            target,
        ))) => {
            let uri = params.text_document.uri.as_str().to_owned();
            run(
                state,
                "Looking for fixes",
                &uri,
                (stamp, small),
                errand,
                move |_, _| Ok(Some(actions(&document, &target, &params))),
            );
        }
    }
}

fn prepare(state: &mut State, params: &CodeActionParams) -> Result<Option<(Subject, Target)>> {
    let uri = &params.text_document.uri;
    let target = Target::of(state, uri)?;
    let open = state.document(uri.as_str())?;
    let Some(document) = open.document() else {
        return Ok(None);
    };
    if document.program().is_some() {
        let small = document
            .text()
            .is_none_or(|text| text.line_count() <= SMALL);
        return Ok(Some((
            Subject {
                document: document.clone(),
                stamp: open.stamp,
                small,
            },
            target,
        )));
    }
    Ok(Some((subject_of(state, uri.as_str())?, target)))
}

fn actions(document: &Document, target: &Target, params: &CodeActionParams) -> CodeActionResponse {
    let unit_mm = document
        .drawing()
        .map_or(1.0, |drawing| document.settings().unit_of(drawing).mm);
    let mut actions = Vec::new();
    if wants(&params.context, CodeActionKind::QUICKFIX.as_str()) {
        for finding in chosen(document, params, target.encoding) {
            let related_of = target.shows_related.then_some(target.uri.as_str());
            let diagnostic = convert::diagnostic(document, &finding, target.encoding, related_of);
            for (index, fix) in document.fixes(&finding).iter().enumerate() {
                actions.extend(quick_fix(
                    document,
                    target,
                    &diagnostic,
                    fix,
                    index == 0,
                    unit_mm,
                ));
            }
        }
    }
    if wants(&params.context, FIX_ALL) && is_asked_for(&params.context) {
        let action = CodeAction {
            title: say!(fix_all_that_can_be_fixed_safely).into(),
            kind: Some(CodeActionKind::new(FIX_ALL)),
            ..CodeAction::default()
        };
        actions.extend(fix_all(
            document,
            target,
            action,
            params.context.only.is_some(),
        ));
    }
    if let Some(program) = document.program()
        && is_asked_for(&params.context)
    {
        let selection = convert::bytes_of(program.text(), params.range, target.encoding);
        let proposals = language::refactorings(program, document.settings(), selection, |id| {
            wants(&params.context, id)
        });
        actions.extend(
            proposals
                .into_iter()
                .filter_map(|proposal| refactoring(document, target, proposal)),
        );
    }
    actions
        .into_iter()
        .map(CodeActionOrCommand::CodeAction)
        .collect()
}

/// In a long document that is gone through once where the editor asks for whatever there is, at every step of the cursor.
fn fix_all(
    document: &Document,
    target: &Target,
    action: CodeAction,
    is_meant: bool,
) -> Option<CodeAction> {
    let is_long = document.text().map_or_else(
        || document.drawing().map_or(0, |drawing| drawing.len()) > LONG,
        |text| text.line_count() > LONG,
    );
    if is_long && !is_meant {
        return with_edit(document, target, action, &document.fix_all()?);
    }
    match document.fix_all_to_the_end()? {
        Rounds::OfText(edits) => with_edit(document, target, action, &Edit::Text(edits)),
        Rounds::OfDrawing(rounds) => {
            let changes = rounds
                .iter()
                .flat_map(|(drawing, edit)| protocol::changes_of(drawing, edit))
                .collect();
            with_changes(target, action, changes)
        }
    }
}

/// False where an editor only wants to know whether to show a light bulb, at every move of the cursor.
fn is_asked_for(context: &CodeActionContext) -> bool {
    context.only.is_some() || context.trigger_kind != Some(CodeActionTriggerKind::AUTOMATIC)
}

/// A refactoring, or the reason why it cannot be done for clients that show it.
fn refactoring(
    document: &Document,
    target: &Target,
    proposal: language::Proposal,
) -> Option<CodeAction> {
    let action = CodeAction {
        title: proposal.title,
        kind: Some(CodeActionKind::new(proposal.id)),
        ..CodeAction::default()
    };
    match proposal.edits {
        Ok(edits) => with_edit(document, target, action, &Edit::Text(edits)),
        Err(reason) => target.shows_disabled.then(|| CodeAction {
            disabled: Some(CodeActionDisabled { reason }),
            ..action
        }),
    }
}

/// True when the client asked for this kind, for one above it, or for all.
fn wants(context: &CodeActionContext, kind: &str) -> bool {
    let Some(only) = &context.only else {
        return true;
    };
    only.iter().any(|asked| {
        let asked = asked.as_str();
        asked.is_empty()
            || kind == asked
            || kind
                .strip_prefix(asked)
                .is_some_and(|rest| rest.starts_with('.'))
    })
}

/// The findings that the client means: those of its diagnostics where they say which, else those in the range.
fn chosen(document: &Document, params: &CodeActionParams, encoding: Encoding) -> Vec<Finding> {
    let findings = document.all_findings();
    let named: FxHashSet<(String, String, usize)> = params
        .context
        .diagnostics
        .iter()
        .filter_map(name_of)
        .collect();
    // In a program, rule and line say which: its findings have no handle.
    let said: FxHashSet<(String, u32)> = params
        .context
        .diagnostics
        .iter()
        .filter_map(|diagnostic| Some((rule_of(diagnostic)?, diagnostic.range.start.line)))
        .collect();
    let said_of = |finding: &Finding| {
        let (text, range) = (document.text()?, document.range_of(&finding.place)?);
        Some((
            finding.rule.name().to_owned(),
            convert::range_of(text, range, encoding).start.line,
        ))
    };
    let drawing = document.drawing().cloned().unwrap_or_default();
    let in_range = in_range(document, params.range, encoding);
    let is_named = if document.program().is_some() {
        !said.is_empty()
    } else {
        !named.is_empty()
    };
    let is_chosen = |finding: &Finding| match (!is_named, &finding.place) {
        (true, _) => in_range(document, finding),
        (false, Place::Segment { entity, segment }) => drawing.get(*entity).is_some_and(|entity| {
            named.contains(&(
                finding.rule.name().to_owned(),
                entity.handle.to_string(),
                *segment,
            ))
        }),
        (false, _) => said_of(finding).is_some_and(|name| said.contains(&name)),
    };
    let chosen: Vec<Finding> = findings
        .iter()
        .filter(|finding| is_chosen(finding))
        .take(LISTED)
        .cloned()
        .collect();
    chosen
}

/// Rule, handle and segment that a client's diagnostic names.
fn name_of(diagnostic: &ls_types::Diagnostic) -> Option<(String, String, usize)> {
    let data: FindingData = serde_json::from_value(diagnostic.data.clone()?).ok()?;
    Some((rule_of(diagnostic)?, data.handle?, data.segment?))
}

fn rule_of(diagnostic: &ls_types::Diagnostic) -> Option<String> {
    match diagnostic.code.as_ref()? {
        ls_types::NumberOrString::String(rule) => Some(rule.clone()),
        ls_types::NumberOrString::Number(_) => None,
    }
}

/// Whether a finding lies in the range: by line in a drawing, by the bytes of its number or of its segment in a text.
fn in_range(
    document: &Document,
    range: Range,
    encoding: Encoding,
) -> impl Fn(&Document, &Finding) -> bool + use<> {
    let bytes = document
        .text()
        .map(|text| convert::bytes_of(text, range, encoding));
    let segments: FxHashSet<_> = bytes
        .clone()
        .map(|bytes| document.segments_at(bytes))
        .unwrap_or_default()
        .into_iter()
        .collect();
    move |document, finding| {
        let segment = match finding.place {
            Place::Segment { entity, segment } => Some((entity, segment)),
            _ => None,
        };
        match (&bytes, document.range_of(&finding.place)) {
            (Some(bytes), Some(own)) => {
                (own.start <= bytes.end && bytes.start <= own.end)
                    || segment.is_some_and(|segment| segments.contains(&segment))
            }
            _ => {
                let line = segment.map_or(0, |(_, segment)| segment);
                (range.start.line as usize..=range.end.line as usize).contains(&line)
            }
        }
    }
}

fn quick_fix(
    document: &Document,
    target: &Target,
    diagnostic: &Diagnostic,
    fix: &Fix<Edit>,
    first: bool,
    unit_mm: f64,
) -> Option<CodeAction> {
    let action = CodeAction {
        title: finding::title(&fix.kind, unit_mm),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: convert::lsp_diagnostic(diagnostic).map(|diagnostic| vec![diagnostic]),
        is_preferred: (first && fix.preferred).then_some(true),
        ..CodeAction::default()
    };
    with_edit(document, target, action, &fix.edit)
}

/// The action with its edit in the form that the document takes; `None` where the edit cannot be made there.
fn with_edit(
    document: &Document,
    target: &Target,
    action: CodeAction,
    edit: &Edit,
) -> Option<CodeAction> {
    match (document.source(), edit) {
        (Source::Dxf(dxf), Edit::Drawing(edit)) => match dxf.text_edits(edit) {
            Ok(edits) => {
                let edits = convert::lsp_edits(dxf.text(), edits, target.encoding);
                Some(CodeAction {
                    edit: Some(workspace_edit(target, edits)),
                    ..action
                })
            }
            Err(reason) => {
                tracing::info!("\"{}\" is not offered: {reason}", action.title);
                None
            }
        },
        (Source::Cad(drawing), Edit::Drawing(edit)) => {
            with_changes(target, action, protocol::changes_of(drawing, edit))
        }
        (_, Edit::Text(edits)) => {
            let edits = convert::lsp_edits(document.text()?, edits.clone(), target.encoding);
            Some(CodeAction {
                edit: Some(workspace_edit(target, edits)),
                ..action
            })
        }
        (Source::Program(_), Edit::Drawing(_)) => None,
    }
}

fn with_changes(
    target: &Target,
    action: CodeAction,
    changes: Vec<protocol::DrawingChange>,
) -> Option<CodeAction> {
    let argument = protocol::DrawingEdit {
        uri: target.uri.as_str().into(),
        version: target.version,
        changes,
    };
    let arguments = vec![serde_json::to_value(argument).ok()?];
    let command = Command {
        title: action.title.clone(),
        command: method::APPLY_DRAWING_EDIT_COMMAND.into(),
        arguments: Some(arguments),
    };
    Some(CodeAction {
        command: Some(command),
        ..action
    })
}
