"""Renders a room with Cycles, in Blender's own Python:

    blender -b -noaudio -P in_blender.py -- JOB.json

The job names the room, the size, the threads and the renderings. What each of them took of the
processor goes into the file that it names as `times`. Blender's world is right-handed with z up:
y and z change places."""

import json
import math
import pathlib
import resource
import sys

import bmesh
import bpy
import mathutils

SEGMENTS, RINGS = 96, 48  # of a sphere, whose silhouette is off by 0.0006 of its radius at most
BOX_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def swapped(point):
    return mathutils.Vector((point[0], point[2], point[1]))


def material(thing, metal_roughness):
    made = bpy.data.materials.new("material")
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    color = (*thing["color"], 1)
    if thing.get("is_metal"):
        shader = nodes.new("ShaderNodeBsdfPrincipled")
        shader.distribution = "GGX"
        shader.inputs["Base Color"].default_value = color
        shader.inputs["Metallic"].default_value = 1
        shader.inputs["Roughness"].default_value = metal_roughness
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = color
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(shader.outputs[0], output.inputs["Surface"])
    return made


def add(mesh, thing, metal_roughness):
    mesh.materials.append(material(thing, metal_roughness))
    bpy.context.collection.objects.link(bpy.data.objects.new("thing", mesh))


def add_box(thing, metal_roughness):
    """Adds a box. CRT's turn about y by 90 degrees takes z to x."""
    angle = math.radians(thing["turned"])
    corners = []
    for index in range(8):
        x, y, z = (thing["high" if index >> axis & 1 else "low"][axis] for axis in range(3))
        corner = (x * math.cos(angle) + z * math.sin(angle), y,
                  z * math.cos(angle) - x * math.sin(angle))
        corners.append(swapped([a + b for a, b in zip(corner, thing["at"])]))
    mesh = bpy.data.meshes.new("box")
    mesh.from_pydata(corners, [], BOX_FACES)
    add(mesh, thing, metal_roughness)


def add_sphere(thing, metal_roughness):
    mesh = bpy.data.meshes.new("sphere")
    place = mathutils.Matrix.Translation(swapped(thing["center"]))
    work = bmesh.new()
    bmesh.ops.create_uvsphere(
        work, u_segments=SEGMENTS, v_segments=RINGS, radius=thing["radius"], matrix=place
    )
    for face in work.faces:
        face.smooth = True
    work.to_mesh(mesh)
    work.free()
    add(mesh, thing, metal_roughness)


def add_light(light):
    """Adds an area light. Blender's power of one is 4 times its area times its radiance, as closed
    rooms of both programs show."""
    made = bpy.data.lights.new("light", "AREA")
    made.shape = "RECTANGLE"
    made.size, made.size_y = light["x"], light["z"]
    made.color = light["radiance"]
    made.energy = 4 * light["x"] * light["z"]
    thing = bpy.data.objects.new("light", made)
    x, y, z = light["corner"]
    thing.location = swapped((x + light["x"] / 2, y, z + light["z"] / 2))
    bpy.context.collection.objects.link(thing)


def add_camera(camera):
    made = bpy.data.cameras.new("camera")
    made.sensor_fit = "VERTICAL"
    made.angle = math.radians(camera["fov"])
    made.clip_start = 1e-3
    thing = bpy.data.objects.new("camera", made)
    position, pointing = swapped(camera["position"]), swapped(camera["pointing"])
    thing.location = position
    thing.rotation_euler = (pointing - position).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def add_environment(color):
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*color, 1)
    bpy.context.scene.world = world


def settle(job):
    """Sets what CRT does, too: no denoiser, no clamping, no blur of what is glossy, a box as the
    filter. Everything else stays as Blender has it."""
    scene, cycles = bpy.context.scene, bpy.context.scene.cycles
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", job["threads"]
    scene.render.resolution_x, scene.render.resolution_y = job["width"], job["height"]
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "ZIP"
    cycles.device = "CPU"
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
    cycles.diffuse_bounces = cycles.glossy_bounces = job["bounces"]
    cycles.max_bounces = 2 * job["bounces"]


def render(rendering):
    """Renders, and returns the seconds of the processor that it took."""
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.seed = rendering["samples"], rendering["seed"]
    scene.render.filepath = rendering["picture"]
    begin = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    bpy.ops.render.render(write_still=True)
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime - begin


def main():
    job = json.loads(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="cycles")
    room = job["room"]
    for thing in room["boxes"]:
        add_box(thing, job["metal_roughness"])
    for thing in room["spheres"]:
        add_sphere(thing, job["metal_roughness"])
    add_light(room["light"])
    add_camera(room["camera"])
    add_environment(room["environment"])
    settle(job)
    times = [render(rendering) for rendering in job["renderings"]]
    pathlib.Path(job["times"]).write_text(json.dumps(times))


main()
