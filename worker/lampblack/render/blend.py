"""Export of a frame's scene as a .blend; runs in the render process."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .lights import AMBIENT_SHEEN
from .stage import Stage
from .wire import SaveBlend

Floats = NDArray[np.float32]

SAMPLES = 64


def save_blend(stage: Stage, job: SaveBlend, ink: Floats, diffuse: Floats, unlit: Floats) -> None:
    """Write the relief, the floor, all lights and the camera.

    The stage cannot be used afterwards. A render of the file in Blender gives the lit drawing,
    except for Lampblack's compression of highlights and its denoised passes.

    Args:
        ink: (H, W, 4) sRGB, straight alpha: the line, laid over the light and not lit itself.
        diffuse, unlit: (V,), 1 where a vertex has a diffuse colour, or is left as drawn.

    Raises:
        RuntimeError: Blender could not write.
    """
    stage.set_canvas(job.canvas)
    stage.set_floor(job.floor, job.canvas)
    stage.set_view(job.view, job.size, job.canvas)
    stage.set_subject("character")
    objects = stage.scene.collection.objects
    bpy.data.objects.remove(objects["twin"])
    lamps = stage.set_sources(job.lights, job.ambient, job.canvas)
    for unused in [thing for thing in objects if thing.type == "LIGHT" and thing.hide_render]:
        bpy.data.objects.remove(unused)
    for number, (light, lamp) in enumerate(zip(job.lights, lamps, strict=True), start=1):
        lamp.name = lamp.data.name = light.name or f"light {number}"
    stage.scene.world.name = f"ambient, {AMBIENT_SHEEN:.0%} to glossy rays"
    _assign_materials(objects["figure"], ink, diffuse, unlit, job)
    floor = objects["floor"]
    if job.floor is None:
        bpy.data.objects.remove(floor)
    else:
        floor.hide_render = False
        floor.is_shadow_catcher = True
        floor.visible_camera = True
    _set_render(stage.scene)
    bpy.context.preferences.filepaths.save_version = 0  # no .blend1 beside it
    bpy.ops.wm.save_as_mainfile(filepath=job.path, copy=True, compress=True)


def _assign_materials(
    character: Any, ink: Floats, diffuse: Floats, unlit: Floats, job: SaveBlend
) -> None:
    """Assign one material whose shaders do what the composite does with the light. The line is a
    packed picture that emits its own colour over the lit fill."""
    mesh = character.data
    for name, values in (("diffuse", diffuse), ("unlit", unlit)):
        mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", values)
    _unwrap(mesh, job)
    material = mesh.materials[0]
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()

    def attribute(name: str, output: str = "Fac") -> Any:
        node = nodes.new("ShaderNodeAttribute")
        node.attribute_name = name
        return node.outputs[output]

    def scaled(colour: Any, amount: Any) -> Any:
        node = nodes.new("ShaderNodeVectorMath")
        node.operation = "SCALE"
        links.new(colour, node.inputs[0])
        links.new(amount, node.inputs["Scale"])
        return node.outputs[0]

    def shader(kind: str, colour: Any) -> Any:
        node = nodes.new(kind)
        links.new(colour, node.inputs["Color"])
        return node

    def both(first: Any, second: Any) -> Any:
        node = nodes.new("ShaderNodeAddShader")
        links.new(first.outputs[0], node.inputs[0])
        links.new(second.outputs[0], node.inputs[1])
        return node

    albedo = attribute("albedo", "Vector")
    shine = nodes.new("ShaderNodeMix")  # white on a diffuse colour, else the colour itself
    shine.data_type = "VECTOR"
    links.new(attribute("diffuse"), shine.inputs["Factor"])
    links.new(albedo, shine.inputs[4])
    shine.inputs[5].default_value = (1, 1, 1)
    lobe = shader("ShaderNodeBsdfAnisotropic", scaled(shine.outputs[1], attribute("gloss")))
    lobe.distribution = "GGX"
    links.new(attribute("roughness"), lobe.inputs["Roughness"])
    matt = shader("ShaderNodeBsdfDiffuse", scaled(albedo, attribute("diffuse")))
    plain = shader("ShaderNodeEmission", scaled(albedo, attribute("unlit")))
    fill = both(both(matt, lobe), plain)
    texture = nodes.new("ShaderNodeTexImage")
    texture.image, texture.extension = _packed(ink), "EXTEND"
    line = shader("ShaderNodeEmission", texture.outputs["Color"])
    drawn = nodes.new("ShaderNodeMixShader")
    links.new(texture.outputs["Alpha"], drawn.inputs["Fac"])
    links.new(fill.outputs[0], drawn.inputs[1])
    links.new(line.outputs[0], drawn.inputs[2])
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(drawn.outputs[0], output.inputs["Surface"])


def _packed(ink: Floats) -> Any:
    height, width = ink.shape[:2]
    picture = bpy.data.images.new("ink", width, height, alpha=True)
    picture.pixels.foreach_set(np.ascontiguousarray(ink[::-1]).ravel())
    picture.pack()
    return picture


def _unwrap(mesh: Any, job: SaveBlend) -> None:
    """Project the drawing onto the mesh from the front."""
    places = np.zeros(3 * len(mesh.vertices), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", places)
    corners = np.zeros(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    half = np.float32(job.canvas.default_height)
    x, y, width, height = job.view
    across = (places[0::3] * half + job.canvas.width / 2 - x) / width
    down = (job.canvas.height / 2 - places[1::3] * half - y) / height
    laid = np.stack([across, 1 - down], axis=1)[corners].astype(np.float32)
    mesh.uv_layers.new(name="drawing").uv.foreach_set("vector", laid.ravel())


def _set_render(scene: Any) -> None:
    scene.cycles.samples = SAMPLES
    scene.cycles.use_sample_subset = False
    scene.cycles.use_denoising = True
    scene.render.use_compositing = True
    scene.render.threads_mode = "AUTO"
    scene.view_settings.view_transform = "Standard"
