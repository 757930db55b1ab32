"""Shots spread over tasks and machines: every frame made, each drawing once, losses survived."""

from __future__ import annotations

import shlex
import shutil
from pathlib import Path
from typing import Any

import msgspec
import pytest
import yaml
from openjd.model import (
    ParameterValue,
    ParameterValueType,
    create_job,
    decode_job_template,
)

from lampblack.cache import ArrayCache
from lampblack.drawing import parse_frames, save_picture
from lampblack.drawing.sequence import frame_list
from lampblack.errors import LampblackError
from lampblack.farm.cluster import _take_in, check_address, light_group
from lampblack.farm.tasks import MAX_TASKS, cut_into_tasks
from lampblack.finals.png import save_png
from lampblack.finals.render_shot import Outcome, RenderListener
from lampblack.finals.resolve import resolve_job
from lampblack.finals.settings import RenderSettings
from lampblack.finals.targets import Targets
from lampblack.finals.tasks import stamps
from lampblack.pipeline import Pipeline
from lampblack.scene import default_scene, encode_scene
from lampblack.shot import ShotFrame
from support.command_line import Run
from support.drawings import draw_ball
from support.projects import document, image, layer, png, walk, write_project


def test_tasks_hold_each_drawing_whole() -> None:
    frames = [ShotFrame(n, f"{n}.png", f"drawing {n % 5}") for n in range(1, 24)]
    tasks = cut_into_tasks(frames, 6)
    assert sorted(number for task in tasks for number in task) == list(range(1, 24))
    for drawing in range(5):
        holders = [task for task in tasks if any(number % 5 == drawing for number in task)]
        assert len(holders) == 1
    assert all(len(task) >= 6 for task in tasks[:-1])
    many = [ShotFrame(n, f"{n}.png", str(n)) for n in range(5000)]
    assert len(cut_into_tasks(many, 1)) <= MAX_TASKS
    with pytest.raises(LampblackError, match="no number"):
        cut_into_tasks([ShotFrame(None, "a.png", "")], 1)


@pytest.mark.parametrize("numbers", [[1], [1, 2, 3], [1, 3, 4, 9], list(range(0, 99, 2))])
def test_frame_lists_are_read_back(numbers: list[int]) -> None:
    assert parse_frames(frame_list(numbers)) == numbers


def test_a_job_names_each_drawing_in_one_task(run: Run, tmp_path: Path) -> None:
    project, target = walk(tmp_path, [1, 2, 1, 2, 3, 3, 1]), tmp_path / "job.yaml"
    words = ("--to", tmp_path / "lit.%04d.exr", "--quality", "final", "--frames-per-task", 1)
    assert run("job", project, "-o", target, *words).code == 0
    template = yaml.safe_load(target.read_text())
    decode_job_template(template=template)
    (step,) = template["steps"]
    (frames,) = step["parameterSpace"]["taskParameterDefinitions"]
    assert frames["range"] == ["1,3,7", "2,4", "5-6"]
    defaults = {p["name"]: p.get("default") for p in template["parameterDefinitions"]}
    assert defaults["Input"] == "walk.pclx"
    assert (defaults["Output"], defaults["OutputNames"]) == (".", "lit.%04d.exr")
    (tmp_path / "elsewhere").mkdir()
    told = run("job", project, "-o", tmp_path / "elsewhere" / "job.yaml", *words)
    assert f"-p Input={project} -p Output={tmp_path}" in told.err
    assert "--quality=final" in step["script"]["actions"]["onRun"]["args"]


def test_a_job_names_files_and_folders_that_exist(run: Run, tmp_path: Path) -> None:
    """Farms copy what its parameters of type PATH name, and know no patterns."""
    (tmp_path / "seq").mkdir()
    for number in (1, 2):
        save_picture(tmp_path / "seq" / f"w.{number:04d}.png", draw_ball(64))
    words = ("-o", tmp_path / "job.yaml", "--to", tmp_path / "lit.v2")
    for source in ("seq", "seq/w.%04d.png", "seq/w.0001.png"):
        assert run("job", tmp_path / source, *words).code == 0
        template = yaml.safe_load((tmp_path / "job.yaml").read_text())
        paths = {
            p["name"]: (p["objectType"], p["default"])
            for p in template["parameterDefinitions"]
            if p["type"] == "PATH"
        }
        single = source.endswith("1.png")
        assert paths["Input"] == (("FILE", source) if single else ("DIRECTORY", "seq"))
        assert paths["Output"] == ("DIRECTORY", "lit.v2")
    (step,) = template["steps"]
    assert "{{Param.Input}}" in step["script"]["actions"]["onRun"]["args"]


def collected(template: Path) -> set[str]:
    """The files that a farm copies: as AWS Deadline Cloud collects attachments of a job."""
    found: set[Path] = set()
    for parameter in yaml.safe_load(template.read_text())["parameterDefinitions"]:
        if parameter["type"] == "PATH" and "IN" in parameter["dataFlow"]:
            path = template.parent / parameter["default"]
            is_file = parameter["objectType"] == "FILE"
            assert path.is_file() if is_file else path.is_dir()
            found |= {path} if is_file else {one for one in path.rglob("*") if one.is_file()}
    return {str(path.relative_to(template.parent)) for path in found}


@pytest.mark.parametrize("kind", ["pclx", "pcl", "pictures"])
def test_a_farm_gets_every_file_that_is_read(run: Run, tmp_path: Path, kind: str) -> None:
    """Also those that lie beside a project."""
    wanted, words = {f"w.{kind}", f"w.{kind}.lampblack.json"}, []
    source = tmp_path / f"w.{kind}"
    if kind == "pictures":
        source = tmp_path / "seq" / "w.%04d.png"
        source.parent.mkdir()
        wanted = {"seq/w.0001.png", "mask.png", "ink.png", "light.json"}
        for name in wanted - {"light.json"}:
            save_picture(tmp_path / name, draw_ball(64))
        words = [f"--{name}={tmp_path / name}.png" for name in ("mask", "ink")]
        words.append(f"--scene={tmp_path / 'light.json'}")
    else:
        xml = document([layer(2, "ball", [image(1, "1.png", -40, -40)])], size=(96, 96))
        write_project(source, xml, {"1.png": png(draw_ball(80))})
        wanted |= {"w.pcl.data/1.png"} if kind == "pcl" else set()
    scene = tmp_path / ("light.json" if kind == "pictures" else f"{source.name}.lampblack.json")
    scene.write_bytes(encode_scene(default_scene(96, 96)))
    assert run("job", source, "-o", tmp_path / "job.yaml", *words).code == 0
    assert collected(tmp_path / "job.yaml") == wanted


def test_braces_in_names_are_only_names(run: Run, tmp_path: Path) -> None:
    project = walk(tmp_path, [1]).rename(tmp_path / "walk {{v2}}.pclx")
    words = ("--background", "{{Param.Lampblack}}")
    assert run("job", project, "-o", tmp_path / "job.yaml", *words).code == 0
    template = yaml.safe_load((tmp_path / "job.yaml").read_text())
    job = create_job(
        job_template=decode_job_template(template=template), job_parameter_values={
            "Input": ParameterValue(type=ParameterValueType.PATH, value=str(project)),
            "Output": ParameterValue(type=ParameterValueType.PATH, value="lit"),
        } | {
            p["name"]: ParameterValue(type=ParameterValueType.STRING, value=p["default"])
            for p in template["parameterDefinitions"] if p["type"] == "STRING"
        },
    )  # fmt: skip
    assert "{ {v2} }" in job.name
    values = {name: each.value for name, each in job.parameters.items()}
    assert "--background={{Param.Lampblack}}" in values.values()


def test_the_command_to_try_is_quoted(run: Run, tmp_path: Path) -> None:
    """It may be pasted into a shell, whatever the names in it are."""
    output = tmp_path / "x;touch made '$(id)"
    template = tmp_path / "elsewhere" / "job.yaml"
    template.parent.mkdir()
    printed = run("job", walk(tmp_path, [1]), "-o", template, "--to", output)
    (line,) = [line for line in printed.err.splitlines() if "Try it here: " in line]
    words = shlex.split(line.partition("Try it here: ")[2])
    assert f"Output={output.absolute()}" in words


def test_jobs_that_cannot_be_are_told(run: Run, tmp_path: Path, ball_png: Path) -> None:
    project, target = walk(tmp_path, [1]), tmp_path / "job.yaml"
    assert run("job", project, "-o", tmp_path / "job.txt").code == 1
    assert run("job", tmp_path / "none.pclx", "-o", target).code == 1
    assert run("job", ball_png, "-o", target).code == 1  # no number
    assert run("job", project, "-o", target, "--frames", "5").code == 1
    assert not target.exists()


@pytest.mark.parametrize(
    "address", ["tcp://scheduler:8786", "tcp://10.0.0.7:1", "scheduler:8786", "ws://a:1", ""]
)
def test_clusters_without_tls_are_refused(address: str) -> None:
    with pytest.raises(LampblackError, match="TLS"):
        check_address(address)


@pytest.mark.parametrize("address", ["tls://scheduler:8786", "tcp://127.0.0.1:1", "tcp://[::1]:1"])
def test_clusters_over_tls_or_on_this_machine_are_not(address: str) -> None:
    check_address(address)


def test_a_worker_notices_drawings_that_change_between_two_runs(
    tmp_path: Path, unrendered: list[str]
) -> None:
    save_picture(tmp_path / "a.0001.png", draw_ball(64))
    settings = RenderSettings(inputs=(str(tmp_path / "a.0001.png"),), output=str(tmp_path / "lit"))
    settings_json = msgspec.json.encode(settings)
    assert light_group(settings_json, "first", ["a.0001.png"]) == [("a.0001.png", "done", [])]
    assert light_group(settings_json, "first", ["a.0001.png"]) == [("a.0001.png", "kept", [])]
    save_picture(tmp_path / "a.0001.png", draw_ball(64, (60, 120, 220)))
    assert light_group(settings_json, "second", ["a.0001.png"]) == [("a.0001.png", "done", [])]
    (tmp_path / "a.0001.png").write_text("no picture")
    ((_, became, words),) = light_group(settings_json, "third", ["a.0001.png"])
    assert became == "failed"
    assert "not a picture" in words[0]


def test_a_cluster_that_is_not_there_is_told(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lampblack.farm.cluster.CONNECT_SECONDS", 0.5)
    save_picture(tmp_path / "a.0001.png", draw_ball(64))
    words = ("--cluster", "tcp://127.0.0.1:9")
    told = run("render", tmp_path / "a.0001.png", "-o", tmp_path / "lit", *words)
    assert told.code == 1
    assert "no cluster" in told.err


class Answer:
    """What came back from a machine."""

    def __init__(self, said: object) -> None:
        self.said = said

    def result(self) -> object:
        if isinstance(self.said, Exception):
            raise self.said
        return self.said


def now(frame: ShotFrame) -> str:
    return "now"


@pytest.mark.parametrize(
    "said",
    [
        [("1.png", "done", [])],
        [("1.png", "done", []), ("7.png", "done", [])],
        [("1.png", "done", []), ("1.png", "done", [])],
        [("1.png", "done", []), ("2.png", "done", [])],  # its file is not there
        [("1.png", "done", []), ("3.png", "kept", [])],  # its file is cut short
        [("1.png", "perfect", []), ("2.png", "failed", ["why"])],
        [("1.png", "done", ["why"]), ("2.png", "failed", ["why"])],
        [("1.png", "done", []), ("2.png", "failed", [])],
        [("1.png", "done", []), ("2.png", "failed", ["x"] * 9 + [7])],
        "1.png", None, {"1.png": "done"}, 5, OSError("gone"),
    ],
)  # fmt: skip
def test_a_machine_that_lies_is_not_believed(tmp_path: Path, said: Any) -> None:
    save_png(tmp_path / "1.png", draw_ball(20), "now")
    save_png(tmp_path / "3.png", draw_ball(20), "now")
    (tmp_path / "3.png").write_bytes((tmp_path / "3.png").read_bytes()[:-9])
    second = 3 if "3.png" in str(said) else 2
    group = [ShotFrame(n, f"{n}.png", str(n)) for n in (1, second)]
    outcome = Outcome()
    _take_in(outcome, group, Answer(said), RenderListener(), Targets(str(tmp_path)), now)
    assert [frame.number for frame, _ in outcome.failed] == [1, second]
    assert not outcome.done


def test_a_machine_that_says_what_is_so_is_believed(tmp_path: Path) -> None:
    save_png(tmp_path / "1.png", draw_ball(20), "now")
    group = [ShotFrame(n, f"{n}.png", str(n)) for n in (1, 2)]
    outcome = Outcome()
    said = [("2.png", "failed", ["What.", "Do.", "details"]), ("1.png", "done", [])]
    _take_in(outcome, group, Answer(said), RenderListener(), Targets(str(tmp_path)), now)
    assert outcome.done == [group[0]]
    ((frame, error),) = outcome.failed
    assert (frame, error.what, error.remedy) == (group[1], "What.", "Do.")


def test_a_machine_that_returns_another_frame_is_not_believed(tmp_path: Path) -> None:
    for number in (1, 2):
        save_picture(tmp_path / f"{number}.png", draw_ball(20 + number, canvas=24))
    job = resolve_job(RenderSettings(inputs=(str(tmp_path),), output=str(tmp_path / "lit")))
    first, second = job.frames
    with Pipeline(ArrayCache(tmp_path / "cache")) as pipeline:
        stamp = stamps(job, pipeline)
        assert stamp(first) == stamp(first) != stamp(second)
        for frame in job.frames:
            save_png(job.targets.path(frame), draw_ball(20), stamp(frame))

        def believed(*frames: ShotFrame) -> list[ShotFrame]:
            outcome, said = Outcome(), [(frame.name, "done", []) for frame in frames]
            _take_in(outcome, [*frames], Answer(said), RenderListener(), job.targets, stamp)
            return outcome.done

        assert believed(first) == [first]
        shutil.copy(job.targets.path(second), job.targets.path(first))
        assert believed(first) == []
        assert believed(second) == [second]
