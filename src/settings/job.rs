//! Contradictory or ineffective settings of a program and its workpiece.

use super::{
    Compensation, Effective, LengthSetting, PassFault, Settings, SkimCorner, WearCompensation,
};

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
    let mut check = |key, stop: &str, ends: String| match what_does(stop, &end, &pause) {
        Does::Stop => {}
        Does::End => complain(key, ends),
        Does::Nothing => complain(key, say!(a_stop_that_does_not_stop, key, stop, pause)),
    };
    if let Some(stop) = &program.tab_stop {
        let key = "program.tab-stop";
        check(key, stop, say!(a_stop_that_ends, key, stop));
    }
    if let Some(stop) = program
        .pause_between_passes
        .as_deref()
        .filter(|stop| !stop.is_empty())
    {
        let key = "program.pause-between-passes";
        check(key, stop, say!(a_pause_that_ends, key, stop));
    }
    if let Some((hole, wire)) = program.start_hole.zip(settings.wire_diameter)
        && hole <= wire
    {
        let (key, other) = ("program.start-hole", "wire-diameter");
        complain(
            key,
            say!(a_hole_narrower_than_the_wire, key, hole, other, wire),
        );
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
    if let Some(job) = &settings.job {
        let counts = [&job.wires, &job.wire_gaps, &job.wire_rates];
        let [wires, gaps, rates] = counts.map(|list| list.as_ref().map_or(0, Vec::len));
        if wires != gaps || wires != rates {
            let keys = ["job.wires", "job.wire-gaps", "job.wire-rates"];
            let stated = keys.iter().zip(counts).find(|(_, list)| list.is_some());
            let key = stated.map_or(keys[0], |(key, _)| *key);
            complain(key, say!(each_wire_needs_all, wires, gaps, rates));
        }
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

/// Settings without effect beside the others.
pub(super) fn idle(settings: &Settings) -> Vec<PassFault> {
    let (program, passes) = (
        settings.program(),
        settings.passes.clone().unwrap_or_default(),
    );
    let milling = settings.milling.clone().unwrap_or_default();
    let mut faults = Vec::new();
    let mut complain = |key, message| faults.push(PassFault::of(key, message));
    let compensation = program.compensation();
    let count = passes.corrections.as_ref().map_or(1, Vec::len);
    if count > 1 && compensation == Compensation::None {
        let key = "passes.corrections";
        complain(
            key,
            say!(passes_on_the_drawn_line, key, "program.compensation", count),
        );
    }
    if passes.registers.is_some() && compensation == Compensation::Path {
        let (key, other) = ("passes.registers", "program.compensation");
        complain(key, say!(registers_need_the_control, key, other));
    }
    if passes.skim_corner() == SkimCorner::ConstantStock && count == 1 {
        let key = "passes.skim-corner";
        complain(key, say!(a_stock_needs_skims, key, "passes.corrections"));
    }
    if program.pause_between_passes.is_some() && count == 1 {
        let key = "program.pause-between-passes";
        complain(key, say!(a_pause_needs_passes, key, "passes.corrections"));
    }
    if program.tab_stop.is_some() && !keeps_a_tab(settings) {
        let key = "program.tab-stop";
        complain(key, say!(a_stop_needs_a_tab, key, "program.tab"));
    }
    let job = settings.job.clone().unwrap_or_default();
    let for_minutes = [
        ("job.thickness", job.thickness.is_none()),
        ("passes.rates", passes.rates.is_none()),
    ];
    let missing = for_minutes
        .into_iter()
        .filter(|(_, is_missing)| *is_missing);
    let missing: Vec<&str> = missing.map(|(key, _)| key).collect();
    if job.wires.is_some() && job.thickness.is_none() {
        let (key, other) = ("job.wires", "job.thickness");
        complain(key, say!(wires_need_a_height, key, other));
    }
    if job.machine_rate.is_some() && job.wires.is_none() && !missing.is_empty() {
        let (key, and) = ("job.machine-rate", say!(and));
        complain(key, say!(a_rate_needs_minutes, key, missing.join(and)));
    }
    if milling.step.is_some() && milling.wear_compensation() != WearCompensation::Linear {
        let (key, other) = ("milling.step", "milling.wear-compensation");
        complain(key, say!(a_step_needs_linear_feed, key, other));
    }
    faults
}

/// True where some contour is to leave a tab.
fn keeps_a_tab(settings: &Settings) -> bool {
    match &settings.program().tab {
        None => false,
        Some(LengthSetting::One(length)) => *length > 0.0,
        Some(LengthSetting::ByHandle(lengths)) => lengths.values().any(|length| *length > 0.0),
    }
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
