//! One finding that stands for several of one cause: those of a local rule in one contour, and open contours that are too
//! many to be slips. Each is still found at its own place, for its repairs.

use super::Analysis;
use crate::drawing::{ContourKey, Drawing, EntityId};
use crate::finding::{Detail, Finding, Place, Rule, Severity};
use crate::rules::{
    CONTOUR_RULES, ContourRule, LOCAL_RULES, LocalRule, Observation, Outlook, Together, ends_apart,
};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Observations that are worked out to find the one that stands for all of its contour.
const WORKED_OUT: usize = 256;
/// Other places that are named.
const NAMED: usize = 32;

/// A finding without its rule.
pub(super) type Gathered = (Place, Detail, Vec<Place>);

/// One finding for several observations of a rule in a contour.
pub(super) fn of_observations(
    outlook: &Outlook,
    rule: &LocalRule,
    together: Together,
    concerned: Vec<Observation>,
) -> Option<Gathered> {
    let mut worst = concerned.clone();
    let order = |one: &Observation, other: &Observation| {
        let heavier = other.weight.total_cmp(&one.weight);
        heavier.then(one.index.cmp(&other.index))
    };
    if worst.len() > WORKED_OUT {
        worst.select_nth_unstable_by(WORKED_OUT, order);
        worst.truncate(WORKED_OUT);
    }
    worst.sort_unstable_by(order);
    let told = |one: Observation| Some((one, (rule.detail)(outlook, one, None)?));
    let some: Vec<(Observation, Detail)> = worst.into_iter().filter_map(told).collect();
    let (at, detail) = together(outlook, &some, concerned.len())?;
    let others = concerned.iter().filter(|one| one.index != at.index);
    let places = others.filter_map(|one| outlook.place(one.index as usize));
    let place = outlook.place(at.index as usize)?;
    Some((place, detail, places.take(NAMED).collect()))
}

/// One finding for many contours, with the layers that they lie on, those with most of them first.
pub(super) fn of_contours(rule: &ContourRule, met: &[Outlook]) -> Option<Gathered> {
    let places = met
        .iter()
        .filter_map(|outlook| Some((outlook, (rule.places)(outlook)?.0)));
    let places: Vec<(&Outlook, Place)> = places.collect();
    let layer = |(outlook, place): &(&Outlook, Place)| {
        Some(outlook.drawing.get(place.entity()?.0)?.layer.clone())
    };
    of_layers(
        places.iter().filter_map(layer),
        places.iter().map(|(_, place)| place.clone()),
        ends_apart(met),
    )
}

fn of_layers(
    layers: impl Iterator<Item = Arc<str>>,
    mut places: impl Iterator<Item = Place>,
    next: Option<f64>,
) -> Option<Gathered> {
    let mut counts: BTreeMap<Arc<str>, usize> = BTreeMap::new();
    layers.for_each(|layer| *counts.entry(layer).or_default() += 1);
    let mut layers: Vec<(Arc<str>, usize)> = counts.into_iter().collect();
    layers.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let count = layers.iter().map(|(_, count)| count).sum();
    let place = places.next()?;
    Some((
        place,
        Detail::OpenContours {
            count,
            layers,
            next,
        },
        places.take(NAMED).collect(),
    ))
}

impl Analysis {
    /// The findings at a segment that others may stand for, each by itself.
    pub fn each_at(&self, drawing: &Drawing, at: (EntityId, usize)) -> Vec<Finding> {
        let Some((key, index)) = self.chains.index_of(at.0, at.1) else {
            return Vec::new();
        };
        let Some((outlook, known)) = self.outlook(drawing, key).zip(self.known.get(&key)) else {
            return Vec::new();
        };
        let role = self.outlines(drawing).iter().find(|outline| {
            let mut pieces = outline.contour.pieces.iter();
            pieces.any(|piece| piece.entity == at.0)
        });
        let side = role.and_then(|outline| self.wire_side(key, outline.role));
        let mut found = known.each_at(&outlook, side, index);
        for rule in CONTOUR_RULES
            .iter()
            .filter(|_| side.is_none() && !outlook.contour.closed)
        {
            let here = (rule.places)(&outlook).filter(|_| (rule.holds)(&outlook));
            let is_here = |place: &Place| place.entity() == Some((at.0, Some(at.1)));
            if let Some((place, _)) = here.filter(|(place, _)| is_here(place)) {
                found.extend((rule.detail)(&outlook).map(|detail| (rule.rule, place, detail)));
            }
        }
        let finding = |(rule, place, detail): (Rule, Place, Detail)| {
            Some(Finding {
                rule,
                severity: self.settings.severity(rule)?,
                place,
                detail,
                related: Vec::new(),
            })
        };
        found.into_iter().filter_map(finding).collect()
    }

    /// Findings that are named by themselves, with one that stands for those of a contour and a rule.
    pub(super) fn together_again(&self, drawing: &Drawing, findings: Vec<Finding>) -> Vec<Finding> {
        // Open contours of a drawing are told together, whatever contour they are; others by contour.
        type Group = (Rule, Severity, Option<ContourKey>);
        let mut groups: FxHashMap<Group, Vec<usize>> = FxHashMap::default();
        for (number, finding) in findings.iter().enumerate() {
            let Some((key, _)) = self.index_of(finding) else {
                continue;
            };
            let contour = match finding.rule {
                Rule::OpenContour => None,
                rule if has_together(rule) && !is_of_no_side(finding) => Some(key),
                _ => continue,
            };
            let group = (finding.rule, finding.severity, contour);
            groups.entry(group).or_default().push(number);
        }
        let mut findings: Vec<Option<Finding>> = findings.into_iter().map(Some).collect();
        for numbers in groups.into_values() {
            let own: Vec<&Finding> = (numbers.iter())
                .filter_map(|number| findings.get(*number)?.as_ref())
                .collect();
            let Some((place, detail, related)) = self.told_together(drawing, &own) else {
                continue;
            };
            let first = numbers.first().copied();
            numbers
                .iter()
                .skip(1)
                .for_each(|&number| findings[number] = None);
            if let Some(Some(finding)) = first.and_then(|first| findings.get_mut(first)) {
                (finding.place, finding.detail, finding.related) = (place, detail, related);
            }
        }
        findings.into_iter().flatten().collect()
    }

    fn told_together(&self, drawing: &Drawing, own: &[&Finding]) -> Option<Gathered> {
        let first = own.first()?;
        if let Some(rule) = CONTOUR_RULES.iter().find(|rule| rule.rule == first.rule) {
            let places = || own.iter().map(|finding| finding.place.clone());
            let layer = |place: Place| Some(drawing.get(place.entity()?.0)?.layer.clone());
            if own.len() < rule.many {
                return None;
            }
            let outlook = |finding: &&Finding| self.outlook(drawing, self.index_of(finding)?.0);
            let met: Vec<Outlook> = own.iter().filter_map(outlook).collect();
            return of_layers(places().filter_map(layer), places(), ends_apart(&met));
        }
        let rule = LOCAL_RULES.iter().find(|rule| rule.rule == first.rule)?;
        let (key, _) = self.index_of(first)?;
        let observation = |finding: &&Finding| {
            let (_, index) = self.index_of(finding)?;
            let weight = match finding.detail {
                Detail::SharpCorner { turn, .. } | Detail::NearTangent { turn } => turn.abs(),
                _ => 0.0,
            };
            let weight = weight as f32;
            Some(Observation {
                weight,
                ..Observation::at(index)
            })
        };
        let concerned: Vec<Observation> = own.iter().filter_map(observation).collect();
        let outlook = self.outlook(drawing, key)?;
        let several = rule.together.filter(|_| own.len() > 1)?;
        of_observations(&outlook, rule, several, concerned)
    }

    fn index_of(&self, finding: &Finding) -> Option<(ContourKey, usize)> {
        match finding.place {
            Place::Segment { entity, segment } => self.chains.index_of(entity, segment),
            _ => None,
        }
    }
}

fn has_together(rule: Rule) -> bool {
    LOCAL_RULES
        .iter()
        .any(|local| local.rule == rule && local.together.is_some())
}

/// True for the hint that stands for the corners of a contour already.
fn is_of_no_side(finding: &Finding) -> bool {
    matches!(finding.detail, Detail::SharpCorner { count: Some(_), .. })
}
