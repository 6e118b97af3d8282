//! Settings that contradict each other or the drawing, and what is said of each: asked through the command line and the live server.

/// One contradiction: `wedm.toml` and drawing, the rule that finds it, and some words of what it says.
pub struct Contradiction {
    pub settings: &'static str,
    /// Layer and corners of each contour; the handles are A0, A1 and so on.
    pub drawing: &'static [(&'static str, &'static [[f64; 2]])],
    pub rule: &'static str,
    pub says: &'static str,
}

const PLATE: &[[f64; 2]] = &[[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]];
const WITHIN: &[[f64; 2]] = &[[5.0, 2.0], [10.0, 2.0], [10.0, 7.0], [5.0, 7.0]];
const ACROSS: &[[f64; 2]] = &[[15.0, 5.0], [35.0, 5.0], [35.0, 15.0], [15.0, 15.0]];
const SLOT: &[[f64; 2]] = &[[0.0, 0.0], [20.0, 0.0], [20.0, 0.9], [0.0, 0.9]];
/// Of two corners: an open line.
const LINE: &[[f64; 2]] = &[[0.0, 0.0], [20.0, 0.0]];

const ONE: &[(&str, &[[f64; 2]])] = &[("A", PLATE)];
const NESTED: &[(&str, &[[f64; 2]])] = &[("A", PLATE), ("B", WITHIN)];
const CROSSED: &[(&str, &[[f64; 2]])] = &[("A", PLATE), ("B", ACROSS)];
const NARROW: &[(&str, &[[f64; 2]])] = &[("A", SLOT)];
const OPEN: &[(&str, &[[f64; 2]])] = &[("A", LINE)];

const fn row(
    drawing: &'static [(&'static str, &'static [[f64; 2]])],
    settings: &'static str,
    rule: &'static str,
    says: &'static str,
) -> Contradiction {
    Contradiction {
        settings,
        drawing,
        rule,
        says,
    }
}

macro_rules! wire {
    ($more:literal) => {
        concat!("wire-diameter = 0.18\ngap = 0.01\n", $more)
    };
}

macro_rules! electrode {
    ($more:literal) => {
        concat!(
            "side = \"opening\"\n[milling]\ntool-diameter = 0.5\ngap = 0.05\ndepth = 0.2\nwear = 0.02\n",
            $more
        )
    };
}

#[rustfmt::skip]
pub const CONTRADICTIONS: &[Contradiction] = &[
    // Passes.
    row(ONE, "side = \"punch\"\npasses.corrections = [0.1, 0.2]\n", "pass-order", "corrections decrease"),
    row(ONE, "side = \"punch\"\ncorrection = 0.05\nwire-diameter = 0.18\n", "pass-order", "the wire's radius 0.09"),
    row(ONE, "side = \"punch\"\npasses.corrections = [0.2, 0.1]\npasses.registers = [\"D1\"]\n", "pass-order", "one for each of the 2 passes"),
    row(ONE, "side = \"punch\"\npasses.corrections = [0.2, 0.1]\npasses.gaps = [0.01]\n", "pass-order", "one for each of the 2 passes"),
    row(ONE, "side = \"punch\"\npasses.rates = [1, 2]\n", "pass-order", "one for the one pass"),
    row(ONE, "side = \"punch\"\nwire-diameter = 0.18\npasses.registers = [\"D1\", \"D2\"]\n", "pass-order", "one for the one pass"),
    row(ONE, "side = \"punch\"\npasses.corrections = [0.2, 0.1]\npasses.registers = [\"D1\", \"D1\"]\n", "pass-order", "a register of its own"),
    row(ONE, "side = \"punch\"\npasses.corrections = [0.2, 0.1]\npasses.registers = [\"D1\", \"d01\"]\n", "pass-order", "a register of its own"),
    row(ONE, "side = \"punch\"\npasses.corrections = [0.2, 0.1]\npasses.registers = [\"D1\", \"M30\"]\n", "pass-order", "not an offset register"),
    row(ONE, "side = \"punch\"\ncorrection = 0.11\nwire-diameter = 0.2\ngap = 0.5\n", "pass-order", "0.4900 mm beyond the contour"),
    row(ONE, wire!("side = \"punch\"\npasses.corrections = [0.2, 0.095]\n"), "pass-order", "0.0050 mm beyond the contour"),
    row(ONE, "side = \"punch\"\nwire-diameter = 0.18\npasses.gaps = [0.2, 0.01]\npasses.corrections = [0.2, 0.1]\n", "pass-order", "passes.corrections[0]"),
    row(ONE, "side = \"opening\"\nprogram.compensation = \"controller\"\n[passes]\ncorrections = [0.2, 0.145]\nskim-corner = \"constant-stock\"\n", "settings", "each pass would run beside the drawn contour"),
    // Values that cannot be.
    row(ONE, "side = \"punch\"\ncorrection = -0.1\n", "settings", "expected a number above 0"),
    row(ONE, "side = \"punch\"\nprogram.tab = -1\n", "settings", "expected a number of 0 or above"),
    row(ONE, "side = \"punch\"\npasses.corrections = [0.1, -0.1]\n", "settings", "above 0"),
    // Tabs, overlaps, slugs, words of the program.
    row(ONE, "side = \"punch\"\nprogram.tab = 100\n", "lead-in", "leaves nothing of contour A0"),
    row(ONE, "side = \"punch\"\nprogram.tab = 60\n", "lead-in", "leaves nothing of contour A0"),
    row(ONE, "side = \"punch\"\nprogram.closing-overlap = 100\n", "lead-in", "goes all round contour A0"),
    row(OPEN, "side = \"left\"\nprogram.tab = 3\n", "lead-in", "contour A0 is open"),
    row(ONE, "side = \"punch\"\nprogram.tab.ZZ = 3\n", "settings", "the handle ZZ"),
    row(NESTED, "side = \"auto\"\nprogram.tab = 1\njob.slug-limit = 1\n", "settings", "expected job.thickness"),
    row(ONE, "side = \"opening\"\njob.machine-rate = 60\n", "settings", "expected job.thickness and passes.rates as well"),
    row(ONE, "side = \"opening\"\njob.thickness = 40\njob.machine-rate = 60\n", "settings", "expected passes.rates as well"),
    row(ONE, "side = \"opening\"\n[job]\nthickness = 40\nwires = [0.25, 0.1]\nwire-gaps = [0.01]\n", "settings", "job.wires has 2 wires, job.wire-gaps 1 and job.wire-rates 0"),
    row(ONE, "side = \"opening\"\n[job]\nwires = [0.25]\nwire-gaps = [0.01]\nwire-rates = [60]\n", "settings", "expected job.thickness as well"),
    row(ONE, "side = \"opening\"\n[job]\nthickness = 40\nwires = []\n", "settings", "one for each wire"),
    row(ONE, "side = \"opening\"\njob.thickness = 40\njob.slug-limit = 100\n", "settings", "no effect without program.tab"),
    row(ONE, "side = \"opening\"\njob.thickness = 40\njob.slug-limit = 100\nprogram.tab = 0\n", "settings", "no effect without program.tab"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"\"\nprogram.tab = 3\n", "settings", "program.tab-stop"),
    row(ONE, "side = \"punch\"\nprogram.end = \"D\"\n", "settings", "so is program.pause"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"DD\"\nprogram.tab = 3\n", "settings", "would never be cut off"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"M30\"\nprogram.tab = 3\n", "settings", "would never be cut off"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"M02\"\n", "settings", "would never be cut off"),
    row(ONE, "side = \"punch\"\nprogram.end = \"STOP\"\nprogram.tab-stop = \"stop\"\n", "settings", "would never be cut off"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"T1\"\nprogram.tab = 3\n", "settings", "which stops no machine"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"G00\"\n", "settings", "which is no part of a block"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"M08\"\n", "settings", "which stops no machine"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"M00\"\n", "settings", "no effect without program.tab"),
    row(ONE, "side = \"punch\"\nprogram.tab-stop = \"M00\"\nprogram.tab = 0\n", "settings", "no effect without program.tab"),
    // Without effect.
    row(ONE, "side = \"punch\"\nprogram.compensation = \"none\"\npasses.corrections = [0.2, 0.17]\n", "settings", "along the drawn line itself"),
    row(ONE, "side = \"punch\"\n[passes]\ncorrections = [0.2, 0.17]\nregisters = [\"D1\", \"D2\"]\n", "settings", "no effect while program.compensation is path"),
    row(ONE, "side = \"punch\"\npasses.skim-corner = \"constant-stock\"\n", "settings", "no effect on one pass"),
    // Where the wire is threaded and comes to its contour.
    row(ONE, "side = \"opening\"\nprogram.start-hole = 12\n", "start-hole", "has room in contour A0"),
    row(ONE, "side = \"opening\"\nprogram.start-hole = 0.18\nwire-diameter = 0.18\ngap = 0.01\n", "settings", "the wire does not go through the hole"),
    row(ONE, "side = \"punch\"\nprogram.thread = [10, 5]\n", "lead-in", "the thread hole (10.000, 5.000)"),
    row(ONE, "side = \"punch\"\ncorrection = 0.2\nprogram.lead-in = 0.1\n", "settings", "within the kerf of its own cut"),
    row(ONE, "side = \"opening\"\npasses.corrections = [0.2, 0.1]\nprogram.lead-in = 0.15\n", "settings", "below the correction 0.2"),
    row(ONE, "side = \"punch\"\nprogram.entry = [100, 50]\n", "settings", "expected a point on it"),
    row(NESTED, "side = \"auto\"\nprogram.thread = [-5, 5]\n", "settings", "2 contours"),
    row(ONE, "side = \"punch\"\nprogram.thread.ZZ = [-5, 5]\n", "settings", "the handle ZZ"),
    // Single contours, and what lies within what.
    row(ONE, "side = \"punch\"\n[drawings.\"x.dxf\".contours.ZZ]\nside = \"opening\"\n", "settings", "has no ZZ"),
    row(ONE, "side = \"punch\"\n[drawings.\"x.dxf\".suppress.ZZ]\ngap = \"it is so\"\n", "settings", "suppresses nothing"),
    row(NESTED, "side = \"punch\"\n", "settings", "A1 is a punch within the punch A0"),
    row(NESTED, "side = \"auto\"\ncontours.A1 = \"punch\"\n", "settings", "A1 is a punch within the punch A0"),
    row(CROSSED, "side = \"punch\"\nworkpieces.one = [\"A\", \"B\"]\n", "self-intersection", "crosses itself or another"),
    // Pairs.
    row(ONE, "pair.drawn-as = \"punch\"\npair.clearance = 0.01\n", "settings", "expected wire-diameter and gap"),
    row(ONE, "pair.drawn-as = \"punch\"\n", "settings", "has no effect without pair.clearance"),
    row(ONE, "pair.clearance = 0.01\n", "settings", "has no pair"),
    row(ONE, "pair.stripper = 0.01\n", "settings", "expected pair.drawn-as"),
    row(ONE, wire!("side = \"punch\"\npair.drawn-as = \"punch\"\npair.clearance = 0.01\n"), "settings", "expected side = \"both\""),
    row(NESTED, wire!("[pair]\ndrawn-as = \"punch\"\nclearance = 0.01\n[workpieces]\none = [\"A\"]\ntwo = [\"B\"]\n"), "settings", "expected one of the two"),
    row(CROSSED, wire!("pair.clearance = 0.01\n[workpieces]\none = [\"A\"]\ntwo = [\"A\"]\n"), "settings", "the layer A"),
    row(CROSSED, wire!("side = \"auto\"\npair.clearance = 0.01\n[workpieces]\none = [\"A\"]\ntwo = [\"B\"]\n"), "does-not-fit", "it has no partner"),
    row(CROSSED, wire!("side = \"auto\"\npair.clearance = 0.01\n[workpieces]\none = [\"A\"]\ntwo = [\"C\"]\n"), "does-not-fit", "nothing is drawn on the layers of two"),
    row(ONE, wire!("pair.drawn-as = \"punch\"\npair.clearance = 0.02\nprogram.compensation = \"none\"\n"), "settings", "along the drawn lines themselves"),
    row(ONE, "wire-diameter = 0.18\ngap = 0.01\n[passes]\ncorrections = [0.15, 0.1]\n[pair]\ndrawn-as = \"punch\"\nclearance = 0.12\n[program]\ncompensation = \"controller\"\n", "settings", "keeps to one"),
    row(CROSSED, wire!("pair.clearance = 0.01\nprogram.compensation = \"none\"\n[workpieces]\none = [\"A\"]\ntwo = [\"B\"]\n"), "settings", "along the drawn lines themselves"),
    // Milling.
    row(NARROW, "side = \"opening\"\n[milling]\ntool-diameter = 1\ngap = 0.05\nlayer = 0.01\ndepth = 0.2\nwear = 0.02\n", "narrow-slot", "the electrode needs 1.100 mm"),
    row(NARROW, "side = \"opening\"\nmilling.tool-diameter = 1\n", "settings", "expected milling.gap"),
    row(NARROW, electrode!("layer = 0.3\n"), "settings", "at most milling.depth"),
    row(NARROW, electrode!("layer = 0.01\nwear-compensation = \"linear\"\n"), "settings", "expected milling.step"),
    row(NARROW, electrode!("layer = 0.01\nstep = 1\n"), "settings", "unless milling.wear-compensation is linear"),
    row(NARROW, electrode!("layer = 0.01\nstep = 100\nwear-compensation = \"linear\"\n"), "settings", "longer than a layer of this contour"),
];

impl Contradiction {
    /// The drawing as DXF; a contour of two corners is open.
    pub fn dxf(&self) -> String {
        let mut text = String::from(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
        );
        for (number, (layer, corners)) in self.drawing.iter().enumerate() {
            let (count, closed) = (corners.len(), u8::from(corners.len() > 2));
            text +=
                &format!("0\nLWPOLYLINE\n5\nA{number}\n8\n{layer}\n90\n{count}\n70\n{closed}\n");
            for [x, y] in *corners {
                text += &format!("10\n{x:?}\n20\n{y:?}\n");
            }
        }
        text + "0\nENDSEC\n0\nEOF\n"
    }
}
