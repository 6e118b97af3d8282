//! Every message of the name space `wedm/`, once: its name, and the types of what it takes and gives.

use super::*;
use schemars::generate::SchemaGenerator;
use serde_json::{Map, Value};

/// A message as a type. Whoever sends it, answers it or describes it takes its name and types from here.
pub(crate) trait Message {
    const NAME: &'static str;
    type Params;
    /// `()` where nothing is answered.
    type Answer;
}

/// What the table says of an answer; nothing where there is none.
macro_rules! answer {
    () => {
        ()
    };
    ($answer:ty) => {
        $answer
    };
}

/// Turns rows into types, and into the part of the schema that says what each message takes and gives.
macro_rules! messages {
    ($($message:ident $name:literal $(by $sender:ident)? ($params:ty) $(-> $answer:ty)? $(, refused by $error:ty)?;)*) => {
        /// The messages as types.
        pub(crate) mod messages {
            $(pub(crate) enum $message {})*
        }

        $(impl Message for messages::$message {
            const NAME: &'static str = $name;
            type Params = $params;
            type Answer = answer!($($answer)?);
        })*

        pub(super) fn methods(types: &mut SchemaGenerator) -> Map<String, Value> {
            let mut methods = Map::new();
            $(
                let mut method = Map::new();
                $(method.insert("sentBy".into(), stringify!($sender).into());)?
                method.insert("params".into(), types.subschema_for::<$params>().to_value());
                $(method.insert("result".into(), types.subschema_for::<$answer>().to_value());)?
                $(method.insert("errorData".into(), types.subschema_for::<$error>().to_value());)?
                methods.insert($name.into(), method.into());
            )*
            methods
        }
    };
}

messages! {
    DidOpenDrawing "wedm/didOpenDrawing" (OpenDrawing);
    DidChangeDrawing "wedm/didChangeDrawing" (ChangeDrawing);
    DidCloseDrawing "wedm/didCloseDrawing" (CloseDrawing);
    Inspect "wedm/inspect" (Inspect) -> Inspection;
    Contours "wedm/contours" (ContoursOf) -> Contours;
    Toolpath "wedm/toolpath" (OptionsOf) -> Toolpath;
    Picture "wedm/picture" (PictureOf) -> Picture;
    Export "wedm/export" (Export) -> Exported;
    Holes "wedm/holes" (Holes) -> Exported;
    Repairs "wedm/repairs" (RepairsOf) -> Repairs;
    Fit "wedm/fit" (OptionsOf) -> Fit, refused by Refused;
    Pair "wedm/pair" (Generate) -> PairPrograms, refused by Refused;
    Simulate "wedm/simulate" (Simulate) -> Simulation;
    Locate "wedm/locate" (Locate) -> Option<Located>;
    Settings "wedm/settings" (DrawingName) -> SettingsInForce;
    RulePage "wedm/rulePage" (RulePage) -> RulePageText;
    Generate "wedm/generate" (Generate) -> Program, refused by Refused;
    Calibrate "wedm/calibrate" (Calibrate) -> Calibrated;
    ApplyDrawingEdit "wedm/applyDrawingEdit" by server (ApplyDrawingEdit) -> Applied;
    ResendDrawing "wedm/resendDrawing" by server (ResendDrawing) -> Resent;
}

/// The command that a drawing's code actions hold.
pub(crate) const APPLY_DRAWING_EDIT_COMMAND: &str = "wedm.applyDrawingEdit";
/// The server's command that scales a program; its argument is `{ uri, factor }`.
pub(crate) const SCALE_COMMAND: &str = "wedm.scale";
