//! `wedm/settings`: the settings in force for a document, open or not.

use crate::protocol::{CorrectionSource, SettingsInForce, as_stated};
use crate::server::config::{ProjectFile, uri_of};
use crate::server::state::State;
use crate::settings::{Effective, Origin};

pub(in crate::server) fn settings(
    state: &State,
    uri: &str,
    file: Option<&ProjectFile>,
) -> SettingsInForce {
    let effective = state.config.effective_for(uri, file);
    let effective: &Effective = &effective;
    let open = state.documents.get(uri);
    let drawing = open.and_then(|open| open.content.drawing());
    let mut said = vec![effective.said_corrections(), effective.said_side()];
    said.extend(drawing.map(|drawing| effective.said_unit(drawing)));
    SettingsInForce {
        correction: as_stated(effective.correction),
        corrections: effective
            .corrections
            .iter()
            .copied()
            .map(as_stated)
            .collect(),
        correction_from: source(effective.origins.correction),
        side: effective.side,
        side_from: effective.origins.side,
        units_to_mm: drawing.map(|drawing| effective.unit_of(drawing).mm),
        units_from: drawing.map(|drawing| effective.unit_from(drawing)),
        said: said.join(say!(comma)),
        file: file.and_then(|file| uri_of(&file.path)),
        contours: effective.own.clone(),
    }
}

/// An electrode counts like a wire here.
fn source(origin: Origin) -> CorrectionSource {
    match origin {
        Origin::Client => CorrectionSource::Client,
        Origin::File => CorrectionSource::File,
        _ => CorrectionSource::Default,
    }
}
