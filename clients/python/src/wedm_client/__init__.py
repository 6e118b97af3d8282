"""Checks and repairs wire-EDM drawings and writes their programs, by the language server ``wedm``.

    from wedm_client import Polyline, Server

    with Server(settings={"correction": 0.12}) as server:
        drawing = server.open([Polyline([(0, 0), (19.92, 0, 0.41421356237), (20, 0.08), (20, 10), (0, 10)], handle="2A")])
        for diagnostic in server.diagnostics(drawing):
            print(diagnostic)
        server.fix(drawing)
        server.generate(drawing, "3b", options={"side": "opening"}).save("plate.3b")
"""

from .archive import Checked, check_many
from .cad import UnsupportedEntity, UnsupportedUnits
from .documents import Document, Drawing, TextDocument, write_back
from .entities import Arc, Change, Circle, Delete, Entity, Line, Point, Polyline, Put, Splice, Text, Vertex
from .errors import (
    DoesNotApply,
    NoAnswer,
    NotOpen,
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
from .results import (
    Bounds,
    Closure,
    Contour,
    ContourPiece,
    Contours,
    Diagnostic,
    Fit,
    FitAlone,
    FitPlace,
    Fixed,
    Gap,
    InspectedEntity,
    Inspection,
    Located,
    PairProgram,
    PairPrograms,
    PathPiece,
    Picture,
    Program,
    Segment,
    SettingsInForce,
    SimulatedBlock,
    Simulation,
    Toolpath,
    WirePath,
)
from .server import Action, Server
from .settings import Pair, Passes, ProgramSettings, Settings

__version__ = "0.1.0"

__all__ = [
    "Action",
    "Arc",
    "Bounds",
    "Change",
    "Checked",
    "Circle",
    "Closure",
    "Contour",
    "ContourPiece",
    "Contours",
    "Delete",
    "Diagnostic",
    "Document",
    "DoesNotApply",
    "Drawing",
    "Entity",
    "Fit",
    "FitAlone",
    "FitPlace",
    "Fixed",
    "Gap",
    "InspectedEntity",
    "Inspection",
    "Line",
    "Located",
    "NoAnswer",
    "NotOpen",
    "Outdated",
    "Pair",
    "PairProgram",
    "PairPrograms",
    "Passes",
    "PathPiece",
    "Picture",
    "Point",
    "Polyline",
    "Program",
    "ProgramSettings",
    "Put",
    "Refused",
    "RequestFailed",
    "Segment",
    "SimulatedBlock",
    "Simulation",
    "Server",
    "ServerDied",
    "ServerNotFound",
    "Settings",
    "SettingsInForce",
    "Splice",
    "Text",
    "TextDocument",
    "Toolpath",
    "UnsupportedEntity",
    "UnsupportedUnits",
    "Vertex",
    "WedmError",
    "WirePath",
    "WrongProtocol",
    "WrongSettings",
    "check_many",
    "find",
    "write_back",
]
