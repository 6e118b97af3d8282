//! The types of every `wedm/` message, and how they are made from the core and turned into it.
//!
//! Keys are camelCase, angles degrees, coordinates drawing units. Server and command line share these types, so that
//! what an editor is sent and what `--output json` prints are one thing. Nothing here knows of transport or state.

mod change;
mod contours;
mod data;
mod diagnostic;
mod drawing;
mod generate;
mod in_force;
mod inspection;
mod locate;
mod number;
mod requests;
mod schema;
mod segment;
mod simulate;
mod toolpath;

pub use change::{DrawingChange, Splice, apply, changes_of};
pub use contours::{ContourPiece, Contours, ContoursContour, Direction, Gap};
pub use data::{FindingData, RelatedPlace};
pub use diagnostic::{
    CodeDescription, Diagnostic, Location, Position, Range, RelatedInformation, severity_number,
};
pub use drawing::{Drawing, Entity, Units};
pub use generate::{Closure, Generate, Program, Refused};
pub use in_force::{CorrectionSource, SettingsInForce};
pub use inspection::{InspectedEntity, InspectedSegment, Inspection};
pub use locate::{Locate, Located};
pub use requests::{
    Applied, ApplyDrawingEdit, ChangeDrawing, CloseDrawing, DrawingEdit, DrawingName,
    DrawingVersion, Inspect, OpenDrawing, OptionsOf, Picture, ResendDrawing, Resent, RulePage,
    RulePageText, ScaleProgram,
};
pub use schema::{schema, settings_schema};
pub use segment::{SegmentKind, SegmentShape};
pub use simulate::{Simulate, SimulatedBlock, SimulatedBounds, Simulation, StepKind};
pub use toolpath::{PathPiece, PathSource, Toolpath, ToolpathPath};

/// Version of the `wedm/` name space that the handshake states.
pub const PROTOCOL: u32 = 1;

/// Names of the methods, notifications and commands.
pub mod method {
    pub const DID_OPEN_DRAWING: &str = "wedm/didOpenDrawing";
    pub const DID_CHANGE_DRAWING: &str = "wedm/didChangeDrawing";
    pub const DID_CLOSE_DRAWING: &str = "wedm/didCloseDrawing";
    pub const RESEND_DRAWING: &str = "wedm/resendDrawing";
    pub const APPLY_DRAWING_EDIT: &str = "wedm/applyDrawingEdit";
    pub const GENERATE: &str = "wedm/generate";
    pub const INSPECT: &str = "wedm/inspect";
    pub const CONTOURS: &str = "wedm/contours";
    pub const TOOLPATH: &str = "wedm/toolpath";
    pub const PICTURE: &str = "wedm/picture";
    pub const SIMULATE: &str = "wedm/simulate";
    pub const LOCATE: &str = "wedm/locate";
    pub const SETTINGS: &str = "wedm/settings";
    pub const RULE_PAGE: &str = "wedm/rulePage";
    /// The command that a drawing's code actions hold.
    pub const APPLY_DRAWING_EDIT_COMMAND: &str = "wedm.applyDrawingEdit";
    /// The server's command that scales a program; its argument is `{ uri, factor }`.
    pub const SCALE_COMMAND: &str = "wedm.scale";
}
