# A notebook as a text: Jupyter (with jupytext), VS Code and Spyder show each part after a %% as a cell.

# %% A die opening, with a corner that the wire cannot follow
from wedm_client import Polyline, Server

server = Server(settings={"correction": 0.12}).__enter__()
quarter = 0.41421356237309503
opening = Polyline([(0, 0), (5.92, 0, quarter), (6, 0.08), (6, 4), (0, 4)], handle="2A", role="opening")
drawing = server.open([opening])

# %% What is wrong with it, as a table
drawing.diagnostics()

# %% A drawing shows itself: contours, faults under lenses, the wire's path where there is one
drawing

# %% The radii, as a table
drawing.inspect()

# %% Repaired; the rest are hints
drawing.fix()

# %% The wire's path runs inside now
drawing.picture({"program": {"thread": (3, 2)}})

# %% The program
print(drawing.generate("3b", options={"program": {"thread": (3, 2), "layout": "checking"}}))

# %%
server.close()
