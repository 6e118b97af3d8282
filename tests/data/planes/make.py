"""Drawings whose blocks are tilted in space and still draw level, with where ezdxf says that all of it lies.

usage: python make.py      with ezdxf (benches/requirements.txt); writes NAME.dxf and NAME.points beside itself.

Shapes are made level with the drawing, moved back through the references that will draw them, and put into the innermost block.
Each line of NAME.points is a point on a curve that the references draw, as ezdxf resolves them; a line `tilted KIND` stands for an
entity that does not end level.
"""
import io, math, pathlib, random
import ezdxf
from ezdxf.lldxf.tagwriter import TagWriter
from ezdxf.math import Matrix44, Vec3

HERE = pathlib.Path(__file__).parent


def shapes(layout, corner):
    x, y, z = corner
    new = [
        layout.add_line((x, y, z), (x + 3, y + 1, z)),
        layout.add_arc((x + 1, y + 4, z), 0.75, 20, 250),
        layout.add_arc((-x - 4, y + 4, -z), 0.5, 300, 80, dxfattribs={"extrusion": (0, 0, -1)}),
        layout.add_circle((x + 6, y + 4, z), 0.8),
        layout.add_lwpolyline([(x, y + 6, 0), (x + 2, y + 6, 0.6), (x + 2, y + 8, 0), (x, y + 8, -0.3)], format="xyb", close=True, dxfattribs={"elevation": z}),
        layout.add_polyline2d([(x + 4, y + 6, 0.0), (x + 6, y + 6, 1.0), (x + 6, y + 7, 0.0)], format="xyb", dxfattribs={"elevation": (0, 0, z)}),
        layout.add_polyline3d([(x + 8, y, z), (x + 9, y + 1, z), (x + 8, y + 2, z)], close=True),
        layout.add_ellipse((x + 9, y + 5, z), (1.2, 0.4, 0), 0.5, 0.3, 4.0),
        layout.add_ellipse((x + 9, y + 8, z), (0.0, 1.0, 0), 0.6, 1.0, 5.0, dxfattribs={"extrusion": (0, 0, -1)}),
    ]
    spline = layout.add_spline()
    spline.control_points = [(x, y + 10, z), (x + 2, y + 12, z), (x + 4, y + 9, z), (x + 6, y + 11, z), (x + 7, y + 10, z)]
    spline.dxf.degree = 3
    spline.knots = [0, 0, 0, 0, 1, 2, 2, 2, 2]
    return new + [spline]


def points(entity):
    kind = entity.dxftype()
    if kind == "LINE":
        start, end = Vec3(entity.dxf.start), Vec3(entity.dxf.end)
        return [start, start.lerp(end), end]
    if kind == "ARC":
        first, last = entity.dxf.start_angle, entity.dxf.end_angle
        sweep = (last - first) % 360 or 360
        return list(entity.vertices([first, first + sweep / 3, first + sweep / 2, first + sweep]))
    if kind == "CIRCLE":
        return list(entity.vertices([0, 100, 200, 300]))
    if kind == "ELLIPSE":
        first, last = entity.dxf.start_param, entity.dxf.end_param
        sweep = (last - first) % math.tau or math.tau
        return list(entity.vertices([first + sweep * share for share in (0, 0.3, 0.5, 0.8, 1)]))
    if kind == "SPLINE":
        tool = entity.construction_tool()
        return list(tool.points([tool.max_t * share for share in (0, 0.2, 0.5, 0.7, 1)]))
    return [point for part in entity.virtual_entities() for point in points(part)]


def drawn(insert):
    for entity in insert.virtual_entities():
        if entity.dxftype() == "INSERT":
            yield from drawn(entity)
        else:
            yield entity


def write(name, levels, tilted):
    doc = ezdxf.new("R2000")
    space = doc.modelspace()
    way = Matrix44()
    inner = [doc.blocks.new(f"LEVEL{n}", base_point=(0.5, -0.25, 1.5) if n % 2 else (0, 0, 0)) for n in range(len(levels))]
    for n, attributes in enumerate(levels):
        within = space if n == 0 else inner[n - 1]
        attributes = dict(attributes)
        insert = within.add_blockref(f"LEVEL{n}", attributes.pop("insert"), dxfattribs=attributes)
        way = insert.matrix44() * way
        if n == 0:
            outer = insert
    scratch = doc.blocks.new("SCRATCH")
    for entity in shapes(scratch, (5.0, -2.0, 0.75)):
        scratch.unlink_entity(entity)
        inner[-1].add_entity(entity)
        back = way.copy()
        back.inverse()
        entity.transform(back)
    for kind in tilted:
        if kind == "CIRCLE":
            inner[-1].add_circle((1, 1, 0), 1, dxfattribs={"extrusion": (1, 2, -0.5)})
        else:
            inner[-1].add_ellipse((1, 1, 0), (1, 0.5, 0.25), 0.4)
    doc.blocks.delete_block("SCRATCH", safe=False)
    text = io.StringIO()
    tags = TagWriter(text, write_handles=True, dxfversion="AC1015")
    text.write("0\nSECTION\n2\nBLOCKS\n")
    for block in inner:
        block.block.export_dxf(tags)
        for entity in block:
            entity.export_dxf(tags)
        block.endblk.export_dxf(tags)
    text.write("0\nENDSEC\n0\nSECTION\n2\nENTITIES\n")
    outer.export_dxf(tags)
    text.write("0\nENDSEC\n0\nEOF\n")
    (HERE / f"{name}.dxf").write_text(text.getvalue())
    lines = []
    for entity in drawn(outer):
        there = points(entity)
        level = max(abs(a.z - b.z) for a in there for b in there) < 1e-6
        lines += [f"{p.x:.9f} {p.y:.9f}" for p in there] if level else [f"tilted {entity.dxftype()}"]
    (HERE / f"{name}.points").write_text("\n".join(lines) + "\n")


chance = random.Random(7)
direction = lambda: Vec3(chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(-1, 1)).normalize()
turned = lambda **more: {"insert": tuple(chance.uniform(-9, 9) for _ in range(3)), "extrusion": direction(), "rotation": chance.uniform(0, 360), **more}
alike = lambda scale: {"xscale": scale, "yscale": scale, "zscale": scale}
write("standing", [{"insert": (3, 4, 5), "extrusion": (0, -1, 0)}], [])
write("lying_on_its_side", [{"insert": (3, 4, 5), "extrusion": (1, 0, 0), "rotation": 30}], ["CIRCLE"])
write("askew", [turned(**alike(2.0))], ["ELLIPSE"])
write("mirrored", [turned(xscale=-1.5, yscale=1.5, zscale=1.5)], [])
write("seen_from_below_twice", [{"insert": (1, 2, 3), "extrusion": (0, 0, -1), "rotation": 15}, {"insert": (4, 5, 6), "extrusion": (0, 0, -1)}], [])
write("tilted_and_back", [turned(), turned(**alike(0.5))], ["CIRCLE", "ELLIPSE"])
write("three_deep", [turned(), turned(), turned(**alike(3.0))], ["CIRCLE"])
