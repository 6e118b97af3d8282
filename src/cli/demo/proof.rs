//! The demonstration's own proof: reads drawing and program again, from their text alone.

use super::super::Failure;
use super::holds;
use crate::document::{Document, Source};
use crate::drawing::Role;
use crate::finding::sentence;
use crate::geometry::{Arc, Point, Segment};
use crate::program::path::{Kind, Step};
use crate::program::three_b;
use crate::program::write::scaled;
use crate::protocol::{PathPiece, PathSource, SegmentShape, Toolpath};
use crate::settings::{Effective, Settings};
use crate::{dxf, picture, toolpath};
use serde_json::Value;
use std::sync::Arc as Shared;

pub(crate) struct Proof {
    pub(crate) blocks: usize,
    /// Largest distance of a decoded block from the path, or of the path from the blocks, µm.
    pub(crate) from_path_um: f64,
    /// Distance of the program's end from the last thread hole, each block decoded from the end of the one before, µm.
    pub(crate) open_um: f64,
    /// Smallest and largest distance in mm from the contours to the wire's cuts along them.
    pub(crate) least_distance: f64,
    pub(crate) largest_distance: f64,
    pub(crate) picture: String,
}

/// Places on each block that are checked.
const SAMPLES: u32 = 16;

/// `faulty` and `fixed` are DXF text; `path` is the reply of `wedm/toolpath` for the latter.
pub(crate) fn of(
    faulty: &str,
    fixed: &str,
    program: &str,
    path: &Value,
    correction: f64,
) -> Result<Proof, Failure> {
    let path: Toolpath = serde_json::from_value(path.clone())
        .map_err(|error| Failure(say!(the_wire_path_is_not_one, error)))?;
    let settings = settings(correction);
    let mut before = document(faulty, &settings);
    let mut after = document(fixed, &settings);
    let (faults, _) = before.findings(usize::MAX);
    holds(!after.has_errors() && !faults.is_empty(), || {
        say!(the_repaired_drawing_has_errors_when_it_is_read_again).into()
    })?;
    let (Some(snapshot), Some(first)) = (after.snapshot(), path.paths.first()) else {
        return Err(Failure(
            say!(there_is_no_path_to_hold_the_program_against).into(),
        ));
    };

    let motions = decoded(program, Point::from(first.thread_hole))?;
    let pieces: Vec<(PathSource, Segment)> = path
        .paths
        .iter()
        .flat_map(|path| &path.segments)
        .filter_map(|piece| Some((piece.source, geometry(piece)?)))
        .collect();
    let contours: Vec<Segment> = snapshot
        .outlines
        .iter()
        .flat_map(|outline| {
            outline
                .contour
                .segments(&snapshot.drawing)
                .map(|segment| segment.geometry)
        })
        .collect();
    let mut proof = measured(&motions, &pieces, &contours);
    let arcs = motions
        .iter()
        .filter(|motion| motion.segment.as_arc().is_some())
        .count();
    if let (Some(motion), Some(path)) = (motions.last(), path.paths.last()) {
        proof.open_um = (motion.segment.end() - Point::from(path.thread_hole)).norm() * 1e3;
    }
    // A controller that counts J may drift on the way round.
    let allowed_um = crate::program::path::tolerance(arcs);
    let near = proof.from_path_um <= allowed_um && proof.open_um <= allowed_um;
    holds(near, || {
        say!(the_program_lies_um_from_the_path, proof.from_path_um)
    })?;
    let distances = (proof.least_distance - correction)
        .abs()
        .max((proof.largest_distance - correction).abs())
        * 1e3;
    holds(distances <= allowed_um, || {
        say!(the_wire_leaves_its_distance_by_um, distances)
    })?;

    let planned = toolpath::plan(
        &snapshot.drawing,
        &snapshot.outlines,
        &snapshot.settings,
        None,
    )
    .unwrap_or_default();
    proof.picture = picture::svg(&picture::View {
        name: None,
        drawing: &snapshot.drawing,
        outlines: &snapshot.outlines,
        findings: &faults,
        paths: &planned,
        parts: &[],
        holes: &[],
        why: None,
        settings: &snapshot.settings,
    });
    Ok(proof)
}

fn settings(correction: f64) -> Shared<Effective> {
    let layers = [
        ("DIE", Role::Opening),
        ("HOLES", Role::Opening),
        ("PLATE", Role::Ignore),
    ];
    let layers = layers
        .into_iter()
        .map(|(layer, role)| (layer.to_string(), role))
        .collect();
    Shared::new(Effective::of(&Settings {
        correction: Some(correction),
        layers: Some(layers),
        ..Settings::default()
    }))
}

fn document(text: &str, settings: &Shared<Effective>) -> Document {
    Document::new(
        Source::Dxf(dxf::Document::read(text.as_bytes().to_vec())),
        settings.clone(),
    )
}

/// A block that moves, decoded, in mm.
struct Motion {
    segment: Segment,
    /// It leads from one contour to the next.
    jump: bool,
}

/// Every block decoded from where the one before it ended.
fn decoded(program: &str, start: Point) -> Result<Vec<Motion>, Failure> {
    let read = three_b::Document::read(program.as_bytes().to_vec());
    holds(read.findings().is_empty(), || {
        let first = read.findings().into_iter().next();
        first.map_or_else(String::new, |finding| sentence(&finding, 1.0))
    })?;
    let trace = read.trace().into_meant();
    let by = start * 1e3 - trace.start;
    let steps = trace.steps.iter();
    let motion = |step: &Step| {
        let segment = scaled(&step.ideal?.moved(by), 1e-3);
        let jump = step.kind == Kind::Rapid;
        Some(Motion { segment, jump })
    };
    Ok(steps.filter_map(motion).collect())
}

fn geometry(piece: &PathPiece) -> Option<Segment> {
    let SegmentShape {
        start,
        end,
        center,
        sweep,
        ..
    } = &piece.shape;
    let (start, end) = (Point::from(*start), Point::from(*end));
    let (Some(center), Some(sweep)) = (center, sweep) else {
        return Some(Segment::line(start, end));
    };
    Some(Segment::Arc(Arc::about(
        Point::from(*center),
        start,
        end,
        *sweep > 0.0,
    )))
}

/// Compares each block with the path, and its cuts along a contour with the contours.
fn measured(motions: &[Motion], pieces: &[(PathSource, Segment)], contours: &[Segment]) -> Proof {
    let mut proof = Proof {
        blocks: motions.len(),
        from_path_um: 0.0,
        open_um: 0.0,
        least_distance: f64::INFINITY,
        largest_distance: 0.0,
        picture: String::new(),
    };
    for motion in motions.iter().filter(|motion| !motion.jump) {
        for sample in 0..=SAMPLES {
            let point = motion
                .segment
                .point_at(f64::from(sample) / f64::from(SAMPLES));
            let nearest = pieces
                .iter()
                .map(|(source, piece)| (piece.distance_to(point), *source))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((distance, source)) = nearest else {
                continue;
            };
            proof.from_path_um = proof.from_path_um.max(distance * 1e3);
            if matches!(source, PathSource::Segment | PathSource::Corner) {
                let clearance = contours
                    .iter()
                    .map(|contour| contour.distance_to(point))
                    .fold(f64::INFINITY, f64::min);
                proof.least_distance = proof.least_distance.min(clearance);
                proof.largest_distance = proof.largest_distance.max(clearance);
            }
        }
    }
    // In the other direction as well: no piece of the path may be missing.
    for (_, piece) in pieces {
        for sample in 0..=SAMPLES {
            let point = piece.point_at(f64::from(sample) / f64::from(SAMPLES));
            let nearest = motions
                .iter()
                .map(|motion| motion.segment.distance_to(point))
                .fold(f64::INFINITY, f64::min);
            proof.from_path_um = proof.from_path_um.max(nearest * 1e3);
        }
    }
    proof
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLATE: &str = include_str!("plate.dxf");

    /// The repaired plate, its program and the reply of `wedm/toolpath`, all made without a server.
    fn made(correction: f64) -> (String, String, Value) {
        let settings = settings(correction);
        let mut fixed = document(PLATE, &settings);
        let Source::Dxf(text) = fixed.source() else {
            unreachable!()
        };
        let Some(crate::finding::Edit::Drawing(edit)) = fixed.fix_all() else {
            unreachable!()
        };
        let edits = text.text_edits(&edit).unwrap();
        let mut bytes = PLATE.to_string();
        edits
            .iter()
            .rev()
            .for_each(|edit| bytes.replace_range(edit.range.clone(), &edit.text));
        fixed = document(&bytes, &settings);
        let snapshot = fixed.snapshot().unwrap();
        let planned = crate::job::planned(&snapshot, &settings, None, false, &()).unwrap();
        let program = three_b::write(&planned.paths, 1.0, &settings).unwrap();
        (
            bytes,
            program.text,
            serde_json::to_value(Toolpath::new(
                &snapshot.drawing,
                &snapshot.outlines,
                &settings,
                &planned,
            ))
            .unwrap(),
        )
    }

    #[test]
    fn what_is_right_is_proved() {
        for correction in [0.1, 0.12] {
            let (fixed, program, path) = made(correction);
            let proof = of(PLATE, &fixed, &program, &path, correction).unwrap();
            assert!(proof.blocks > 30 && proof.from_path_um < 3.0 && proof.open_um < 3.0);
            assert!(
                (proof.least_distance - correction).abs() < 2e-3
                    && (proof.largest_distance - correction).abs() < 2e-3
            );
        }
    }

    #[test]
    fn what_is_wrong_is_found() {
        let (fixed, program, path) = made(0.1);
        let tampered = [
            ("about another centre", program.replacen("NR1", "NR3", 1)),
            (
                "a contour left out",
                program
                    .lines()
                    .skip_while(|line| *line != "D")
                    .collect::<Vec<_>>()
                    .join("\n"),
            ),
            (
                "a tenth too long",
                program.replacen("B2900B0B2900GXL1", "B3000B0B3000GXL1", 1),
            ),
            ("no end", program.replace("DD", "")),
            (
                "a block lost",
                program
                    .lines()
                    .filter(|line| !line.contains("NR2"))
                    .collect::<Vec<_>>()
                    .join("\n"),
            ),
            ("no program", "hello".into()),
        ];
        for (what, program) in &tampered {
            assert!(*program != made(0.1).1, "{what} is the same program");
            assert!(
                of(PLATE, &fixed, program, &path, 0.1).is_err(),
                "{what} is proved"
            );
        }
        assert!(
            of(PLATE, PLATE, &program, &path, 0.1).is_err(),
            "the faulty drawing is proved"
        );
        assert!(
            of(PLATE, &fixed, &program, &path, 0.15).is_err(),
            "another correction is proved"
        );
    }
}
