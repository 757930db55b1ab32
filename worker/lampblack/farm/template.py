"""Render settings as an OpenJD job template (version 2023-09) for render farms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import msgspec

from ..choices import FileFormat
from ..drawing.numbering import is_pattern
from ..drawing.sequence import frame_list
from ..errors import LampblackError
from ..finals.settings import RenderSettings
from .tasks import on_one_device

VERSION = "jobtemplate-2023-09"
FRAMES = "{{Task.Param.Frames}}"
_WRITTEN = tuple(f".{kind}" for kind in get_args(FileFormat))

_FILES = {"Scene": "scene", "DepthHints": "depth_hints", "Mask": "mask", "Ink": "ink"}
"""Parameters of a template that are files, and their fields in the settings."""


def job_template(
    settings: RenderSettings, tasks: Sequence[Sequence[int]], folder: Path
) -> dict[str, Any]:
    """The template: parameters for values that differ between machines, and a step whose tasks are
    ordinary ``lampblack render`` commands.

    Args:
        settings: has one input, absolute paths, and names its scene file.
        tasks: frame numbers of each task.
        folder: the template's folder. Paths in it are defaults of parameters; other paths must be
            given when the job is submitted (``paths_outside``).

    Raises:
        LampblackError: the extra ``farm`` is not installed, or the template is invalid.
    """
    paths = _paths(settings)
    parameters: list[dict[str, str]] = []
    named: dict[str, str] = {}
    for name, path in paths.items():
        parameters.append(_parameter(name, path, folder))
        named[name] = "{{Param." + name + "}}"
        if path.pattern:
            parameters.append(_text(f"{name}Names", path.pattern))
            named[name] += "/{{Param." + name + "Names}}"
    replaced: dict[str, Any] = {"inputs": (named["Input"],), "output": named["Output"]}
    replaced |= {field: named[name] for name, field in _FILES.items() if name in named}
    task = msgspec.structs.replace(on_one_device(settings), frames=FRAMES, **replaced)
    words = _unbraced(task.arguments(), (*named.values(), FRAMES), parameters)
    parameters.append(
        {"name": "Lampblack", "type": "STRING", "default": "lampblack",
         "description": "The command, on the machines that render."}
    )  # fmt: skip
    template = {
        "specificationVersion": VERSION,
        "name": _unmeant(f"Light {Path(settings.inputs[0]).name}"[:60]),
        "parameterDefinitions": parameters,
        "steps": [
            {
                "name": "Light",
                "parameterSpace": {
                    "taskParameterDefinitions": [
                        {"name": "Frames", "type": "STRING",
                         "range": [frame_list(task) for task in tasks]}
                    ]
                },
                "script": {
                    "actions": {
                        "onRun": {
                            "command": "{{Param.Lampblack}}",
                            "args": ["render", *words, "--allow-blank"],
                            "cancelation": {"mode": "NOTIFY_THEN_TERMINATE"},
                        }
                    }
                },
            }
        ],
    }  # fmt: skip
    _check(template)
    return template


def write_yaml(template: dict[str, Any]) -> bytes:
    """The template as YAML."""
    try:
        import yaml
    except ImportError as error:
        raise _not_installed() from error
    return bytes(yaml.safe_dump(template, sort_keys=False, allow_unicode=True, encoding="utf-8"))


def _not_installed() -> LampblackError:
    return LampblackError(
        "Job templates need a part of Lampblack that is not installed.",
        "Install it: pip install 'lampblack[farm]'.",
    )


def paths_outside(settings: RenderSettings, folder: Path) -> dict[str, Path]:
    """The parameters, by name, that have no default in a template in ``folder``."""
    return {
        name: path.file
        for name, path in _paths(settings).items()
        if not path.file.is_relative_to(folder)
    }


@dataclass(frozen=True)
class _Path:
    """A file or a folder, and the pattern of names in it, if there is one: a farm copies files and
    folders, and knows no patterns."""

    file: Path
    pattern: str = ""

    @staticmethod
    def of(path: str) -> _Path:
        whole = Path(path)
        if is_pattern(whole.name) and not whole.exists():
            return _Path(whole.parent, whole.name)
        return _Path(whole)

    @property
    def is_folder(self) -> bool:
        """Also of a folder that is still to be made."""
        is_file = self.file.is_file() or self.file.suffix.lower() in _WRITTEN
        return bool(self.pattern) or self.file.is_dir() or not is_file


def _paths(settings: RenderSettings) -> dict[str, _Path]:
    (source,) = settings.inputs
    paths: dict[str, str | None] = {"Input": source, "Output": settings.output}
    paths |= {name: getattr(settings, field) for name, field in _FILES.items()}
    if Path(source).suffix.lower() == ".pcl":
        paths["InputData"] = f"{source}.data"  # read beside it
    return {name: _Path.of(path) for name, path in paths.items() if path is not None}


def _parameter(name: str, path: _Path, folder: Path) -> dict[str, str]:
    parameter = {
        "name": name,
        "type": "PATH",
        "objectType": "DIRECTORY" if path.is_folder else "FILE",
        "dataFlow": "OUT" if name == "Output" else "IN",
    }
    if path.file.is_relative_to(folder):
        parameter["default"] = str(path.file.relative_to(folder))
    return parameter


def _text(name: str, text: str) -> dict[str, str]:
    return {"name": name, "type": "STRING", "default": text}


def _unbraced(
    words: Sequence[str], meant: Sequence[str], parameters: list[dict[str, str]]
) -> list[str]:
    """``words`` as arguments of a template, where ``{{`` begins an expression. A word that has it
    by itself becomes a parameter; ``meant`` are the expressions of our own."""
    found = []
    for word in words:
        rest = word
        for expression in meant:
            rest = rest.replace(expression, "")
        if "{{" in rest or "}}" in rest:
            name = f"Word{len(parameters)}"
            parameters.append(_text(name, word))
            word = "{{Param." + name + "}}"
        found.append(word)
    return found


def _unmeant(text: str) -> str:
    return text.replace("{{", "{ {").replace("}}", "} }")


def _check(template: dict[str, Any]) -> None:
    try:
        from openjd.model import DecodeValidationError, decode_job_template
    except ImportError as error:
        raise _not_installed() from error
    try:
        decode_job_template(template=template)
    except DecodeValidationError as error:
        raise LampblackError(
            "No valid job template can be made from these settings.",
            "Choose shorter names, or fewer frames.",
            str(error),
        ) from error
