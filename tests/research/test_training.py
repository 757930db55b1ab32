"""The trainer: batches, budget, checkpoints and what it refuses."""

from __future__ import annotations

import itertools
import json
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import psutil
import pytest
import torch
import trimesh
from numpy.typing import NDArray
from PIL import Image

from lampblack.errors import LampblackError
from lampblack.normals.card import NetworkCard, load_network, save_network
from lampblack.normals.character import LUMO
from lampblack.normals.networks import build_network
from lampblack_research.dataset.build import DatasetOptions, build_dataset
from lampblack_research.dataset.triple import Triple
from lampblack_research.training.character_batches import (
    CharacterBatches,
    input_and_truth,
    place_on_canvas,
)
from lampblack_research.training.character_loss import (
    Batch,
    angles,
    bend_loss,
    bends,
    mark_loss,
    pair_losses,
)
from lampblack_research.training.checkpoint import Progress
from lampblack_research.training.curve import SIZE
from lampblack_research.training.hint_strokes import bent_cells, random_hints
from lampblack_research.training.normalisation import recompute_statistics
from lampblack_research.training.tile_batches import normal_loss, view_of
from lampblack_research.training.train import TrainingOptions, train


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A data set of two models, which no test changes."""
    models, folder = tmp_path_factory.mktemp("models"), tmp_path_factory.mktemp("data")
    trimesh.creation.icosphere(subdivisions=3).export(models / "ball.ply")
    trimesh.creation.capsule(radius=0.4).export(models / "pill.obj")
    build_dataset(
        models, folder, None, DatasetOptions(views=2, resolution=96, hands=2, freestyle=0)
    )
    return folder


def one_triple(data: Path) -> Triple:
    return Triple.load(sorted(data.rglob("*.npz"))[0])


def test_tiles_mirror_the_normals_with_the_drawing(data: Path) -> None:
    view = view_of(one_triple(data), np.random.default_rng(0))
    for seed in range(6):
        tile, truth = view.tile(np.random.default_rng(seed))
        inside = tile[3] > 0
        lengths = np.linalg.norm(truth, axis=0)
        assert np.allclose(lengths[inside], 1, atol=0.02)
        assert not lengths[~inside].any()
        # Outwards is outwards: on the whole the normal's x grows with the pixel's x.
        _rows, columns = np.nonzero(inside)
        assert np.corrcoef(columns, truth[0][inside])[0, 1] > 0.3


def test_the_loss_of_depth_order_prefers_the_right_side_in_front() -> None:
    """Two plates, the right one nearer by 0.1 sides of the canvas."""
    truth = torch.zeros(1, 8, 8)
    truth[..., 4:] = 0.1
    inside = torch.ones(1, 8, 8, dtype=torch.bool)
    right = [float(loss) for loss in pair_losses(truth + 3.0, truth, inside)]
    flat = [float(loss) for loss in pair_losses(torch.zeros_like(truth), truth, inside)]
    wrong = [float(loss) for loss in pair_losses(-truth, truth, inside)]
    assert right[0] == pytest.approx(0, abs=1e-6)
    assert right[1] < 0.01 < flat[1] < wrong[1]
    assert right[0] < flat[0] < wrong[0]
    # Of a plane there is no order, and nothing outside the character counts.
    plane = torch.linspace(0, 0.05, 8).expand(1, 8, 8)
    assert float(pair_losses(-plane, plane, inside)[1]) == 0
    inside[..., 4:] = False
    assert pair_losses(-truth, truth, inside)[0] == 0


def dome(side: int, sign: int) -> NDArray[np.float32]:
    """(side, side, 3) normals of a dome as wide as the canvas, or of a bowl."""
    y, x = (np.indices((side, side), np.float32) + 0.5) / side * 2 - 1
    normals = np.dstack([sign * x / 2, -sign * y / 2, np.sqrt(1 - (x * x + y * y) / 4)])
    return normals.astype(np.float32)


def test_bends_of_a_dome_and_of_a_bowl_have_their_closed_form() -> None:
    found, truth = (
        torch.from_numpy(np.stack([dome(64, sign).transpose(2, 0, 1)])) for sign in (1, -1)
    )
    # The normal's x is x / 2 over a half side of 1, so per side it is 1; y alike.
    assert bends(found, 64.0)[0, 2:-2, 2:-2].numpy() == pytest.approx(2.0, abs=1e-4)
    assert bends(truth, 64.0)[0, 2:-2, 2:-2].numpy() == pytest.approx(-2.0, abs=1e-4)
    mask = torch.zeros(1, 64, 64)
    mask[:, 4:-4, 4:-4] = 1
    right, wrong = float(bend_loss(truth, truth, mask)), float(bend_loss(found, truth, mask))
    assert right == pytest.approx(np.log1p(np.exp(-2)), abs=0.02)
    assert wrong == pytest.approx(np.log1p(np.exp(2)), abs=0.02)


def test_hints_lie_where_the_surface_bends_as_they_say() -> None:
    normals = np.concatenate([dome(64, 1), dome(64, -1)], axis=1)
    bent = bent_cells(normals, np.ones((64, 128), bool))
    assert set(np.unique(bent[2:-2, 2:12])) == {1}
    assert set(np.unique(bent[2:-2, -12:-2])) == {-1}
    seen = set()
    for seed in range(20):
        hints = random_hints(bent, np.random.default_rng(seed))
        assert (np.sign(hints) == bent)[hints != 0].all()
        assert 0 < np.count_nonzero(hints) < 0.5 * hints.size
        seen |= set(np.unique(np.sign(hints)))
    assert seen == {-1, 0, 1}


def test_only_cells_with_ink_teach_what_a_mark_is() -> None:
    truth = torch.full((1, 4, 4), -1.0)
    truth[0, 0], truth[0, 1] = 0, 1
    right = torch.where(truth > 0, 9.0, -9.0)
    elsewhere = torch.where(truth < 0, 50.0, right)
    assert float(mark_loss(right, truth)) == pytest.approx(0, abs=1e-3)
    assert float(mark_loss(elsewhere, truth)) == float(mark_loss(right, truth))
    assert float(mark_loss(-right, truth)) == pytest.approx((9 + 3 * 9) / 2, abs=1e-2)
    assert float(mark_loss(right, torch.full((1, 4, 4), -1.0))) == 0


def test_marks_are_told_from_lines_by_cell(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lampblack_research.training.character_batches.MARKED", 1.0)
    triple = one_triple(data)
    found = 0
    for seed in range(6):
        character = place_on_canvas(triple, np.random.default_rng(seed), [128])
        for ink, kinds in zip(character.inks, character.marks, strict=True):
            drawn = by_cell((ink > 0).astype(np.float32)) > 0
            assert drawn[kinds >= 0].all()
            found += np.count_nonzero(kinds == 1)
        *_, truth = input_and_truth(character, np.random.default_rng(seed))
        assert truth.shape[0] == 4
    assert found > 50


def test_whole_characters_mirror_every_map_with_the_drawing(data: Path) -> None:
    character = place_on_canvas(one_triple(data), np.random.default_rng(0), [96])
    for seed in range(6):
        fine, coarse, truth, auxiliary = input_and_truth(character, np.random.default_rng(seed))
        inside = fine[1] > 0
        assert np.allclose(np.linalg.norm(truth, axis=0)[inside], 1, atol=0.02)
        cells = by_cell(inside) > 0.9
        _rows, columns = np.nonzero(cells)
        # Lumo's x, the distance's fall and the place follow the truth's x, mirrored or not.
        outwards = by_cell(truth[0])[cells]
        assert np.corrcoef(columns, outwards)[0, 1] > 0.3
        assert np.corrcoef(coarse[LUMO][0][cells], outwards)[0, 1] > 0.7
        assert np.corrcoef(coarse[4][cells], outwards)[0, 1] < -0.3
        assert np.corrcoef(coarse[8][cells], outwards)[0, 1] > 0.7
        assert np.corrcoef(auxiliary[0][cells], by_cell(truth[2])[cells])[0, 1] > 0.7


def by_cell(plane: NDArray[np.float32]) -> NDArray[np.float32]:
    """Means over cells of 4 x 4 pixels."""
    rows, columns = plane.shape
    means: NDArray[np.float32] = plane.reshape(rows // 4, 4, columns // 4, 4).mean((1, 3))
    return means


def test_angles_are_angles() -> None:
    a = torch.nn.functional.normalize(torch.randn(2, 3, 5, 5), dim=1)
    b = torch.nn.functional.normalize(torch.randn(2, 3, 5, 5), dim=1)
    assert torch.allclose(angles(a, b), (a * b).sum(dim=1).acos(), atol=2e-2)
    assert angles(a, a).max() < 2e-3


def test_batches_of_large_canvases_are_smaller(data: Path) -> None:
    seen = {}
    with CharacterBatches(data, (64, 384), seed=0, capacity=8) as batches:
        for _ in range(40):
            fine = batches._batch(9).fine
            seen[fine.shape[2] * fine.shape[3]] = len(fine)
    areas = sorted(seen)
    assert areas[-1] > 20 * areas[0]
    assert seen[areas[0]] == 9
    assert seen[areas[-1]] == 4


def test_the_loader_of_a_killed_run_ends(data: Path) -> None:
    program = (
        "import sys, time; from pathlib import Path\n"
        "from lampblack_research.training.character_batches import CharacterBatches\n"
        "if __name__ == '__main__':\n"
        "    with CharacterBatches(Path(sys.argv[1]), (64,), 0, 4) as batches:\n"
        "        batches._batch(1)\n"
        "        print(batches._stream._loader.pid, flush=True)\n"
        "        time.sleep(60)\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", program, str(data)], stdout=subprocess.PIPE, text=True
    ) as run:
        assert run.stdout is not None
        loader = int(run.stdout.readline())
        run.kill()
    for _ in range(200):
        if not psutil.pid_exists(loader) or psutil.Process(loader).status() == "zombie":
            return
        time.sleep(0.1)
    pytest.fail("The loader outlived its run.")


class Enough(Exception):
    """Ends a run from its report."""


def test_training_continues_where_it_was_stopped(data: Path, tmp_path: Path) -> None:
    run = tmp_path / "run"
    steps: list[int] = []

    def stop_every_second(progress: Progress) -> None:
        steps.append(progress.step)
        if progress.step % 2 == 0:
            raise Enough

    card = NetworkCard("figure-net", (64, 96))
    options = TrainingOptions(batch=2, sides=(64, 96), first_side=64, capacity=4)
    for _ in range(2):
        with pytest.raises(Enough):
            train(data, run, card, options, stop_every_second)
    assert steps == [1, 2, 3, 4]
    _, kept = load_network(run / "network.safetensors")
    assert kept.training is not None
    assert kept.training["steps"] == 4
    other = NetworkCard("strided-unet")
    with pytest.raises(LampblackError, match="another network"):
        train(data, run, other, TrainingOptions())


def test_a_run_without_initial_weights_starts_on_small_canvases(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seconds = itertools.count()
    clock = SimpleNamespace(process_time=lambda: next(seconds), monotonic=time.monotonic)
    monkeypatch.setattr("lampblack_research.training.train.time", clock)
    widest: list[int] = []
    batch_of = CharacterBatches._batch

    def seen(batches: CharacterBatches, size: int) -> Batch:
        batch = batch_of(batches, size)
        widest.append(max(batch.fine.shape[2:]))
        return batch

    monkeypatch.setattr(CharacterBatches, "_batch", seen)
    monkeypatch.setattr("lampblack_research.training.train.STATISTICS_ROUNDS", 0)
    monkeypatch.setattr("lampblack_research.training.train.EXAMPLES", 1)
    options = TrainingOptions(minutes=0.1, batch=1, sides=(160,), first_side=64, capacity=2)
    card = NetworkCard("figure-net", (64, 96))
    begun = train(data, tmp_path / "run", card, options)
    # Six steps of a second: two fifths of the time is three, and a look at the end of each part.
    assert [width < 160 for width in widest] == 4 * [True] + 4 * [False]
    _, kept = load_network(begun)
    assert kept.training is not None
    assert kept.training["canvas_sides"] == [[64], [160]]
    widest.clear()
    train(data, tmp_path / "later", card, options, init_from=[begun])
    assert min(widest) >= 160


def test_a_run_writes_its_log_its_curve_and_examples(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lampblack_research.training.train.LOG_STEPS", 2)
    run = tmp_path / "run"
    card = NetworkCard("figure-net", (64, 96))

    def stop(progress: Progress) -> None:
        if progress.step % 2 == 0:
            raise Enough

    options = TrainingOptions(batch=1, sides=(64,), first_side=64, capacity=4)
    for _ in range(2):
        with pytest.raises(Enough):
            train(data, run, card, options, stop)
        with Image.open(run / "curve.png") as curve, Image.open(run / "examples.png") as examples:
            assert curve.size == SIZE
            assert examples.height > 3 * 64
    lines = (run / "log.jsonl").read_text().splitlines()
    logged = [json.loads(line) for line in lines]
    assert [row["step"] for row in logged] == [2, 4]
    assert 0 < logged[0]["seconds"] < logged[1]["seconds"]


def test_a_run_starts_from_the_mean_of_given_weights(data: Path, tmp_path: Path) -> None:
    torch.manual_seed(5)
    card = NetworkCard("figure-net", (64, 96))
    networks = [build_network("figure-net") for _ in range(3)]
    given = [tmp_path / f"{number}.safetensors" for number in range(3)]
    for path, network in zip(given, networks, strict=True):
        save_network(path, network, card)

    def stop(progress: Progress) -> None:
        raise Enough

    options = TrainingOptions(batch=1, sides=(64,), first_side=64, capacity=1, rate=0.0)
    with pytest.raises(Enough):
        train(data, tmp_path / "run", card, options, stop, given)
    begun, _ = load_network(tmp_path / "run" / "network.safetensors")
    for *old, new in zip(*(n.parameters() for n in [*networks, begun]), strict=True):
        assert torch.allclose(sum(old) / 3, new, atol=1e-3)
    with pytest.raises(LampblackError, match="figure-net"):
        train(data, tmp_path / "other", NetworkCard("dilated-unet"), options, stop, given)


def test_statistics_are_those_of_the_weights_themselves() -> None:
    torch.manual_seed(0)
    network = torch.nn.Sequential(torch.nn.Conv2d(1, 2, 1), torch.nn.BatchNorm2d(2)).eval()
    shown = [torch.randn(4, 1, 8, 8) * 3 + 1 for _ in range(10)]
    batches = iter(shown)
    recompute_statistics(network, lambda: network(next(batches)), 10)
    assert not network.training
    kept = network[1].state_dict()
    with torch.no_grad():
        seen = network[0](torch.cat(shown))
    assert torch.allclose(kept["running_mean"], seen.mean((0, 2, 3)), atol=1e-4)
    assert torch.allclose(kept["running_var"], seen.var((0, 2, 3)), rtol=0.05)


@pytest.mark.parametrize("architecture", ["dilated-unet", "strided-unet"])
def test_networks_of_tiles_share_the_trainer(data: Path, tmp_path: Path, architecture: str) -> None:
    def stop(progress: Progress) -> None:
        raise Enough

    options = TrainingOptions(batch=1, capacity=1)
    with pytest.raises(Enough):
        train(data, tmp_path / "run", NetworkCard(architecture), options, stop)
    _, kept = load_network(tmp_path / "run" / "network.safetensors")
    assert kept.architecture == architecture


def test_unusable_data_and_run_folders_are_errors(data: Path, tmp_path: Path) -> None:
    with pytest.raises(LampblackError, match="dataset build"):
        train(tmp_path / "nowhere", tmp_path / "run", NetworkCard(), TrainingOptions())
    (tmp_path / "file").write_text("")
    with pytest.raises(LampblackError):
        train(data, tmp_path / "file" / "run", NetworkCard(), TrainingOptions())
    (tmp_path / "run" / "checkpoint.safetensors").write_bytes(b"junk")
    with pytest.raises(LampblackError, match="damaged"):
        train(data, tmp_path / "run", NetworkCard(), TrainingOptions())


def test_loss_is_one_minus_cosine_for_unit_normals() -> None:
    a = torch.nn.functional.normalize(torch.randn(1, 3, 8, 8), dim=1)
    b = torch.nn.functional.normalize(torch.randn(1, 3, 8, 8), dim=1)
    mask = torch.zeros(1, 1, 8, 8)
    mask[..., :4] = 1
    expected = (1 - (a * b).sum(dim=1))[..., :4].mean()
    assert normal_loss(a, b, mask).item() == pytest.approx(expected.item(), rel=1e-5)
