"""Imports a model into Blender and compares each joint in each frame with the recording."""
import json
import sys

import bpy
import numpy

FRAMES_A_SECOND = 90
MOST_MM = 0.1
NAMES = ["wrist"] + [
    f"{finger}-{part}"
    for finger in ("thumb", "index-finger", "middle-finger", "ring-finger", "pinky-finger")
    for part in ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")
    if (finger, part) != ("thumb", "phalanx-intermediate")
]

numpy.bool = bool  # which the importer of Blender 3.4 still asks for

recording, model = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = FRAMES_A_SECOND
bpy.ops.import_scene.gltf(filepath=model)
armatures = [thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE"]
assert len(armatures) == 1, armatures
armature = armatures[0]
missing = [name for name in NAMES if name not in armature.pose.bones]
assert not missing, (missing, sorted(bone.name for bone in armature.pose.bones))

with open(recording) as lines:
    frames = [json.loads(line) for line in lines][1:]
start = frames[0]["t"]
worst_mm = 0.0
for frame in frames:
    at = (frame["t"] - start) * 1e-9 * FRAMES_A_SECOND
    bpy.context.scene.frame_set(round(at))
    for name, joint in zip(NAMES, frame["right"]["joints"][1:]):
        x, y, z = (armature.matrix_world @ armature.pose.bones[name].matrix).translation
        # Blender's +Z is up.
        away = numpy.linalg.norm(numpy.array([x, z, -y]) - joint[:3])
        worst_mm = max(worst_mm, 1e3 * away)
print(f"{model}: {len(frames)} frames, joints within {worst_mm:.5f} mm")
assert worst_mm < MOST_MM
