//! `textDocument/codeAction`: the fixes of findings, one action that makes every safe fix, and the refactorings of programs.
//!
//! A refactoring rewrites the whole text: clients that resolve actions get its edit for the one that is chosen.

use crate::document::{Document, Source};
use crate::drawing::{Drawing, EntityId};
use crate::finding::{Edit, Finding, Keep, Place, Rule};
use crate::job::{self, Outcome, Repairs};
use crate::program::{self, Offer};
use crate::protocol::{self, FindingData, method};
use crate::server::context::RequestContext;
use crate::server::convert;
use crate::server::errors::{moved_on, refused};
use crate::settings;
use crate::text::SourceText;
use ls_types::{
    CodeAction, CodeActionContext, CodeActionDisabled, CodeActionKind, CodeActionOrCommand,
    CodeActionParams, CodeActionResponse, CodeActionTriggerKind, Command, Range,
};
use rustc_hash::FxHashSet;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeSet;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) const FIX_ALL: &str = "source.fixAll.wedm";

/// More findings than this in one range get their fixes by "fix all" only: a longer list is of no use.
const LISTED: usize = 100;

/// Lines of a text, or entities of a drawing, beyond which repairs after other repairs are only tried on request: it
/// costs too much to try them for no use.
const LONG: usize = 50_000;

/// Lines of a program beyond which a refactoring is not tried before it is chosen: trying all takes a second for some
/// 20,000.
const TRIED: usize = 5_000;

/// The `data` of an action: its document, and the refactoring that its edit comes from.
#[derive(Deserialize, Serialize)]
pub(super) struct Unresolved {
    pub(super) uri: String,
    version: i64,
    #[serde(skip_serializing_if = "Option::is_none")]
    refactoring: Option<Chosen>,
}

#[derive(Deserialize, Serialize)]
struct Chosen {
    id: String,
    range: Range,
}

/// `codeAction/resolve`: the edit of a refactoring. Other actions come back as they are.
pub(in crate::server) fn resolve(
    context: &RequestContext,
    action: CodeAction,
) -> Result<CodeAction> {
    let data = action
        .data
        .clone()
        .map(serde_json::from_value::<Unresolved>);
    let Some(Ok(Unresolved {
        version,
        refactoring: Some(chosen),
        ..
    })) = data
    else {
        return Ok(action);
    };
    let document = context.document();
    let Some((document, program)) = document.and_then(|own| Some((own, own.program()?))) else {
        return Ok(action);
    };
    if version != context.version {
        return Err(moved_on());
    }
    let selection = convert::bytes_of(program.text(), chosen.range, context.encoding);
    let settings = document.settings();
    let offers = program::offers(program, settings, selection, |id| id == chosen.id);
    // One profile's is told from another's by its title.
    let offer = offers.iter().find(|offer| offer.title == action.title);
    let edits = offer
        .map_or(Ok(Vec::new()), Offer::edits)
        .map_err(refused)?;
    if edits.is_empty() {
        return Err(refused(say!(it_would_change_nothing)));
    }
    let plain = action.clone();
    Ok(with_edit(context, document, action, &Edit::Text(edits)).unwrap_or(plain))
}

pub(in crate::server) fn code_action(
    context: &RequestContext,
    params: CodeActionParams,
) -> Result<Option<CodeActionResponse>> {
    // A text that is neither drawing nor program has no fixes.
    let actions = context
        .document()
        .map(|document| actions(context, document, &params));
    Ok(Some(actions.unwrap_or_default()))
}

fn actions(
    context: &RequestContext,
    document: &Document,
    params: &CodeActionParams,
) -> CodeActionResponse {
    let unit_mm = document
        .drawing()
        .map_or(1.0, |drawing| document.settings().unit_of(drawing).mm);
    let asked = &params.context;
    let mut actions = Vec::new();
    if wants(asked, CodeActionKind::QUICKFIX.as_str()) {
        let related_of = context
            .abilities
            .related_information
            .then_some(&*context.uri);
        let mut whereabouts = document.whereabouts();
        for finding in chosen(context, document, params) {
            let data = FindingData::of(document, &finding, &mut whereabouts);
            let diagnostic =
                convert::diagnostic(document, &finding, data, context.encoding, related_of);
            for (index, fix) in document.fixes(&finding).iter().enumerate() {
                let action = CodeAction {
                    title: fix.kind.title(unit_mm),
                    kind: Some(CodeActionKind::QUICKFIX),
                    diagnostics: convert::lsp_diagnostic(&diagnostic)
                        .map(|diagnostic| vec![diagnostic]),
                    is_preferred: (index == 0 && fix.preferred).then_some(true),
                    ..CodeAction::default()
                };
                actions.extend(with_edit(context, document, action, &fix.edit));
            }
        }
    }
    if wants(asked, FIX_ALL) && is_asked_for(asked) {
        let action = CodeAction {
            title: say!(fix_all_that_can_be_fixed_safely).into(),
            kind: Some(CodeActionKind::new(FIX_ALL)),
            ..CodeAction::default()
        };
        actions.extend(fix_all(context, document, action, asked.only.is_some()));
    }
    if let Some(program) = document.program()
        && is_asked_for(asked)
    {
        let selection = convert::bytes_of(program.text(), params.range, context.encoding);
        let offers = program::offers(program, document.settings(), selection, |id| {
            wants(asked, id)
        });
        actions.extend(
            offers
                .into_iter()
                .filter_map(|offer| refactoring(context, document, params.range, offer)),
        );
    }
    let named = |action: CodeAction| CodeAction {
        data: action.data.or_else(|| unresolved(context, None)),
        ..action
    };
    let named = actions.into_iter().map(named);
    named.map(CodeActionOrCommand::CodeAction).collect()
}

/// All safe fixes; in a long document one round of them where the editor asks for everything at every step of the
/// cursor.
fn fix_all(
    context: &RequestContext,
    document: &Document,
    action: CodeAction,
    is_meant: bool,
) -> Option<CodeAction> {
    let is_long = document.text().map_or_else(
        || document.drawing().map_or(0, |drawing| drawing.len()) > LONG,
        |text| text.line_count() > LONG,
    );
    if is_long && !is_meant {
        return with_edit(context, document, action, &document.fix_all()?);
    }
    let (made, repaired) = match job::fix_all(document, context)? {
        Repairs::OfText {
            edits, repaired, ..
        } => {
            let edit = Edit::Text(edits);
            (with_edit(context, document, action, &edit)?, repaired)
        }
        Repairs::OfDrawing { rounds, repaired } => {
            let changes = rounds
                .iter()
                .flat_map(|(drawing, edit)| protocol::changes_of(drawing, edit))
                .collect();
            (with_changes(context, action, changes)?, repaired)
        }
    };
    let outcome = Outcome::of(document, &repaired);
    let data = protocol::FixAllData {
        uri: context.uri.to_string(),
        version: context.version,
        said: outcome.said(),
        repaired: outcome.repaired,
        left: outcome.left,
    };
    Some(CodeAction {
        data: serde_json::to_value(data).ok(),
        ..made
    })
}

/// False where an editor only wants to know whether to show a light bulb, at every move of the cursor.
fn is_asked_for(context: &CodeActionContext) -> bool {
    context.only.is_some() || context.trigger_kind != Some(CodeActionTriggerKind::AUTOMATIC)
}

/// A refactoring, or why it is not possible for clients that show that. In a long text it is not tried before it is
/// chosen, where the client asks again then.
fn refactoring(
    context: &RequestContext,
    document: &Document,
    range: Range,
    offer: Offer,
) -> Option<CodeAction> {
    let action = CodeAction {
        title: offer.title.clone(),
        kind: Some(CodeActionKind::new(offer.id)),
        ..CodeAction::default()
    };
    let resolves = context.abilities.resolves_actions;
    let lines = document.text().map_or(0, SourceText::line_count);
    let later = || {
        let id = offer.id.to_owned();
        let data = unresolved(context, Some(Chosen { id, range }));
        Some(CodeAction {
            data,
            ..action.clone()
        })
    };
    if resolves && lines > TRIED {
        return later();
    }
    match offer.tried()?.edits {
        Ok(_) if resolves => later(),
        Ok(edits) => with_edit(context, document, action, &Edit::Text(edits)),
        Err(reason) => context.abilities.disabled_actions.then(|| CodeAction {
            disabled: Some(CodeActionDisabled { reason }),
            ..action
        }),
    }
}

/// What resolving an action needs; nothing for clients that do not.
fn unresolved(context: &RequestContext, refactoring: Option<Chosen>) -> Option<Value> {
    let data = Unresolved {
        uri: context.uri.to_string(),
        version: context.version,
        refactoring,
    };
    let is_wanted = context.abilities.resolves_actions;
    is_wanted.then(|| serde_json::to_value(data).ok())?
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

/// The findings that the request is about: those of its diagnostics where they say which, else
/// those in the range.
fn chosen(
    context: &RequestContext,
    document: &Document,
    params: &CodeActionParams,
) -> Vec<Finding> {
    let diagnostics = &params.context.diagnostics;
    let named: FxHashSet<(String, String, usize)> =
        diagnostics.iter().filter_map(name_of).collect();
    // In a program, rule and line identify a finding: it has no handle.
    let said: FxHashSet<(String, u32)> = diagnostics
        .iter()
        .filter_map(|diagnostic| Some((rule_of(diagnostic)?, diagnostic.range.start.line)))
        .collect();
    let said_of = |finding: &Finding| {
        let (text, range) = (document.text()?, document.range_of(&finding.place)?);
        let line = convert::range_of(text, range, context.encoding).start.line;
        Some((finding.rule.name().to_owned(), line))
    };
    let in_range = in_range(context, document, params.range);
    let is_named = match document.program() {
        Some(_) => !said.is_empty(),
        None => !named.is_empty(),
    };
    let is_chosen = |finding: &Finding| match (is_named, &finding.place) {
        (false, _) => in_range(finding),
        (true, Place::Segment { entity, segment }) => document
            .drawing()
            .and_then(|drawing| drawing.get(*entity))
            .is_some_and(|entity| {
                let rule = finding.rule.name().to_owned();
                named.contains(&(rule, entity.handle.to_string(), *segment))
            }),
        (true, _) => said_of(finding).is_some_and(|name| said.contains(&name)),
    };
    let findings = document.all_findings();
    let chosen = findings.iter().filter(|finding| is_chosen(finding));
    let mut chosen: Vec<Finding> = chosen.take(LISTED).cloned().collect();
    // One finding may stand for several: each is repaired where it is.
    let places = match (document.source(), document.text()) {
        (Source::Cad(drawing), _) => {
            let several = if is_named { &chosen[..] } else { &findings[..] };
            stood_for(drawing, several, &named, params.range)
        }
        (_, Some(text)) if !is_named => {
            let bytes = convert::bytes_of(text, params.range, context.encoding);
            let segments = document.segments_at(bytes).into_iter();
            segments.map(|at| (at, None)).collect()
        }
        _ => Vec::new(),
    };
    for (at, rule) in places.into_iter().take(LISTED) {
        let known = |one: &Finding| {
            let mut all = chosen.iter();
            all.any(|other| (other.rule, &other.place) == (one.rule, &one.place))
        };
        let is_meant = |one: &Finding| rule.is_none_or(|rule| rule == one.rule) && !known(one);
        let each = document.each_at(at).into_iter();
        let new: Vec<Finding> = each.filter(is_meant).collect();
        chosen.extend(new);
    }
    chosen
}

/// The places of a drawing without text that findings stand for, each with its rule: those that are named themselves, and
/// those in the range of the findings, of the entities that these name.
fn stood_for(
    drawing: &Drawing,
    findings: &[Finding],
    named: &FxHashSet<(String, String, usize)>,
    range: Range,
) -> Vec<((EntityId, usize), Option<Rule>)> {
    let of_name = |(rule, handle, segment): &(String, String, usize)| {
        Some(((drawing.find(handle)?, *segment), Some(Rule::named(rule)?)))
    };
    let mut places: Vec<_> = named.iter().filter_map(of_name).collect();
    places.sort_unstable();
    for finding in findings
        .iter()
        .filter(|finding| !finding.related.is_empty())
    {
        let own = std::iter::once(&finding.place).chain(&finding.related);
        let entities = own.filter_map(|place| Some(place.entity()?.0));
        let entities: BTreeSet<EntityId> = entities.collect();
        if places.len() >= LISTED {
            break;
        }
        for entity in entities {
            let count = drawing
                .get(entity)
                .map_or(0, |it| it.geometry.segment_count());
            let lines = range.start.line as usize..count.min(range.end.line as usize + 1);
            let at = lines.map(|segment| ((entity, segment), Some(finding.rule)));
            places.extend(at.take(LISTED));
        }
    }
    places
}

/// Rule, handle and segment in a client's diagnostic.
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
    context: &RequestContext,
    document: &Document,
    range: Range,
) -> impl Fn(&Finding) -> bool {
    let bytes = document
        .text()
        .map(|text| convert::bytes_of(text, range, context.encoding));
    let segments: FxHashSet<_> = bytes
        .clone()
        .map(|bytes| document.segments_at(bytes))
        .unwrap_or_default()
        .into_iter()
        .collect();
    move |finding| {
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

/// The action with its edit in the form that the document takes; `None` where the edit cannot be made there.
fn with_edit(
    context: &RequestContext,
    document: &Document,
    action: CodeAction,
    edit: &Edit,
) -> Option<CodeAction> {
    let edits = match (document.source(), edit) {
        (Source::Cad(drawing), Edit::Drawing(edit)) => {
            return with_changes(context, action, protocol::changes_of(drawing, edit));
        }
        (Source::Dxf(dxf), Edit::Drawing(edit)) => dxf
            .text_edits(edit)
            .inspect_err(|reason| tracing::info!("\"{}\" is not offered: {reason}", action.title))
            .ok()?,
        (_, Edit::Settings(keeps)) => return with_settings(context, action, keeps),
        (_, Edit::Text(edits)) => edits.clone(),
        (Source::Program(_), Edit::Drawing(_)) => return None,
    };
    let edit = context.workspace_edit(document.text()?, edits).ok()?;
    Some(CodeAction {
        edit: Some(edit),
        ..action
    })
}

/// The action with lines for the `wedm.toml` that holds for the document, or for a new one beside it.
fn with_settings(
    context: &RequestContext,
    action: CodeAction,
    keeps: &[Keep],
) -> Option<CodeAction> {
    let file = context.settings_file()?;
    let text = file.text.as_str_lossy();
    let edits = vec![settings::keep(&text, keeps)?];
    let edit = context.settings_edit(file, edits)?;
    Some(CodeAction {
        edit: Some(edit),
        ..action
    })
}

fn with_changes(
    context: &RequestContext,
    action: CodeAction,
    changes: Vec<protocol::DrawingChange>,
) -> Option<CodeAction> {
    let argument = protocol::DrawingEdit {
        uri: context.uri.to_string(),
        version: context.version,
        changes,
    };
    let command = Command {
        title: action.title.clone(),
        command: method::APPLY_DRAWING_EDIT_COMMAND.into(),
        arguments: Some(vec![serde_json::to_value(argument).ok()?]),
    };
    Some(CodeAction {
        command: Some(command),
        ..action
    })
}
