// Made out of docs/protocol.schema.json by generate-protocol.mjs: edit neither by hand.

/** Version of the name space that these clients speak. */
export const PROTOCOL = 1;

export type SegmentKind = "line" | "arc" | "circle";
/**
 * A point `[x, y]` in drawing units.
 *
 * @minItems 2
 * @maxItems 2
 */
export type Point = [number, number];
/**
 * Direction in which a closed contour is travelled as it was drawn.
 */
export type Direction = "ccw" | "cw";
/**
 * The kind of outline: it decides on which side the wire runs.
 */
export type Role = "opening" | "punch" | "both" | "left" | "right" | "line" | "ignore";
/**
 * Side of the contour on which the wire runs, where neither the entity nor its layer says.
 */
export type SideSetting = "both" | "auto" | "opening" | "punch" | "left" | "right";
export type UnitSetting = "mm" | "inch";
/**
 * Direction of the passes of a contour.
 */
export type Sequence = "alternate" | "one-way";
/**
 * How the passes after the first go through a corner that the wire runs inside of.
 */
export type SkimCorner = "sharp" | "constant-stock";
/**
 * Severity of a rule, or off.
 */
export type RuleSeverity = "error" | "warning" | "information" | "hint" | "off";
/**
 * What a program is written in.
 */
export type ProgramFormat = "3b" | "4b" | "iso" | "milling";
export type Layout = "compact" | "aligned" | "checking";
/**
 * Direction in which a closed contour is cut.
 */
export type Direction2 = "ccw" | "cw" | "as-drawn";
/**
 * How the wire path rounds a convex corner of the part.
 */
export type Corner = "arc" | "intersection";
/**
 * One point, or one for each contour by the handle of an entity in it.
 */
export type PointSetting =
  | [number, number]
  | {
      /**
       * @minItems 2
       * @maxItems 2
       */
      [k: string]: [number, number];
    };
/**
 * One length in mm, or one for each contour by the handle of an entity in it.
 */
export type LengthSetting =
  | number
  | {
      [k: string]: number;
    };
/**
 * How the wire comes from the thread hole to its path and goes back.
 */
export type Lead = "straight" | "perpendicular" | "arc";
/**
 * Which contour is cut after which. What lies within a contour always comes before it: the part drops when the contour round it is cut.
 */
export type Order = "as-drawn" | "inside-first" | "nearest" | "as-picked";
/**
 * What comes between the contours of one program.
 */
export type Jumps = "blocks" | "none";
/**
 * Where the correction is applied.
 */
export type Compensation = "path" | "controller" | "none";
/**
 * Millimetres with a decimal point, or whole micrometres without one.
 */
export type NumberUnit = "mm" | "um";
/**
 * Which part of a pair is drawn.
 */
export type DrawnAs = "punch" | "plate";
/**
 * How the feed of a milling electrode makes up for its wear.
 */
export type WearCompensation = "none" | "uniform" | "linear";
/**
 * G90 or G91.
 */
export type Coordinates = "absolute" | "incremental";
/**
 * Where absolute coordinates count from.
 */
export type Zero = "drawing" | "start";
/**
 * How I and J lead to an arc's centre.
 */
export type CenterRule = "start-to-center" | "center-to-start" | "absolute";
export type LineEnd = "lf" | "crlf";
/**
 * What a piece of the path follows.
 */
export type PathSource = ("segment" | "lead-in" | "lead-out") | "corner" | "tab" | "cut-off" | "overlap";
/**
 * What a picture can be written as.
 */
export type PictureForm = "svg" | "png" | "pdf";
/**
 * What a drill list can be written as.
 */
export type HoleForm = "csv" | "dxf";
/**
 * Side of the entity's own direction on which the wire runs.
 */
export type SideName = "left" | "right";
/**
 * What a step of the program does.
 */
export type StepKind = ("line" | "arc" | "pause" | "end") | "rapid";
/**
 * The level that has the last word on the correction.
 */
export type CorrectionSource = "default" | "client" | "file";
/**
 * A level of settings, or what else says a value.
 */
export type Origin = "default" | "client" | "file" | "config" | "option" | "drawing";
/**
 * Material between the faces that were measured, as of a punch, or room, as in an opening.
 */
export type FeatureKind = "outer" | "inner";

/**
 * Params and result of each request.
 */
export interface Methods {
  "wedm/inspect": {
    params: Inspect;
    result: Inspection;
  };
  "wedm/contours": {
    params: ContoursOf;
    result: Contours;
  };
  "wedm/toolpath": {
    params: OptionsOf;
    result: Toolpath;
  };
  "wedm/picture": {
    params: PictureOf;
    result: Picture;
  };
  "wedm/export": {
    params: Export;
    result: Exported;
  };
  "wedm/holes": {
    params: Holes;
    result: Exported;
  };
  "wedm/repairs": {
    params: RepairsOf;
    result: Repairs;
  };
  "wedm/fit": {
    params: OptionsOf;
    result: Fit;
  };
  "wedm/pair": {
    params: Generate;
    result: PairPrograms;
  };
  "wedm/simulate": {
    params: Simulate;
    result: Simulation;
  };
  "wedm/locate": {
    params: Locate;
    result: Located | null;
  };
  "wedm/settings": {
    params: DrawingName;
    result: SettingsInForce;
  };
  "wedm/rulePage": {
    params: RulePage;
    result: RulePageText;
  };
  "wedm/generate": {
    params: Generate;
    result: Program;
  };
  "wedm/calibrate": {
    params: Calibrate;
    result: Calibrated;
  };
}
/**
 * Params of `wedm/inspect`.
 */
export interface Inspect {
  uri: string;
  /**
   * Only this entity.
   */
  handle?: string;
}
/**
 * Every entity that has plane geometry, in machining order.
 */
export interface Inspection {
  /**
   * Millimetres in one drawing unit.
   */
  unitsToMm: number;
  entities: InspectedEntity[];
  /**
   * The thickest wire that still cuts every arc of a contour, where the gap is set.
   */
  largestWire?: LargestWire;
}
export interface InspectedEntity {
  handle: string;
  /**
   * The DXF name: LINE, ARC, CIRCLE, LWPOLYLINE, POLYLINE.
   */
  type: string;
  layer: string;
  closed: boolean;
  /**
   * False where it is no part of a contour: its layer is frozen or switched off, its role is `ignore`, it is drawn to be read (as centre
   * lines are) and not to be cut, or it is a point.
   */
  cut: boolean;
  segments: InspectedSegment[];
}
/**
 * Geometry of one segment in drawing units.
 */
export interface InspectedSegment {
  /**
   * Index within the entity: that of the vertex it starts in.
   */
  index: number;
  kind: SegmentKind;
  start: Point;
  end: Point;
  length: number;
  center?: Point;
  radius?: number;
  /**
   * Degrees, positive counter-clockwise.
   */
  sweep?: number;
  /**
   * `tan(sweep / 4)`; left out for lines and for a full turn, which has none.
   */
  bulge?: number;
  /**
   * `ok`, or the names of the rules of which an error or a warning lies here, with a comma between.
   */
  verdict: string;
}
/**
 * The thickest wire that still cuts every arc and passes every narrow place: Ø = 2 (r − gap).
 */
export interface LargestWire {
  /**
   * mm.
   */
  diameter: number;
  /**
   * Of the arc that says so, mm; where that is a narrow place, half its width.
   */
  radius: number;
  handle: string;
  /**
   * Index within the entity.
   */
  segment: number;
  /**
   * The facing wall of a narrow place, where that says so and no arc.
   */
  facing?: FacingWall;
}
/**
 * One of the walls of a narrow place.
 */
export interface FacingWall {
  handle: string;
  /**
   * Index within the entity.
   */
  segment: number;
}
/**
 * Params of `wedm/contours`.
 */
export interface ContoursOf {
  uri: string;
  /**
   * `false`: instead of its segments each contour has the handles of its entities.
   */
  segments?: boolean;
}
/**
 * Contours in machining order.
 */
export interface Contours {
  /**
   * Millimetres in one drawing unit.
   */
  unitsToMm: number;
  contours: ContoursContour[];
}
/**
 * A contour; `area` and `direction` are those of a closed one.
 */
export interface ContoursContour {
  closed: boolean;
  direction?: Direction;
  role: Role;
  /**
   * Square drawing units, arcs counted in.
   */
  area?: number;
  /**
   * Drawing units, along the segments.
   */
  length: number;
  /**
   * Its place among the cuts, from 0: as drawn, but what lies within another contour before it. Missing for what is not cut, and in
   * a drawing of more than 20,000 contours.
   */
  order?: number;
  /**
   * The start mark beside it: a TEXT or MTEXT "O", or a POINT.
   *
   * @minItems 2
   * @maxItems 2
   */
  mark?: [number, number];
  /**
   * In the direction of travel.
   */
  segments: ContourPiece[];
  /**
   * The handles of its entities, where they are asked for instead.
   */
  handles?: string[];
  /**
   * Ends that lay apart within the join tolerance and were taken as one.
   */
  gaps: Gap[];
}
/**
 * Geometry of one segment in drawing units.
 */
export interface ContourPiece {
  handle: string;
  /**
   * Index within the entity.
   */
  segment: number;
  /**
   * Travelled against the entity's own direction.
   */
  reversed: boolean;
  kind: SegmentKind;
  start: Point;
  end: Point;
  length: number;
  center?: Point;
  radius?: number;
  /**
   * Degrees, positive counter-clockwise.
   */
  sweep?: number;
  /**
   * `tan(sweep / 4)`; left out for lines and for a full turn, which has none.
   */
  bulge?: number;
}
/**
 * A gap that chaining closed.
 */
export interface Gap {
  /**
   * Index in the contour's `segments` of the one that ends here.
   */
  after: number;
  /**
   * Drawing units.
   */
  distance: number;
}
/**
 * Params of `wedm/toolpath` and `wedm/fit`.
 */
export interface OptionsOf {
  uri: string;
  /**
   * Laid over every other level of settings for this request.
   */
  options?: Settings;
}
/**
 * One level of settings: built-in, `initializationOptions`, `workspace/configuration`, `wedm.toml`, a request's `options`, the command line.
 */
export interface Settings {
  /**
   * Diameter of the wire, mm. With `gap` it gives the correction where no `correction` is set: half the diameter + gap; where only one of the two is set, the other has its default. Together with `correction` or `passes.corrections` it says how thick the wire is, see `pass-order`. A later level that sets one of the two and no `correction` sets the correction again.
   */
  wireDiameter?: number;
  /**
   * Spark gap, mm. See `wire-diameter`.
   */
  gap?: number;
  /**
   * Wire radius + spark gap, mm. This is the distance of the wire's centre from the contour. A later level that sets it and no `passes.corrections` cuts in one pass.
   */
  correction?: number;
  /**
   * Side on which the wire runs, for contours whose entity and layer state none.
   */
  side?: SideSetting;
  /**
   * Unit of drawings that do not state one.
   */
  units?: UnitSetting;
  /**
   * mm added to the correction when a fix chooses its radius.
   */
  margin?: number;
  /**
   * Deviations below this (mm) are not reported. A shorter segment (up to 0.005) is no part of any contour, and the corner that it hides counts as that corner; `gap`, `near-tangent`, `sharp-corner` and `overlap` say nothing of less.
   */
  resolution?: number;
  /**
   * Ends of entities up to this far apart (mm) belong together: the contour is closed, and `gap` tells the distance. More than the default is for drawings whose ends were rounded, as those in inches with three decimals; of several ends the nearest are joined.
   */
  join?: number;
  /**
   * Several passes.
   */
  passes?: Passes;
  /**
   * Role of the entities on a layer, by its name. An entity's own `role` comes first. A contour takes the role of its first entity that has one. A role other than `ignore` cuts also what is frozen or switched off. `line` cuts on the line, without correction.
   */
  layers?: {
    [k: string]: Role;
  };
  /**
   * Role of entities by their linetype, their own or that of their layer; it comes before layers and colours. Without one, what is drawn in CENTER, HIDDEN, PHANTOM and their like is not cut: see `unsupported-entity`.
   */
  linetypes?: {
    [k: string]: Role;
  };
  /**
   * Role of the contour that holds an entity, by the entity's handle, before layers and colours. A handle belongs to one drawing: in a `wedm.toml` for several drawings it means the entity of that handle in each.
   */
  contours?: {
    [k: string]: Role;
  };
  /**
   * Role of entities by their colour, their own or that of their layer, where neither entity nor layer has a role. Colours are `red`, `yellow`, `green`, `cyan`, `blue`, `magenta`, `white`, `1` to `255` (AutoCAD colour index), `#rrggbb`.
   */
  colors?: {
    [k: string]: Role;
  };
  /**
   * Settings of one drawing, by the name of its file: `[drawings."plate.dxf".suppress.2A]`.
   */
  drawings?: {
    [k: string]: DrawingSettings;
  };
  /**
   * How near the arcs lie to the ellipses and splines that they stand for, mm.
   */
  arcFit?: number;
  /**
   * Five or more lines in a row that lie this near to one arc (mm) are cut as that arc; 0: none are. The drawing stays as it is, and how far the arcs are from it at most is said with the program. To change the drawing, repair `arc-as-chords`.
   */
  chordFit?: number;
  /**
   * Severity of a rule, by its name. It applies to every case of the rule, to the milder ones too; the defaults are on each rule's page.
   */
  rules?: {
    [k: string]: RuleSeverity;
  };
  /**
   * Address of the page of a rule, such as `https://edm.example/rules/{rule}.html`: `{rule}` stands for its name. Findings link there. Not set: they link nowhere, and `wedm explain RULE` shows the page.
   */
  docsUrl?: string;
  /**
   * How a program is written.
   */
  program?: ProgramSettings;
  /**
   * The workpiece.
   */
  job?: JobSettings;
  /**
   * A punch and its plate.
   */
  pair?: PairSettings;
  /**
   * Milling by an electrode.
   */
  milling?: MillingSettings;
  /**
   * Parts drawn over each other that are not checked against each other, each by its name with the layers it is drawn on; what is on no layer of them is a part of its own. With `pair.clearance`, parts are compared with each other: `does-not-fit`.
   */
  workpieces?: {
    [k: string]: string[];
  };
  /**
   * Profiles of ISO programs of your own, by name.
   */
  profiles?: {
    [k: string]: ProfileSettings;
  };
}
/**
 * Corrections of a multi-pass cut.
 */
export interface Passes {
  /**
   * Correction of each pass from rough to finish, mm, in place of `correction`: a program cuts each contour that often. They decrease: `pass-order`.
   */
  corrections?: number[];
  /**
   * Spark gap of each pass, mm. Not set: `gap` for all.
   */
  gaps?: number[];
  /**
   * Direction of the passes of a contour.
   */
  sequence?: Sequence;
  /**
   * Offset register of each pass in ISO programs. Not set: the profile's `register` for the first pass, and the next numbers for the others.
   */
  registers?: string[];
  /**
   * What each pass cuts in a minute, mm²/min: length × `job.thickness` / rate is its time. Not set: no times are reported.
   */
  rates?: number[];
  /**
   * How the passes after the first go through a corner that the wire runs inside of. With `constant-stock` the last one leaves a radius there, the difference of the first and the last correction added to the wire's: `sharp-corner`.
   */
  skimCorner?: SkimCorner;
}
/**
 * Settings of one drawing.
 */
export interface DrawingSettings {
  /**
   * Findings that somebody has looked at and lets stand, by the handle of the entity at which they are reported and the name of the rule, with the reason: suppressions.
   */
  suppress?: {
    [k: string]: {
      [k: string]: string;
    };
  };
  /**
   * Settings of one contour, by the handle of an entity of it or by a point of it, mm: `[drawings."plate.dxf".contours.2A]`, `[drawings."plate.dxf".contours."12.5,40"]`, in its own keys. It comes before `contours`, `program.thread`, `program.entry` and `program.order`.
   */
  contours?: {
    [k: string]: ContourSettings;
  };
}
/**
 * Settings of one contour of one drawing. Points are in mm, as all lengths are, whatever unit the drawing is in.
 */
export interface ContourSettings {
  /**
   * Side on which the wire runs.
   */
  side?: Role;
  /**
   * Thread hole `[x, y]`, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  thread?: [number, number];
  /**
   * Point `[x, y]` of the contour where the cut begins, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  entry?: [number, number];
  /**
   * Its place among the contours that have one; they are cut before all others. What lies within a contour comes before it all the same.
   */
  order?: number;
}
/**
 * How a program is written.
 */
export interface ProgramSettings {
  /**
   * What `wedm generate`, `wedm pair` and `wedm report` write where neither `--format` nor the name of the file says it. Not set: 3B.
   */
  format?: ProgramFormat;
  /**
   * Form of the blocks. Programs that are formatted keep their own where none is set, and in every one the block numbers and end points that they have.
   */
  layout?: Layout;
  /**
   * Whether 3B and 4B programs begin with `; Start Point = x , y`, the comment that says where the wire is threaded, mm; and ISO programs that the control offsets with comments such as `(D1 = 0.2000)`, the correction of each register, mm. Not set: in every layout but `compact`.
   */
  header?: boolean;
  /**
   * Direction in which closed contours are cut.
   */
  direction?: Direction2;
  /**
   * How the wire goes round a convex corner of the part.
   */
  corner?: Corner;
  /**
   * Thread hole `[x, y]`, mm. A table has them by handle. Not set: the TEXT or MTEXT "O" nearest to the contour; or a POINT on a layer of start holes (such as START-HOLES), or where the contour has no other mark; else the centre of a round opening, where neither entry nor `lead-in` is set; else it is found from the entry. An "O" on the part's side, or within the correction of the contour, is not the hole but the entry beside it.
   */
  thread?: PointSetting;
  /**
   * Point `[x, y]` of the contour where the cut begins, mm. A table has them by handle. Not set: the point beside an "O" that means it; under `as-picked` the start of the entity picked first; the point nearest to the thread hole; else the middle of the longest line; else the point of the longest arc with the largest x, or its middle; where no lead fits there, the same of the next longest, of up to eight.
   */
  entry?: PointSetting;
  /**
   * Length of the lead from thread hole to the wire's path where no thread hole is given, mm. Halved until it fits. By default the hole lies 3 mm from the contour.
   */
  leadIn?: number;
  /**
   * Length of the contour, mm, that all passes leave standing before the entry, so that a punch does not drop while it is cut: then comes the stop, then what stands is cut off in passes of its own. An opening whose slug is heavier than `job.slug-limit` keeps one, too. 0: none. A table by handle says it for each contour by itself; those that it does not name keep none.
   */
  tab?: LengthSetting;
  /**
   * Diameter of the start holes, mm. Where no thread hole is given it is proposed where such a hole keeps the correction and 0.1 mm from every contour; one that does not is reported: `start-hole`. The drill list is made by `wedm holes`.
   */
  startHole?: number;
  /**
   * How the wire comes from the thread hole to its path and goes back.
   */
  lead?: Lead;
  /**
   * Word that stops the machine before the tab is cut off. Not set: the profile's `pause` in ISO, `pause` in 3B.
   */
  tabStop?: string;
  /**
   * How far each pass goes on past its start when the contour is closed, mm.
   */
  closingOverlap?: number;
  /**
   * Order of the contours; what lies within one always comes before it.
   */
  order?: Order;
  /**
   * Whether parts that share an edge are cut apart by one cut on that edge, where each then is smaller by half the kerf: parts that share an edge. Else such an edge is an error.
   */
  commonLine?: boolean;
  /**
   * What comes between the contours of one program.
   */
  jumps?: Jumps;
  /**
   * Where the correction is applied.
   */
  compensation?: Compensation;
  /**
   * Digits of the controller's numbers in 3B and 4B. Longer blocks are split when they are written, and a fault (`too-many-digits`) where they are read.
   */
  digits?: number;
  /**
   * Unit of the numbers of an ISO program that does not state it (G20, G21). Not set: mm, and a hint (`units`) where its size suggests inches.
   */
  units?: UnitSetting;
  /**
   * What a number without a decimal point is in an ISO program: whole millimetres, or micrometres (inches and ten-thousandths of one under G20). Not set: found from the program, and reported where its numbers leave it open.
   */
  wholeNumbers?: NumberUnit;
  /**
   * The drawing that programs belong to, from their own folder on, which they are compared with: `not-the-drawing`. Not set: the one that a comment of the program names, else the DXF of the same name.
   */
  drawing?: string;
  /**
   * How ISO programs are written: `fast-wire`, `generic`, `robofil`, or one of `profiles`.
   */
  profile?: string;
  /**
   * Word of letters and digits that ends a 3B or 4B program; what ends one in ISO is in its profile.
   */
  end?: string;
  /**
   * Word of letters and digits that stops the machine so that the wire can be cut or threaded.
   */
  pause?: string;
  /**
   * Word that stops the machine between the passes of a contour; empty: they follow each other without a stop, except in 4B, whose correction is set at the machine. Not set: the profile's `pause-between-passes` in ISO, `pause` in 3B and 4B.
   */
  pauseBetweenPasses?: string;
}
/**
 * The workpiece.
 */
export interface JobSettings {
  /**
   * Height of the workpiece, mm.
   */
  thickness?: number;
  /**
   * Mass of a slug in g above which an opening keeps a tab of the length `program.tab`. It needs `thickness`: 7.85 g/cm³ × area × thickness.
   */
  slugLimit?: number;
  /**
   * Cost of an hour of the machine, in any currency: the times that follow from `passes.rates` then have a cost.
   */
  machineRate?: number;
  /**
   * Diameters of the wires that the shop has, mm. With `wire-gaps`, `wire-rates` and `thickness`, hover and report say what a small radius costs: prices of radii.
   */
  wires?: number[];
  /**
   * Spark gap of the last pass of each of `wires`, mm.
   */
  wireGaps?: number[];
  /**
   * What each of `wires` cuts in a minute, all its passes together, mm²/min.
   */
  wireRates?: number[];
  /**
   * Heading of the page of `wedm report`. Not set: the part, else the name of the drawing.
   */
  title?: string;
  /**
   * Name or number of the part, for the head of the page of `wedm report`.
   */
  part?: string;
  /**
   * Material of the workpiece, for the head of that page.
   */
  material?: string;
  /**
   * The machine that cuts it, for the head of that page.
   */
  machine?: string;
  /**
   * Revision of the drawing, for the head of that page.
   */
  revision?: string;
  /**
   * Who made the program, for the head of that page.
   */
  programmer?: string;
}
/**
 * A punch and its plate: corrections that follow from their clearance, and the fit.
 */
export interface PairSettings {
  /**
   * The part whose size is drawn where each contour is cut twice, once from outside as the punch and once from inside as the plate.
   */
  drawnAs?: DrawnAs;
  /**
   * Clearance between punch and plate, mm a side. The part that is not drawn is cut with a correction smaller by it. The fit is then checked, `does-not-fit`, which needs `wire-diameter` and `gap`.
   */
  clearance?: number;
  /**
   * Clearance of the stripper about the punch, mm a side.
   */
  stripper?: number;
  /**
   * By how much the holder is tighter than the punch, mm a side.
   */
  holder?: number;
}
/**
 * Milling by a cylindrical electrode that wears while it erodes, layer by layer: [milling](programs.md#milling). Where no wire
 * is set, a drawing is judged for the electrode: half its diameter + `milling.gap` is the correction then.
 */
export interface MillingSettings {
  /**
   * Diameter of the electrode, mm.
   */
  toolDiameter?: number;
  /**
   * Spark gap beside the electrode, mm.
   */
  gap?: number;
  /**
   * Height of a layer, mm. The last one is as thin as what is left of `milling.depth`.
   */
  layer?: number;
  /**
   * Depth below the surface, mm.
   */
  depth?: number;
  /**
   * Volume that the electrode loses for each unit of volume that it erodes.
   */
  wear?: number;
  /**
   * How the feed makes up for the wear of the electrode.
   */
  wearCompensation?: WearCompensation;
  /**
   * Distance after which `linear` feeds again, mm.
   */
  step?: number;
  /**
   * Whether the round ends of a slot along an open contour count among what a layer erodes.
   */
  slotEnds?: boolean;
}
/**
 * What somebody has set of a profile.
 */
export interface ProfileSettings {
  /**
   * The profile whose values apply where none is set: one that ships, `generic` by default.
   */
  base?: string;
  /**
   * G90 or G91.
   */
  coordinates?: Coordinates;
  /**
   * Where absolute coordinates count from.
   */
  zero?: Zero;
  /**
   * Millimetres with a decimal point, or whole micrometres without one.
   */
  unit?: NumberUnit;
  /**
   * Digits after the decimal point of millimetres.
   */
  decimals?: number;
  /**
   * How I and J lead to an arc's centre.
   */
  center?: CenterRule;
  /**
   * False: a full circle is written as two halves, which every control takes.
   */
  fullCircles?: boolean;
  /**
   * True: G00 to G03 and coordinates that have not changed are left out.
   */
  modal?: boolean;
  /**
   * Spaces between the words of a block.
   */
  spaces?: boolean;
  /**
   * Step of the N numbers; 0 for none.
   */
  numbers?: number;
  /**
   * What ends a line.
   */
  lineEnd?: LineEnd;
  /**
   * Lines before everything else. `{x}` and `{y}` are the place where the wire is threaded first.
   */
  begin?: string[];
  /**
   * Offset register of the first pass; the second pass has the next number.
   */
  register?: string;
  /**
   * Lines before each contour. `{side}` is G41 or G42, `{register}` the offset register of the pass; a line with `{side}` is left out where the offset is in the coordinates.
   */
  contourBegin?: string[];
  /**
   * Lines before the lead-out of each contour, where the control offsets it.
   */
  contourEnd?: string[];
  /**
   * Lines at which the wire is taken out or threaded, between contours.
   */
  pause?: string[];
  /**
   * Lines between the passes of a contour, where the wire stays threaded.
   */
  pauseBetweenPasses?: string[];
  /**
   * Lines at the end.
   */
  end?: string[];
}
/**
 * Wire paths in machining order.
 */
export interface Toolpath {
  /**
   * Millimetres in one drawing unit.
   */
  unitsToMm: number;
  paths: ToolpathPath[];
  /**
   * Where the wire is threaded, in the order of the cuts.
   */
  holes?: StartHole[];
  /**
   * What the paths come to on the machine; of a pair that of each part is in `parts`.
   */
  work?: Work;
  /**
   * The parts of a pair, where the drawing is one of which everything is set.
   */
  parts?: ToolpathPart[];
}
/**
 * The path for one contour in one pass.
 */
export interface ToolpathPath {
  /**
   * Index of the contour in the reply of `wedm/contours`.
   */
  contour: number;
  /**
   * The part of a pair that it cuts.
   */
  part?: string;
  /**
   * 1-based number of the pass.
   */
  pass: number;
  /**
   * Which way a closed contour is gone round in this pass.
   */
  direction?: Direction;
  /**
   * How far the path lies from the contour, drawing units.
   */
  correction: number;
  threadHole: Point;
  /**
   * Drawing units, leads included.
   */
  length: number;
  segments: PathPiece[];
}
/**
 * Geometry of one segment in drawing units.
 */
export interface PathPiece {
  source: PathSource;
  handle?: string;
  /**
   * Index within the entity.
   */
  segment?: number;
  kind: SegmentKind;
  start: Point;
  end: Point;
  length: number;
  center?: Point;
  radius?: number;
  /**
   * Degrees, positive counter-clockwise.
   */
  sweep?: number;
  /**
   * `tan(sweep / 4)`; left out for lines and for a full turn, which has none.
   */
  bulge?: number;
}
/**
 * Where the wire is threaded for a contour.
 */
export interface StartHole {
  /**
   * Handle of the contour's first entity.
   */
  contour: string;
  /**
   * Drawing units.
   */
  at: Point;
  /**
   * mm; where `program.start-hole` says it.
   */
  diameter?: number;
  /**
   * By the settings or by a mark in the drawing; else it was found.
   */
  given: boolean;
  /**
   * The part of a pair that is threaded there.
   */
  part?: string;
}
/**
 * What the cuts come to. Where a key is not set that something would need, it is left out and the key is `missing`.
 */
export interface Work {
  /**
   * In the order of the cuts.
   */
  cuts: WorkCut[];
  /**
   * mm of all cuts, leads included.
   */
  length: number;
  /**
   * mm of the ways from one contour to the next, on which nothing is cut.
   */
  jumps: number;
  /**
   * Of all cuts: length × `job.thickness` / `passes.rates`.
   */
  minutes?: number;
  /**
   * In the money of `job.machine-rate`.
   */
  cost?: number;
  /**
   * What drops out of openings.
   */
  slugs: Slug[];
  /**
   * The largest angle between a lead and its contour, degrees.
   */
  leadAngle?: number;
  largestWire?: LargestWire;
  /**
   * Keys that are not set.
   */
  missing: string[];
}
/**
 * One pass along one contour.
 */
export interface WorkCut {
  /**
   * Handle of the contour's first entity.
   */
  contour: string;
  /**
   * 1-based number of the pass.
   */
  pass: number;
  /**
   * It cuts off the tab.
   */
  cutOff?: boolean;
  /**
   * mm, leads included.
   */
  length: number;
  minutes?: number;
}
/**
 * What drops out of an opening.
 */
export interface Slug {
  /**
   * Handle of the contour's first entity.
   */
  contour: string;
  /**
   * g of steel: 7.85 g/cm³ × area × `job.thickness`.
   */
  mass: number;
}
/**
 * One part of a pair, cut by the correction that `wedm/pair` gives it.
 */
export interface ToolpathPart {
  /**
   * `punch`, `plate`, `stripper`, `holder`, or the name of a workpiece.
   */
  part: string;
  /**
   * The correction of each pass, mm; below 0 for passes on the other side of the drawn outline, where not all run there.
   */
  corrections: number[];
  /**
   * The wire runs on the other side of the drawn outline.
   */
  otherSide?: boolean;
  work: Work;
}
/**
 * Params of `wedm/picture`.
 */
export interface PictureOf {
  uri: string;
  /**
   * Laid over every other level of settings for this request.
   */
  options?: Settings;
  /**
   * A picture of more than 2,000 elements is wanted in pieces.
   */
  pieces?: boolean;
}
/**
 * Result of `wedm/picture`.
 */
export interface Picture {
  /**
   * With `pieces` it has the heading and the legend only.
   */
  svg: string;
  /**
   * The drawing, from the bottom up, where it is wanted in pieces and has many.
   */
  pieces?: Piece[];
}
/**
 * A line or an area of the drawing.
 */
export interface Piece {
  /**
   * As the element of the SVG has it.
   */
  class: string;
  handle?: string;
  segment?: number;
  /**
   * In the picture of a program.
   */
  line?: number;
  /**
   * The width of the kerf that the wire cuts along it, thousandths of the local coordinates.
   */
  width?: number;
  /**
   * The number of a contour in the order of the cuts, at its thread hole.
   */
  order?: number;
  /**
   * `x, y` where it begins, then `x, y, radius` of each line and arc of it: where that ends, 0 for a line, and below 0 for an arc
   * that runs clockwise; an arc is less than a half turn. Thousandths of the local coordinates, y upwards.
   */
  at: number[];
}
/**
 * Params of `wedm/export`.
 */
export interface Export {
  uri: string;
  format: PictureForm;
  /**
   * Laid over every other level of settings for this request.
   */
  options?: Settings;
}
/**
 * Result of `wedm/export` and `wedm/holes`.
 */
export interface Exported {
  /**
   * The file, in base64.
   */
  data: string;
}
/**
 * Params of `wedm/holes`.
 */
export interface Holes {
  uri: string;
  format: HoleForm;
  /**
   * Laid over every other level of settings for this request.
   */
  options?: Settings;
}
/**
 * Params of `wedm/repairs`: the rule of a finding in a drawing, and its place as in `data`.
 */
export interface RepairsOf {
  uri: string;
  rule: string;
  handle: string;
  segment?: number;
}
/**
 * Result of `wedm/repairs`: the preferred one first; none where the finding is no longer there.
 */
export interface Repairs {
  repairs: Repair[];
}
/**
 * What a repair would bring.
 */
export interface Repair {
  /**
   * That of its code action.
   */
  title: string;
  /**
   * The segments that were not there before, in drawing units.
   */
  segments: SegmentShape[];
}
/**
 * Geometry of one segment in drawing units.
 */
export interface SegmentShape {
  kind: SegmentKind;
  start: Point;
  end: Point;
  length: number;
  center?: Point;
  radius?: number;
  /**
   * Degrees, positive counter-clockwise.
   */
  sweep?: number;
  /**
   * `tan(sweep / 4)`; left out for lines and for a full turn, which has none.
   */
  bulge?: number;
}
/**
 * Result of `wedm/fit`: each outline as the wire leaves it, laid in the other.
 */
export interface Fit {
  /**
   * Nowhere do two parts of a pair bind.
   */
  fits: boolean;
  /**
   * Clearance that there should be, mm a side.
   */
  clearance: number;
  /**
   * The least clearance that is left anywhere, mm; below 0 where two parts bind. Where no contour has a partner, nothing is compared: that
   * which there should be.
   */
  least: number;
  /**
   * Every place where less is left than there should be.
   */
  places: FitPlace[];
  /**
   * Contours of workpieces that have no partner.
   */
  alone?: FitAlone[];
  /**
   * One outline in the other, the places marked.
   */
  svg: string;
}
/**
 * A place where clearance is missing.
 */
export interface FitPlace {
  /**
   * On the outline that stands too far out, drawing units.
   */
  at: Point;
  /**
   * What is left there, mm; below 0 where the parts bind.
   */
  clearance: number;
  handle: string;
  /**
   * Index within the entity.
   */
  segment: number;
  /**
   * The part that stands too far out, of which the segment is: `punch`, `plate`, or the name of a workpiece.
   */
  of: string;
}
/**
 * A contour without a partner.
 */
export interface FitAlone {
  handle: string;
  /**
   * Its workpiece.
   */
  of: string;
}
/**
 * Params of `wedm/generate`.
 */
export interface Generate {
  uri: string;
  /**
   * Language of the program: `3b`, `4b` or `iso`; `milling` for an electrode.
   */
  format: string;
  /**
   * Only the contours that hold one of these entities.
   */
  handles?: string[];
  /**
   * Only the contours that have an entity on one of these layers; beside `handles` those of both.
   */
  layers?: string[];
  /**
   * Laid over every other level of settings for this request.
   */
  options?: Settings;
  /**
   * Make the program although the drawing has errors.
   */
  force?: boolean;
}
/**
 * Result of `wedm/pair`: a program for each part.
 */
export interface PairPrograms {
  programs: PairProgram[];
}
/**
 * The program of one part of a pair.
 */
export interface PairProgram {
  /**
   * `punch`, `plate`, `stripper`, `holder`, or the name of a workpiece.
   */
  part: string;
  /**
   * Correction of each pass, mm. Below 0 for the passes on the other side of what is drawn, where the clearance lies between the
   * corrections; where they all run there, how far they are from it, with `otherSide`.
   */
  corrections: number[];
  /**
   * The clearance is not smaller than the correction: the wire runs on what is drawn or on its other side.
   */
  otherSide: boolean;
  program: string;
  /**
   * Where the wire is threaded first, drawing units.
   */
  threadHole?: Point;
  /**
   * Number of blocks.
   */
  blocks: number;
  /**
   * mm of all cuts, leads and all passes included; the ways between contours are none.
   */
  length: number;
  /**
   * mm of the ways without a cut between contours.
   */
  jumps?: number;
  closure: Closure;
  /**
   * Largest distance in µm of the decoded blocks from the path, over their whole length.
   */
  deviation: number;
  /**
   * Largest distance in µm of an arc of the path's outline from the chords of the drawing for which it stands, under `chord-fit`.
   */
  offChords?: number;
  /**
   * What all passes leave of the contours, where several are cut or a contour is open.
   */
  finished?: FinishedPart;
  /**
   * The layers and the wear of an electrode, of the format `milling`.
   */
  milling?: Milling;
  /**
   * Where the wire is threaded, in the order of the cuts.
   */
  holes?: StartHole[];
  /**
   * How long the machine runs alone, what falls meanwhile and in which order it would run longest, in sentences; nothing of a single
   * cut, and of times where `job.thickness` or `passes.rates` is not set.
   */
  unattended?: string[];
  /**
   * What the program comes to on the machine.
   */
  work?: Work;
  /**
   * The corrections to enter at the control, one for each pass, where it offsets the contour.
   */
  offsets?: ControlOffset[];
  /**
   * Of all cuts, as in `work`.
   */
  minutes?: number;
  warnings: Diagnostic[];
}
/**
 * The rounding of J in all arcs of a program, added up, µm: `wedm/simulate` says where a controller stops that counts it.
 */
export interface Closure {
  x: number;
  y: number;
}
/**
 * The largest deviations of the part that all passes leave from its drawing.
 */
export interface FinishedPart {
  /**
   * What stays beyond the contour where it stays thickest, mm.
   */
  uncut: number;
  /**
   * Where that is, drawing units.
   */
  at: Point;
  /**
   * How far the wire cuts beyond the contour, mm.
   */
  overcut: number;
}
/**
 * The layers of an electrode, and what a simulation of its wear says of them. Lengths in mm; depths are below the surface.
 */
export interface Milling {
  /**
   * How far the electrode's axis runs beside a closed contour: half its diameter + the gap.
   */
  correction: number;
  /**
   * How many layers there are.
   */
  layers: number;
  /**
   * Height of a layer.
   */
  layer: number;
  /**
   * Height of the last one.
   */
  lastLayer: number;
  /**
   * The depth that is wanted.
   */
  depth: number;
  /**
   * In the order of the cuts.
   */
  contours: MilledContour[];
}
/**
 * What milling one contour comes to.
 */
export interface MilledContour {
  /**
   * Handle of the contour's first entity.
   */
  contour: string;
  /**
   * Of the way in each layer.
   */
  length: number;
  /**
   * K: by how much the electrode gets shorter in a layer, as a share of its height.
   */
  wearOfLayer: number;
  /**
   * What each layer is fed at its beginning.
   */
  feed: number;
  /**
   * What the last one is.
   */
  lastFeed: number;
  /**
   * What is fed on each mm of the way, where the wear is compensated linearly.
   */
  feedAlong?: number;
  /**
   * Where the electrode is told to go at last.
   */
  fed: number;
  /**
   * Simulated: mean depth of the floor along the way.
   */
  depth: number;
  /**
   * Simulated: the highest and the deepest place of the floor.
   */
  floor: Floor;
  /**
   * Simulated: by how much the electrode is shorter then, the contours before among it.
   */
  worn: number;
}
/**
 * How deep a floor lies.
 */
export interface Floor {
  least: number;
  most: number;
}
/**
 * What the control has to hold for a program whose contour it offsets.
 */
export interface ControlOffset {
  /**
   * The word that says where the control finds it, such as `D1`; absent in 4B, and where the profile names none.
   */
  register?: string;
  /**
   * mm.
   */
  correction: number;
}
/**
 * One finding. In a drawing's diagnostics the line is the segment's index within its entity.
 */
export interface Diagnostic {
  range: Range;
  /**
   * 1 error, 2 warning, 3 information, 4 hint.
   */
  severity: number;
  /**
   * Name of the rule.
   */
  code: string;
  codeDescription?: CodeDescription;
  /**
   * Always `wedm`.
   */
  source: string;
  message: string;
  /**
   * Sent to clients that can show it.
   */
  relatedInformation?: RelatedInformation[];
  data?: FindingData;
}
export interface Range {
  start: Position;
  end: Position;
}
/**
 * Zero-based line and character, counted as the client and the server agreed on in the handshake.
 */
export interface Position {
  line: number;
  character: number;
}
export interface CodeDescription {
  /**
   * The rule's page of documentation.
   */
  href: string;
}
/**
 * Another place that a finding concerns, and what is there.
 */
export interface RelatedInformation {
  location: Location;
  message: string;
}
export interface Location {
  uri: string;
  range: Range;
}
/**
 * What a finding is about, in drawing units and degrees; in a program in mm, points from its start or, where it says where it begins,
 * absolute. Only what the finding has is there.
 */
export interface FindingData {
  handle?: string;
  /**
   * Index of the segment within its entity: that of the vertex it starts in.
   */
  segment?: number;
  radius?: number;
  /**
   * The correction that the radius is compared with.
   */
  required?: number;
  center?: Point;
  start?: Point;
  end?: Point;
  /**
   * Degrees, positive counter-clockwise.
   */
  sweep?: number;
  side?: SideName;
  /**
   * What an untrimmed offset cuts beyond the wire's contour.
   */
  overcut?: number;
  /**
   * What stays when the control trims; left out where it is without bound.
   */
  stockLeft?: number;
  /**
   * 1-based number of the pass with the largest correction, where several are set.
   */
  pass?: number;
  /**
   * Why no fix is offered: `narrow-slot`, `seals-contour`, `short-segment`, `spoils`, `no-neighbour`, `not-editable` or `program`.
   */
  noFix?: string;
  /**
   * Degrees by which the contour turns at a corner, positive counter-clockwise in the entity's own direction.
   */
  turn?: number;
  /**
   * How much the wire leaves standing in a corner, or of a part that it does not reach: the distance of the farthest point from
   * what is cut.
   */
  uncut?: number;
  /**
   * The point where two segments meet, or near which a part is lost.
   */
  at?: Point;
  /**
   * Width of a slot, distance of two ends, deviation of chords from their circle, the clearance left between two parts, or how far a
   * program is beside its drawing.
   */
  distance?: number;
  length?: number;
  /**
   * Kind of entity that is not cut, or the part of a pair.
   */
  kind?: string;
  /**
   * How many the finding stands for.
   */
  count?: number;
  /**
   * The other segment or entity, where two are concerned.
   */
  related?: RelatedPlace[];
}
/**
 * Another place that a finding concerns.
 */
export interface RelatedPlace {
  handle: string;
  /**
   * Index of the segment within its entity; not there where the entity as a whole is meant.
   */
  segment?: number;
}
/**
 * Params of `wedm/simulate`.
 */
export interface Simulate {
  uri: string;
  /**
   * mm/min: with it the reply says how many minutes the way takes.
   */
  feed?: number;
}
/**
 * Result of `wedm/simulate`.
 */
export interface Simulation {
  blocks: SimulatedBlock[];
  /**
   * From the program's start to where the machine ends, µm.
   */
  closure: Closure;
  /**
   * mm, along the lines and arcs; ways without a cut are counted in.
   */
  length: number;
  /**
   * mm that are cut.
   */
  cut?: number;
  /**
   * mm of the ways without a cut.
   */
  jumps?: number;
  /**
   * The largest deviation of a block, µm.
   */
  deviation: number;
  /**
   * The text says where the program begins; else that is the origin.
   */
  startIsKnown: boolean;
  /**
   * Not there where nothing moves.
   */
  bounds?: SimulatedBounds;
  /**
   * At the feed that was asked for.
   */
  minutes?: number;
}
/**
 * A block or word and what it makes the machine do; points in µm, in the program's own frame.
 */
export interface SimulatedBlock {
  /**
   * Line of the text, from 0.
   */
  line: number;
  /**
   * Number that the block carries.
   */
  number?: number;
  kind: StepKind;
  start: Point;
  /**
   * Where the machine stops.
   */
  end: Point;
  /**
   * Where the line or arc ends that the block means; not there where it means none.
   */
  idealEnd?: Point;
  /**
   * From the ideal end to the machine's, µm.
   */
  deviation: number;
  center?: Point;
  radius?: number;
  /**
   * Degrees, positive counter-clockwise.
   */
  sweep?: number;
  /**
   * Index of the contour; a pause is between two of them.
   */
  contour: number;
  /**
   * Where the wire's upper end is after the block; not there where that is where the machine stops.
   */
  upperEnd?: Point;
}
/**
 * A box, µm.
 */
export interface SimulatedBounds {
  min: Point;
  max: Point;
}
/**
 * Params of `wedm/locate`: either `position`, or `handle` with or without `segment`.
 */
export interface Locate {
  uri: string;
  /**
   * A place in the text; the answer is what is written there.
   */
  position?: Position;
  /**
   * An entity; the answer is where it is written.
   */
  handle?: string;
  /**
   * One of its segments.
   */
  segment?: number;
}
/**
 * Result of `wedm/locate`; null where nothing with geometry is written.
 */
export interface Located {
  handle: string;
  /**
   * Missing where the place is of the entity, and of none of its segments: the head of a polyline.
   */
  segment?: number;
  /**
   * The number that a finding on the segment stands at, or the entity's name.
   */
  range: Range;
}
export interface DrawingName {
  uri: string;
}
/**
 * Result of `wedm/settings`.
 */
export interface SettingsInForce {
  /**
   * mm; what radii are compared with: the largest of `corrections`.
   */
  correction: number;
  /**
   * mm; that of each pass.
   */
  corrections: number[];
  correctionFrom: CorrectionSource;
  side: SideSetting;
  /**
   * The level that the side comes from.
   */
  sideFrom: Origin;
  /**
   * Millimetres in one unit of the drawing, where it is an open one.
   */
  unitsToMm?: number;
  /**
   * What says that unit.
   */
  unitsFrom?: Origin;
  /**
   * Correction, side and the unit of an open drawing, each with where it comes from: a sentence to be shown.
   */
  said: string;
  /**
   * URI of the `wedm.toml` that holds for the document, where there is one.
   */
  file?: string;
  /**
   * Settings of single contours of this drawing, by handle or by a point.
   */
  contours?: {
    [k: string]: ContourSettings;
  };
}
/**
 * Params of `wedm/rulePage`.
 */
export interface RulePage {
  /**
   * Name of the rule, which is the `code` of its findings.
   */
  rule: string;
}
/**
 * Result of `wedm/rulePage`.
 */
export interface RulePageText {
  /**
   * Markdown without pictures. Links lead to pages of other rules only, as `NAME.md`.
   */
  text: string;
}
/**
 * Result of `wedm/generate`: a program that has been decoded again and compared with its path.
 */
export interface Program {
  program: string;
  /**
   * Where the wire is threaded first, drawing units.
   */
  threadHole?: Point;
  /**
   * Number of blocks.
   */
  blocks: number;
  /**
   * mm of all cuts, leads and all passes included; the ways between contours are none.
   */
  length: number;
  /**
   * mm of the ways without a cut between contours.
   */
  jumps?: number;
  closure: Closure;
  /**
   * Largest distance in µm of the decoded blocks from the path, over their whole length.
   */
  deviation: number;
  /**
   * Largest distance in µm of an arc of the path's outline from the chords of the drawing for which it stands, under `chord-fit`.
   */
  offChords?: number;
  /**
   * What all passes leave of the contours, where several are cut or a contour is open.
   */
  finished?: FinishedPart;
  /**
   * The layers and the wear of an electrode, of the format `milling`.
   */
  milling?: Milling;
  /**
   * Where the wire is threaded, in the order of the cuts.
   */
  holes?: StartHole[];
  /**
   * How long the machine runs alone, what falls meanwhile and in which order it would run longest, in sentences; nothing of a single
   * cut, and of times where `job.thickness` or `passes.rates` is not set.
   */
  unattended?: string[];
  /**
   * What the program comes to on the machine.
   */
  work?: Work;
  /**
   * The corrections to enter at the control, one for each pass, where it offsets the contour.
   */
  offsets?: ControlOffset[];
  /**
   * Of all cuts, as in `work`.
   */
  minutes?: number;
  warnings: Diagnostic[];
}
/**
 * Params of `wedm/calibrate`; mm.
 */
export interface Calibrate {
  measurements: Measured[];
  /**
   * With which the piece was cut, of each pass.
   */
  corrections: number[];
  /**
   * Without it no gap follows.
   */
  wireDiameter?: number;
  /**
   * Of a single measurement, 0.002 unless stated: 95 of 100 are nearer to the truth.
   */
  uncertainty?: number;
}
/**
 * A size that was measured.
 */
export interface Measured {
  /**
   * Measurements of the same name are of the same feature; without one each is of its own.
   */
  feature?: string;
  kind: FeatureKind;
  /**
   * After which it was measured, from 1; without it the last one.
   */
  pass?: number;
  nominal: number;
  measured: number;
}
/**
 * Result of `wedm/calibrate`.
 */
export interface Calibrated {
  /**
   * The passes that were measured.
   */
  passes: CalibratedPass[];
}
/**
 * Half of the kerf of a pass; mm.
 */
export interface CalibratedPass {
  pass: number;
  /**
   * With which it was cut.
   */
  correction: number;
  halfKerf: number;
  /**
   * At 95 % confidence.
   */
  uncertainty: number;
  gap?: number;
  /**
   * The count of measured features.
   */
  features: number;
  /**
   * By the outer features alone.
   */
  outer?: number;
  /**
   * By the inner features alone.
   */
  inner?: number;
}
