//! The kerf of each pass, from what was measured on a cut test piece.
//!
//! The wire's centre runs the correction c beside the contour and takes away whatever is nearer to it than half of the kerf,
//! k = wire radius + gap. So the part ends c − k outside of the contour on each side: of the nominal size s an outer feature
//! measures m = s + 2 (c − k), an opening m = s − 2 (c − k). Each feature is an estimate of k; the least squares of all of
//! them, none better known than another, are their mean.
//!
//! The uncertainty is the half of the 95 % confidence interval, Student's t · s / √n (NIST/SEMATECH e-Handbook of Statistical
//! Methods, 1.3.5.2), and never less than half of that of a single measurement: a caliper that reads too much does so in all
//! of them. Outer and inner means are compared by the two-sample t-test (1.3.5.3), the feature that lies farthest from the
//! others by Grubbs' test (1.3.5.17.1), both at 95 %.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// Of a single measurement, where nothing is stated, mm.
pub(crate) const UNCERTAINTY: f64 = 0.002;

/// The share of measurements that may lie outside of what is stated.
const OUTSIDE: f64 = 0.05;

/// Student's t hardly changes beyond so many degrees of freedom.
const MOST_FREEDOM: usize = 1000;

/// A size that was measured after a pass, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Measurements of the same name are of the same feature.
    pub feature: String,
    /// Its material is between the faces that were measured, as of a punch; else they face each other, as in an opening.
    pub is_outer: bool,
    /// 1-based.
    pub pass: usize,
    pub nominal: f64,
    pub measured: f64,
}

/// What the piece was cut and measured with, mm.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The correction of each pass.
    pub corrections: Vec<f64>,
    pub wire_radius: Option<f64>,
    /// Of a single measurement: 95 of 100 are nearer to the truth.
    pub uncertainty: f64,
}

/// Half of the kerf of one pass, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Kerf {
    /// 1-based.
    pub pass: usize,
    /// The correction with which it was cut, mm.
    pub correction: f64,
    pub half: f64,
    /// 95 % confidence.
    pub uncertainty: f64,
    /// Where the wire is known.
    pub gap: Option<f64>,
    pub features: usize,
    /// By the outer and by the inner features alone.
    pub by_kind: [Option<f64>; 2],
    /// Nothing shows how much its measurements scatter.
    pub is_single: bool,
}

/// What all measurements of one feature say of a pass.
struct Feature<'a> {
    name: &'a str,
    is_outer: bool,
    halves: Vec<f64>,
}

impl Feature<'_> {
    fn half(&self) -> f64 {
        mean(&self.halves)
    }
}

/// Half of the kerf of each pass that was measured.
///
/// # Errors
/// Each contradiction in a sentence.
pub fn calibrate(measurements: &[Measurement], setup: &Setup) -> Result<Vec<Kerf>, Vec<String>> {
    let (mut kerfs, mut refusals): (Vec<Kerf>, Vec<String>) = (Vec::new(), Vec::new());
    let passes: BTreeSet<usize> = measurements.iter().map(|one| one.pass).collect();
    for pass in passes {
        let index = pass.checked_sub(1);
        let Some(correction) = index.and_then(|index| setup.corrections.get(index).copied()) else {
            let count = setup.corrections.len();
            refusals.push(say!(a_pass_that_is_not_set, pass, count));
            continue;
        };
        let own = measurements.iter().filter(|one| one.pass == pass);
        let found = features(own, correction).and_then(|features| {
            let features: Vec<Feature<'_>> = features.into_values().collect();
            match contradictions(pass, &features, setup.uncertainty) {
                none if none.is_empty() => Ok(kerf((pass, correction), &features, setup)),
                some => Err(some),
            }
        });
        match found {
            Ok(kerf) => kerfs.push(kerf),
            Err(of_pass) => refusals.extend(of_pass),
        }
    }
    for kerf in &kerfs {
        if let (Some(gap), Some(radius)) = (kerf.gap, setup.wire_radius)
            && gap < 0.0
        {
            let Kerf { pass, half, .. } = kerf;
            refusals.push(say!(the_wire_is_thicker_than_its_kerf, pass, half, radius));
        }
    }
    for (before, kerf) in kerfs.iter().zip(kerfs.iter().skip(1)) {
        let allowed = before.uncertainty.hypot(kerf.uncertainty);
        if kerf.half > before.half + allowed {
            let (pass, half) = (kerf.pass, kerf.half);
            refusals.push(say!(
                a_pass_cuts_wider_than_the_one_before,
                pass,
                half,
                before.pass,
                before.half,
                allowed
            ));
        }
    }
    match refusals.is_empty() {
        true => Ok(kerfs),
        false => Err(refusals),
    }
}

/// The features of a pass by name, each with what its measurements say.
fn features<'a>(
    measurements: impl Iterator<Item = &'a Measurement>,
    correction: f64,
) -> Result<BTreeMap<&'a str, Feature<'a>>, Vec<String>> {
    let mut features = BTreeMap::new();
    let mut refusals = Vec::new();
    for one in measurements {
        let beyond = (one.measured - one.nominal) / 2.0;
        let half = match one.is_outer {
            true => correction - beyond,
            false => correction + beyond,
        };
        // No kerf is narrower than nothing; and one of twice the correction comes from a slip of the pen.
        if half <= 0.0 || half >= 2.0 * correction {
            let Measurement {
                feature,
                nominal,
                measured,
                ..
            } = one;
            refusals.push(say!(
                no_kerf_explains_a_size,
                feature,
                measured,
                nominal,
                correction,
                half
            ));
        }
        let feature = features
            .entry(one.feature.as_str())
            .or_insert_with(|| Feature {
                name: &one.feature,
                is_outer: one.is_outer,
                halves: Vec::new(),
            });
        feature.halves.push(half);
    }
    match refusals.is_empty() {
        true => Ok(features),
        false => Err(refusals),
    }
}

/// A feature that stands out; else outer and inner features that differ, which no correction explains.
fn contradictions(pass: usize, features: &[Feature<'_>], uncertainty: f64) -> Vec<String> {
    let halves: Vec<f64> = features.iter().map(Feature::half).collect();
    // What measuring alone scatters: t of many degrees of freedom is 2, and a size has two faces.
    let least = uncertainty / 4.0;
    if let Some((index, others, allowed)) = standing_out(&halves, least)
        && let (Some(feature), Some(half)) = (features.get(index), halves.get(index))
    {
        let name = feature.name;
        return vec![say!(
            a_feature_stands_out,
            pass,
            name,
            half,
            others,
            allowed
        )];
    }
    let [outer, inner] = by_kind(features);
    if outer.is_empty() || inner.is_empty() {
        return Vec::new();
    }
    let (of_outer, of_inner) = (mean(&outer), mean(&inner));
    let counts = [outer.len(), inner.len()].map(|count| 1.0 / count as f64);
    let freedom = outer.len() + inner.len() - 2;
    let by_scatter = match freedom {
        0 => 0.0,
        _ => {
            let scatter = ((squares(&outer) + squares(&inner)) / freedom as f64).sqrt();
            student_t(OUTSIDE, freedom) * scatter * (counts[0] + counts[1]).sqrt()
        }
    };
    // Jaws that are off by the stated uncertainty, outside one way and inside the other.
    let allowed = by_scatter.max(uncertainty);
    match (of_outer - of_inner).abs() > allowed {
        true => vec![say!(
            outer_and_inner_features_differ,
            pass,
            of_outer,
            of_inner,
            allowed
        )],
        false => Vec::new(),
    }
}

/// The value farthest from the mean of the others, where Grubbs' test says that it is none of them: its index, that mean,
/// and what would be allowed. It is the same as the t-test of the value against the others, at the share of n values and
/// two sides.
fn standing_out(values: &[f64], least: f64) -> Option<(usize, f64, f64)> {
    let count = values.len();
    if count < 3 {
        return None;
    }
    let middle = mean(values);
    let off = |index: &usize| values.get(*index).map_or(0.0, |own| (own - middle).abs());
    let index = (0..count).max_by(|a, b| off(a).total_cmp(&off(b)))?;
    let others: Vec<f64> = values
        .iter()
        .enumerate()
        .filter(|(other, _)| *other != index)
        .map(|(_, value)| *value)
        .collect();
    let freedom = count - 2;
    let scatter = (squares(&others) / freedom as f64).sqrt().max(least);
    let allowed = student_t(OUTSIDE / count as f64, freedom)
        * scatter
        * (1.0 + 1.0 / others.len() as f64).sqrt();
    let of_others = mean(&others);
    ((values.get(index)? - of_others).abs() > allowed).then_some((index, of_others, allowed))
}

fn kerf((pass, correction): (usize, f64), features: &[Feature<'_>], setup: &Setup) -> Kerf {
    let all: Vec<f64> = features.iter().map(Feature::half).collect();
    // The measurements of one feature share its form: only where there is no other do they count one by one.
    let estimates = match features {
        [only] => &only.halves,
        _ => &all,
    };
    let count = estimates.len();
    let by_scatter = match count {
        1 => 0.0,
        _ => {
            let scatter = (squares(estimates) / (count - 1) as f64).sqrt();
            student_t(OUTSIDE, count - 1) * scatter / (count as f64).sqrt()
        }
    };
    let half = mean(&all);
    Kerf {
        pass,
        correction,
        half,
        uncertainty: by_scatter.max(setup.uncertainty / 2.0),
        gap: setup.wire_radius.map(|radius| half - radius),
        features: features.len(),
        by_kind: by_kind(features).map(|halves| (!halves.is_empty()).then(|| mean(&halves))),
        is_single: count == 1,
    }
}

/// What the outer and the inner features say.
fn by_kind(features: &[Feature<'_>]) -> [Vec<f64>; 2] {
    [true, false].map(|is_outer| {
        let own = features
            .iter()
            .filter(|feature| feature.is_outer == is_outer);
        own.map(Feature::half).collect()
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The sum of the squared distances from the mean.
fn squares(values: &[f64]) -> f64 {
    let middle = mean(values);
    values.iter().map(|value| (value - middle).powi(2)).sum()
}

/// Student's t: the distance from the mean, in standard errors, beyond which this share lies on both sides together.
pub fn student_t(outside: f64, freedom: usize) -> f64 {
    let freedom = freedom.clamp(1, MOST_FREEDOM);
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        match share_within(middle, freedom) < 1.0 - outside {
            true => low = middle,
            false => high = middle,
        }
    }
    (freedom as f64).sqrt() * low.tan()
}

/// The share between −t and t for the angle arctan(t / √ν): Abramowitz and Stegun, Handbook of Mathematical Functions,
/// 26.7.3 for odd ν and 26.7.4 for even ones.
fn share_within(angle: f64, freedom: usize) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let odd = freedom % 2;
    let mut term = if odd == 1 { cosine } else { 1.0 };
    let mut sum = 0.0;
    for step in 0..freedom / 2 {
        sum += term;
        let over = (2 * step + 1 + odd) as f64;
        term *= cosine * cosine * over / (over + 1.0);
    }
    match odd {
        1 => FRAC_2_PI * (angle + sine * sum),
        _ => sine * sum,
    }
}
