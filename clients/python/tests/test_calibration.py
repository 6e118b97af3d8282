"""Gap and corrections from a cut test piece."""

from pathlib import Path

import pytest

from wedm_client import Calibration, Kerf, WedmError, calibrate


def test_sizes_give_the_gap(program: str) -> None:
    found = calibrate(outer=[(20, 20.006), (12, 12.006)], inner=[(10, 9.994)], correction=0.155, wire_diameter=0.25, command=program)
    kerf = found.passes[0]
    assert (kerf.pass_, kerf.correction, kerf.features) == (1, 0.155, 3)
    assert kerf.half_kerf == pytest.approx(0.152) and kerf.gap == pytest.approx(0.027)
    assert kerf.outer == pytest.approx(0.152) and kerf.inner == pytest.approx(0.152)
    assert found.settings == {"wire-diameter": 0.25, "gap": 0.027}


def test_a_table_of_several_passes_is_written_where_that_is_asked_for(program: str, tmp_path: Path) -> None:
    table = tmp_path / "piece.csv"
    table.write_text("kind,pass,nominal,measured\nouter,1,20,20.113\ninner,1,10,9.887\nouter,2,20,20.001\ninner,2,10,9.999\n")
    found = calibrate(table, passes=[0.215, 0.14], uncertainty=0.001, write=True, command=program)
    assert isinstance(found, Calibration) and all(isinstance(one, Kerf) for one in found.passes)
    assert [one.pass_ for one in found.passes] == [1, 2]
    assert found.settings["passes.corrections"] == [0.215, 0.1395]
    assert "corrections = [0.2150, 0.1395]" in (tmp_path / "wedm.toml").read_text()


def test_what_contradicts_itself_is_refused(program: str, tmp_path: Path) -> None:
    with pytest.raises(WedmError, match="outer"):
        calibrate(outer=[(20, 20.02), (12, 12.021)], inner=[(10, 10.02), (6, 6.021)], correction=0.1, command=program)
    (tmp_path / "wedm.toml").write_text("side = 'punch'\n")
    with pytest.raises(WedmError, match="correction"):
        calibrate(outer=[(20, 20.02)], config=tmp_path / "wedm.toml", command=program)
