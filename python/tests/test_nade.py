"""Tests of the installed wheel: python/test_wheel runs them.

NADE_TEST_PROGRAM is the program `nade`, NADE_TEST_DOG the dog's mesh; what needs them, a C compiler
or matplotlib is skipped where there is none.
"""

from __future__ import annotations

import copy
import ctypes
import gc
import importlib
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
from typing import Any, Optional

import numpy as np

import nade
from nade import _hands, _library, _surfaces

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("NADE_TEST_PROGRAM", "")
DOG = os.environ.get("NADE_TEST_DOG", "")
FRAME_NS = 11_111_111

needs_program = unittest.skipUnless(os.path.exists(PROGRAM), "no NADE_TEST_PROGRAM")
needs_compiler = unittest.skipUnless(shutil.which("cc"), "no C compiler")


def stroke(side: str = "right", frames: int = 150, noise_m: float = 0.001) -> Any:
    """Positions and rotations of a hand that presses 20 mm below y = 0 and strokes.

    Of numbers that float32 has, as engines and trackers give them: then all interfaces see the same
    hand, while a hand that is rounded first may take another way at a knife's edge.
    """
    rest = nade.rest_hand(side)
    random = np.random.default_rng(7 if side == "right" else 8)
    share = np.linspace(0.0, 1.0, frames)
    way = np.zeros((frames, 1, 3))
    way[:, 0, 0] = 0.04 * np.sin(9.0 * share) + (0.05 if side == "right" else -0.05)
    way[:, 0, 1] = 0.07 - 0.09 * np.minimum(3.0 * share, 1.0)
    way[:, 0, 2] = 0.06 * np.cos(7.0 * share)
    shaken = random.normal(0.0, noise_m, (frames, 1, 3))
    positions = (rest["position"] + way + shaken).astype(np.float32).astype(np.float64)
    rotations = np.repeat(rest["rotation"][np.newaxis].astype(np.float64), frames, axis=0)
    return positions, rotations


def times(frames: int) -> np.ndarray:
    return np.arange(frames, dtype=np.int64) * FRAME_NS


def recording(frames: int = 150) -> nade.Recording:
    """Two noisy hands, of which each is lost for some frames."""
    hands = {}
    for side, lost in (("left", slice(40, 44)), ("right", slice(60, 75))):
        positions, rotations = stroke(side, frames)
        positions[lost] = rotations[lost] = np.nan
        radii = np.full((frames, 26), np.float64(np.float32(0.008)))
        confidence = np.linspace(0.5, 1.0, frames)
        radii[lost] = confidence[lost] = np.nan
        hands[side] = nade.RecordedHand(positions, rotations, radii, confidence)
    return nade.Recording(times(frames), hands["left"], hands["right"], {"source": "test"})


def ball(radius: float, rings: int = 24, sectors: int = 32) -> Any:
    """A closed mesh, of numbers that float32 has."""
    rows = [[0.0, radius, 0.0]]
    for ring in range(1, rings):
        polar = math.pi * ring / rings
        for sector in range(sectors):
            turn = 2.0 * math.pi * sector / sectors
            out = radius * math.sin(polar)
            rows.append([out * math.cos(turn), radius * math.cos(polar), -out * math.sin(turn)])
    rows.append([0.0, -radius, 0.0])
    faces = []
    last = len(rows) - 1
    for sector in range(sectors):
        after = (sector + 1) % sectors
        faces.append([0, 1 + sector, 1 + after])
        faces.append([last, last - sectors + after, last - sectors + sector])
        for ring in range(rings - 2):
            upper, lower = 1 + ring * sectors, 1 + (ring + 1) * sectors
            faces.append([upper + sector, lower + sector, lower + after])
            faces.append([upper + sector, lower + after, upper + after])
    return np.array(rows, np.float32), np.array(faces, np.uint32)


def hand_of_balls() -> Any:
    """The arguments of `nade.Flesh` and `nade.Skin` for a hand that has a ball at each joint."""
    bind = nade.rest_hand()
    vertices, triangles = ball(1.0, 6, 8)
    count = len(vertices)
    return (
        "right",
        np.concatenate([bind["position"][i] + 0.008 * vertices for i in range(1, 26)]),
        np.tile(vertices, (25, 1)),
        np.concatenate([triangles + i * count for i in range(25)]),
        np.repeat(np.arange(1, 26), count)[:, np.newaxis] * [1, 0, 0, 0],
        np.tile([1.0, 0, 0, 0], (25 * count, 1)),
        bind,
    )


def read_dog(path: str) -> Any:
    """Vertices and triangles of a .glb whose first mesh stands where its file has it."""
    data = pathlib.Path(path).read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20 : 20 + length])
    binary = data[28 + length :]

    def values(index: int, width: int) -> np.ndarray:
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        dtype = {5123: np.uint16, 5125: np.uint32, 5126: np.float32}[accessor["componentType"]]
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(binary, dtype, width * accessor["count"], at).reshape(-1, width)

    primitive = document["meshes"][0]["primitives"][0]
    triangles = values(primitive["indices"], 1).reshape(-1, 3)
    return values(primitive["attributes"]["POSITION"], 3), triangles


class Folder(unittest.TestCase):
    """Has a folder of its own."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Layout(Folder):
    STRUCTS = {
        "nade_joint": _library.Joint,
        "nade_placement": _library.Placement,
        "nade_feel": _library.Feel,
        "nade_corrector_options": _library.CorrectorOptions,
        "nade_contact": _library.Contact,
        "nade_result": _library.Result,
        "nade_mesh": _library.Mesh,
        "nade_mesh_report": _library.MeshReport,
        "nade_surface_point": _library.SurfacePoint,
        "nade_group_member": _library.GroupMember,
        "nade_surface_callbacks": _library.SurfaceCallbacks,
        "nade_hand_mesh": _library.HandMesh,
    }
    CONSTANTS = {
        "NADE_ABI_VERSION": _library.ABI_VERSION,
        "NADE_JOINT_COUNT": _library.JOINT_COUNT,
        "NADE_MAX_CONTACTS": _library.MAX_CONTACTS,
        **{f"NADE_{side.upper()}": value for side, value in _library.SIDES.items()},
        **{f"NADE_METHOD_{name.upper()}": value for name, value in _library.METHODS.items()},
        **{f"NADE_HAND_{status.name}": status.value for status in nade.HandStatus},
        **{f"NADE_FAULT_{fault.name}": fault.value for fault in nade.Fault},
        **{f"NADE_ERROR_{code.name}": code.value for code in nade.ErrorCode},
        **{f"NADE_JOINT_{name.upper()}": i for i, name in enumerate(nade.JOINT_NAMES)},
        **{f"NADE_SOLID_{name}": i for i, name in enumerate(("CLOSED", "DEFECTIVE", "SHEET"))},
    }
    TYPES = {
        "double": ctypes.c_double,
        "size_t": ctypes.c_size_t,
        "uint64_t": ctypes.c_uint64,
        "int64_t": ctypes.c_int64,
        "nade_side": ctypes.c_int32,
    }

    @needs_compiler
    def test_structs_and_constants_are_those_of_the_compiler(self) -> None:
        wanted, lines = {}, []

        def add(name: str, value: int, expression: str) -> None:
            wanted[name] = value
            lines.append(f'  printf("{name} %ld\\n", (long)({expression}));')

        for name, declared in self.STRUCTS.items():
            add(name, ctypes.sizeof(declared), f"sizeof({name})")
            for field, kind, *_ in declared._fields_:
                place = getattr(declared, field).offset
                add(f"{name}.{field}", place, f"offsetof({name}, {field})")
                size = ctypes.sizeof(kind)
                add(f"{name}.{field}:size", size, f"sizeof((({name}*)0)->{field})")
        for name, value in self.CONSTANTS.items():
            add(name, value, name)
        source = self.folder / "layout.c"
        body = "\n".join(lines)
        source.write_text(
            '#include <stdio.h>\n#include "nade.h"\n'
            f"int main(void) {{\n{body}\n  return 0;\n}}\n"
        )
        program = self.folder / "layout"
        command = ["cc", f"-I{ROOT / 'include'}", str(source), "-o", str(program)]
        subprocess.run(command, check=True)
        told = subprocess.run([program], check=True, capture_output=True, text=True).stdout
        found = {line.split()[0]: int(line.split()[1]) for line in told.splitlines()}
        self.assertEqual(found, wanted)

    def test_functions_are_those_of_the_header(self) -> None:
        header = (ROOT / "include/nade.h").read_text()
        pattern = r"NADE_API nade_status (nade_\w+)\(([^)]*)\)\s+NADE_NOEXCEPT"
        declared = dict(re.findall(pattern, header))
        for name, kinds in _library.STATUS_FUNCTIONS.items():
            with self.subTest(name):
                arguments = [argument.split() for argument in declared[name].split(",")]
                self.assertEqual(len(arguments), len(kinds))
                for words, kind in zip(arguments, kinds):
                    text = " ".join(words)
                    if "*" in text or "[" in text:
                        is_pointer = kind is ctypes.c_void_p or hasattr(kind, "contents")
                        self.assertTrue(is_pointer, text)
                    else:
                        self.assertIs(kind, self.TYPES[words[0]], text)

    def test_arrays_of_the_library(self) -> None:
        self.assertEqual(nade.JOINT.itemsize, 32)
        self.assertEqual(nade.PLACEMENT.itemsize, 32)
        self.assertEqual(nade.CONTACT.itemsize, 56)
        result = np.zeros(1, _hands._RESULT)
        self.assertEqual(result["velocity_mps"].shape, (1, 26, 3))
        self.assertEqual(len(nade.JOINT_NAMES), 26)


class Surfaces(unittest.TestCase):
    def test_each_shape_is_where_it_says(self) -> None:
        square = [[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]]
        corners = [[x, y, z] for x in (-1, 1) for y in (-0.1, 0.1) for z in (-1, 1)]
        vertices, triangles = ball(0.2)
        tops = [
            (nade.Plane(), 0.0),
            (nade.Plate(square, 0.02), 0.0),
            (nade.Sphere(0.15), 0.15),
            (nade.Ellipsoid([0.1, 0.2, 0.3]), 0.2),
            (nade.Box([0.1, 0.2, 0.3], rounding=0.01), 0.2),
            (nade.Cylinder(0.3, 0.1, 0.02), 0.3),
            (nade.Capsule(0.2, 0.05), 0.15),
            (nade.Hull(corners), 0.1),
            (nade.HeightField(np.full((3, 4), 0.25), 0.1), 0.25),
            (nade.Mesh(vertices, triangles), 0.2),
            (nade.Mesh(vertices, triangles, scale=[1, 2, 1]), 0.4),
        ]
        for surface, top in tops:
            with self.subTest(type(surface).__name__):
                near = surface.closest_point([0.0, top + 0.01, 0.0])
                self.assertIsNotNone(near)
                self.assertAlmostEqual(near.signed_distance, 0.01, places=6)
                np.testing.assert_allclose(near.point, [0.0, top, 0.0], atol=1e-6)
                self.assertAlmostEqual(near.normal[1], 1.0, places=2)
                self.assertIsNone(surface.closest_point([0.0, 9.0, 0.0], max_distance=1.0))

    def test_placed(self) -> None:
        placed = nade.placement([0, 1, 0], scale=2)
        near = nade.Sphere(0.1).closest_point([0, 1.5, 0], placement=placed)
        self.assertAlmostEqual(near.signed_distance, 0.3, places=6)

    def test_mesh_tells_what_it_mended(self) -> None:
        vertices, triangles = ball(0.2)
        report = nade.Mesh(vertices, triangles).report
        self.assertEqual(report.solid, "closed")
        self.assertEqual(report.triangles_used, len(triangles))
        self.assertEqual(nade.Mesh(vertices, triangles[:40]).report.solid, "sheet")

    def test_mesh_moves(self) -> None:
        vertices, triangles = ball(0.2)
        mesh = nade.Mesh(vertices, triangles)
        mesh.refit(vertices * 2)
        self.assertAlmostEqual(mesh.closest_point([0, 0.5, 0]).signed_distance, 0.1, places=6)

    def test_group(self) -> None:
        ball = nade.Sphere(0.05)
        group = nade.Group([nade.Sphere(0.1), (ball, nade.placement([0, 0.2, 0]))])
        self.assertAlmostEqual(group.closest_point([0, 1, 0]).point[1], 0.25, places=6)
        group.place(1, nade.placement([0, 0.3, 0]))
        self.assertAlmostEqual(group.closest_point([0, 1, 0]).point[1], 0.35, places=6)
        group.place(1, None)
        self.assertAlmostEqual(group.closest_point([0, 1, 0]).point[1], 0.1, places=6)
        with self.assertRaisesRegex(nade.NadeError, "index"):
            group.place(2, None)
        with self.assertRaisesRegex(TypeError, "surface: expected a nade surface, found str"):
            nade.Group(["ball"])
        with self.assertRaises(nade.NadeError):
            nade.Group([])

    def test_custom_is_as_the_library_s_own(self) -> None:
        def ball(query: Any, farthest: float) -> Any:
            length = float(np.linalg.norm(query))
            if length - 0.15 > farthest:
                return None
            return 0.15 * query / length, query / length, length - 0.15

        positions, rotations = stroke()
        positions = positions[:40]
        rotations = rotations[:40]
        below = nade.placement([0, -0.15, 0])
        given = (positions, rotations, times(len(positions)))
        custom = nade.Custom(ball, bounds=lambda: ([-0.15] * 3, [0.15] * 3), shape=lambda: 1)
        expected = nade.correct(*given, nade.Sphere(0.15), placement=below)
        drawn = nade.correct(*given, custom, placement=below)
        np.testing.assert_allclose(drawn.positions, expected.positions, atol=1e-5)
        scene = nade.Scene()
        scene.add(1, custom, below)
        in_scene = nade.correct(*given, scene)
        np.testing.assert_allclose(in_scene.positions, expected.positions, atol=1e-5)
        kept = len(_surfaces._kept)
        del custom
        gc.collect()
        self.assertEqual(len(_surfaces._kept), kept)  # the scene has it
        nade.correct(*given, scene)
        del scene
        gc.collect()
        self.assertEqual(len(_surfaces._kept), kept - 1)

    def test_what_a_custom_surface_raises_comes_out(self) -> None:
        def broken(query: Any, farthest: float) -> Any:
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            nade.Custom(broken).closest_point([0, 1, 0])
        self.assertIsNotNone(nade.Plane().closest_point([0, 1, 0]))
        with self.assertRaisesRegex(ValueError, "closest_point: point: expected the shape"):
            nade.Custom(lambda *_: ([0, 1], [0, 1, 0], 1.0)).closest_point([0, 1, 0])
        with self.assertRaisesRegex(KeyError, "mine"):
            nade.Corrector().update(nade.rest_hand("right"), nade.Custom(broken), 0, side="right")
        with self.assertRaisesRegex(TypeError, "closest_point: expected a function, found int"):
            nade.Custom(3)

    def test_scene(self) -> None:
        scene = nade.Scene()
        vertices, triangles = ball(0.2)
        mesh = nade.Mesh(vertices, triangles)
        scene.add(5, nade.Plane(), feel=nade.Feel(softness_m=0.01))
        scene.add(2**64 - 1, mesh, nade.placement([0, 9, 0]))
        self.assertEqual(len(scene), 2)
        mesh.refit(vertices)
        scene.deformed(2**64 - 1)
        scene.place(2**64 - 1, nade.placement([0, 8, 0]))
        scene.set_feel(5, None)
        scene.remove(2**64 - 1)
        self.assertEqual(len(scene), 1)

    def test_handles_go_and_what_uses_them_stays(self) -> None:
        scene = nade.Scene()
        scene.add(1, nade.Plane())
        gc.collect()
        positions, rotations = stroke()
        in_scene = nade.correct(positions, rotations, times(len(positions)), scene)
        on_plane = nade.correct(positions, rotations, times(len(positions)), nade.Plane())
        np.testing.assert_allclose(in_scene.positions, on_plane.positions, atol=1e-6)
        for owner in (scene, nade.Plane(), nade.Corrector()):
            with self.assertRaisesRegex(TypeError, "cannot be copied"):
                copy.copy(owner)


class Correcting(unittest.TestCase):
    def test_hand_is_put_onto_the_plane(self) -> None:
        positions, rotations = stroke(noise_m=0.0)
        drawn = nade.correct(positions, rotations, times(len(positions)), nade.Plane())
        self.assertEqual(drawn.positions.shape, positions.shape)
        self.assertEqual(drawn.positions.dtype, np.float64)
        self.assertLess(positions[-1, 0, 1], -0.015)
        self.assertGreater(drawn.positions[-1, 0, 1], 0.005)
        self.assertEqual(drawn.statuses[0], nade.HandStatus.FREE)
        self.assertEqual(drawn.statuses[-1], nade.HandStatus.CORRECTED)
        count = drawn.contact_counts[-1]
        self.assertGreater(count, 0)
        contacts = drawn.contacts[-1][:count]
        np.testing.assert_allclose(contacts["normal"], [[0, 1, 0]] * count, atol=1e-6)
        self.assertTrue((contacts["depth_m"] >= 0.0).all())

    def test_all_at_once_is_frame_by_frame(self) -> None:
        positions, rotations = stroke()
        scene = nade.Scene()
        scene.add(3, nade.Sphere(0.15), nade.placement([0, -0.15, 0]))
        places = nade.placement(np.linspace([0, -0.15, 0], [0.02, -0.14, 0], len(positions)))
        cases: list[tuple[Any, Optional[np.ndarray]]] = [
            (nade.Sphere(0.15), nade.placement([0, -0.15, 0])),
            (nade.Sphere(0.15), places),
            (scene, None),
            (None, None),
        ]
        hands = nade.joints(positions, rotations, np.full((len(positions), 26), 0.01))
        for surface, placed in cases:
            drawn = nade.correct(
                positions,
                rotations,
                times(len(positions)),
                surface,
                radii=np.full(26, 0.01),
                placement=placed,
            )
            corrector = nade.Corrector()
            for i, hand in enumerate(hands):
                place = placed[i] if placed is not None and placed.ndim else placed
                result = corrector.update(hand, surface, i * FRAME_NS, placement=place)
                self.assertEqual(result.status, drawn.statuses[i])
                self.assertEqual(len(result.contacts), drawn.contact_counts[i])
                np.testing.assert_array_equal(result.positions, drawn.positions[i].astype("f4"))
                np.testing.assert_array_equal(result.velocities, drawn.velocities[i])
            np.testing.assert_array_equal(result.radii, hands["radius"][-1])

    def test_free_hand_comes_back_bit_for_bit(self) -> None:
        positions, rotations = stroke()
        positions = positions + math.pi
        drawn = nade.correct(positions, rotations, times(len(positions)), nade.Plane())
        np.testing.assert_array_equal(drawn.positions, positions)
        np.testing.assert_array_equal(drawn.rotations, rotations)
        self.assertTrue((drawn.statuses == nade.HandStatus.FREE).all())

    def test_hands_that_are_missing_or_wrong_come_back_as_they_are(self) -> None:
        positions, rotations = stroke()
        positions[50:60] = rotations[50:60] = np.nan
        positions[90, 10, 1] = np.nan
        rotations[91, 3] = 0.0
        drawn = nade.correct(positions, rotations, times(len(positions)), nade.Plane())
        odd = [*range(50, 60), 90, 91]
        np.testing.assert_array_equal(drawn.positions[odd], positions[odd])
        np.testing.assert_array_equal(drawn.rotations[odd], rotations[odd])
        self.assertTrue((drawn.statuses[odd] == nade.HandStatus.UNTRACKED).all())
        self.assertEqual(drawn.faults[90], nade.Fault.NOT_FINITE)
        self.assertEqual(drawn.faults[91], nade.Fault.ROTATION_NOT_UNIT)
        usable = np.delete(np.arange(len(positions)), odd)
        self.assertTrue(np.isfinite(drawn.positions[usable]).all())

    def test_method_none_and_feel(self) -> None:
        positions, rotations = stroke(noise_m=0.0)
        when = times(len(positions))
        same = nade.correct(positions, rotations, when, nade.Plane(), method="none")
        np.testing.assert_array_equal(same.positions, positions)
        hard = nade.correct(positions, rotations, when, nade.Plane())
        soft = nade.correct(positions, rotations, when, nade.Plane(), feel=nade.Feel(0.02))
        self.assertGreater(hard.positions[-1, 0, 1], soft.positions[-1, 0, 1] + 0.002)

    def test_preview_and_reset(self) -> None:
        hands = nade.joints(*stroke(noise_m=0.0))
        corrector = nade.Corrector()
        for i, hand in enumerate(hands):
            result = corrector.update(hand, nade.Plane(), i * FRAME_NS)
        ahead = hands[-1].copy()
        ahead["position"][:, 0] += 0.01
        moved = corrector.preview(ahead)["position"] - result.positions
        np.testing.assert_allclose(moved, [[0.01, 0, 0]] * 26, atol=1e-5)
        corrector.reset()
        np.testing.assert_array_equal(corrector.preview(ahead), ahead)

    def test_flesh_of_a_hand_of_ones_own(self) -> None:
        flesh = nade.Flesh(*hand_of_balls())
        positions, rotations = stroke(noise_m=0.0)
        drawn = nade.correct(positions, rotations, times(len(positions)), nade.Plane(), flesh=flesh)
        self.assertEqual(drawn.statuses[-1], nade.HandStatus.CORRECTED)

    def test_skin_is_flattened_where_it_is_sunk(self) -> None:
        mesh = hand_of_balls()
        skin, plane, scene = nade.Skin(*mesh), nade.Plane(), nade.Scene()
        scene.add(1, plane)
        vertices, normals = skin.pose(nade.rest_hand())
        np.testing.assert_allclose(vertices, mesh[1], atol=1e-6)
        np.testing.assert_allclose(normals, mesh[2], atol=1e-5)
        positions, rotations = stroke(noise_m=0.0)
        drawn = nade.correct(
            positions, rotations, times(len(positions)), plane, flesh=nade.Flesh(*mesh)
        )
        joints = nade.joints(drawn.positions[-1], drawn.rotations[-1])
        vertices, normals = skin.pose(joints)
        flat, turned = skin.flatten(joints, plane, vertices, normals)
        sunk = vertices[:, 1] < -0.001
        self.assertGreater(sunk.sum(), 5)
        self.assertGreater(flat[:, 1].min(), 0.0001)
        self.assertTrue((turned[sunk, 1] < -0.9).all())
        high = vertices[:, 1] > 0.0021
        np.testing.assert_array_equal(flat[high], vertices[high])
        for same in (
            skin.flatten(joints, scene, vertices, normals),
            skin.flatten(joints, plane, vertices, normals, nade.placement()),
        ):
            np.testing.assert_allclose(same[0], flat, atol=1e-6)
        soft, _ = skin.flatten(joints, plane, vertices, normals, give=0.001)
        self.assertAlmostEqual(float(soft[:, 1].min()), -0.0008, places=4)
        as_it_is, _ = skin.flatten(joints, None, vertices, normals)
        np.testing.assert_array_equal(as_it_is, vertices)

    def test_threads_share_a_mesh(self) -> None:
        mesh = nade.Mesh(*ball(0.15))
        placed = nade.placement([0, -0.15, 0])
        inputs = {side: stroke(side) for side in ("left", "right")}

        def run(side: str) -> np.ndarray:
            positions, rotations = inputs[side]
            when = times(len(positions))
            return nade.correct(positions, rotations, when, mesh, side, placement=placed).positions

        alone = {side: run(side) for side in inputs}
        together: dict[tuple[str, int], np.ndarray] = {}

        def run_often(side: str) -> None:
            for i in range(5):
                together[side, i] = run(side)

        threads = [threading.Thread(target=run_often, args=(side,)) for side in inputs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(together), 10)
        for (side, _), positions in together.items():
            np.testing.assert_array_equal(positions, alone[side])

    def test_threads_share_a_corrector(self) -> None:
        hands = nade.joints(*stroke())
        corrector = nade.Corrector()
        plane = nade.Plane()
        wrong: list[str] = []

        def run(first: int) -> None:
            for i in range(first, len(hands), 2):
                result = corrector.update(hands[i], plane, i * FRAME_NS)
                if not np.isfinite(result.positions).all():
                    wrong.append(f"frame {i}")

        threads = [threading.Thread(target=run, args=(first,)) for first in (0, 1)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


class Mistakes(unittest.TestCase):
    def test_the_sentence_names_the_argument(self) -> None:
        positions, rotations = stroke(frames=3)
        when = times(3)
        plane, hand = nade.Plane(), nade.rest_hand()
        scene = nade.Scene()
        scene.add(1, plane)
        one = nade.placement([0, 0, 0])
        correct, corrector = nade.correct, nade.Corrector()
        mesh = nade.Mesh(*ball(0.1))
        skin = nade.Skin(*hand_of_balls())
        at, up = skin.pose(hand)
        # Each a call, what it raises, and what its sentence has to say.
        cases: list[tuple[Any, type, str]] = [
            (lambda: nade.Sphere(-1), nade.NadeError, "radius_m: expected a number above 0"),
            (lambda: nade.Sphere("1"), TypeError, "radius: expected a number, found str"),
            (lambda: nade.Box([1, 2]), ValueError, r"half_size: .* \(3,\), found \(2,\)"),
            (lambda: nade.Box([1, 2, 3], math.nan), nade.NadeError, "rounding_m"),
            (lambda: nade.Plate([[0, 0], [1, 1]], 1), nade.NadeError, "count"),
            (lambda: nade.Hull(np.zeros((9, 3))), nade.NadeError, ""),
            (lambda: nade.HeightField([[0, 1], [2]], 1), ValueError, "heights: expected numbers"),
            (lambda: nade.Mesh([[0, 0, 0]], [[0, 1, 2]]), nade.NadeError, "triangle 0"),
            (lambda: nade.Mesh([[0, 0, 0]], [[0, 1, -2]]), ValueError, "triangles: .* from 0 to"),
            (lambda: nade.Mesh([[0, 0, 0]], [[0.5, 1, 2]]), TypeError, "triangles: .* whole"),
            (lambda: nade.Mesh(*ball(0.1), scale=[0, 0, 0]), ValueError, "scale: .* none 0"),
            (lambda: mesh.refit(np.zeros((3, 3))), nade.NadeError, "vertex_count"),
            (lambda: nade.Surface(), TypeError, "nade.Plane"),
            (lambda: scene.add(1, plane), nade.NadeError, "id"),
            (lambda: scene.add(-1, plane), ValueError, "id: expected a number from 0"),
            (lambda: scene.add(2.0, plane), TypeError, "id: expected a whole number"),
            (lambda: scene.add(2, scene), TypeError, "surface: expected a nade surface"),
            (lambda: scene.remove(7), nade.NadeError, "id"),
            (lambda: scene.place(1, [0, 0, 0]), TypeError, "placement: .* by nade.placement"),
            (lambda: scene.set_feel(1, nade.Feel(0.5)), nade.NadeError, "softness_m"),
            (lambda: scene.set_feel(1, 0.5), TypeError, "feel: expected a nade.Feel"),
            (lambda: nade.placement([[0, 0]]), ValueError, "position"),
            (
                lambda: nade.placement(np.zeros((2, 3)), np.ones((3, 4))),
                ValueError,
                "position, rotation, scale",
            ),
            (lambda: nade.Corrector("best"), ValueError, "method: .* none, paper, nade"),
            (lambda: nade.Corrector(release=2), nade.NadeError, "release_s"),
            (lambda: nade.Corrector(flesh=3), TypeError, "flesh: expected a nade.Flesh"),
            (lambda: skin.pose(hand, 0), nade.NadeError, "scale: expected a number above 0"),
            (lambda: skin.flatten(hand, plane, at[1:], up), ValueError, "vertices"),
            (lambda: skin.flatten(hand, plane, at, up * np.nan), nade.NadeError, "normals"),
            (lambda: skin.flatten(hand, plane, at, up, give=-1), nade.NadeError, "give_m"),
            (lambda: skin.flatten(hand, "plane", at, up), TypeError, "surface"),
            (lambda: skin.flatten(hand, scene, at, up, one), ValueError, "scene"),
            (lambda: nade.rest_hand("top"), ValueError, "side: expected one of left, right"),
            (lambda: corrector.update(hand, "plane", 0), TypeError, "surface"),
            (lambda: corrector.update(hand[:25], plane, 0), ValueError, r"joints: .* \(26,\)"),
            (lambda: corrector.update(positions[0], plane, 0), TypeError, "by nade.joints"),
            (lambda: corrector.update(hand, plane, 0.5), TypeError, "time_ns: .* whole"),
            (lambda: corrector.update(hand, plane, 2**63), ValueError, "time_ns"),
            (lambda: corrector.update(hand, scene, 0, placement=one), ValueError, "scene"),
            (lambda: corrector.update(hand, plane, 0, object_id=-1), ValueError, "object_id"),
            (lambda: correct(positions[0], rotations, when, plane), ValueError, "positions"),
            (
                lambda: correct(positions[:, :25], rotations, when, plane),
                ValueError,
                r"positions: expected the shape \(3, 26, 3\), found \(3, 25, 3\)",
            ),
            (lambda: correct(positions, rotations[:2], when, plane), ValueError, "rotations"),
            (lambda: correct(positions, rotations, when[:2], plane), ValueError, "times_ns"),
            (lambda: correct(positions, rotations, when * 1.0, plane), TypeError, "times_ns"),
            (lambda: correct(positions, rotations, when[::-1], plane), ValueError, "frame 1"),
            (
                lambda: correct(positions, rotations, when, plane, radii=[0.0] * 25),
                ValueError,
                "radii",
            ),
            (
                lambda: correct(positions, rotations, when, plane, placement=np.tile(one, 2)),
                ValueError,
                "placement: expected one, or one for each of 3 frames",
            ),
            (
                lambda: correct(positions.astype(str), rotations, when, plane),
                TypeError,
                "positions: expected real numbers",
            ),
        ]
        for call, kind, sentence in cases:
            with self.subTest(sentence), self.assertRaisesRegex(kind, sentence):
                call()

    def test_code_and_sentence(self) -> None:
        with self.assertRaises(nade.NadeError) as caught:
            nade.Sphere(math.nan)
        self.assertEqual(caught.exception.code, nade.ErrorCode.ARGUMENT)
        self.assertIn("radius_m", caught.exception.sentence)

    def test_placement_that_cannot_be(self) -> None:
        wrong = nade.placement([0, math.nan, 0])
        with self.assertRaisesRegex(nade.NadeError, "placement: position"):
            nade.Corrector().update(nade.rest_hand(), nade.Plane(), 0, placement=wrong)


class Recordings(Folder):
    HEADER = '{"format":"nade-recording","version":1,"source":"test"}\n'

    def write(self, text: str) -> pathlib.Path:
        path = self.folder / "made.jsonl"
        path.write_text(self.HEADER + text)
        return path

    def hand(self, **keys: Any) -> str:
        rest = nade.rest_hand()
        rows = np.concatenate([rest["position"], rest["rotation"], rest["radius"][:, None]], axis=1)
        return json.dumps({"t": 0, "right": {"joints": rows.astype(float).tolist(), **keys}})

    def assert_same(self, one: nade.Recording, other: nade.Recording) -> None:
        self.assertEqual(one.header, other.header)
        self.assertEqual(one.other, other.other)
        self.assertEqual(one.times_ns.tobytes(), other.times_ns.tobytes())
        for side in ("left", "right"):
            a, b = getattr(one, side), getattr(other, side)
            for name in ("positions", "rotations", "radii", "confidence"):
                self.assertEqual(getattr(a, name).tobytes(), getattr(b, name).tobytes(), name)
            self.assertEqual(a.other, b.other)

    def test_round_trip_is_bit_for_bit(self) -> None:
        made = recording()
        random = np.random.default_rng(3)
        made.right.positions += random.normal(0.0, 1e-3, made.right.positions.shape)
        made.right.positions[0, 3] = [-0.0, 5e-324, 1 / 3]
        made.header.update({"created": "2026-11-29T00:00:00Z", "own": {"ö": [1, 2.5, None]}})
        made.other[2] = {"head": [0, 1.6, 0.5, 0, 0, 0, 1], "mood": "good"}
        made.left.other[3] = {"status": "free", "contact": {}}
        for name in ("made.jsonl", "made.jsonl.gz"):
            path = self.folder / name
            nade.write_recording(path, made)
            self.assert_same(nade.read_recording(path), made)
        packed = (self.folder / "made.jsonl.gz").read_bytes()
        self.assertEqual(packed[:2], b"\x1f\x8b")
        nade.write_recording(path, made)
        self.assertEqual(path.read_bytes(), packed)
        self.assertEqual(len(list(self.folder.iterdir())), 2)

    @needs_program
    def test_the_program_reads_and_writes_the_same(self) -> None:
        made = recording()
        nade.write_recording(self.folder / "made.jsonl", made)
        command = [PROGRAM, "convert", "made.jsonl", "-o", "back.jsonl.gz"]
        subprocess.run(command, cwd=self.folder, check=True, capture_output=True)
        back = nade.read_recording(self.folder / "back.jsonl.gz")
        back.header.pop("hand_scale_known")
        self.assert_same(back, made)

    def test_mistakes_name_file_and_line(self) -> None:
        whole = self.hand()
        cases = [
            ("{\n", "line 2: expected JSON"),
            ('{"t":0}\n{"t":0}\n', "line 3: t: expected a time after 0"),
            ('{"t":0.5}\n', "line 2: t: .* whole nanoseconds"),
            ('{"t":5000000000000000000}\n', "line 2: t: expected a time up to"),
            ("[1]\n", "line 2: expected a frame, found a list"),
            ('{"t":0,"left":3}\n', "line 2: left: expected a hand, found a number"),
            ('{"t":0,"left":{}}\n', "line 2: left: joints: expected 26 joints, found none"),
            ('{"t":0,"left":{"joints":[[1,2]]}}\n', "line 2: left: joints: .* found 1"),
            (whole.replace("0.0, 0.0, 0.0,", "0.0, 0.0,", 1) + "\n", "joint 0: .* found 7"),
            (whole.replace("[0.0,", '["0.0",', 1) + "\n", "joint 0: .* found a string"),
            (whole.replace("[0.0,", "[true,", 1) + "\n", "joint 0: .* found true or false"),
            (whole.replace("[0.0,", "[2e6,", 1) + "\n", r"joint 0: .* up to 1e\+06"),
            (self.hand(confidence=2) + "\n", "line 2: right: confidence: .* found 2"),
        ]
        for text, sentence in cases:
            with self.subTest(sentence), self.assertRaisesRegex(
                nade.NadeError, "made.jsonl: .*" + sentence
            ) as caught:
                nade.read_recording(self.write(text))
            self.assertEqual(caught.exception.code, nade.ErrorCode.DATA)
        path = self.folder / "other.jsonl"
        for text, sentence in (
            ("", "line 1: expected a recording's header"),
            ('{"format":"other"}\n', "line 1: expected the format 'nade-recording'"),
            ('{"format":"nade-recording","version":2}\n', "line 1: expected the version 1"),
        ):
            path.write_text(text)
            with self.subTest(sentence), self.assertRaisesRegex(nade.NadeError, sentence):
                nade.read_recording(path)
        with self.assertRaises(FileNotFoundError):
            nade.read_recording(self.folder / "none.jsonl")

    def test_what_is_forgiven(self) -> None:
        rest = self.hand()
        unit = rest.replace("[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,", "[0, 0, 0, 0, 0, 0, 1.5,", 1)
        self.assertNotEqual(rest, unit)
        cases = [
            ("\n" + rest + "\r\n \n", 1, True, None),
            (rest, 1, True, None),
            (rest + "\n" + rest[:-30], 1, True, "cut off here; the line is left out"),
            (rest.replace("[0.0,", "[null,", 1) + "\n", 1, False, "the hand is left out"),
            (rest.replace("[0.0,", "[NaN,", 1) + "\n", 1, False, "the hand is left out"),
            (rest.replace("[0.0,", "[1e999,", 1) + "\n", 1, False, "the hand is left out"),
            (rest.replace("[0.0,", "[1.0,", 1) + "\n", 1, False, "half a metre"),
            (unit + "\n", 1, True, "not of unit length; it is made so"),
        ]
        for text, frames, tracked, warning in cases:
            with self.subTest(text[-20:]), warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                read = nade.read_recording(self.write(text))
                self.assertEqual(len(read), frames)
                self.assertEqual(read.right.is_tracked.tolist(), [tracked] * frames)
                said = " ".join(str(one.message) for one in caught)
                self.assertEqual(len(caught), 0 if warning is None else 1, said)
                self.assertIn(warning or "", said)
                if tracked:
                    norms = np.linalg.norm(read.right.rotations, axis=-1)
                    np.testing.assert_allclose(norms, 1.0, atol=1e-6)

    def test_cut_off_and_damaged_gzip(self) -> None:
        path = self.folder / "made.jsonl.gz"
        nade.write_recording(path, recording())
        data = path.read_bytes()
        path.write_bytes(data[: len(data) // 2])
        with self.assertWarnsRegex(nade.RecordingWarning, "cut off"):
            read = nade.read_recording(path)
        self.assertGreater(len(read), 10)
        np.testing.assert_array_equal(read.times_ns, times(len(read)))
        broken = bytearray(data)
        broken[len(data) // 2] ^= 0xFF
        path.write_bytes(bytes(broken))
        with self.assertRaisesRegex(nade.NadeError, "made.jsonl.gz: "):
            nade.read_recording(path)

    def test_what_cannot_be_written_leaves_what_was(self) -> None:
        path = self.folder / "made.jsonl"
        path.write_text("before")
        path.chmod(0o640)
        wrong = recording()
        wrong.left.radii[7] = -1.0
        with self.assertRaisesRegex(ValueError, "left: radii: frame 7"):
            nade.write_recording(path, wrong)
        partly = recording()
        partly.right.positions[9, 4, 0] = np.nan
        with self.assertRaisesRegex(ValueError, "right: positions: frame 9: .* finite"):
            nade.write_recording(path, partly)
        twice = recording()
        twice.times_ns[5] = twice.times_ns[4]
        with self.assertRaisesRegex(ValueError, "frame 5"):
            nade.write_recording(path, twice)
        odd = recording()
        odd.other[3] = {"mood": math.nan}
        with self.assertRaisesRegex(ValueError, "frame 3: expected keys that JSON can hold"):
            nade.write_recording(path, odd)
        self.assertEqual(path.read_text(), "before")
        self.assertEqual(len(list(self.folder.iterdir())), 1)
        link = self.folder / "link.jsonl"
        link.symlink_to(path)
        nade.write_recording(link, recording())
        self.assertTrue(link.is_symlink())
        self.assertEqual(len(nade.read_recording(path)), 150)
        self.assertEqual(path.stat().st_mode & 0o777, 0o640)

    def test_corrected(self) -> None:
        made = recording()
        feel = nade.Feel(softness_m=0.005, friction=0.5)
        drawn = nade.correct_recording(made, nade.Plane(), feel=feel)
        self.assertEqual(drawn.header["method"], "nade")
        self.assertEqual(drawn.header["tool"], f"nade {nade.__version__}")
        self.assertEqual(drawn.header["softness"], 0.005)
        self.assertEqual(drawn.right.other[149]["status"], "corrected")
        self.assertNotIn(65, drawn.right.other)
        np.testing.assert_array_equal(drawn.right.is_tracked, made.right.is_tracked)
        self.assertEqual(made.header, {"source": "test"})
        with self.assertRaisesRegex(ValueError, "found a corrected one"):
            nade.correct_recording(drawn, nade.Plane())


@needs_program
class CommandLine(Folder):
    """The program and the wheel give the same hands."""

    MOST_M = 1e-6

    def compare(self, surface: Any, name: str, placed: Optional[np.ndarray], at: Any) -> None:
        made = recording()
        moved = np.asarray(at, np.float32).astype(np.float64)
        for hand in (made.left, made.right):
            hand.positions[:] = (hand.positions + moved).astype(np.float32)
        tracked, corrected = self.folder / "tracked.jsonl", self.folder / "corrected.jsonl"
        nade.write_recording(tracked, made)
        command = [PROGRAM, "correct", str(tracked), "-o", str(corrected), "--object", name]
        subprocess.run(command, check=True, capture_output=True)
        wanted = nade.read_recording(corrected)
        found = nade.correct_recording(made, surface, placement=placed)
        for side in ("left", "right"):
            one, other = getattr(wanted, side), getattr(found, side)
            apart = np.linalg.norm(one.positions - other.positions, axis=-1)
            way = np.linalg.norm(one.positions - getattr(made, side).positions, axis=-1)
            largest = float(np.nanmax(apart))
            print(f"{os.path.basename(name)}, {side}: {1e6 * largest:.3f} um", file=sys.stderr)
            self.assertGreater(np.nanmax(way), 0.01)
            self.assertLess(largest, self.MOST_M)
            self.assertEqual(
                {i: keys["status"] for i, keys in one.other.items()},
                {i: keys["status"] for i, keys in other.other.items()},
            )

    def test_sphere(self) -> None:
        # A place that float32 has, so that both have the same ball.
        placed = nade.placement([0, -0.125, 0])
        self.compare(nade.Sphere(0.125), "sphere:0.125", placed, [0, 0, 0])

    def test_mesh(self) -> None:
        vertices, triangles = ball(0.2)
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.astype(np.float64).tolist()]
        lines += ["f " + " ".join(str(i + 1) for i in row) for row in triangles.tolist()]
        path = self.folder / "ball.obj"
        path.write_text("\n".join(lines) + "\n")
        self.compare(nade.Mesh(vertices, triangles), str(path), None, [0, 0.2, 0])

    @unittest.skipUnless(os.path.exists(DOG), "no NADE_TEST_DOG")
    def test_dog(self) -> None:
        dog = nade.Mesh(*read_dog(DOG))
        top = dog.closest_point([0.04, 0.6, 0.0]).point
        self.compare(dog, DOG, None, top)

    def test_measure(self) -> None:
        made = recording()
        tracked, corrected = self.folder / "tracked.jsonl.gz", self.folder / "corrected.jsonl.gz"
        nade.write_recording(tracked, made)
        nade.write_recording(corrected, nade.correct_recording(made, nade.Plane()))
        report = nade.measure(tracked, corrected, object="plane", program=PROGRAM)
        self.assertEqual(report["method"], "nade")
        self.assertGreater(report["pressing_frames"], 50)
        self.assertLess(report["excess_max_mm"], 3.0)
        with self.assertRaisesRegex(nade.NadeError, "--object"):
            nade.measure(tracked, corrected, program=PROGRAM)
        with self.assertRaisesRegex(FileNotFoundError, "expected the program nade"):
            nade.measure(tracked, corrected, program=self.folder / "none")


class Documents(Folder):
    def test_the_lines_of_the_readmes_run(self) -> None:
        for name in ("README.md", "python/README.md"):
            text = (ROOT / name).read_text()
            blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
            self.assertGreater(len(blocks), 0, name)
            for block in blocks:
                with self.subTest(block[:60]):
                    nade.write_recording(self.folder / "stroke.jsonl.gz", recording())
                    command = [sys.executable, "-c", block]
                    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
                    subprocess.run(command, cwd=self.folder, check=True, env=environment)

    def test_the_example_draws(self) -> None:
        try:
            importlib.import_module("matplotlib")
        except ImportError:
            self.skipTest("no matplotlib")
        example = ROOT / "python/examples/plot_stroke.py"
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        nade.write_recording(self.folder / "stroke.jsonl.gz", recording())
        for arguments in ([], ["stroke.jsonl.gz"]):
            picture = self.folder / "stroke.png"
            command = [sys.executable, str(example), *arguments, "-o", str(picture)]
            subprocess.run(command, cwd=self.folder, check=True, env=environment)
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
            picture.unlink()


if __name__ == "__main__":
    unittest.main()
