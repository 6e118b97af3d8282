//! The types of every `wedm/` message, and how they are made from the core and turned into it.
//!
//! Keys are camelCase, angles degrees, coordinates drawing units. Server and command line share
//! these types, so that an editor is sent the same as `--output json` prints. Nothing here knows of
//! transport or state.

mod against;
mod calibrate;
mod change;
mod contours;
mod data;
mod diagnostic;
mod drawing;
mod fit;
mod generate;
mod in_force;
mod inspection;
mod locate;
mod look;
pub(crate) mod method;
mod milling;
mod number;
mod requests;
mod schema;
mod segment;
mod simulate;
#[cfg(test)]
mod tests;
mod toolpath;
mod vertex;
mod work;

pub(crate) use against::{Against, as_stated};
pub(crate) use calibrate::{Calibrate, Calibrated, CalibratedPass, FeatureKind};
pub(crate) use change::{DrawingChange, apply, changes_of};
pub use contours::Contours;
pub(crate) use contours::{ContourPiece, ContoursContour, Direction};
pub(crate) use data::FindingData;
pub(crate) use diagnostic::{
    CodeDescription, Diagnostic, Location, Position, Range, RelatedInformation, severity_number,
};
pub(crate) use drawing::Drawing;
pub(crate) use fit::{Fit, PairProgram, PairPrograms};
pub(crate) use generate::{Generate, Program, Refused};
pub(crate) use in_force::{CorrectionSource, SettingsInForce};
pub use inspection::Inspection;
pub(crate) use inspection::{InspectedEntity, InspectedSegment};
pub(crate) use locate::{Locate, Located};
pub(crate) use milling::Milling;
pub(crate) use requests::{
    Applied, ApplyDrawingEdit, ChangeDrawing, CloseDrawing, ContoursOf, DrawingEdit, DrawingName,
    Export, Exported, FixAllData, HoleForm, Holes, Inspect, OpenDrawing, OptionsOf, Picture,
    PictureForm, PictureOf, Repair, Repairs, RepairsOf, ResendDrawing, Resent, RulePage,
    RulePageText, ScaleProgram,
};
pub use schema::schema;
pub(crate) use schema::settings_schema;
pub(crate) use segment::{SegmentKind, SegmentShape};
pub(crate) use simulate::{Simulate, SimulatedBlock, Simulation, StepKind};
pub(crate) use toolpath::Toolpath;
pub(crate) use work::{StartHole, Work};

/// Version of the `wedm/` name space that the handshake states.
pub(crate) const PROTOCOL: u32 = 1;
