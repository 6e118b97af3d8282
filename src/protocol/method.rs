//! Every message of the name space `wedm/`, once: its name, and the types of what it takes and gives.

use super::*;
use schemars::generate::SchemaGenerator;
use serde_json::{Map, Value};

/// Turns rows into the names and the part of the schema that says what each takes and gives.
macro_rules! methods {
    ($($constant:ident $name:literal $(by $sender:ident)? { $($key:ident: $type:ty),+ })*) => {
        $(pub(crate) const $constant: &str = $name;)*

        pub(super) fn methods(types: &mut SchemaGenerator) -> Map<String, Value> {
            let mut methods = Map::new();
            $(
                let mut method = Map::new();
                $(method.insert("sentBy".into(), stringify!($sender).into());)?
                $(method.insert(stringify!($key).into(), types.subschema_for::<$type>().to_value());)+
                methods.insert($name.into(), method.into());
            )*
            methods
        }
    };
}

methods! {
    DID_OPEN_DRAWING "wedm/didOpenDrawing" { params: OpenDrawing }
    DID_CHANGE_DRAWING "wedm/didChangeDrawing" { params: ChangeDrawing }
    DID_CLOSE_DRAWING "wedm/didCloseDrawing" { params: CloseDrawing }
    INSPECT "wedm/inspect" { params: Inspect, result: Inspection }
    CONTOURS "wedm/contours" { params: DrawingName, result: Contours }
    TOOLPATH "wedm/toolpath" { params: OptionsOf, result: Toolpath }
    PICTURE "wedm/picture" { params: OptionsOf, result: Picture }
    EXPORT "wedm/export" { params: Export, result: Exported }
    HOLES "wedm/holes" { params: Holes, result: Exported }
    REPAIRS "wedm/repairs" { params: RepairsOf, result: Repairs }
    FIT "wedm/fit" { params: OptionsOf, result: Fit, errorData: Refused }
    PAIR "wedm/pair" { params: Generate, result: PairPrograms, errorData: Refused }
    SIMULATE "wedm/simulate" { params: Simulate, result: Simulation }
    LOCATE "wedm/locate" { params: Locate, result: Option<Located> }
    SETTINGS "wedm/settings" { params: DrawingName, result: SettingsInForce }
    RULE_PAGE "wedm/rulePage" { params: RulePage, result: RulePageText }
    GENERATE "wedm/generate" { params: Generate, result: Program, errorData: Refused }
    APPLY_DRAWING_EDIT "wedm/applyDrawingEdit" by server { params: ApplyDrawingEdit, result: Applied }
    RESEND_DRAWING "wedm/resendDrawing" by server { params: ResendDrawing, result: Resent }
}

/// The command that a drawing's code actions hold.
pub(crate) const APPLY_DRAWING_EDIT_COMMAND: &str = "wedm.applyDrawingEdit";
/// The server's command that scales a program; its argument is `{ uri, factor }`.
pub(crate) const SCALE_COMMAND: &str = "wedm.scale";
