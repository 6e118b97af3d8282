//! `wedm/settings`: the settings in force for a document, open or not.

use crate::protocol::{CorrectionSource, SettingsInForce};
use crate::server::config::{name_of, uri_of};
use crate::server::state::State;
use crate::settings::{Effective, Settings};

pub(in crate::server) fn settings(state: &mut State, uri: &str) -> SettingsInForce {
    let file = state.file_for(uri);
    let of_client = state.config.settings_for(None);
    let settings = state.config.settings_for(file.as_deref());
    let effective = Effective::of_document(&settings, name_of(uri));
    SettingsInForce {
        correction: as_stated(effective.correction),
        corrections: effective.corrections.into_iter().map(as_stated).collect(),
        correction_from: source(&of_client, file.as_ref().map(|file| &file.settings)),
        side: effective.side,
        file: file.as_ref().and_then(|file| uri_of(&file.path)),
        contours: effective.own,
    }
}

/// mm, without what halving a diameter and adding a gap leave in the sixteenth place.
fn as_stated(mm: f64) -> f64 {
    (mm * 1e9).round() / 1e9
}

/// Passes replace a single correction, but one of a later level, which replaces them.
fn source(of_client: &Settings, of_file: Option<&Settings>) -> CorrectionSource {
    let has_passes = |settings: &Settings| {
        settings
            .passes
            .as_ref()
            .is_some_and(|passes| passes.corrections.is_some())
    };
    let has_single = |settings: &Settings| {
        settings
            .correction
            .or(settings.wire_diameter)
            .or(settings.gap)
            .is_some()
    };
    let has_electrode = |settings: &Settings| {
        settings
            .milling
            .as_ref()
            .is_some_and(|milling| milling.is_said())
    };
    let states_one = |settings: &Settings| settings.correction.is_some();
    if of_file.is_some_and(|file| has_passes(file) || states_one(file)) {
        CorrectionSource::File
    } else if has_passes(of_client) {
        CorrectionSource::Client
    } else if of_file.is_some_and(has_single) {
        CorrectionSource::File
    } else if has_single(of_client) {
        CorrectionSource::Client
    } else if of_file.is_some_and(has_electrode) {
        CorrectionSource::File
    } else if has_electrode(of_client) {
        CorrectionSource::Client
    } else {
        CorrectionSource::Default
    }
}
