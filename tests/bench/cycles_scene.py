"""blender -b --python cycles_scene.py -- ENVIRONMENT OUT KIND ROUGHNESS SIZE HEIGHT SAMPLES: what cycles.py draws, by Blender's Cycles.

Writes OUT, floats: red, green, blue and opacity of each pixel, rows from the bottom."""
import array
import math
import sys

import bpy

environment, out, kind, roughness, size, height, samples = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device, cycles.samples, cycles.max_bounces = "CPU", int(samples), 1
cycles.use_denoising = cycles.use_adaptive_sampling = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
scene.render.resolution_x = scene.render.resolution_y = int(size)
scene.render.resolution_percentage = 100
scene.render.film_transparent = True
settings = scene.render.image_settings
settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"

world = scene.world = bpy.data.worlds.new("world")
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
nodes.clear()
place, turned = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeMapping")
picture, light, end = (nodes.new(f"ShaderNode{name}") for name in ("TexEnvironment", "Background", "OutputWorld"))
# Blender's pictures have their centre towards +x and z up; Candela's -z, the line of sight, is Blender's +y.
turned.inputs["Rotation"].default_value = (0, 0, -math.pi / 2)
picture.image = bpy.data.images.load(environment)
for a, b in ((place.outputs["Generated"], turned.inputs["Vector"]), (turned.outputs["Vector"], picture.inputs["Vector"]),
             (picture.outputs[0], light.inputs[0]), (light.outputs[0], end.inputs[0])):
    links.new(a, b)

material = bpy.data.materials.new("material")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
if kind == "metal":
    surface = nodes.new("ShaderNodeBsdfGlossy")
    surface.distribution = "GGX"
else:
    surface = nodes.new("ShaderNodeBsdfDiffuse")
surface.inputs["Color"].default_value = (1, 1, 1, 1)
surface.inputs["Roughness"].default_value = float(roughness)
links.new(surface.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=1)
for polygon in bpy.context.object.data.polygons:
    polygon.use_smooth = True
bpy.context.object.data.materials.append(material)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale = "ORTHO", float(height)
camera.location, camera.rotation_euler = (0, -5, 0), (math.pi / 2, 0, 0)
scene.collection.objects.link(camera)
scene.camera = camera
scene.render.filepath = out + ".exr"
bpy.ops.render.render(write_still=True)
drawn = bpy.data.images.load(out + ".exr")
with open(out, "wb") as file:
    array.array("f", drawn.pixels[:]).tofile(file)
