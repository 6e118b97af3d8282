//! Contradictory or ineffective settings of a program and its workpiece.

use super::{LengthSetting, PassFault, Settings};

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
