//! `wedm/generate`: a program for the machine.

use super::diagnostic::Diagnostic;
use super::milling::Milling;
use super::work::{StartHole, Work};
use crate::document::Snapshot;
use crate::geometry::Xy as Point;
use crate::program::ProvedProgram;
use crate::settings::Settings;
use crate::toolpath::{self, Finished};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Params of `wedm/generate`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Generate {
    pub(crate) uri: String,
    /// Language of the program: `3b`, `4b` or `iso`; `milling` for an electrode.
    pub(crate) format: String,
    /// Only the contours that hold one of these entities.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) handles: Option<Vec<String>>,
    /// Only the contours that have an entity on one of these layers; beside `handles` those of both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) layers: Option<Vec<String>>,
    /// Laid over every other level of settings for this request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) options: Option<Settings>,
    /// Make the program although the drawing has errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) force: Option<bool>,
}

/// The rounding of J in all arcs of a program, added up, µm: `wedm/simulate` says where a controller stops that counts it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Closure {
    pub(crate) x: f64,
    pub(crate) y: f64,
}

impl Closure {
    /// Rounded to nm: anything smaller comes from the calculation.
    pub(crate) fn of(drift: [f64; 2]) -> Closure {
        let [x, y] = drift.map(|um| (um * 1e3).round() / 1e3 + 0.0);
        Closure { x, y }
    }
}

/// Result of `wedm/generate`: a program that has been decoded again and compared with its path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Program {
    pub(crate) program: String,
    /// Where the wire is threaded first, drawing units.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) thread_hole: Option<Point>,
    /// Number of blocks.
    pub(crate) blocks: usize,
    /// mm of all cuts, leads and all passes included; the ways between contours are none.
    pub(crate) length: f64,
    /// mm of the ways without a cut between contours.
    #[serde(default)]
    pub(crate) jumps: f64,
    pub(crate) closure: Closure,
    /// Largest distance in µm of the decoded blocks from the path, over their whole length.
    pub(crate) deviation: f64,
    /// Largest distance in µm of an arc of the path's outline from the chords of the drawing for which it stands, under `chord-fit`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) off_chords: Option<f64>,
    /// What all passes leave of the contours, where several are cut or a contour is open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) finished: Option<FinishedPart>,
    /// The layers and the wear of an electrode, of the format `milling`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) milling: Option<Milling>,
    /// Where the wire is threaded, in the order of the cuts.
    #[serde(default)]
    pub(crate) holes: Vec<StartHole>,
    /// How long the machine runs alone, what falls meanwhile and in which order it would run longest, in sentences; nothing of a single
    /// cut, and of times where `job.thickness` or `passes.rates` is not set.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) unattended: Vec<String>,
    /// What the program comes to on the machine.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) work: Option<Work>,
    /// The corrections to enter at the control, one for each pass, where it offsets the contour.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) offsets: Vec<ControlOffset>,
    /// Of all cuts, as in `work`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) minutes: Option<f64>,
    pub(crate) warnings: Vec<Diagnostic>,
}

/// What the control has to hold for a program whose contour it offsets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ControlOffset {
    /// The word that says where the control finds it, such as `D1`; absent in 4B, and where the profile names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) register: Option<String>,
    /// mm.
    pub(crate) correction: f64,
}

/// The largest deviations of the part that all passes leave from its drawing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct FinishedPart {
    /// What stays beyond the contour where it stays thickest, mm.
    pub(crate) uncut: f64,
    /// Where that is, drawing units.
    pub(crate) at: Point,
    /// How far the wire cuts beyond the contour, mm.
    pub(crate) overcut: f64,
}

impl Program {
    /// `snapshot` is what the program was made of: outlines are counted in it. `warnings` are those of the program.
    pub(crate) fn new(
        snapshot: &Snapshot,
        proved: ProvedProgram,
        finished: Option<Finished>,
        (holes, work): (&[toolpath::StartHole], &toolpath::Work),
        unattended: Vec<String>,
        warnings: Vec<Diagnostic>,
    ) -> Program {
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = snapshot;
        Program {
            holes: holes
                .iter()
                .map(|hole| StartHole::new(drawing, outlines, settings, hole))
                .collect(),
            milling: proved
                .milled
                .as_ref()
                .map(|milled| Milling::new(snapshot, milled)),
            offsets: proved
                .offsets
                .into_iter()
                .map(|(register, correction)| ControlOffset {
                    register: Some(register).filter(|word| !word.is_empty()),
                    correction,
                })
                .collect(),
            minutes: work.minutes,
            unattended,
            work: Some(Work::new(drawing, outlines, work)),
            program: proved.text,
            thread_hole: holes.first().map(|hole| hole.at.into()),
            blocks: proved.blocks,
            length: proved.length,
            jumps: proved.jumps,
            closure: Closure::of(proved.closure),
            deviation: proved.deviation,
            off_chords: Some(proved.off_chords).filter(|&off| off > 0.0),
            finished: finished.map(|finished| FinishedPart {
                uncut: finished.uncut,
                at: finished.at.into(),
                overcut: finished.overcut,
            }),
            warnings,
        }
    }
}

/// `data` of the error −32803: what stands in the way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Refused {
    pub(crate) diagnostics: Vec<Diagnostic>,
}
