"""Line drawings of meshes by Blender's Freestyle (Grabli 2010), as in the paper.

``python -m lampblack_research.render.freestyle FOLDER`` draws every ``FOLDER/*.npz`` into a
``.png`` of the same name, black on white paper. A job holds ``vertices`` (V, 3) float32 in pixels,
x right, y up, z to the viewer, origin in the picture's lower left corner; ``faces`` (F, 3);
``size`` (height, width); and the line style: ``width`` in pixels, ``taper`` 0 or 1, ``wobble`` in
pixels, ``crease`` in degrees (0 draws none), ``seed``.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np

_UNITS = 0.01
"""Blender units a pixel: clipping planes suit objects of a few units."""

SAMPLES = 8


def main(folder: Path) -> None:
    """Draw the folder's jobs; a job that fails is left without a picture."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for path in sorted(folder.glob("*.npz")):
        try:
            with np.load(path, allow_pickle=False) as job:
                _draw(dict(job), path.with_suffix(".png"))
        except (KeyError, ValueError, RuntimeError) as error:
            sys.stderr.write(f"{path.name}: {error}\n")


def _draw(job: dict[str, Any], picture: Path) -> None:
    scene = bpy.context.scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for mesh in list(bpy.data.meshes):
        bpy.data.meshes.remove(mesh)
    height, width = (int(side) for side in job["size"])
    _character(scene, job["vertices"] * _UNITS, job["faces"])
    _camera(scene, width, height, float(job["vertices"][:, 2].max()) * _UNITS)
    _ink(scene, job)
    render = scene.render
    render.engine = "CYCLES"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = False
    render.film_transparent = True
    scene.view_settings.view_transform = "Standard"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.threads_mode, render.threads = "FIXED", 1
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGBA"
    render.filepath = str(picture)
    bpy.ops.render.render(write_still=True)


def _character(scene: Any, vertices: Any, faces: Any) -> None:
    mesh = bpy.data.meshes.new("character")
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    mesh.shade_smooth()
    character = bpy.data.objects.new("character", mesh)
    mesh.materials.append(_white())
    scene.collection.objects.link(character)


def _white() -> Any:
    paper = bpy.data.materials.get("paper") or bpy.data.materials.new("paper")
    paper.use_nodes = True
    nodes, links = paper.node_tree.nodes, paper.node_tree.links
    nodes.clear()
    glow, out = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    links.new(glow.outputs[0], out.inputs[0])
    return paper


def _camera(scene: Any, width: int, height: int, top: float) -> None:
    lens = bpy.data.cameras.get("view") or bpy.data.cameras.new("view")
    lens.type = "ORTHO"
    lens.ortho_scale = max(width, height) * _UNITS
    lens.clip_start, lens.clip_end = 0.1, 1000
    camera = bpy.data.objects.new("view", lens)
    camera.location = (width / 2 * _UNITS, height / 2 * _UNITS, top + 5)
    scene.collection.objects.link(camera)
    scene.camera = camera


def _ink(scene: Any, job: dict[str, Any]) -> None:
    scene.render.use_freestyle = scene.view_layers[0].use_freestyle = True
    scene.render.line_thickness_mode = "ABSOLUTE"
    scene.render.line_thickness = 1.0
    settings = scene.view_layers[0].freestyle_settings
    crease = float(job["crease"])
    settings.crease_angle = np.radians(180 - crease) if crease else 0.0
    lines = settings.linesets[0] if settings.linesets else settings.linesets.new("ink")
    lines.select_silhouette = lines.select_contour = lines.select_border = True
    lines.select_crease = crease > 0
    style = lines.linestyle or bpy.data.linestyles.new("ink")
    lines.linestyle = style
    for modifiers in (style.thickness_modifiers, style.geometry_modifiers):
        for modifier in list(modifiers):
            modifiers.remove(modifier)
    style.thickness = float(job["width"])
    style.color = (0, 0, 0)
    style.caps = "ROUND"
    if job["taper"]:
        along = style.thickness_modifiers.new("taper", "ALONG_STROKE")
        along.mapping = "CURVE"
        along.value_min, along.value_max = 0.25 * style.thickness, style.thickness
        curve = along.curve.curves[0]
        curve.points[0].location, curve.points[-1].location = (0, 0), (1, 0)
        curve.points.new(0.5, 1)
        along.curve.update()
    if job["wobble"] > 0:
        tremor = style.geometry_modifiers.new("tremor", "PERLIN_NOISE_1D")
        tremor.amplitude, tremor.frequency = float(job["wobble"]), 8
        tremor.seed = int(job["seed"])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
