"""Emitters in the Blender scene: meshes that give light, and are not seen themselves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]


def add_emitter(
    add: Callable[[str, Any], Any],
    name: str,
    vertices: Floats,
    faces: NDArray[np.int32],
    radiance: Floats,
) -> Any:
    """An object that shines on the side of its normals, hidden from renders.

    Args:
        add: puts a mesh into the scene, under a name.
        vertices: (V, 3), in Blender's frame. radiance: (V, 3).
    """
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    mesh.attributes["position"].data.foreach_set("vector", np.ascontiguousarray(vertices).ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(faces).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    colour = mesh.attributes.new("radiance", "FLOAT_VECTOR", "POINT")
    colour.data.foreach_set("vector", np.ascontiguousarray(radiance).ravel())
    mesh.update()
    mesh.materials.append(_shining_material(name))
    emitter = add(name, mesh)
    emitter.visible_camera = emitter.visible_shadow = False
    emitter.hide_render = True
    return emitter


def remove_emitter(emitter: Any) -> None:
    """Remove an emitter with its mesh and material."""
    mesh = emitter.data
    bpy.data.objects.remove(emitter)
    for material in mesh.materials:
        bpy.data.materials.remove(material)
    bpy.data.meshes.remove(mesh)


def _shining_material(name: str) -> Any:
    material = bpy.data.materials.new(name)
    material.cycles.emission_sampling = "FRONT"
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    radiance = nodes.new("ShaderNodeAttribute")
    radiance.attribute_name = "radiance"
    shine = nodes.new("ShaderNodeEmission")
    links.new(radiance.outputs["Vector"], shine.inputs["Color"])
    # Light that hits the back goes on: an emitter takes none away.
    side = nodes.new("ShaderNodeMixShader")
    links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], side.inputs["Fac"])
    links.new(shine.outputs[0], side.inputs[1])
    links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], side.inputs[2])
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(side.outputs[0], output.inputs["Surface"])
    return material
