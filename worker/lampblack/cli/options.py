"""The options of render settings, written once for all commands."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from typing import Annotated, Any, Concatenate, ParamSpec, get_args, get_type_hints

import msgspec
import typer

from ..choices import BodyChoice, LayerRole
from ..errors import LampblackError
from ..finals.settings import RenderSettings

OPTIONS: dict[str, Any] = {
    "input": typer.Argument(
        metavar="INPUT", help="A picture, folder, walk.%04d.png, .pclx, .ora, .psd or .kra."
    ),
    "inputs": typer.Argument(
        metavar="INPUT", help="Picture, folder, walk.%04d.png, or one .pclx, .ora, .psd, .kra."
    ),
    "output": typer.Option(
        "-o",
        "--output",
        metavar="DIR|PATTERN",
        help="Folder for the lit frames, or pattern for their names: lit.%04d.exr.",
    ),
    "sheet": typer.Option(
        "--sheet",
        metavar="COLUMNSxROWS",
        help="Cells of a sprite sheet, such as 8x4: each cell of the picture is a frame.",
    ),
    "frame": typer.Option(
        "--frame",
        metavar="N",
        min=0,
        help="Number of the frame. Default: the first frame of the input.",
    ),
    "frames": typer.Option(
        "--frames", metavar="LIST", help="Frame numbers, such as 1-20x2,25. Default: all."
    ),
    "scene": typer.Option(
        "--scene",
        metavar="FILE",
        help="Scene file. Default for walk.pclx: walk.pclx.lampblack.json; else one light.",
    ),
    "rig": typer.Option(
        "--rig",
        metavar="NAME|FILE",
        help="Rig: key, rim, three-point, sunset, moon, under-light, lantern, or a file. "
        "Replaces the scene's lights and ambient light.",
    ),
    "look": typer.Option(
        "--look",
        metavar="NAME|FILE",
        help="Look: smooth, soft-cel, hard-cel, two-tone-rim, or a file. "
        "Replaces the scene's look and rim.",
    ),
    "lights": typer.Option(
        "--light",
        metavar="X,Y,Z",
        help="Position of a white light, in canvas pixels. Replaces the scene's lights; up to 8.",
    ),
    "floor": typer.Option(
        "--floor",
        metavar="Y",
        help="Canvas line of a floor that catches shadows. Replaces the scene's floor.",
    ),
    "quality": typer.Option(
        "--quality", help="Quality preset of the light. Default: the scene's, or low."
    ),
    "depth_hints": typer.Option(
        "--depth-hints",
        metavar="FILE",
        help="File with what is in front: the field depth of a scene. Replaces the scene's.",
    ),
    "format": typer.Option("--format", help="File format. Default: the pattern's, or png."),
    "apart": typer.Option(
        "--apart",
        help="Take each frame apart into layers for compositing: an OpenRaster file, PNG in a "
        "folder for each layer (pencil2d: without blend modes), or layers of the EXR.",
    ),
    "character": typer.Option(
        "--character", metavar="LAYER", help="Project layer to light. May be repeated."
    ),
    "line": typer.Option(
        "--line",
        metavar="LAYER",
        help="Project layer that holds only the characters' line. May be repeated.",
    ),
    "background": typer.Option(
        "--background", metavar="LAYER", help="Project layer to leave unlit. May be repeated."
    ),
    "layer_body": typer.Option(
        "--layer-body",
        metavar="LAYER=BODY",
        help="Surface of a layer: own, below (part of the body below), flat (on it) or auto. "
        "May be repeated.",
    ),
    "camera": typer.Option(
        "--camera", metavar="LAYER", help="Camera layer of the project. Default: the first one."
    ),
    "layers": typer.Option(
        "--layers", help="Layers of a project that the frames show: all, or only the lit ones."
    ),
    "steady": typer.Option(
        "--steady/--no-steady", help="Smooth normals over neighbouring drawings, against flicker."
    ),
    "mask": typer.Option(
        "--mask", metavar="FILE", help="Picture whose white or opaque part is the character mask."
    ),
    "ink": typer.Option(
        "--ink", metavar="FILE", help="Picture whose dark or opaque part is the ink line."
    ),
    "grids": typer.Option(
        "--grids",
        metavar="N",
        min=0,
        max=64,
        help="Grids of tiles that normals are predicted from, as in the paper. "
        "0 predicts the whole character at once.",
    ),
    "solver": typer.Option(
        "--solver",
        help="How normals become a surface: direct finds the exact minimum, adam is the paper's "
        "gradient descent.",
    ),
    "device": typer.Option(
        "--device",
        help="What traces the light. auto is a graphics card on which a test picture came out "
        "right, else the processor.",
    ),
    "again": typer.Option("--again", help="Render frames again whose files are up to date."),
}
"""In the order of ``--help``, by the field of ``RenderSettings``; ``input``, ``frame``,
``layer_body`` and the roles of layers stand for the fields that ``_settings`` makes from them."""

_REQUIRED = "input", "inputs", "output"
_DEFAULTS = {field.name: field.default for field in msgspec.structs.fields(RenderSettings)}
_TYPES = (
    get_type_hints(RenderSettings)
    | {"input": str, "inputs": list[str], "lights": list[str] | None, "frame": int | None}
    | dict.fromkeys((*get_args(LayerRole), "layer_body"), list[str] | None)
)

Own = ParamSpec("Own")


def with_settings(
    *names: str,
) -> Callable[[Callable[Concatenate[RenderSettings, Own], None]], Callable[..., None]]:
    """Give a command the options ``names``, whose values are its first argument.

    ``--help`` lists what is required first, and the command's other options last.
    """

    def decorate(command: Callable[Concatenate[RenderSettings, Own], None]) -> Callable[..., None]:
        own = list(inspect.signature(command, eval_str=True).parameters.values())[1:]
        shared = [_parameter(name) for name in OPTIONS if name in names]
        parameters = [p.replace(kind=p.KEYWORD_ONLY) for p in (*shared, *own)]
        parameters.sort(key=lambda p: (p.default is not p.empty, p.name not in names))

        @functools.wraps(command)
        def call(**given: Any) -> None:
            settings = _settings({name: given.pop(name) for name in names})
            command(settings, **given)  # type: ignore[call-arg]

        call.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        call.__annotations__ = {p.name: p.annotation for p in parameters}
        return call

    return decorate


def _parameter(name: str) -> inspect.Parameter:
    default = inspect.Parameter.empty if name in _REQUIRED else _DEFAULTS.get(name)
    return inspect.Parameter(
        name,
        inspect.Parameter.KEYWORD_ONLY,
        default=None if default == () else default,
        annotation=Annotated[_TYPES[name], OPTIONS[name]],
    )


def _settings(given: dict[str, Any]) -> RenderSettings:
    """Settings from the values of options; None leaves a field at its default.

    Raises:
        LampblackError: a layer was named twice, or the surface of one is not known.
    """
    roles: dict[str, LayerRole] = {}
    for role in get_args(LayerRole):
        for layer in given.pop(role, None) or ():
            if layer in roles:
                raise LampblackError("A layer was named twice.", "Give each layer one role.")
            roles[layer] = role
    bodies = dict(_layer_body(text) for text in given.pop("layer_body", None) or ())
    if "input" in given:
        given["inputs"] = [given.pop("input")]
    if (frame := given.pop("frame", None)) is not None:
        given["frames"] = str(frame)
    named = {name: value for name, value in given.items() if value is not None}
    return msgspec.convert(
        {"inputs": (), "output": "", "roles": roles, "bodies": bodies} | named, RenderSettings
    )


def _layer_body(text: str) -> tuple[str, BodyChoice]:
    layer, _, named = text.rpartition("=")
    for body in get_args(BodyChoice):
        if layer and body == named:
            return layer, body
    raise LampblackError(
        f"{text!r} does not name the surface of a layer.",
        f"Write it as LAYER=BODY, where BODY is {', '.join(get_args(BodyChoice))}.",
    )
