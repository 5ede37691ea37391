"""nade.h in Python: its structs and functions, as ctypes has them.

Nothing here is for users of the package. A struct or a function of nade.h that is added here is
checked by tests/test_nade.py against the header.
"""

from __future__ import annotations

import ctypes
import enum
import pathlib
import threading
import weakref
from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_int64, c_size_t
from ctypes import c_uint32, c_uint64, c_void_p
from typing import Any, Callable, Optional, Sequence

import numpy as np
import numpy.typing as npt

ABI_VERSION = 1
JOINT_COUNT = 26
MAX_CONTACTS = 16


class ErrorCode(enum.IntEnum):
    """What kind of error a `NadeError` is."""

    ARGUMENT = -1  #: not finite, or out of range
    HANDLE = -2  #: an object that was closed, or of another kind
    SIZE = -3  #: the package and its library do not fit each other
    ID = -4  #: an object's id is taken, or there is none of that id
    DATA = -5  #: a mesh, a hull, a height field, a file that cannot be used
    MEMORY = -6
    INTERNAL = -7  #: a bug in nade


class NadeError(Exception):
    """An error that nade tells: `code`, and one `sentence` that names the argument or the file."""

    def __init__(self, code: int, sentence: str) -> None:
        super().__init__(sentence)
        self.code = ErrorCode(code)
        self.sentence = sentence

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (int(self.code), self.sentence))


class Joint(ctypes.Structure):
    _fields_ = [("rotation", c_float * 4), ("position", c_float * 3), ("radius", c_float)]


class Placement(ctypes.Structure):
    _fields_ = [("rotation", c_float * 4), ("position", c_float * 3), ("scale", c_float)]


class Feel(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("reserved", c_uint32),
        ("softness_m", c_double),
        ("softness_depth_m", c_double),
        ("friction", c_double),
        ("friction_kinetic", c_double),
        ("longest_lag_m", c_double),
    ]


class CorrectorOptions(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("method", c_int32),
        ("release_s", c_double),
        ("hand_length_m", c_double),
        ("feel", POINTER(Feel)),
        ("left_flesh", c_void_p),
        ("right_flesh", c_void_p),
    ]


class Contact(ctypes.Structure):
    _fields_ = [
        ("object", c_uint64),
        ("bone", c_int32),
        ("depth_m", c_float),
        ("point", c_float * 3),
        ("normal", c_float * 3),
        ("velocity_mps", c_float * 3),
        ("reserved", c_uint32),
    ]


class Result(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("status", c_int32),
        ("fault", c_int32),
        ("contact_count", c_uint32),
        ("joints", Joint * JOINT_COUNT),
        ("velocity_mps", c_float * 3 * JOINT_COUNT),
        ("contacts", Contact * MAX_CONTACTS),
    ]


class Mesh(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("scale", c_float * 3),
        ("vertices", c_void_p),
        ("triangles", c_void_p),
    ]


class MeshReport(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("solid", c_int32),
        ("triangles_used", c_uint32),
        ("triangles_degenerate", c_uint32),
        ("triangles_duplicate", c_uint32),
        ("triangles_turned", c_uint32),
        ("border_edges", c_uint32),
        ("nonmanifold_edges", c_uint32),
    ]


class SurfacePoint(ctypes.Structure):
    _fields_ = [
        ("point", c_double * 3),
        ("normal", c_double * 3),
        ("signed_distance", c_double),
    ]


class GroupMember(ctypes.Structure):
    _fields_ = [("surface", c_void_p), ("placement", Placement)]


ClosestPoint = ctypes.CFUNCTYPE(
    c_int32, c_void_p, POINTER(c_double), c_double, POINTER(c_uint32), POINTER(SurfacePoint)
)
Shape = ctypes.CFUNCTYPE(c_uint64, c_void_p)
Bounds = ctypes.CFUNCTYPE(c_int32, c_void_p, POINTER(c_double), POINTER(c_double))
Release = ctypes.CFUNCTYPE(None, c_void_p)


class SurfaceCallbacks(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("reserved", c_uint32),
        ("user", c_void_p),
        ("closest_point", ClosestPoint),
        ("first_hit", c_void_p),
        ("shape", Shape),
        ("bounds", Bounds),
        ("release", Release),
    ]


class HandMesh(ctypes.Structure):
    _fields_ = [
        ("size", c_uint32),
        ("side", c_int32),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("vertices", c_void_p),
        ("normals", c_void_p),
        ("triangles", c_void_p),
        ("bones", c_void_p),
        ("weights", c_void_p),
        ("bind", c_void_p),
    ]


#: By name, the arguments of each function that returns a nade_status. Arrays are passed by address.
STATUS_FUNCTIONS: dict[str, Sequence[Any]] = {
    "nade_surface_create_plane": (POINTER(c_void_p),),
    "nade_surface_create_plate": (c_void_p, c_size_t, c_double, POINTER(c_void_p)),
    "nade_surface_create_sphere": (c_double, POINTER(c_void_p)),
    "nade_surface_create_ellipsoid": (c_void_p, POINTER(c_void_p)),
    "nade_surface_create_box": (c_void_p, c_double, POINTER(c_void_p)),
    "nade_surface_create_cylinder": (c_double, c_double, c_double, POINTER(c_void_p)),
    "nade_surface_create_capsule": (c_double, c_double, POINTER(c_void_p)),
    "nade_surface_create_hull": (c_void_p, c_size_t, POINTER(c_void_p)),
    "nade_surface_create_height_field": (
        c_void_p,
        c_size_t,
        c_size_t,
        c_double,
        POINTER(c_void_p),
    ),
    "nade_surface_create_mesh": (POINTER(Mesh), POINTER(MeshReport), POINTER(c_void_p)),
    "nade_surface_create_custom": (POINTER(SurfaceCallbacks), POINTER(c_void_p)),
    "nade_surface_create_group": (c_void_p, c_size_t, POINTER(c_void_p)),
    "nade_surface_place_member": (c_void_p, c_size_t, c_void_p),
    "nade_surface_refit": (c_void_p, c_void_p, c_size_t),
    "nade_surface_closest_point": (
        c_void_p,
        c_void_p,
        c_void_p,
        c_double,
        POINTER(SurfacePoint),
        POINTER(c_int32),
    ),
    "nade_surface_destroy": (c_void_p,),
    "nade_scene_create": (POINTER(c_void_p),),
    "nade_scene_add": (c_void_p, c_uint64, c_void_p, c_void_p, POINTER(Feel)),
    "nade_scene_place": (c_void_p, c_uint64, c_void_p),
    "nade_scene_deformed": (c_void_p, c_uint64),
    "nade_scene_set_feel": (c_void_p, c_uint64, POINTER(Feel)),
    "nade_scene_remove": (c_void_p, c_uint64),
    "nade_scene_size": (c_void_p, POINTER(c_size_t)),
    "nade_scene_destroy": (c_void_p,),
    "nade_rest_hand": (c_int32, c_void_p),
    "nade_flesh_create": (POINTER(HandMesh), POINTER(c_void_p)),
    "nade_flesh_destroy": (c_void_p,),
    "nade_corrector_options_init": (POINTER(CorrectorOptions),),
    "nade_corrector_create": (POINTER(CorrectorOptions), POINTER(c_void_p)),
    "nade_corrector_update": (
        c_void_p,
        c_int32,
        c_void_p,
        c_void_p,
        c_void_p,
        c_uint64,
        c_int64,
        c_void_p,
    ),
    "nade_corrector_update_scene": (c_void_p, c_int32, c_void_p, c_void_p, c_int64, c_void_p),
    "nade_corrector_preview": (c_void_p, c_int32, c_void_p, c_void_p),
    "nade_corrector_set_feel": (c_void_p, POINTER(Feel)),
    "nade_corrector_reset": (c_void_p,),
    "nade_corrector_destroy": (c_void_p,),
    "nade_skin_create": (POINTER(HandMesh), POINTER(c_void_p)),
    "nade_skin_pose": (c_void_p, c_void_p, c_double, c_void_p, c_void_p, c_size_t),
    "nade_skin_flatten": (
        c_void_p,
        c_void_p,
        c_double,
        c_void_p,
        c_void_p,
        c_double,
        c_void_p,
        c_void_p,
        c_size_t,
    ),
    "nade_skin_flatten_scene": (
        c_void_p,
        c_void_p,
        c_double,
        c_void_p,
        c_double,
        c_void_p,
        c_void_p,
        c_size_t,
    ),
    "nade_skin_destroy": (c_void_p,),
}


def _load() -> ctypes.CDLL:
    path = pathlib.Path(__file__).with_name("libnade.so")
    try:
        loaded = ctypes.CDLL(str(path))
    except OSError as error:
        raise ImportError(f"{path}: expected the library that the wheel brings: {error}") from error
    loaded.nade_abi_version.restype = c_uint32
    found = loaded.nade_abi_version()
    if found != ABI_VERSION:
        raise ImportError(f"{path}: expected version {ABI_VERSION} of the interface, found {found}")
    for name, arguments in STATUS_FUNCTIONS.items():
        function = getattr(loaded, name)
        function.argtypes = list(arguments)
        function.restype = c_int32
    for name in ("nade_version", "nade_last_error"):
        getattr(loaded, name).restype = c_char_p
    loaded.nade_fault_text.argtypes = [c_int32]
    loaded.nade_fault_text.restype = c_char_p
    return loaded


library = _load()


#: What a function of the user's raised inside a call of the library, on each thread.
raised = threading.local()


def check(status: int) -> None:
    """Raises the error of the call that was just made on this thread, if it failed."""
    error = raised.__dict__.pop("error", None)
    if error is not None:
        raise error
    if status == 0:
        return
    raise NadeError(status, library.nade_last_error().decode("utf-8", "replace"))


class Owner:
    """Has a handle of the library, and gives it back when nothing refers to it any more."""

    _handle: int
    _finalizer: Callable[[], Any]

    def _own(self, create: Callable[..., int], destroy: Callable[[int], int], *given: Any) -> None:
        handle = c_void_p()
        check(create(*given, ctypes.byref(handle)))
        assert handle.value is not None
        self._handle = handle.value
        self._finalizer = weakref.finalize(self, destroy, handle.value)

    def __copy__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} cannot be copied")

    def __deepcopy__(self, memo: Any) -> Any:
        raise TypeError(f"a {type(self).__name__} cannot be copied")

    def __reduce__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} cannot be pickled")


def numbers(
    name: str, values: Any, shape: Sequence[Optional[int]], dtype: npt.DTypeLike
) -> np.ndarray[Any, Any]:
    """`values` as an array of `dtype`, one piece of memory; None in `shape` is any length.

    Numbers that are too large for the type become infinite, which the library refuses by name.
    """
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name}: expected numbers in equal rows: {error}") from error
    wanted = np.dtype(dtype)
    kinds = "iu" if wanted.kind in "iu" else "iuf"
    if array.dtype.kind not in kinds and array.size > 0:
        what = "whole numbers" if kinds == "iu" else "real numbers"
        raise TypeError(f"{name}: expected {what}, found {array.dtype}")
    if len(array.shape) != len(shape) or any(
        length is not None and length != found for length, found in zip(shape, array.shape)
    ):
        text = ", ".join("any" if length is None else str(length) for length in shape)
        comma = "," if len(shape) == 1 else ""
        raise ValueError(f"{name}: expected the shape ({text}{comma}), found {array.shape}")
    if wanted.kind in "iu" and array.size > 0:
        limits = np.iinfo(wanted)
        if int(array.min()) < limits.min or int(array.max()) > limits.max:
            raise ValueError(f"{name}: expected numbers from {limits.min} to {limits.max}")
    with np.errstate(over="ignore", invalid="ignore"):
        return np.ascontiguousarray(array, dtype=wanted)


def number(name: str, value: Any) -> float:
    """A real number, or a TypeError that names it."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.number)):
        raise TypeError(f"{name}: expected a number, found {type(value).__name__}")
    return float(value)


def whole(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in a range, or an error that names it."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: expected a whole number, found {type(value).__name__}")
    if not least <= value <= most:
        raise ValueError(f"{name}: expected a number from {least} to {most}, found {value}")
    return int(value)


SIDES = {"left": 0, "right": 1}
METHODS = {"none": 0, "paper": 1, "nade": 2}


def choice(name: str, value: Any, choices: dict[str, int]) -> int:
    """What the library calls one of its names."""
    if isinstance(value, str) and value in choices:
        return choices[value]
    raise ValueError(f"{name}: expected one of {', '.join(choices)}, found {value!r}")
