"""What a hand may touch: surfaces, where they stand, how they feel, and scenes of many."""

from __future__ import annotations

import ctypes
import dataclasses
import itertools
from typing import Any, Callable, NamedTuple, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._library import Owner, check, library, number, numbers, whole

#: A placement: quaternion x y z w, position in metres, scale. 32 bytes, as nade.h has it.
PLACEMENT = np.dtype(_library.Placement)

_MOST_ID = 2**64 - 1


def placement(
    position: npt.ArrayLike = (0, 0, 0),
    rotation: npt.ArrayLike = (0, 0, 0, 1),
    scale: npt.ArrayLike = 1,
) -> npt.NDArray[Any]:
    """Where an object stands, or where it stands in each of F frames.

    `position` (3,) or (F, 3), metres, world; `rotation` (4,) or (F, 4), quaternions x y z w;
    `scale` () or (F,), above 0, and 0 where the object is hidden. Gives an array of `PLACEMENT`, ()
    or (F,).
    """
    at, turn, size = np.asarray(position), np.asarray(rotation), np.asarray(scale)
    at = numbers("position", at, (None,) * (at.ndim - 1) + (3,), np.float32)
    turn = numbers("rotation", turn, (None,) * (turn.ndim - 1) + (4,), np.float32)
    size = numbers("scale", size, (None,) * size.ndim, np.float32)
    try:
        shape = np.broadcast_shapes(at.shape[:-1], turn.shape[:-1], np.shape(scale))
    except ValueError:
        raise ValueError(
            "position, rotation, scale: expected one of each, or as many of each, found "
            f"{at.shape[:-1]}, {turn.shape[:-1]}, {np.shape(scale)}"
        ) from None
    made = np.empty(shape, PLACEMENT)
    made["position"], made["rotation"], made["scale"] = at, turn, size.reshape(np.shape(scale))
    return made


def placements(
    given: Optional[npt.NDArray[Any]], count: Optional[int]
) -> Optional[npt.NDArray[Any]]:
    """`given` in one piece of memory: one placement, or where `count` is given as many."""
    if given is None:
        return None
    # One of an array of placements is a np.void.
    if not isinstance(given, (np.ndarray, np.void)) or given.dtype != PLACEMENT:
        raise TypeError(
            f"placement: expected one by nade.placement, found {type(given).__name__}"
            + (f" of {given.dtype}" if isinstance(given, np.ndarray) else "")
        )
    if given.shape != () and given.shape != (count,):
        expected = "one" if count is None else f"one, or one for each of {count} frames"
        raise ValueError(f"placement: expected {expected}, found the shape {given.shape}")
    # ascontiguousarray would make an array of one of a single placement.
    return np.array(given, order="C")


@dataclasses.dataclass(frozen=True)
class Feel:
    """What an object is like under the hand. The defaults: hard, without friction."""

    softness_m: float = 0.0  #: the skin sinks in so far at the most, 0 to 0.02
    softness_depth_m: float = 0.02  #: pressing so deep sinks by two thirds of that, above 0
    friction: float = 0.0  #: lag over pressing depth at which the hand slips, 0 to 2
    friction_kinetic: float = 0.6  #: share of the lag that is left while it slips, 0 to 1
    longest_lag_m: float = 0.03  #: whatever the depth

    def _struct(self) -> _library.Feel:
        struct = _library.Feel(size=ctypes.sizeof(_library.Feel))
        for field in dataclasses.fields(self):
            setattr(struct, field.name, number(field.name, getattr(self, field.name)))
        return struct


def feel_pointer(feel: Optional[Feel]) -> Any:
    """For a call; NULL where there is none."""
    if feel is None:
        return None
    if not isinstance(feel, Feel):
        raise TypeError(f"feel: expected a nade.Feel, found {type(feel).__name__}")
    return ctypes.pointer(feel._struct())


class SurfacePoint(NamedTuple):
    """The point of a surface nearest to a query, in world coordinates."""

    point: npt.NDArray[np.float64]  #: (3,), metres
    normal: npt.NDArray[np.float64]  #: (3,), unit, out of the solid
    signed_distance: float  #: of the query, metres; negative inside the solid


class Surface(Owner):
    """Something to stroke, in its own frame: +Y up, metres. Make one of the classes below.

    Any number of threads may correct hands on a surface, while none refits it.
    """

    def __init__(self) -> None:
        raise TypeError("expected a surface of a kind: nade.Plane, nade.Sphere, nade.Mesh, ...")

    def _make(self, kind: str, *given: Any) -> None:
        create = getattr(library, f"nade_surface_create_{kind}")
        self._own(create, library.nade_surface_destroy, *given)

    def closest_point(
        self,
        query: npt.ArrayLike,
        max_distance: float = float("inf"),
        placement: Optional[npt.NDArray[Any]] = None,
    ) -> Optional[SurfacePoint]:
        """The point nearest to `query` (3,), metres, world; None beyond `max_distance`."""
        at = numbers("query", query, (3,), np.float64)
        placed = placements(placement, None)
        point, found = _library.SurfacePoint(), ctypes.c_int32()
        check(
            library.nade_surface_closest_point(
                self._handle,
                None if placed is None else placed.ctypes.data,
                at.ctypes.data,
                number("max_distance", max_distance),
                ctypes.byref(point),
                ctypes.byref(found),
            )
        )
        if not found.value:
            return None
        return SurfacePoint(np.array(point.point), np.array(point.normal), point.signed_distance)


class Plane(Surface):
    """The half-space below y = 0."""

    def __init__(self) -> None:
        self._make("plane")


class Plate(Surface):
    """A flat plate, as the planes of a room come.

    Its top is the part of the plane y = 0 within `outline` (N, 2): x and z of each of N >= 3
    corners, metres, in either order around, not crossing itself. Solid for `thickness` > 0 below.
    """

    def __init__(self, outline: npt.ArrayLike, thickness: float) -> None:
        corners = numbers("outline", outline, (None, 2), np.float32)
        self._make("plate", corners.ctypes.data, len(corners), number("thickness", thickness))


class Sphere(Surface):
    """A ball about the origin; `radius` in metres, above 0."""

    def __init__(self, radius: float) -> None:
        self._make("sphere", number("radius", radius))


class Ellipsoid(Surface):
    """An ellipsoid about the origin; `half_axes` (3,) in metres, all above 0."""

    def __init__(self, half_axes: npt.ArrayLike) -> None:
        axes = numbers("half_axes", half_axes, (3,), np.float64)
        self._make("ellipsoid", axes.ctypes.data)


class Box(Surface):
    """A box about the origin.

    `half_size` (3,) in metres, above 0, with the rounding; `rounding` of its edges, from 0 to the
    smallest of it.
    """

    def __init__(self, half_size: npt.ArrayLike, rounding: float = 0.0) -> None:
        size = numbers("half_size", half_size, (3,), np.float64)
        self._make("box", size.ctypes.data, number("rounding", rounding))


class Cylinder(Surface):
    """A cylinder about the Y axis, its middle in the origin.

    `half_height` and `radius` in metres, above 0; `rounding` of its rims, from 0 to the smaller.
    """

    def __init__(self, half_height: float, radius: float, rounding: float = 0.0) -> None:
        self._make(
            "cylinder",
            number("half_height", half_height),
            number("radius", radius),
            number("rounding", rounding),
        )


class Capsule(Surface):
    """What is within `radius` > 0 of a line of `length` >= 0 along Y, its middle in the origin."""

    def __init__(self, length: float, radius: float) -> None:
        self._make("capsule", number("length", length), number("radius", radius))


class Hull(Surface):
    """The smallest convex solid with all `points` (N, 3) in it, metres; not all in a plane."""

    def __init__(self, points: npt.ArrayLike) -> None:
        corners = numbers("points", points, (None, 3), np.float32)
        self._make("hull", corners.ctypes.data, len(corners))


class HeightField(Surface):
    """A ground of `heights` (R, C), metres, about the origin, solid below.

    Rows go along +Z, columns along +X, both `step` > 0 metres apart; R and C are 2 or more.
    """

    def __init__(self, heights: npt.ArrayLike, step: float) -> None:
        field = numbers("heights", heights, (None, None), np.float32)
        rows, columns = field.shape
        self._make("height_field", field.ctypes.data, columns, rows, number("step", step))


@dataclasses.dataclass(frozen=True)
class MeshReport:
    """What was found, and mended, in a mesh."""

    solid: str  #: "closed"; "defective": with holes or doubled parts; "sheet": open, solid behind
    triangles_used: int
    triangles_degenerate: int  #: without area; left out
    triangles_duplicate: int  #: the same three corners again; left out
    triangles_turned: int  #: wound against their neighbours; turned
    border_edges: int  #: edges with one triangle
    nonmanifold_edges: int  #: edges with more than two


class Mesh(Surface):
    """A triangle mesh.

    `vertices` (V, 3) in metres; `triangles` (T, 3), indices of vertices, counter-clockwise seen
    from outside; `scale` (3,) along x, y and z, none 0. `report` says what was mended. About a second
    for a million triangles.
    """

    report: MeshReport

    def __init__(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        scale: npt.ArrayLike = (1, 1, 1),
    ) -> None:
        corners = numbers("vertices", vertices, (None, 3), np.float32)
        indices = numbers("triangles", triangles, (None, 3), np.uint32)
        sizes = numbers("scale", scale, (3,), np.float32)
        # All 0 stands for 1, 1, 1 in the struct; from here it would be a mistake.
        if not sizes.all():
            raise ValueError(f"scale: expected three numbers, none 0, found {sizes.tolist()}")
        mesh = _library.Mesh(
            size=ctypes.sizeof(_library.Mesh),
            vertex_count=len(corners),
            triangle_count=len(indices),
            vertices=corners.ctypes.data,
            triangles=indices.ctypes.data,
        )
        mesh.scale[:] = sizes.tolist()
        found = _library.MeshReport(size=ctypes.sizeof(_library.MeshReport))
        self._make("mesh", ctypes.byref(mesh), ctypes.byref(found))
        self.report = MeshReport(
            solid=("closed", "defective", "sheet")[found.solid],
            **{
                field.name: getattr(found, field.name)
                for field in dataclasses.fields(MeshReport)[1:]
            },
        )

    def refit(self, vertices: npt.ArrayLike) -> None:
        """New positions (V, 3) for the vertices that it was made of; its scale is applied.

        0.02 ms for a thousand triangles. A scene that has the mesh is told by `Scene.deformed`.
        """
        corners = numbers("vertices", vertices, (None, 3), np.float32)
        check(library.nade_surface_refit(self._handle, corners.ctypes.data, len(corners)))


class Group(Surface):
    """Up to 255 surfaces as one, such as the parts of a thing.

    `members` are surfaces, or pairs of a surface and where it stands in the group, by
    `nade.placement`. For more, or where several move, a `Scene` is faster.
    """

    def __init__(self, members: Sequence[Union[Surface, tuple[Surface, npt.NDArray[Any]]]]) -> None:
        made = (_library.GroupMember * len(members))()
        for entry, member in zip(made, members):
            surface, placed = member if isinstance(member, tuple) else (member, placement())
            entry.surface = handle_of(surface)
            one = placements(placed, None)
            if one is None:
                one = placement()
            ctypes.memmove(ctypes.byref(entry.placement), one.ctypes.data, PLACEMENT.itemsize)
        self._make("group", ctypes.addressof(made), len(members))

    def place(self, index: int, placement: Optional[npt.NDArray[Any]]) -> None:
        """Moves a member, counted from 0."""
        placed = placements(placement, None)
        address = None if placed is None else placed.ctypes.data
        number = whole("index", index, 0, _MOST_ID)
        check(library.nade_surface_place_member(self._handle, number, address))


class Custom(Surface):
    """A surface of your own, in its own frame, by functions.

    `closest_point(query, max_distance)` gets a point (3,) and a distance, which may be infinite, and
    gives the nearest point of the surface that is no farther: a `SurfacePoint`, or a tuple like
    one; or None. `bounds()`, if given, is the low and the high corner of a box that all of the
    surface is in: a scene then asks only where a hand is near. `shape()`, if given, is another
    number whenever the surface has another shape. They are called hundreds of times a frame, so a
    hand takes milliseconds. What they raise comes out of the call that asked.
    """

    def __init__(
        self,
        closest_point: Callable[..., Any],
        bounds: Optional[Callable[[], Any]] = None,
        shape: Optional[Callable[[], int]] = None,
    ) -> None:
        for name, function in (("bounds", bounds), ("shape", shape)):
            if function is not None and not callable(function):
                raise TypeError(f"{name}: expected a function, found {type(function).__name__}")
        if not callable(closest_point):
            found = type(closest_point).__name__
            raise TypeError(f"closest_point: expected a function, found {found}")

        def nearest(_: Any, query: Any, farthest: float, hint: Any, out: Any) -> int:
            answer = closest_point(np.array(query[:3]), farthest)
            if answer is None:
                return 0
            point, normal, distance = answer
            out[0].point[:] = numbers("closest_point: point", point, (3,), np.float64).tolist()
            out[0].normal[:] = numbers("closest_point: normal", normal, (3,), np.float64).tolist()
            out[0].signed_distance = number("closest_point: signed distance", distance)
            return 1

        def box(_: Any, low: Any, high: Any) -> int:
            assert bounds is not None
            corners = numbers("bounds", bounds(), (2, 3), np.float64).tolist()
            for axis in range(3):
                low[axis], high[axis] = corners[0][axis], corners[1][axis]
            return 1

        def version(_: Any) -> int:
            assert shape is not None
            return whole("shape", shape(), 0, _MOST_ID)

        key = next(_keys)
        callbacks = _library.SurfaceCallbacks(
            size=ctypes.sizeof(_library.SurfaceCallbacks),
            user=key,
            closest_point=_library.ClosestPoint(_told(nearest)),
            release=_release,
        )
        if bounds is not None:
            callbacks.bounds = _library.Bounds(_told(box))
        if shape is not None:
            callbacks.shape = _library.Shape(_told(version))
        _kept[key] = callbacks
        try:
            self._make("custom", ctypes.byref(callbacks))
        except BaseException:
            del _kept[key]
            raise


#: The functions of custom surfaces, as long as the library may call them.
_kept: dict[int, _library.SurfaceCallbacks] = {}
_keys = itertools.count(1)


@_library.Release
def _release(key: int) -> None:
    _kept.pop(key, None)


def _told(function: Callable[..., int]) -> Callable[..., int]:
    """The function; what it raises is kept for `check`, and counts as no answer."""

    def call(*given: Any) -> int:
        try:
            return function(*given)
        except BaseException as error:
            _library.raised.error = error
            return 0

    return call


def handle_of(surface: Any) -> int:
    if isinstance(surface, Surface):
        return surface._handle
    raise TypeError(f"surface: expected a nade surface, found {type(surface).__name__}")


class Scene(Owner):
    """All objects that a hand may touch, hundreds of them, by ids of your own (0 to 2^64 - 1).

    What is farther than 0.3 m from a hand costs next to nothing and changes nothing. Any number of
    threads may correct hands on a scene, while none changes it. `len` is the number of objects.
    """

    def __init__(self) -> None:
        self._own(library.nade_scene_create, library.nade_scene_destroy)

    def add(
        self,
        id: int,
        surface: Surface,
        placement: Optional[npt.NDArray[Any]] = None,
        feel: Optional[Feel] = None,
    ) -> None:
        """One more object; several may share a surface. An id that is taken is an error."""
        placed = placements(placement, None)
        check(
            library.nade_scene_add(
                self._handle,
                whole("id", id, 0, _MOST_ID),
                handle_of(surface),
                None if placed is None else placed.ctypes.data,
                feel_pointer(feel),
            )
        )

    def place(self, id: int, placement: Optional[npt.NDArray[Any]]) -> None:
        """Moves, turns or scales an object, in any frame."""
        placed = placements(placement, None)
        address = None if placed is None else placed.ctypes.data
        check(library.nade_scene_place(self._handle, whole("id", id, 0, _MOST_ID), address))

    def deformed(self, id: int) -> None:
        """The object's mesh was refitted."""
        check(library.nade_scene_deformed(self._handle, whole("id", id, 0, _MOST_ID)))

    def set_feel(self, id: int, feel: Optional[Feel]) -> None:
        """How the object feels from the next frame on; None: the defaults."""
        pointer = feel_pointer(feel)
        check(library.nade_scene_set_feel(self._handle, whole("id", id, 0, _MOST_ID), pointer))

    def remove(self, id: int) -> None:
        """A hand on the object comes back slowly to where the person is."""
        check(library.nade_scene_remove(self._handle, whole("id", id, 0, _MOST_ID)))

    def __len__(self) -> int:
        size = ctypes.c_size_t()
        check(library.nade_scene_size(self._handle, ctypes.byref(size)))
        return size.value

    def __bool__(self) -> bool:
        """A scene without objects is one nonetheless."""
        return True
