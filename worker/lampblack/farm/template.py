"""Render settings as an OpenJD job template (version 2023-09) for render farms."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from ..drawing.sequence import frame_list
from ..errors import LampblackError
from ..finals.settings import RenderSettings

VERSION = "jobtemplate-2023-09"

_FILES = {"Scene": "scene", "DepthHints": "depth_hints", "Mask": "mask", "Ink": "ink"}
"""Parameters of a template that are files, and their fields in the settings."""


def job_template(
    settings: RenderSettings, tasks: Sequence[Sequence[int]], folder: Path
) -> dict[str, Any]:
    """The template: parameters for values that differ between machines, and a step whose tasks are
    ordinary ``lampblack render`` commands.

    Args:
        settings: has one input, and absolute paths.
        tasks: frame numbers of each task.
        folder: the template's folder. Paths in it are defaults of parameters; other paths must be
            given when the job is submitted (``paths_outside``).

    Raises:
        LampblackError: the extra ``farm`` is not installed, or the template is invalid.
    """
    paths = _paths(settings)
    parameters = [_parameter(name, path, folder) for name, path in paths.items()]
    named = {name: "{{Param." + name + "}}" for name in paths}
    replaced: dict[str, Any] = {"inputs": (named["Input"],), "output": named["Output"]}
    replaced |= {field: named[name] for name, field in _FILES.items() if name in named}
    task = msgspec.structs.replace(settings, frames="{{Task.Param.Frames}}", **replaced)
    parameters.append(
        {"name": "Lampblack", "type": "STRING", "default": "lampblack",
         "description": "The command, on the machines that render."}
    )  # fmt: skip
    template = {
        "specificationVersion": VERSION,
        "name": f"Light {paths['Input'].name}"[:64],
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
                            "args": ["render", *task.arguments(), "--allow-blank"],
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
        name: path for name, path in _paths(settings).items() if not path.is_relative_to(folder)
    }


def _paths(settings: RenderSettings) -> dict[str, Path]:
    (source,) = settings.inputs
    paths: dict[str, str | None] = {"Input": source, "Output": settings.output}
    paths |= {name: getattr(settings, field) for name, field in _FILES.items()}
    return {name: Path(path) for name, path in paths.items() if path is not None}


def _parameter(name: str, path: Path, folder: Path) -> dict[str, str]:
    parameter = {
        "name": name,
        "type": "PATH",
        "objectType": "DIRECTORY" if path.is_dir() else "FILE",
        "dataFlow": "OUT" if name == "Output" else "IN",
    }
    if path.is_relative_to(folder):
        parameter["default"] = str(path.relative_to(folder))
    return parameter


def _check(template: dict[str, Any]) -> None:
    try:
        from openjd.model import DecodeValidationError, decode_job_template
    except ImportError as error:
        raise _not_installed() from error
    try:
        decode_job_template(template=template)
    except DecodeValidationError as error:
        raise LampblackError(
            "These settings make no valid job template.",
            "Choose shorter names, or fewer frames.",
            str(error),
        ) from error
