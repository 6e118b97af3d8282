"""Checks and repairs wire-EDM drawings and writes their programs, by the language server ``wedm``.

    from wedm_client import Polyline, Server

    with Server(settings={"correction": 0.12}) as server:
        drawing = server.open([Polyline([(0, 0), (19.92, 0, 0.41421356237), (20, 0.08), (20, 10), (0, 10)], handle="2A")])
        for diagnostic in server.diagnostics(drawing):
            print(diagnostic)
        drawing.fix()
        drawing.generate("3b", options={"side": "opening"}).save("plate.3b")
"""

import sys
import warnings

from .archive import Checked, check_many, report
from .calibration import Calibration, Kerf, calibrate
from .cad import UnsupportedEntity, UnsupportedUnits
from .documents import Action, Document, Drawing, ProgramFormat, TextDocument, WireFormat, write_back
from .entities import Arc, Change, Circle, Delete, Entity, Line, Mark, Point, Polyline, Put, Splice, Text, Vertex
from .errors import (
    DoesNotApply,
    NoAnswer,
    NotOpen,
    NotSaved,
    Outdated,
    Refused,
    RequestFailed,
    ServerDied,
    ServerNotFound,
    WedmError,
    WrongProtocol,
    WrongSettings,
)
from .find import find
from .findings import Diagnostic, Findings, Fixed, Located
from .programs import (
    Bounds,
    Closure,
    ControlOffset,
    FinishedPart,
    Fit,
    FitAlone,
    FitPlace,
    Floor,
    MilledContour,
    Milling,
    PairProgram,
    PairPrograms,
    Program,
    SimulatedBlock,
    Simulation,
)
from .progress import Progress
from .results import (
    Contour,
    ContourPiece,
    Contours,
    FacingWall,
    Gap,
    InspectedEntity,
    Inspection,
    LargestWire,
    PathPiece,
    Picture,
    Repair,
    Repairs,
    Segment,
    SegmentShape,
    SettingsInForce,
    Slug,
    StartHole,
    Toolpath,
    ToolpathPart,
    WirePath,
    Work,
    WorkCut,
)
from .server import Server
from .settings import ContourSettings, DrawingSettings, Job, MillingSettings, Pair, Passes, Profile, ProgramSettings, Settings
from .shown import Rows

__version__ = "0.1.0"

# Python ignores resource warnings by default; a repair that is lost is worth a line.
if not sys.warnoptions:
    warnings.simplefilter("default", NotSaved)

__all__ = [
    "Action",
    "Arc",
    "Bounds",
    "Calibration",
    "Change",
    "Checked",
    "Circle",
    "Closure",
    "Contour",
    "ContourPiece",
    "ContourSettings",
    "Contours",
    "ControlOffset",
    "Delete",
    "Diagnostic",
    "Document",
    "DoesNotApply",
    "Drawing",
    "DrawingSettings",
    "Entity",
    "FacingWall",
    "Findings",
    "FinishedPart",
    "Fit",
    "FitAlone",
    "FitPlace",
    "Fixed",
    "Floor",
    "Gap",
    "InspectedEntity",
    "Inspection",
    "Job",
    "Kerf",
    "LargestWire",
    "Line",
    "Located",
    "Mark",
    "MilledContour",
    "Milling",
    "MillingSettings",
    "NoAnswer",
    "NotOpen",
    "NotSaved",
    "Outdated",
    "Pair",
    "PairProgram",
    "PairPrograms",
    "Passes",
    "PathPiece",
    "Picture",
    "Point",
    "Polyline",
    "Profile",
    "Program",
    "Repair",
    "Repairs",
    "ProgramFormat",
    "ProgramSettings",
    "Progress",
    "Put",
    "Refused",
    "RequestFailed",
    "Rows",
    "Segment",
    "SegmentShape",
    "SimulatedBlock",
    "Simulation",
    "Slug",
    "StartHole",
    "Server",
    "ServerDied",
    "ServerNotFound",
    "Settings",
    "SettingsInForce",
    "Splice",
    "Text",
    "TextDocument",
    "Toolpath",
    "ToolpathPart",
    "UnsupportedEntity",
    "UnsupportedUnits",
    "Vertex",
    "WedmError",
    "WirePath",
    "WireFormat",
    "Work",
    "WorkCut",
    "WrongProtocol",
    "WrongSettings",
    "calibrate",
    "check_many",
    "find",
    "report",
    "write_back",
]
