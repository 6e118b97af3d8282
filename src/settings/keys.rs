//! Every key of the settings, once: name, type, default, range and meaning.
//!
//! Any level may set any key. A key that is added here is read, overlaid and documented; what it does is up to the code that uses it.

use super::reader::{Reader, Table};
use super::row::{Range, Row, naming_profiles};
use super::spelling::words_of;
use super::table::{Overlay, as_toml, kebab_case};
use super::value::Node;
use super::{
    CenterRule, Compensation, Coordinates, Corner, Direction, DrawnAs, Jumps, Layout, Lead,
    LengthSetting, LineEnd, NumberUnit, Order, PointSetting, ProgramFormat, RuleSeverity, Sequence,
    SideSetting, SkimCorner, UnitSetting, WearCompensation, Zero,
};
use crate::drawing::Role;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Coarser than a tenth of a millimetre the arcs no longer show the drawing's curve; finer than a
/// nanometre is noise.
const ARC_FIT: Range = Range::of(1e-6, 0.1);

/// Below a micrometre no two ends of a real drawing meet; a millimetre is more than any wire.
const JOINS: Range = Range::of(0.001, 1.0);

/// As with `ARC_FIT`; 0 leaves chords as they are.
const CHORD_FITS: Range = Range::of(0.0, 0.1);

/// Digits of controllers: with fewer than four nothing larger than a millimetre could be cut.
const DIGITS: Range = Range::of(4.0, 9.0);

/// Digits after the decimal point of millimetres: from micrometres to nanometres.
const DECIMALS: Range = Range::of(3.0, 6.0);

/// Distances after which an electrode is fed: no machine goes finer than a micrometre.
const MILLING_STEPS: Range = Range {
    least: 0.001,
    ..Range::FROM_ZERO
};

/// Volumes that an electrode loses of each that it erodes: most lose a few hundredths.
const WEAR: Range = Range::of(0.0, 100.0);

/// Contours of a drawing, counted by people.
const ORDERS: Range = Range::of(1.0, 1e6);

tables! {
    /// One level of settings: built-in, `initializationOptions`, `workspace/configuration`, `wedm.toml`, a request's `options`, the command line.
    Settings() {
        /// Diameter of the wire, mm. With `gap` it gives the correction where no `correction` is set: half the diameter + gap; where only one
        /// of the two is set, the other has its default. Together with `correction` or `passes.corrections` it says how thick the wire is, see
        /// [`pass-order`](rules/pass-order.md). A later level that sets one of the two and no `correction` sets the correction again.
        wire_diameter: f64 = 0.18 => number in Range::ABOVE_ZERO;
        /// Spark gap, mm. See `wire-diameter`.
        gap: f64 = 0.01 => number in Range::FROM_ZERO;
        /// Wire radius + spark gap, mm. This is the distance of the wire's centre from the contour. A later level that sets it and no
        /// `passes.corrections` cuts in one pass.
        correction: f64 = 0.10 => number in Range::ABOVE_ZERO;
        /// Side on which the wire runs, for contours whose entity and layer state none.
        side: SideSetting = SideSetting::Both => name;
        /// Unit of drawings that do not state one.
        units: UnitSetting = UnitSetting::Mm => name;
        /// mm added to the correction when a fix chooses its radius.
        margin: f64 = 0.001 => number in Range::FROM_ZERO;
        /// Deviations below this (mm) are not reported. A shorter segment (up to 0.005) is no part of any contour,
        /// and the corner that it hides counts as that corner; `gap`, `near-tangent`, `sharp-corner` and `overlap` say nothing of less.
        resolution: f64 = 0.001 => number in Range::FROM_ZERO;
        /// Ends of entities up to this far apart (mm) belong together: the contour is closed, and [`gap`](rules/gap.md) tells the distance. More
        /// than the default is for drawings whose ends were rounded, as those in inches with three decimals; of several ends the nearest are joined.
        join: f64 = 0.01 => number in JOINS;
        /// Several passes.
        passes: Passes => table;
        /// Role of the entities on a layer, by its name. An entity's own `role` comes first. A contour takes the role of its first entity that
        /// has one. A role other than `ignore` cuts also what is frozen or switched off. `line` cuts [on the line](programs.md#cut-on-the-line),
        /// without correction.
        layers: BTreeMap<String, Role> => roles;
        /// Role of entities by their linetype, their own or that of their layer; it comes before layers and colours.
        /// Without one, what is drawn in CENTER, HIDDEN, PHANTOM and their like is not cut: see
        /// [`unsupported-entity`](rules/unsupported-entity.md).
        linetypes: BTreeMap<String, Role> => roles;
        /// Role of the contour that holds an entity, by the entity's handle, before layers and colours. A handle belongs to one drawing:
        /// in a `wedm.toml` for several drawings it means the entity of that handle in each.
        contours: BTreeMap<String, Role> => roles;
        /// Role of entities by their colour, their own or that of their layer, where neither entity nor layer has a role. Colours are `red`, `yellow`,
        /// `green`, `cyan`, `blue`, `magenta`, `white`, `1` to `255` (AutoCAD colour index), `#rrggbb`.
        colors: BTreeMap<String, Role> => colors;
        /// Settings of one drawing, by the name of its file: `[drawings."plate.dxf".suppress.2A]`.
        drawings: BTreeMap<String, DrawingSettings> => tables;
        /// How near the arcs lie to the ellipses and splines that they stand for, mm.
        arc_fit: f64 = 0.001 => number in ARC_FIT;
        /// Five or more lines in a row that lie this near to one arc (mm) are cut as that arc; 0: none are. The drawing stays as it is, and how
        /// far the arcs are from it at most is said with the program. To change the drawing, repair [`arc-as-chords`](rules/arc-as-chords.md).
        chord_fit: f64 = 0.0 => number in CHORD_FITS;
        /// Severity of a rule, by its name. It applies to every case of the rule, to the milder ones too; the defaults are on
        /// [each rule's page](rules/).
        rules: BTreeMap<String, RuleSeverity> => rules;
        /// Address of the page of a rule, such as `https://edm.example/rules/{rule}.html`: `{rule}` stands for its name. Findings link there.
        /// Not set: they link nowhere, and `wedm explain RULE` shows the page.
        docs_url: String => page_address;
        /// How a program is written.
        program: ProgramSettings => table;
        /// The workpiece.
        job: JobSettings => table;
        /// A punch and its plate.
        pair: PairSettings => table;
        /// Milling by an electrode.
        milling: MillingSettings => table;
        /// Parts drawn over each other that are not checked against each other, each by its name with the layers it is drawn on; what is on no layer
        /// of them is a part of its own. With `pair.clearance`, parts are compared with each other:
        /// [`does-not-fit`](rules/does-not-fit.md).
        workpieces: BTreeMap<String, Vec<String>> => layers_by_name;
        /// [Profiles](programs.md#profiles) of ISO programs of your own, by name.
        profiles: BTreeMap<String, ProfileSettings> => tables;
    }

    /// Settings of one drawing.
    DrawingSettings() {
        /// Findings that somebody has looked at and lets stand, by the handle of the entity at which they are reported and the name of the
        /// rule, with the reason: [suppressions](rules/README.md#suppressions).
        suppress: BTreeMap<String, BTreeMap<String, String>> => reasons;
        /// Settings of one contour, by the handle of an entity of it or by a point of it, mm: `[drawings."plate.dxf".contours.2A]`,
        /// `[drawings."plate.dxf".contours."12.5,40"]`, in [its own keys](programs.md#one-contour). It comes before `contours`,
        /// `program.thread`, `program.entry` and `program.order`.
        contours: BTreeMap<String, ContourSettings> => tables;
    }

    /// Settings of one contour of one drawing. Points are in mm, as all lengths are, whatever unit the drawing is in.
    ContourSettings() {
        /// Side on which the wire runs.
        side: Role => name;
        /// Thread hole `[x, y]`, mm.
        thread: [f64; 2] => point;
        /// Point `[x, y]` of the contour where the cut begins, mm.
        entry: [f64; 2] => point;
        /// Its place among the contours that have one; they are cut before all others. What lies within a contour comes before it all
        /// the same.
        order: u32 => whole in ORDERS;
    }

    /// Corrections of a multi-pass cut.
    Passes() {
        /// Correction of each pass from rough to finish, mm, in place of `correction`: a program cuts each contour that often. They decrease:
        /// [`pass-order`](rules/pass-order.md).
        corrections: Vec<f64> => numbers in Range::ABOVE_ZERO;
        /// Spark gap of each pass, mm. Not set: `gap` for all.
        gaps: Vec<f64> => numbers in Range::FROM_ZERO;
        /// Direction of the passes of a contour.
        sequence: Sequence = Sequence::Alternate => name;
        /// Offset register of each pass in ISO programs. Not set: the profile's `register` for the first pass, and the next numbers for
        /// the others.
        registers: Vec<String> => words;
        /// What each pass cuts in a minute, mm²/min: length × `job.thickness` / rate is its time. Not set: no times are reported.
        rates: Vec<f64> => numbers in Range::ABOVE_ZERO;
        /// How the passes after the first go through a corner that the wire runs inside of. With `constant-stock` the last one leaves a
        /// radius there, the difference of the first and the last correction added to the wire's: [`sharp-corner`](rules/sharp-corner.md).
        skim_corner: SkimCorner = SkimCorner::Sharp => name;
    }

    /// How a program is written.
    ProgramSettings() {
        /// What `wedm generate`, `wedm pair` and `wedm report` write where neither `--format` nor the name of the file says it. Not set: 3B.
        format: ProgramFormat => name;
        /// Form of the blocks. Programs that are formatted keep their own where none is set, and in every one the block numbers
        /// and end points that they have.
        layout: Layout = Layout::Compact => name;
        /// Whether 3B and 4B programs begin with `; Start Point = x , y`, the comment that says where the wire is threaded, mm; and ISO
        /// programs that the control offsets with comments such as `(D1 = 0.2000)`, the correction of each register, mm. Not set: in every
        /// layout but `compact`.
        header: bool => truth;
        /// Direction in which closed contours are cut.
        direction: Direction = Direction::Ccw => name;
        /// How the wire goes round a convex corner of the part.
        corner: Corner = Corner::Arc => name;
        /// Thread hole `[x, y]`, mm. A table has them by handle. Not set: the TEXT or MTEXT "O" nearest to the contour; or a POINT on a layer
        /// of start holes (such as START-HOLES), or where the contour has no other mark; else the centre of a round opening, where neither
        /// entry nor `lead-in` is set; else it is found from the entry. An "O" on the part's side, or within the correction of the contour, is not the hole but the entry beside it.
        thread: PointSetting => point_setting;
        /// Point `[x, y]` of the contour where the cut begins, mm. A table has them by handle. Not set: the point beside
        /// an "O" that means it; under `as-picked` the start of the entity picked first; the point nearest to the thread hole; else the
        /// middle of the longest line; else the point of the longest arc with the largest x, or its middle; where no lead fits
        /// there, the same of the next longest, of up to eight.
        entry: PointSetting => point_setting;
        /// Length of the lead from thread hole to the wire's path where no thread hole is given, mm. Halved until it fits. By default the
        /// hole lies 3 mm from the contour.
        lead_in: f64 = 3.0 => number in Range::ABOVE_ZERO;
        /// Length of the contour, mm, that all passes leave standing before the entry, so that a punch does not drop while it is cut: then comes
        /// the stop, then what stands is cut off in passes of its own. An opening whose slug is heavier than `job.slug-limit` keeps one,
        /// too. 0: none. A table by handle says it for each contour by itself; those that it does not name keep none.
        tab: LengthSetting => length_setting in Range::FROM_ZERO;
        /// Diameter of the start holes, mm. Where no thread hole is given it is proposed where such a hole keeps the correction and 0.1 mm
        /// from every contour; one that does not is reported: [`start-hole`](rules/start-hole.md). The drill list is made by `wedm holes`.
        start_hole: f64 => number in Range::ABOVE_ZERO;
        /// How the wire comes from the thread hole to its path and goes back.
        lead: Lead = Lead::Perpendicular => name;
        /// Word that stops the machine before the tab is cut off. Not set: the profile's `pause` in ISO, `pause` in 3B.
        tab_stop: String => word;
        /// How far each pass goes on past its start when the contour is closed, mm.
        closing_overlap: f64 = 0.0 => number in Range::FROM_ZERO;
        /// Order of the contours; what lies within one always comes before it.
        order: Order = Order::Nearest => name;
        /// Whether parts that share an edge are cut apart by one cut on that edge, where each then is smaller by half the kerf:
        /// [parts that share an edge](programs.md#parts-that-share-an-edge). Else such an edge is an error.
        common_line: bool = false => truth;
        /// What comes between the contours of one program.
        jumps: Jumps = Jumps::Blocks => name;
        /// Where the correction is applied.
        compensation: Compensation = Compensation::Path => name;
        /// Digits of the controller's numbers in 3B and 4B. Longer blocks are split when they are written, and a fault
        /// ([`too-many-digits`](rules/too-many-digits.md)) where they are read.
        digits: u8 = 6 => whole in DIGITS;
        /// Unit of the numbers of an ISO program that does not state it (G20, G21). Not set: mm, and a hint ([`units`](rules/units.md))
        /// where its size suggests inches.
        units: UnitSetting => name;
        /// What a number without a decimal point is in an ISO program: whole millimetres, or micrometres (inches and ten-thousandths of
        /// one under G20). Not set: [found from the program](programs.md#how-long-a-number-is), and reported where its numbers leave it open.
        whole_numbers: NumberUnit => name;
        /// The drawing that programs belong to, from their own folder on, which they are compared with:
        /// [`not-the-drawing`](rules/not-the-drawing.md). Not set: the one that a comment of the program names, else the DXF of the same name.
        drawing: String => path;
        /// How ISO programs are written: {profiles}, or one of `profiles`.
        profile: String = "generic" => profile_name;
        /// Word of letters and digits that ends a 3B or 4B program; what ends one in ISO is in its profile.
        end: String = "DD" => word;
        /// Word of letters and digits that stops the machine so that the wire can be cut or threaded.
        pause: String = "D" => word;
        /// Word that stops the machine between the passes of a contour; empty: they follow each other without a stop, except in 4B, whose
        /// correction is set at the machine. Not set: the profile's `pause-between-passes` in ISO, `pause` in 3B and 4B.
        pause_between_passes: String => word_or_nothing;
    }

    /// The workpiece.
    JobSettings() {
        /// Height of the workpiece, mm.
        thickness: f64 => number in Range::ABOVE_ZERO;
        /// Mass of a slug in g above which an opening keeps a tab of the length `program.tab`. It needs `thickness`: 7.85 g/cm³ × area ×
        /// thickness.
        slug_limit: f64 => number in Range::FROM_ZERO;
        /// Cost of an hour of the machine, in any currency: the times that follow from `passes.rates` then have a cost.
        machine_rate: f64 => number in Range::FROM_ZERO;
        /// Diameters of the wires that the shop has, mm. With `wire-gaps`, `wire-rates` and `thickness`, hover and report say what a small radius
        /// costs: [prices of radii](programs.md#what-a-radius-costs).
        wires: Vec<f64> => numbers in Range::ABOVE_ZERO;
        /// Spark gap of the last pass of each of `wires`, mm.
        wire_gaps: Vec<f64> => numbers in Range::FROM_ZERO;
        /// What each of `wires` cuts in a minute, all its passes together, mm²/min.
        wire_rates: Vec<f64> => numbers in Range::ABOVE_ZERO;
        /// Heading of the page of `wedm report`. Not set: the part, else the name of the drawing.
        title: String => label;
        /// Name or number of the part, for the head of the page of `wedm report`.
        part: String => label;
        /// Material of the workpiece, for the head of that page.
        material: String => label;
        /// The machine that cuts it, for the head of that page.
        machine: String => label;
        /// Revision of the drawing, for the head of that page.
        revision: String => label;
        /// Who made the program, for the head of that page.
        programmer: String => label;
    }

    /// A punch and its plate: corrections that follow from their clearance, and the fit.
    PairSettings() {
        /// The part whose size is drawn where each contour is cut twice, once from outside as the punch and once from inside as the plate.
        drawn_as: DrawnAs => name;
        /// Clearance between punch and plate, mm a side. The part that is not drawn is cut with a correction smaller by it. The fit is
        /// then checked, [`does-not-fit`](rules/does-not-fit.md), which needs `wire-diameter` and `gap`.
        clearance: f64 => number in Range::ABOVE_ZERO;
        /// Clearance of the stripper about the punch, mm a side.
        stripper: f64 => number in Range::FROM_ZERO;
        /// By how much the holder is tighter than the punch, mm a side.
        holder: f64 => number in Range::FROM_ZERO;
    }

    /// Milling by a cylindrical electrode that wears while it erodes, layer by layer: [milling](programs.md#milling). Where no wire
    /// is set, a drawing is judged for the electrode: half its diameter + `milling.gap` is the correction then.
    MillingSettings() {
        /// Diameter of the electrode, mm.
        tool_diameter: f64 => number in Range::ABOVE_ZERO;
        /// Spark gap beside the electrode, mm.
        gap: f64 => number in Range::FROM_ZERO;
        /// Height of a layer, mm. The last one is as thin as what is left of `milling.depth`.
        layer: f64 => number in Range::ABOVE_ZERO;
        /// Depth below the surface, mm.
        depth: f64 => number in Range::ABOVE_ZERO;
        /// Volume that the electrode loses for each unit of volume that it erodes.
        wear: f64 => number in WEAR;
        /// How the feed makes up for the wear of the electrode.
        wear_compensation: WearCompensation = WearCompensation::Uniform => name;
        /// Distance after which `linear` feeds again, mm.
        step: f64 => number in MILLING_STEPS;
        /// Whether the round ends of a slot along an open contour count among what a layer erodes.
        slot_ends: bool = false => truth;
    }

    /// What somebody has set of a profile.
    ProfileSettings(as Profile, name: String) {
        /// The profile whose values apply where none is set: one that ships, `generic` by default.
        base: String => base;
        /// G90 or G91.
        coordinates: Coordinates = Coordinates::Absolute => name;
        /// Where absolute coordinates count from.
        zero: Zero = Zero::Drawing => name;
        /// Millimetres with a decimal point, or whole micrometres without one.
        unit: NumberUnit = NumberUnit::Mm => name;
        /// Digits after the decimal point of millimetres.
        decimals: u8 = 3 => whole in DECIMALS;
        /// How I and J lead to an arc's centre.
        center: CenterRule = CenterRule::StartToCenter => name;
        /// False: a full circle is written as two halves, which every control takes.
        full_circles: bool = false => truth;
        /// True: G00 to G03 and coordinates that have not changed are left out.
        modal: bool = false => truth;
        /// Spaces between the words of a block.
        spaces: bool = true => truth;
        /// Step of the N numbers; 0 for none.
        numbers: u32 = 0_u32 => whole in Range::of(0.0, 1000.0);
        /// What ends a line.
        line_end: LineEnd = LineEnd::Lf => name;
        /// Lines before everything else. `{x}` and `{y}` are the place where the wire is threaded first.
        begin: Vec<String> = [] => lines;
        /// Offset register of the first pass; the second pass has the next number.
        register: String = "D1" => word;
        /// Lines before each contour. `{side}` is G41 or G42, `{register}` the offset register of the pass; a line with `{side}` is
        /// left out where the offset is in the coordinates.
        contour_begin: Vec<String> = [] => lines;
        /// Lines before the lead-out of each contour, where the control offsets it.
        contour_end: Vec<String> = [] => lines;
        /// Lines at which the wire is taken out or threaded, between contours.
        pause: Vec<String> = ["M00".to_owned()] => lines;
        /// Lines between the passes of a contour, where the wire stays threaded.
        pause_between_passes: Vec<String> = [] => lines;
        /// Lines at the end.
        end: Vec<String> = ["M02".to_owned()] => lines;
    }
}

/// Every key, in the order of the documentation.
pub fn rows() -> Vec<Row> {
    let tables = ["passes", "program", "job", "pair", "milling"];
    let mut rows = Settings::rows("");
    rows.retain(|row| !tables.contains(&row.key.as_str()));
    rows.extend(Passes::rows("passes."));
    rows.extend(ProgramSettings::rows("program."));
    rows.extend(JobSettings::rows("job."));
    rows.extend(PairSettings::rows("pair."));
    rows.extend(MillingSettings::rows("milling."));
    rows.extend(DrawingSettings::rows("drawings.NAME."));
    rows.extend(ContourSettings::rows("drawings.NAME.contours.HANDLE."));
    rows.extend(ProfileSettings::rows("profiles.NAME."));
    rows
}
