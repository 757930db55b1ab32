"""Measures and peers, against closed forms."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from shapes import angles, ball

from lampblack.errors import LampblackError
from lampblack.normals.silhouette import flat_normals, lumo_normals
from lampblack_research.evaluation.depth_meter import CEILINGS, TRUE_DEPTH, TRUE_NORMALS
from lampblack_research.evaluation.drawings import drawings
from lampblack_research.evaluation.evaluate import PEERS, evaluate
from lampblack_research.evaluation.laigter import laigter_normals
from lampblack_research.evaluation.lumo_mixed import lumo_mixed_normals
from lampblack_research.evaluation.metrics import bootstrap, means, measure
from lampblack_research.evaluation.surfaces import NetworkMethod
from support.command_line import Run


def test_the_truth_has_no_error_and_flat_has_its_own() -> None:
    mask, truth = ball(200, 80.0)
    right = measure(truth, truth, mask)
    assert right.mean < 0.1
    assert right.l1 == right.l2 == 0
    assert right.under_11 == right.curvature == 100
    assert right.tilt == right.truth_tilt == pytest.approx(45, abs=0.5)
    flat = measure(flat_normals(mask), truth, mask)
    assert flat.mean == pytest.approx(right.truth_tilt, abs=0.1)
    assert flat.tilt == pytest.approx(0, abs=0.1)
    assert flat.rim == pytest.approx(90, abs=0.1)
    assert right.rim < 20


def test_a_dent_has_the_wrong_curvature() -> None:
    mask, truth = ball(200, 80.0)
    dent = (truth * [-1, -1, 1]).astype(np.float32)
    assert measure(dent, truth, mask).curvature < 5
    assert measure(truth, dent, mask).concave < 5
    assert measure(dent, dent, mask).concave == 100
    assert np.isnan(measure(dent, truth, mask).concave)


def test_means_leave_out_drawings_without_hollows() -> None:
    mask, truth = ball(120, 50.0)
    dent = (truth * [-1, -1, 1]).astype(np.float32)
    rows = [measure(dent, dent, mask), measure(truth, truth, mask)]
    assert means(rows)["concave"] == 100
    assert np.isnan(means(rows[1:])["concave"])


def test_tuned_bevel_makes_a_disk_round_and_inflates_regions() -> None:
    mask, truth = ball(300, 120.0)
    tuned = angles(laigter_normals(mask, None), truth)[mask].mean()
    assert tuned < 12 < angles(laigter_normals(mask), truth)[mask].mean()
    lines = np.zeros(mask.shape, np.float32)
    lines[:, 149:151] = 1
    mixed = lumo_mixed_normals(lines * mask, mask, weight=1.0)
    left, right = mixed[150, 140], mixed[150, 160]
    assert left[0] > 0.7 and right[0] < -0.7  # noqa: PT018  # a seam between two halves
    assert np.array_equal(lumo_mixed_normals(lines * 0, mask), lumo_normals(mask))


def test_bootstrap_tells_a_sure_gain_from_a_chance() -> None:
    models = [f"m{i // 4}" for i in range(40)]
    rng = np.random.default_rng(0)
    theirs = rng.uniform(20, 30, 40)
    low, high = bootstrap(list(theirs * 0.8), list(theirs), models)
    assert low == pytest.approx(0.2)
    assert high == pytest.approx(0.2)
    low, high = bootstrap(list(rng.permutation(theirs)), list(theirs), models)
    assert low < 0 < high


def test_every_method_is_measured_on_the_same_drawings(tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=3).export(tmp_path / "ball.ply")
    table = evaluate(tmp_path, None, dict(PEERS), views=2, character_px=120)
    assert set(table) == set(PEERS)
    assert table["lumo"]["mean"] < 8 < table["flat"]["mean"]
    assert len({row["truth_tilt"] for row in table.values()}) == 1
    assert table["lumo"]["first_is_better_percent"] < 0


def test_depth_adds_columns_and_the_rows_of_its_ceilings(tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=3).export(tmp_path / "ball.ply")
    methods = {"lumo": PEERS["lumo"], "flat": PEERS["flat"]}
    table = evaluate(tmp_path, None, methods, views=2, character_px=120, most=1, depth=True)
    assert set(table) == {"lumo", "flat", *CEILINGS}
    assert table[TRUE_DEPTH]["false"] == table[TRUE_DEPTH]["rmse"] == 0
    assert table[TRUE_NORMALS]["rmse"] < table["lumo"]["rmse"] < table["flat"]["rmse"]
    assert table["flat"]["height_angle"] > 30
    assert "mean" in table["flat"]
    assert "mean" not in table[TRUE_DEPTH]
    with pytest.raises(LampblackError, match="4000 pixels"):
        evaluate(tmp_path, None, methods, character_px=4000, depth=True)


def test_some_of_the_drawings_vary_in_model_and_side(tmp_path: Path) -> None:
    for name in "abcd":
        trimesh.creation.box().export(tmp_path / f"{name}.ply")
    paths = sorted(tmp_path.iterdir())
    every = list(drawings(paths, 4, 64, "gbuffer"))
    some = list(drawings(paths, 4, 64, "gbuffer", most=4))
    assert len(every) == 16
    assert len({drawing.model for drawing in some}) == 4
    assert all(any(np.array_equal(a.lines, b.lines) for b in every) for a in some)
    assert len({drawing.mask.shape for drawing in some}) > 1
    assert np.array_equal(np.isfinite(some[0].depth), some[0].mask)


def test_command_writes_the_figures_of_depth_too(run: Run, tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=3).export(tmp_path / "ball.ply")
    models = ["--models", tmp_path, "--split", "all", "--methods", "lumo,flat"]
    small = ["--lines", "gbuffer", "--views", 1, "--resolution", 96]
    found = tmp_path / "found.json"
    outcome = run("evaluate", *models, *small, "--depth", "--marks", "--json", found)
    assert outcome.code == 0
    rows = json.loads(found.read_text())
    assert set(rows) == {"lumo", "flat", *CEILINGS}
    assert rows["flat"]["marks_cut"] == rows["flat"]["marks_rise"] == 0
    for column in ("recovered", "shadow_recall", "spots_cut"):
        assert column in rows["lumo"]
    assert run("evaluate", *models, *small, "--marks").code == 1


def test_clicks_are_measured_for_networks_in_a_row_of_their_own(tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=3).export(tmp_path / "ball.ply")
    methods = {"lampblack": NetworkMethod(None), "flat": PEERS["flat"]}
    table = evaluate(tmp_path, None, methods, views=1, character_px=120, depth=True, clicks=True)
    assert set(table) == {*methods, "lampblack, one click", *CEILINGS}
    rmse = (table[name]["rmse"] for name in ("lampblack", "lampblack, one click"))
    assert next(rmse) == pytest.approx(next(rmse), rel=0.05)
