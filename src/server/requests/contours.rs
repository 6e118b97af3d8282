//! `wedm/contours`: what is chained to what.

use super::{Errand, is_small, run, snapshot_of, written};
use crate::protocol::{Contours, DrawingName};
use crate::server::state::State;

pub(in crate::server) fn contours(state: &mut State, params: DrawingName, errand: Errand) {
    match snapshot_of(state, &params.uri) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok((snapshot, stamp)) => {
            let marks = (stamp, is_small(&snapshot.drawing));
            run(state, "Listing contours", &params.uri, marks, errand, move |_, _| {
                let unit_mm = snapshot.settings.unit_of(&snapshot.drawing).mm;
                written(&Contours::new(&snapshot.drawing, &snapshot.outlines, unit_mm))
            });
        }
    }
}
