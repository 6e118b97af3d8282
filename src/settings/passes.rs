//! The corrections of the passes, held against each other and against the wire.

/// Two lengths in mm that differ by less are equal: half a diameter is rounded.
const ROUNDING: f64 = 1e-9;

/// A pass that cannot follow the one before it, or that no wire can cut.
#[derive(Clone, Debug, PartialEq)]
pub struct PassFault {
    /// Index of the pass.
    pub pass: usize,
    /// Lower-case, no final dot.
    pub message: String,
}

/// What is wrong with the corrections of the passes from rough to finish, mm: one that is above that of the pass before it, and one
/// that is below the wire's radius, where the diameter is known. `is_list`: they come from `passes.corrections`, not from `correction`.
pub fn pass_faults(
    corrections: &[f64],
    is_list: bool,
    wire_diameter: Option<f64>,
) -> Vec<PassFault> {
    let name = |pass: usize| {
        if is_list {
            format!("passes.corrections[{pass}]")
        } else {
            "correction".into()
        }
    };
    let mut faults = Vec::new();
    for (pass, &correction) in corrections.iter().enumerate() {
        if let Some(before) = pass
            .checked_sub(1)
            .and_then(|before| corrections.get(before))
            && correction > before + ROUNDING
        {
            let message = say!(
                is_expected_at_most_that_of_the_pass_before,
                name(pass),
                correction,
                before
            );
            faults.push(PassFault { pass, message });
        }
        if let Some(radius) = wire_diameter.map(|diameter| diameter / 2.0)
            && correction < radius - ROUNDING
        {
            let message = say!(
                is_expected_at_least_the_wire_radius,
                name(pass),
                correction,
                radius
            );
            faults.push(PassFault { pass, message });
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corrections_fall_and_stay_above_the_radius_of_the_wire() {
        let check = |corrections: &[f64], diameter: Option<f64>, expected: &[usize]| {
            let passes: Vec<usize> = pass_faults(corrections, true, diameter)
                .iter()
                .map(|fault| fault.pass)
                .collect();
            assert_eq!(passes, expected, "{corrections:?} {diameter:?}");
        };
        check(&[0.175, 0.146, 0.140], None, &[]);
        check(&[0.175, 0.146, 0.140], Some(0.25), &[]);
        check(&[0.14], Some(0.28), &[]);
        check(&[0.14, 0.14, 0.14], Some(0.25), &[]);
        check(&[0.140, 0.146, 0.175], None, &[1, 2]);
        check(&[0.2, 0.1, 0.15], None, &[2]);
        check(&[0.175, 0.12], Some(0.25), &[1]);
        check(&[0.1, 0.12], Some(0.25), &[0, 1, 1]);
        check(&[], Some(0.25), &[]);
    }
}
