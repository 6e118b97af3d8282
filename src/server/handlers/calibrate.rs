//! `wedm/calibrate`: the kerf of each pass, from what was measured on a cut test piece.

use crate::calibration::{self, Measurement, Setup, UNCERTAINTY};
use crate::protocol::{Calibrate, Calibrated, CalibratedPass, FeatureKind};
use crate::server::errors::refused;
use crate::settings::LARGEST;
use tower_lsp::jsonrpc::{Error, Result};

pub(in crate::server) fn calibrate(params: Calibrate) -> Result<Calibrated> {
    let last = params.corrections.len();
    let uncertainty = params.uncertainty.unwrap_or(UNCERTAINTY);
    let measured = params.measurements.iter();
    let lengths = measured.flat_map(|one| [one.nominal, one.measured]);
    let of_setup = params.corrections.iter().chain(&params.wire_diameter);
    let mut all = lengths.chain(of_setup.copied()).chain([uncertainty]);
    if let Some(wrong) = all.find(|length| !(0.0..=LARGEST).contains(length) || *length == 0.0) {
        let expected = say!(expected_a_length_in_mm_above_0);
        return Err(Error::invalid_params(say!(says, wrong, expected)));
    }
    if params.measurements.is_empty() {
        return Err(Error::invalid_params(say!(nothing_is_measured)));
    }
    let measurements = params.measurements.into_iter().zip(1..);
    let measurements = measurements.map(|(one, number): (_, usize)| Measurement {
        feature: one.feature.unwrap_or_else(|| number.to_string()),
        is_outer: one.kind == FeatureKind::Outer,
        pass: one.pass.unwrap_or(last),
        nominal: one.nominal,
        measured: one.measured,
    });
    let setup = Setup {
        corrections: params.corrections,
        wire_radius: params.wire_diameter.map(|diameter| diameter / 2.0),
        uncertainty,
    };
    let kerfs = calibration::calibrate(&measurements.collect::<Vec<_>>(), &setup);
    let kerfs = kerfs.map_err(|refusals| refused(refusals.join(say!(semicolon))))?;
    Ok(Calibrated {
        passes: kerfs.iter().map(CalibratedPass::from).collect(),
    })
}
