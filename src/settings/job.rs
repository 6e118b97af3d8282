//! Contradictory or ineffective settings of a program and its workpiece.

use super::{Compensation, Effective, LengthSetting, PassFault, Settings, SkimCorner};

/// Two lengths in mm that differ by less are equal.
const ROUNDING: f64 = 1e-9;

/// Words that end a program of blocks in one controller or another, and such that pause it.
pub(crate) const ENDS: [&str; 4] = ["DD", "E", "FF", "MJ"];
pub(crate) const PAUSES: [&str; 2] = ["D", "A"];

pub(super) fn faults(settings: &Settings) -> Vec<PassFault> {
    let program = settings.program();
    let mut faults = Vec::new();
    let mut complain = |key, message| faults.push(PassFault::of(key, message));
    let (end, pause) = (program.end(), program.pause());
    if end.eq_ignore_ascii_case(&pause) {
        let keys = ["program.end", "program.pause"];
        let [key, other] = match program.end.is_some() {
            true => keys,
            false => [keys[1], keys[0]],
        };
        complain(key, say!(one_word_for_pause_and_end, key, end, other));
    }
    if let Some(stop) = &program.tab_stop {
        let key = "program.tab-stop";
        match what_does(stop, &end, &pause) {
            Does::Stop => {}
            Does::End => complain(key, say!(a_stop_that_ends, key, stop)),
            Does::Nothing => complain(key, say!(a_stop_that_does_not_stop, key, stop, pause)),
        }
    }
    let passes = settings.passes.clone().unwrap_or_default();
    let count = passes.corrections.as_ref().map_or(1, Vec::len);
    if passes.skim_corner() == SkimCorner::ConstantStock
        && program.compensation() == Compensation::Controller
        && count > 1
    {
        let (key, other) = ("passes.skim-corner", "program.compensation");
        complain(
            key,
            say!(the_control_runs_beside_the_drawn_contour, key, other),
        );
    }
    if let Some(job) = &settings.job
        && job.slug_limit.is_some()
    {
        let key = "job.slug-limit";
        if job.thickness.is_none() {
            complain(key, say!(a_mass_needs_a_height, key));
        } else if matches!(program.tab, None | Some(LengthSetting::One(0.0))) {
            complain(key, say!(a_limit_needs_a_tab, key));
        }
    }
    faults
}

/// What may be meant: a lead so short that the wire is threaded within the kerf of its own cut.
pub(super) fn doubts(settings: &Settings) -> Vec<PassFault> {
    let program = settings.program();
    let effective = Effective::of(settings);
    let correction = effective.correction;
    let runs_beside = program.compensation() != Compensation::None && !effective.mills;
    let key = "program.lead-in";
    let short = program
        .lead_in
        .filter(|length| *length < correction - ROUNDING);
    let short = short.filter(|_| runs_beside);
    let said = |length| PassFault::of(key, say!(a_lead_within_the_kerf, key, length, correction));
    short.map(said).into_iter().collect()
}

enum Does {
    Stop,
    End,
    Nothing,
}

/// What a word between the cuts does, in a program of blocks or of ISO: one that stops either is taken for one.
fn what_does(word: &str, end: &str, pause: &str) -> Does {
    let is = |known: &str| word.eq_ignore_ascii_case(known);
    let of_iso = || {
        let number = word.strip_prefix(['M', 'm'])?;
        number.parse::<u32>().ok()
    };
    match of_iso() {
        Some(0 | 1) => Does::Stop,
        _ if is(end) => Does::End,
        _ if is(pause) => Does::Stop,
        Some(2 | 30) => Does::End,
        _ if ENDS.into_iter().any(is) => Does::End,
        _ if PAUSES.into_iter().any(is) => Does::Stop,
        _ => Does::Nothing,
    }
}
