"""Export of a frame's 3D scene: GLB for any program, .blend for Blender."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray
from PIL import Image
from trimesh.visual.material import PBRMaterial
from trimesh.visual.texture import TextureVisuals

from ..atomic import atomic_file, atomic_path
from ..drawing import Drawing
from ..materials import MaterialTable
from ..prepared import PreparedDrawing
from ..render.client import RenderChild
from ..render.quality import QUALITIES
from ..render.request import frame_request
from ..scene import Scene, shining
from ..surface import Relief
from .left_out import warn_without_glows

SUFFIXES = (".glb", ".blend")
GLOSSY, MATT = 0.5, 1.0


def save_scene(drawing: Drawing, prepared: PreparedDrawing, scene: Scene, path: Path) -> None:
    """Write the relief in its drawing's colours. A .blend also has the lights, floor and camera.
    It warns of lights that it leaves out.

    In both, half the canvas's long side is 1, and the canvas's centre is the origin, with x right,
    y up, z to the viewer. (Blender rotates a GLB on import, because its z axis points up.)

    Raises:
        OutputError: it cannot be written. RenderError: Blender failed.
    """
    stride = QUALITIES[scene.quality].mesh_stride
    relief = prepared.relief(stride=stride, relief_scale=scene.relief_scale)
    surface = prepared.with_materials(relief, scene)
    if path.suffix.lower() == ".glb":
        _save_glb(prepared, relief, scene, path)
        return
    warn_without_glows(prepared, scene, path.name)
    shown = zip(scene.lights, shining(scene.lights), strict=True)
    lit = replace(scene, lights=tuple(light for light, shines in shown if shines))
    request = frame_request(drawing.size, surface, lit)
    ink = np.dstack([drawing.ink_colour, drawing.ink]).astype(np.float32)
    materials = MaterialTable.of(scene, prepared.palette.colours)
    _, worn = prepared.paint_at(relief)
    diffuse = materials.diffuse[worn].astype(np.float32)
    unlit = (~(materials.diffuse | materials.glossy))[worn].astype(np.float32)
    with atomic_path(path) as temporary, RenderChild() as child:
        child.save_blend(request, scene.ambient, ink, diffuse, unlit, temporary.resolve())


def _save_glb(prepared: PreparedDrawing, relief: Relief, scene: Scene, path: Path) -> None:
    """A mesh for each body, with its own drawing as its texture."""
    width, height = prepared.size
    centre = np.array([width / 2, height / 2, 0], np.float32)
    meshes = trimesh.Scene()
    parts = [("drawing", prepared.layers, np.zeros(3, np.float32))]
    if relief.bodies is not None:
        parts = [(body.name, body.drawing.layers, body.corner) for body in prepared.bodies]
    for index, (name, drawing, corner) in enumerate(parts):
        assert isinstance(drawing, Drawing)
        vertices, faces = relief.vertices, relief.faces
        if relief.bodies is not None:
            own = relief.bodies == index
            number = np.cumsum(own) - 1
            vertices, faces = vertices[own], number[faces[own[faces[:, 0]]]]
        places = (vertices - corner)[:, :2] / drawing.size
        material = PBRMaterial(  # type: ignore[no-untyped-call]
            name=name,
            baseColorTexture=Image.fromarray(_flat(drawing)),
            metallicFactor=0.0,
            roughnessFactor=GLOSSY if scene.default_material.glossy else MATT,
        )
        texture = TextureVisuals(  # type: ignore[no-untyped-call]
            uv=np.column_stack([places[:, 0], 1 - places[:, 1]]), material=material
        )
        placed = (vertices - centre) * [1, -1, 1] / scene.canvas.default_height
        mesh = trimesh.Trimesh(placed, faces, visual=texture, process=False)
        meshes.add_geometry(mesh, geom_name=f"{name}_{index}" if index else name)
    with atomic_file(path) as file:
        file.write(bytes(meshes.export(file_type="glb")))  # type: ignore[no-untyped-call]


def _flat(drawing: Drawing) -> NDArray[np.uint8]:
    """(H, W, 3) uint8 sRGB: fill and line, continued past the edge so that it is not white."""
    ink = drawing.ink[..., None]
    colour = drawing.albedo + ink * (drawing.ink_colour - drawing.albedo)
    return np.asarray(np.rint(np.clip(colour, 0, 1) * 255).astype(np.uint8))
