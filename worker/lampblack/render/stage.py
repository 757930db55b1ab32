"""The Blender scene: one relief, one light, a floor, an orthographic camera.

Blender's frame here: the canvas centre is the origin, x right, y up, z to the viewer, and
half the canvas's long side is 1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import bpy
import numpy as np
from numpy.typing import NDArray

from ..choices import GlowName
from ..processors import usable_processors
from ..scene import Ambient, AreaLight, Canvas, Floor
from .cards import use_card
from .device import Card
from .glow import add_emitter, remove_emitter
from .lights import Lights, to_blender
from .quality import Sampling
from .spent import spent_on

CAMERA_HEIGHT = 60.0
FLOOR_REACH = 200.0
FLOOR_ALBEDO = 0.6
ALBEDO_RANGE = 0.03, 0.9  # not 0: Cycles divides light by it; not 1: reflections would not fade
PASSES = (
    "diffuse_direct",
    "diffuse_indirect",
    "diffuse_color",
    "glossy_direct",
    "glossy_indirect",
    "glossy_color",
)

Floats = NDArray[np.float32]
Arrays = Sequence[Any]


class Stage:
    """The Blender scene, kept between renders, so that only changed parts are rebuilt.

    Args:
        card: traces instead of the processor.

    Raises:
        RuntimeError: ``card`` cannot be used.
    """

    def __init__(self, card: Card | None = None) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene: Any = bpy.context.scene
        self._set_engine()
        if card is not None:
            use_card(self.scene, card)
        self._surface: Arrays | None = None
        self._emitters: Mapping[GlowName, Arrays] = {}
        self._glows: dict[GlowName, Any] = {}
        self._glow: GlowName | None = None
        self._shadows = True
        self._canvas: Canvas | None = None
        self._character = self._add("figure", bpy.data.meshes.new("figure"))
        # A mesh with two users has its own BVH, which then survives when a light moves.
        self._twin = self._add("twin", self._character.data)
        self._twin.location = (0, 0, -10 * FLOOR_REACH)
        self._twin.scale = (1e-3, 1e-3, 1e-3)
        _set_visible(self._twin, "")
        self._floor = self._add("floor", _floor_mesh())
        self._floor_places = {"standing": (0.0, 0.0, 0.0), "sunk": (0.0, 0.0, 0.0)}
        camera = bpy.data.cameras.new("camera")
        camera.type = "ORTHO"
        camera.clip_end = 2 * CAMERA_HEIGHT + FLOOR_REACH
        self._camera = self._add("camera", camera)
        self.scene.camera = self._camera
        self._lights = Lights(self.scene)

    def set_surface(self, relief: Arrays, emitters: Mapping[GlowName, Arrays]) -> None:
        """Set the relief and the emitters, in canvas pixels, as ``wire.Load`` has their arrays.
        ``set_canvas`` builds their meshes."""
        self._surface, self._emitters = relief, emitters
        self._canvas = None

    def set_canvas(self, canvas: Canvas) -> None:
        """Build the relief's mesh for ``canvas``, unless it is there already."""
        if canvas == self._canvas or self._surface is None:
            return
        with spent_on("mesh"):
            mesh = _character_mesh(self._surface, canvas)
        old = self._character.data
        self._character.data = self._twin.data = mesh
        for material in old.materials:
            bpy.data.materials.remove(material)
        bpy.data.meshes.remove(old)
        for glow in self._glows.values():
            remove_emitter(glow)
        self._glows = {
            name: add_emitter(self._add, name, to_blender(arrays[0], canvas), *arrays[1:])
            for name, arrays in self._emitters.items()
        }
        self._canvas = canvas

    def character_box(self) -> Floats:
        """(2, 2): left and top, right and bottom of the relief, canvas pixels; 0 if it is empty."""
        if self._surface is None or not len(self._surface[0]):
            return np.zeros((2, 2), np.float32)
        places = self._surface[0][:, :2]
        return np.stack([places.min(axis=0), places.max(axis=0)])

    def set_floor(self, floor: Floor | None, canvas: Canvas) -> None:
        """Hinge the floor at its line, pitched towards the viewer; None removes it."""
        self._floor.hide_render = floor is None
        if floor is None:
            return
        pitch, depth = math.radians(floor.pitch), 0.0
        if self._surface is not None and len(self._surface[0]):
            _, y, z = self._surface[0].T
            above = (floor.y - y) * math.cos(pitch) + z * math.sin(pitch)
            depth = min(0.0, float(above.min()) / canvas.default_height)
        hinge = float(to_blender(np.array([[0, floor.y, 0]], np.float32), canvas)[0, 1])
        self._floor_places = {
            "standing": (0.0, hinge, 0.0),
            "sunk": (0.0, hinge + depth * math.cos(pitch), depth * math.sin(pitch)),
        }
        self._floor.rotation_euler = (pitch - math.pi / 2, 0, 0)

    def set_view(
        self, view: tuple[float, float, float, float], size: tuple[int, int], canvas: Canvas
    ) -> None:
        """Aim the camera at ``view`` (x, y, width, height, canvas pixels), ``size`` pixels."""
        x, y, width, height = view
        centre = np.array([[x + width / 2, y + height / 2, 0]], np.float32)
        self._camera.location = (*to_blender(centre, canvas)[0, :2], CAMERA_HEIGHT)
        self._camera.data.ortho_scale = max(width, height) / canvas.default_height
        render = self.scene.render
        render.resolution_x, render.resolution_y = size
        # The aspect of a pixel is such that the rounded size covers the view exactly.
        aspect = (width / size[0]) / (height / size[1])
        render.pixel_aspect_x, render.pixel_aspect_y = max(1, aspect), max(1, 1 / aspect)

    def set_source(
        self, light: AreaLight | None, canvas: Canvas, glow: GlowName | None = None
    ) -> None:
        """Turn on one source: a white area light or sun of power 1, an emitter, or the ambient
        light."""
        lights = [] if light is None else [replace(light, colour="#ffffff", power=1.0)]
        ambient = Ambient(strength=float(light is None and glow is None))
        for name, emitter in self._glows.items():
            emitter.hide_render = name != glow
        self._glow = glow
        self._shadows = light is None or light.casts_shadow
        self._lights.shine(lights, ambient, canvas)

    def set_sources(
        self, lights: Sequence[AreaLight], ambient: Ambient, canvas: Canvas
    ) -> list[Any]:
        """Turn on all of ``lights`` and the ambient light, in their colours and powers. All of them
        cast shadows. Returns Blender's objects of the lights."""
        for emitter in self._glows.values():
            emitter.hide_render = True
        self._glow = None
        self._shadows = True
        return self._lights.shine(lights, ambient, canvas)

    def set_subject(self, subject: Literal["character", "floor", "bare floor"]) -> None:
        """Choose what the camera sees. The other part is invisible but still reflects light.

        The floor never casts a shadow. When the character is rendered, the floor is lowered below
        all of it, so that a character that extends below the floor's line has no seam.
        """
        rays = {"character": "cdgs", "floor": "dgs", "bare floor": ""}[subject]
        _set_visible(self._character, rays if self._shadows else rays.replace("s", ""))
        if self._glow == "emission" and self._glow in self._glows:  # it belongs to the character
            self._glows[self._glow].hide_render = subject == "bare floor"
        _set_visible(self._floor, "dg" if subject == "character" else "cdg")
        self._floor.location = self._floor_places["sunk" if subject == "character" else "standing"]

    def set_sampling(self, sampling: Sampling) -> None:
        """Set samples per pixel."""
        self.set_samples(sampling.spp, 0, sampling.spp)

    def set_samples(self, spp: int, first: int, count: int) -> None:
        """Trace ``count`` samples per pixel, from ``first`` on, of a pattern of ``spp``. The mean
        of all subsets is as good as one render; the mean of renders with other seeds is not."""
        cycles = self.scene.cycles
        cycles.samples = spp
        cycles.use_sample_subset = count < spp
        cycles.sample_offset, cycles.sample_subset_length = first, count
        # Cycles reads its settings again only when the film changes.
        self.scene.render.filter_size = self.scene.render.filter_size

    def _set_engine(self) -> None:
        render = self.scene.render
        render.engine = "CYCLES"
        render.film_transparent = True
        render.use_persistent_data = True
        render.use_compositing = render.use_sequencer = False
        render.threads_mode = "FIXED"
        render.threads = usable_processors()
        cycles = self.scene.cycles
        cycles.pixel_filter_type = "BOX"
        cycles.use_auto_tile = False
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        cycles.light_sampling_threshold = 0
        cycles.caustics_reflective = cycles.caustics_refractive = False
        cycles.max_bounces = cycles.diffuse_bounces = 4
        cycles.glossy_bounces = 2
        layer = self.scene.view_layers[0]
        for name in PASSES:
            setattr(layer, f"use_pass_{name}", True)

    def _add(self, name: str, data: Any) -> Any:
        thing = bpy.data.objects.new(name, data)
        self.scene.collection.objects.link(thing)
        return thing


def _set_visible(thing: Any, rays: str) -> None:
    """Set visibility for camera, diffuse, glossy and shadow rays, by initial.

    Objects stay visible for transmission rays, which do not occur: Cycles would drop an object
    that no ray sees, and rebuild it later.
    """
    thing.visible_camera = "c" in rays
    thing.visible_diffuse = "d" in rays
    thing.visible_glossy = "g" in rays
    thing.visible_shadow = "s" in rays


def _character_mesh(surface: Arrays, canvas: Canvas) -> Any:
    """The relief in Blender's frame, smooth shaded, with its material per vertex."""
    vertices, faces, albedo, gloss, roughness = surface
    mesh = bpy.data.meshes.new("figure")
    if not len(vertices):
        return mesh
    mesh.vertices.add(len(vertices))
    # Setting the attribute is a hundred times faster than setting the vertices.
    mesh.attributes["position"].data.foreach_set("vector", to_blender(vertices, canvas).ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(faces).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    colour = mesh.attributes.new("albedo", "FLOAT_VECTOR", "POINT")
    colour.data.foreach_set("vector", np.clip(albedo, *ALBEDO_RANGE).ravel())
    for name, values in (("gloss", gloss), ("roughness", roughness)):
        mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", values)
    mesh.update()
    mesh.materials.append(_character_material(glossy=bool(gloss.any())))
    return mesh


def _character_material(*, glossy: bool) -> Any:
    """A diffuse material in the albedo, plus a white GGX lobe in the amount of gloss."""
    material = bpy.data.materials.new("figure")
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()

    def attribute(name: str, output: str) -> Any:
        node = nodes.new("ShaderNodeAttribute")
        node.attribute_name = name
        return node.outputs[output]

    shader = nodes.new("ShaderNodeBsdfDiffuse")
    links.new(attribute("albedo", "Vector"), shader.inputs["Color"])
    if glossy:
        lobe = nodes.new("ShaderNodeBsdfAnisotropic")
        lobe.distribution = "GGX"
        links.new(attribute("gloss", "Fac"), lobe.inputs["Color"])
        links.new(attribute("roughness", "Fac"), lobe.inputs["Roughness"])
        both = nodes.new("ShaderNodeAddShader")
        links.new(shader.outputs[0], both.inputs[0])
        links.new(lobe.outputs[0], both.inputs[1])
        shader = both
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def _floor_mesh() -> Any:
    """A diffuse square that faces its own z, and is invisible from behind."""
    mesh = bpy.data.meshes.new("floor")
    r = FLOOR_REACH
    mesh.from_pydata([(-r, -r, 0), (r, -r, 0), (r, r, 0), (-r, r, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("floor")
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (FLOOR_ALBEDO, FLOOR_ALBEDO, FLOOR_ALBEDO, 1)
    side = nodes.new("ShaderNodeMixShader")
    links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], side.inputs["Fac"])
    links.new(diffuse.outputs[0], side.inputs[1])
    links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], side.inputs[2])
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(side.outputs[0], output.inputs["Surface"])
    mesh.materials.append(material)
    return mesh
