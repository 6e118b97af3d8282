//! The job on its page: the drill list, time and material, and whether the parts fit.

use super::super::fit::of_least;
use super::html::{cell, more, number, table, text};
use crate::analysis::{ShopWire, TightPlace, radius_prices};
use crate::document::{Document, Snapshot};
use crate::job::{self, NightWatch};
use crate::message::duration;
use crate::picture;
use crate::program::Format;
use crate::protocol::{Fit, StartHole, Work};
use crate::settings::part_title;
use crate::toolpath::{self, WirePath};

/// The most start holes and slugs on a page: other commands list them all.
const MOST: usize = 500;

/// The thread holes by their numbers, which they have in the picture and in the drill list, too.
pub(super) fn drill_list(holes: &[(usize, StartHole)], unit_mm: f64) -> String {
    let heads = [
        say!(column_number),
        say!(column_contour),
        "x mm",
        "y mm",
        "Ø mm",
        say!(column_hole),
    ];
    let row = |(index, hole): &(usize, StartHole)| {
        // A coordinate that rounds to zero has no sign.
        let mm = |along: f64| format!("{:.4}", (along * unit_mm * 1e4).round() / 1e4 + 0.0);
        let hole_is = if hole.given {
            say!(hole_given)
        } else {
            say!(hole_found)
        };
        vec![
            number(index),
            cell(&hole.contour),
            number(mm(hole.at.0)),
            number(mm(hole.at.1)),
            number(
                hole.diameter
                    .map(|diameter| diameter.to_string())
                    .unwrap_or_default(),
            ),
            cell(hole_is),
        ]
    };
    table(&heads, holes.iter().take(MOST).map(row)) + &more(holes.len(), MOST)
}

/// Lengths, times, costs, the largest wire and the slugs.
pub(super) fn time_and_material(work: &Work) -> String {
    let mut facts: Vec<String> = vec![match work.minutes {
        Some(minutes) => say!(the_cut_takes, work.length, duration(minutes), ""),
        None => say!(the_cut_is_long, work.length),
    }];
    facts.extend(work.cost.map(|cost| say!(the_cut_costs, cost)));
    if work.jumps > 0.0 {
        facts.push(say!(the_jumps_are_long, work.jumps));
    }
    if let Some(angle) = work.lead_angle {
        facts.push(say!(leads_turn_at_most, angle));
    }
    if let Some(largest) = &work.largest_wire {
        facts.push(largest.sentence());
    }
    if !work.missing.is_empty() {
        facts.push(say!(keys_are_missing, work.missing.join(", ")));
    }
    let slugs = work
        .slugs
        .iter()
        .take(MOST)
        .map(|slug| vec![cell(&slug.contour), number(format!("{:.1}", slug.mass))]);
    let heads = [say!(column_contour), say!(column_slug)];
    self::facts(&facts) + &table(&heads, slugs) + &more(work.slugs.len(), MOST)
}

/// How long the machine runs alone, what falls meanwhile, and where somebody has to stand by; nothing of a single cut.
pub(super) fn night(
    snapshot: &Snapshot,
    paths: &[WirePath],
    work: &toolpath::Work,
    format: Format,
) -> String {
    let night = job::night(snapshot, paths, work, format);
    if night.len() < 2 {
        return String::new();
    }
    let name = |watch: &NightWatch| {
        let outline = snapshot.outlines.get(watch.outline);
        outline.map_or("?", |outline| outline.name(&snapshot.drawing))
    };
    let row = |watch: &NightWatch| {
        let pass = match watch.cut_off {
            false => watch.pass.to_string(),
            true => say!(cut_off_in_pass, watch.pass),
        };
        let loose = watch.loose.as_ref().map(|loose| {
            let (class, what) = match (loose.is_slug, loose.is_watched) {
                (true, true) => ("", say!(the_slug_is_loose)),
                (false, true) => ("", say!(the_part_is_loose)),
                (true, false) => ("warning", say!(the_slug_falls)),
                (false, false) => ("warning", say!(the_part_falls)),
            };
            let mass = loose.mass.map(|mass| format!(" {mass:.1} g"));
            (class, text(format!("{what}{}", mass.unwrap_or_default())))
        });
        vec![
            cell(name(watch)),
            cell(pass),
            number(watch.until.map(duration).unwrap_or_default()),
            loose.unwrap_or_else(|| cell("")),
            cell(if watch.waits {
                say!(the_machine_waits)
            } else {
                ""
            }),
        ]
    };
    let heads = [
        say!(column_contour),
        say!(column_pass),
        say!(column_done_after),
        say!(column_loose),
        say!(column_stop),
    ];
    let rows = night.iter().take(MOST).map(row);
    self::facts(&job::unattended(snapshot, &night))
        + &table(&heads, rows)
        + &more(night.len(), MOST)
}

/// The most places named for a wire that they keep out.
const MOST_PLACES: usize = 8;

/// What each wire of the shop's table takes for the drawing, and what keeps it out.
pub(super) fn prices(snapshot: &Snapshot) -> String {
    let Snapshot {
        drawing,
        outlines,
        settings,
    } = snapshot;
    let Some(prices) = radius_prices(drawing, outlines, settings) else {
        return String::new();
    };
    let heads = [
        say!(column_wire),
        say!(column_from_radius),
        say!(column_time),
        say!(column_cost),
        say!(column_what_keeps_it_out),
    ];
    let name = |place: &TightPlace| {
        let handle = drawing.get(place.entity).map_or("?", |one| &one.handle);
        format!("{handle}/{} R {:.3}", place.segment, place.radius)
    };
    let row = |wire: &ShopWire| {
        let barring = prices.barring(wire);
        let mut listed: Vec<String> = barring.iter().take(MOST_PLACES).map(name).collect();
        if barring.len() > MOST_PLACES {
            listed.push("…".to_owned());
        }
        let is_chosen = prices.chosen() == Some(wire);
        let kept_out = match barring.len() {
            _ if is_chosen => ("good", text(say!(the_chosen_wire))),
            0 => cell(""),
            count => cell(say!(
                so_many_places,
                say!(places, count),
                listed.join(say!(comma))
            )),
        };
        vec![
            number(wire.diameter),
            number(format!("{:.3}", wire.least)),
            number(duration(wire.minutes)),
            number(
                wire.cost
                    .map(|cost| format!("{cost:.2}"))
                    .unwrap_or_default(),
            ),
            kept_out,
        ]
    };
    table(&heads, prices.wires.iter().map(row))
}

/// Sentences, a line each.
pub(super) fn facts(facts: &[String]) -> String {
    let line = |fact: &String| format!("<p class=\"fact\">{}</p>\n", text(fact));
    facts.iter().map(line).collect()
}

/// Whether punch and plate go into each other, where a clearance is set: the sentence, the places and the picture.
pub(super) fn fit(
    document: &Document,
    snapshot: &Snapshot,
    unit_mm: f64,
) -> Option<Result<Fit, String>> {
    snapshot.settings.pair.clearance?;
    let found = job::fit(document, snapshot, &()).map_err(|refusal| refusal.sentence(unit_mm));
    Some(found.map(|fit| {
        let svg = picture::fit_svg(&snapshot.drawing, &fit, unit_mm);
        Fit::new(&snapshot.drawing, &fit, svg, unit_mm)
    }))
}

pub(super) fn fit_part(fit: &Result<Fit, String>) -> String {
    let fit = match fit {
        Ok(fit) => fit,
        Err(reason) => return format!("<p class=\"error\">{}</p>\n", text(reason)),
    };
    let (class, verdict) = match fit.fits {
        true => ("good", say!(fits)),
        false => ("error", say!(do_not_fit)),
    };
    let sentence = of_least(fit, verdict);
    let alone: String = fit
        .alone
        .iter()
        .map(|alone| say!(a_contour_has_no_partner, alone.handle, alone.of))
        .map(|line| format!("<p class=\"warning\">{}</p>\n", text(line)))
        .collect();
    let rows = fit.places.iter().take(MOST).map(|place| {
        vec![
            number(format!("{:+.4}", place.clearance)),
            cell(part_title(&place.of)),
            cell(&place.handle),
            number(place.segment),
            number(format!("{:.4}, {:.4}", place.at.0, place.at.1)),
        ]
    });
    let heads = [
        say!(column_left),
        say!(column_part),
        say!(column_entity),
        say!(column_segment),
        say!(column_place),
    ];
    let places = table(&heads, rows);
    format!(
        "<p class=\"{class}\">{}</p>\n{alone}{places}{}",
        text(sentence),
        fit.svg
    )
}
