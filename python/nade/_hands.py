"""Hands, and the corrector that keeps them on surfaces."""

from __future__ import annotations

import ctypes
import dataclasses
import enum
import threading
from typing import Any, Callable, ClassVar, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _library
from ._library import JOINT_COUNT, METHODS, SIDES, Owner, check, choice, library, number, numbers
from ._library import whole
from ._surfaces import Feel, Scene, Surface, feel_pointer, handle_of, placements

#: A joint: rotation (4,) x y z w, position (3,) in metres, radius in metres. 32 bytes.
JOINT = np.dtype(_library.Joint)
#: Skin of one bone that touches: object, bone (index of the joint at its base), depth_m, point
#: (3,), normal (3,), velocity_mps (3,), as nade.h has it.
CONTACT = np.dtype(_library.Contact)
_RESULT = np.dtype(_library.Result)

#: The names of the 26 joints, in their order: that of XrHandJointEXT.
JOINT_NAMES = (
    "palm",
    "wrist",
    *(f"thumb_{part}" for part in ("metacarpal", "proximal", "distal", "tip")),
    *(
        f"{finger}_{part}"
        for finger in ("index", "middle", "ring", "little")
        for part in ("metacarpal", "proximal", "intermediate", "distal", "tip")
    ),
)


class HandStatus(enum.IntEnum):
    """What became of a tracked hand."""

    FREE = 0  #: nothing touched: the tracked hand, bit for bit
    CORRECTED = 1  #: some part rests on an object, or is braked to land on it
    RELEASED = 2  #: nothing touched any more, what was left of a correction fades
    UNTRACKED = 3  #: the hand could not be used, see `Fault`: as it was passed


class Fault(enum.IntEnum):
    """Why a hand could not be used."""

    NONE = 0
    NOT_FINITE = 1  #: a number of a joint is not finite
    ROTATION_NOT_UNIT = 2  #: a rotation's length is not 0.5 to 2
    WRIST_FAR = 3  #: the wrist is 1000 km or more from the origin
    JOINT_FAR = 4  #: a joint is half a metre or more from the wrist
    NO_LENGTH = 5  #: wrist and middle knuckle less than a millimetre apart


def joints(
    positions: npt.ArrayLike, rotations: npt.ArrayLike, radii: Optional[npt.ArrayLike] = None
) -> npt.NDArray[Any]:
    """Hands as the library has them: an array of `JOINT`, (26,) or (F, 26).

    `positions` (26, 3) or (F, 26, 3), metres, world; `rotations` (26, 4) or (F, 26, 4), quaternions
    x y z w; `radii` (26,) or (F, 26), joint to skin in metres, 0 where unknown.
    """
    at = np.asarray(positions)
    frames = at.shape[:-2]
    if len(frames) > 1:
        raise ValueError(f"positions: expected the shape (any, 26, 3), found {at.shape}")
    at = numbers("positions", at, (*frames, JOINT_COUNT, 3), np.float32)
    made = np.zeros((*frames, JOINT_COUNT), JOINT)
    made["position"] = at
    made["rotation"] = numbers("rotations", rotations, (*frames, JOINT_COUNT, 4), np.float32)
    if radii is not None:
        made["radius"] = numbers("radii", radii, (*frames, JOINT_COUNT), np.float32)
    return made


def rest_hand(side: str = "right") -> npt.NDArray[Any]:
    """The built-in hand at rest, (26,) of `JOINT`, of an adult's size.

    The palm joint is in the origin, palm down, fingers along -Z; radii are 0.
    """
    made = np.zeros(JOINT_COUNT, JOINT)
    check(library.nade_rest_hand(choice("side", side, SIDES), made.ctypes.data))
    return made


def _one_hand(given: Any) -> npt.NDArray[Any]:
    if not isinstance(given, np.ndarray) or given.dtype != JOINT:
        found = (
            f"an array of {given.dtype}" if isinstance(given, np.ndarray) else type(given).__name__
        )
        raise TypeError(f"joints: expected a hand by nade.joints, found {found}")
    if given.shape != (JOINT_COUNT,):
        raise ValueError(f"joints: expected the shape ({JOINT_COUNT},), found {given.shape}")
    return np.ascontiguousarray(given)


class _MeasuredMesh(Owner):
    """What the library makes of a hand mesh, which `Flesh` describes."""

    side: str
    vertex_count: int
    _create: ClassVar[Callable[..., int]]
    _destroy: ClassVar[Callable[[int], int]]

    def __init__(
        self,
        side: str,
        vertices: npt.ArrayLike,
        normals: npt.ArrayLike,
        triangles: npt.ArrayLike,
        bones: npt.ArrayLike,
        weights: npt.ArrayLike,
        bind: npt.NDArray[Any],
    ) -> None:
        number_of_side = choice("side", side, SIDES)
        at = numbers("vertices", vertices, (None, 3), np.float32)
        up = numbers("normals", normals, (len(at), 3), np.float32)
        corners = numbers("triangles", triangles, (None, 3), np.uint32)
        on = numbers("bones", bones, (len(at), 4), np.uint8)
        shares = numbers("weights", weights, (len(at), 4), np.float32)
        pose = _one_hand(bind)
        mesh = _library.HandMesh(
            size=ctypes.sizeof(_library.HandMesh),
            side=number_of_side,
            vertex_count=len(at),
            triangle_count=len(corners),
            vertices=at.ctypes.data,
            normals=up.ctypes.data,
            triangles=corners.ctypes.data,
            bones=on.ctypes.data,
            weights=shares.ctypes.data,
            bind=pose.ctypes.data,
        )
        self._own(self._create, self._destroy, ctypes.byref(mesh))
        self.side = side
        self.vertex_count = len(at)
        self._lock = threading.Lock()


class Flesh(_MeasuredMesh):
    """What can touch of a hand that you draw yourself: its skin, measured once.

    The mesh is in its bind pose, metres: `vertices` and unit `normals` (V, 3), `triangles` (T, 3),
    `bones` (V, 4) as indices of joints, `weights` (V, 4), 0 or more, `bind` (26,) of `JOINT`. Takes
    a fraction of a second.
    """

    _create = library.nade_flesh_create
    _destroy = library.nade_flesh_destroy


class Skin(_MeasuredMesh):
    """The skin of a hand as it is drawn, flattened where its flesh is sunk in an object.

    The mesh as for `Flesh`. One for each hand that is drawn, and one thread at a time.
    """

    _create = library.nade_skin_create
    _destroy = library.nade_skin_destroy

    def pose(
        self, joints: npt.NDArray[Any], scale: float = 1.0
    ) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Where `joints` (26,) of `JOINT` carry vertices and normals, each (V, 3).

        `scale` is the size of what is drawn over the mesh's own: 1 where its bones are merely put
        where the joints are.
        """
        hand, size = _one_hand(joints), number("scale", scale)
        vertices = np.zeros((self.vertex_count, 3), np.float32)
        normals = np.zeros_like(vertices)
        check(
            library.nade_skin_pose(
                self._handle,
                hand.ctypes.data,
                size,
                vertices.ctypes.data,
                normals.ctypes.data,
                self.vertex_count,
            )
        )
        return vertices, normals

    def flatten(
        self,
        joints: npt.NDArray[Any],
        surface: Union[Surface, Scene, None],
        vertices: npt.ArrayLike,
        normals: npt.ArrayLike,
        placement: Optional[npt.NDArray[Any]] = None,
        scale: float = 1.0,
        give: float = 0.0,
    ) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Posed vertices and normals, moved out of a surface or of all that is in a scene.

        What is 2 mm above it or more stays bit for bit. `give`, metres: the object is drawn pressed
        in by so much under the hand; 0 where it is drawn as it is.
        """
        hand, size, pressed = _one_hand(joints), number("scale", scale), number("give", give)
        shape = (self.vertex_count, 3)
        at = numbers("vertices", vertices, shape, np.float32).copy()
        up = numbers("normals", normals, shape, np.float32).copy()
        skin = (at.ctypes.data, up.ctypes.data, self.vertex_count)
        placed = placements(placement, None)
        with self._lock:
            if isinstance(surface, Scene):
                if placed is not None:
                    raise ValueError("placement: expected none beside a scene, which has its own")
                flatten = library.nade_skin_flatten_scene
                check(flatten(self._handle, hand.ctypes.data, size, surface._handle, pressed, *skin))
            else:
                touched = None if surface is None else handle_of(surface)
                place = None if placed is None else placed.ctypes.data
                flatten = library.nade_skin_flatten
                check(flatten(self._handle, hand.ctypes.data, size, touched, place, pressed, *skin))
        return at, up


@dataclasses.dataclass(frozen=True)
class Result:
    """A corrected hand, in the tracked hand's frame."""

    joints: npt.NDArray[Any]  #: (26,) of `JOINT`, to draw
    status: HandStatus
    fault: Fault
    velocities: npt.NDArray[np.float32]  #: (26, 3), of the drawn joints, m/s
    contacts: npt.NDArray[Any]  #: (up to 16,) of `CONTACT`, at most one of each bone

    @property
    def positions(self) -> npt.NDArray[np.float32]:
        """(26, 3), metres."""
        return self.joints["position"]

    @property
    def rotations(self) -> npt.NDArray[np.float32]:
        """(26, 4), quaternions x y z w."""
        return self.joints["rotation"]

    @property
    def radii(self) -> npt.NDArray[np.float32]:
        """(26,), metres, as they were passed."""
        return self.joints["radius"]


@dataclasses.dataclass(frozen=True)
class Correction:
    """A hand in F frames, corrected, in the tracked hand's frame."""

    positions: npt.NDArray[np.floating[Any]]  #: (F, 26, 3), metres
    rotations: npt.NDArray[np.floating[Any]]  #: (F, 26, 4), quaternions x y z w
    velocities: npt.NDArray[np.float32]  #: (F, 26, 3), of the drawn joints, m/s
    statuses: npt.NDArray[np.int32]  #: (F,), of `HandStatus`
    faults: npt.NDArray[np.int32]  #: (F,), of `Fault`
    contact_counts: npt.NDArray[np.uint32]  #: (F,), 0 to 16
    contacts: npt.NDArray[Any]  #: (F, 16) of `CONTACT`; those beyond the count are 0


class Corrector(Owner):
    """Corrects one hand, frame by frame: make one for each hand.

    `method` is "nade", "paper" or "none"; `feel` is that of objects outside of a scene; what cannot
    be continuous fades over `release` seconds, 0 to 1; `hand_length` is that of the hand that is
    drawn, from wrist to middle knuckle in metres, None: what the tracker says on the average;
    `flesh` is the skin of a hand of your own, None: the built-in hand's.

    Threads may share a corrector, which then takes them one at a time; several correctors run at
    once, also on the same surface or scene.
    """

    def __init__(
        self,
        method: str = "nade",
        feel: Optional[Feel] = None,
        release: float = 0.2,
        hand_length: Optional[float] = None,
        flesh: Optional[Flesh] = None,
    ) -> None:
        options = _library.CorrectorOptions(size=ctypes.sizeof(_library.CorrectorOptions))
        check(library.nade_corrector_options_init(ctypes.byref(options)))
        options.method = choice("method", method, METHODS)
        options.release_s = number("release", release)
        options.feel = feel_pointer(feel)
        if hand_length is not None:
            options.hand_length_m = number("hand_length", hand_length)
        if flesh is not None:
            if not isinstance(flesh, Flesh):
                raise TypeError(f"flesh: expected a nade.Flesh, found {type(flesh).__name__}")
            setattr(options, f"{flesh.side}_flesh", flesh._handle)
        self._own(
            library.nade_corrector_create, library.nade_corrector_destroy, ctypes.byref(options)
        )
        # The library takes no lock, and ctypes lets other threads run during a call.
        self._lock = threading.Lock()

    def update(
        self,
        joints: npt.NDArray[Any],
        surface: Union[Surface, Scene, None],
        time_ns: int,
        side: str = "right",
        placement: Optional[npt.NDArray[Any]] = None,
        object_id: int = 0,
    ) -> Result:
        """The hand to draw for a tracked hand `joints` (26,) of `JOINT`, never for a drawn one.

        `surface` is what it may touch: a surface, a scene, or None where no object is near; a hand
        that is not tracked is not passed at all. `time_ns`: nanoseconds, of any origin. `placement`
        is the surface's; `object_id` tells objects that share a surface apart. A hand that cannot
        be used comes back as it is, `HandStatus.UNTRACKED`, and `fault` says why.
        """
        hand = _one_hand(joints)
        results: npt.NDArray[Any] = np.zeros(1, _RESULT)
        placed = placements(placement, None)
        self._run(
            choice("side", side, SIDES),
            hand.reshape(1, JOINT_COUNT),
            surface,
            [whole("time_ns", time_ns, -(2**63), 2**63 - 1)],
            placed,
            whole("object_id", object_id, 0, 2**64 - 1),
            results,
        )
        result = results[0]
        return Result(
            joints=result["joints"],
            status=HandStatus(result["status"]),
            fault=Fault(result["fault"]),
            velocities=result["velocity_mps"],
            contacts=result["contacts"][: result["contact_count"]],
        )

    def preview(self, joints: npt.NDArray[Any], side: str = "right") -> npt.NDArray[Any]:
        """The latest correction on a newer pose of the same hand, (26,) of `JOINT`.

        For a picture's late update. Remembers nothing.
        """
        hand = _one_hand(joints)
        drawn = np.zeros(JOINT_COUNT, JOINT)
        number_of_side = choice("side", side, SIDES)
        with self._lock:
            check(
                library.nade_corrector_preview(
                    self._handle, number_of_side, hand.ctypes.data, drawn.ctypes.data
                )
            )
        return drawn

    def set_feel(self, feel: Optional[Feel]) -> None:
        """How objects outside of a scene feel from the next frame on; None: the defaults."""
        pointer = feel_pointer(feel)
        with self._lock:
            check(library.nade_corrector_set_feel(self._handle, pointer))

    def reset(self) -> None:
        """Forgets everything about the hand so far."""
        with self._lock:
            check(library.nade_corrector_reset(self._handle))

    def _run(
        self,
        side: int,
        hands: npt.NDArray[Any],
        surface: Union[Surface, Scene, None],
        times_ns: list[int],
        placed: Optional[npt.NDArray[Any]],
        object_id: int,
        results: npt.NDArray[Any],
        frames: Optional[list[int]] = None,
    ) -> None:
        """Corrects `frames` of `hands`, or all of them, into `results`; each in one piece."""
        results["size"] = _RESULT.itemsize
        handle = self._handle
        read, hand_bytes = hands.ctypes.data, JOINT_COUNT * JOINT.itemsize
        write, result_bytes = results.ctypes.data, _RESULT.itemsize
        if frames is None:
            frames = list(range(len(hands)))
        with self._lock:
            if isinstance(surface, Scene):
                if placed is not None:
                    raise ValueError("placement: expected none beside a scene, which has its own")
                update_scene, scene = library.nade_corrector_update_scene, surface._handle
                for i in frames:
                    status = update_scene(
                        handle,
                        side,
                        read + i * hand_bytes,
                        scene,
                        times_ns[i],
                        write + i * result_bytes,
                    )
                    check(status)
                return
            update = library.nade_corrector_update
            touched = None if surface is None else handle_of(surface)
            place = 0 if placed is None else placed.ctypes.data
            step = 0 if placed is None or placed.ndim == 0 else placed.itemsize
            for i in frames:
                status = update(
                    handle,
                    side,
                    read + i * hand_bytes,
                    touched,
                    place + i * step or None,
                    object_id,
                    times_ns[i],
                    write + i * result_bytes,
                )
                check(status)


def correct(
    positions: npt.ArrayLike,
    rotations: npt.ArrayLike,
    times_ns: npt.ArrayLike,
    surface: Union[Surface, Scene, None],
    side: str = "right",
    radii: Optional[npt.ArrayLike] = None,
    placement: Optional[npt.NDArray[Any]] = None,
    method: str = "nade",
    feel: Optional[Feel] = None,
    release: float = 0.2,
    hand_length: Optional[float] = None,
    flesh: Optional[Flesh] = None,
) -> Correction:
    """All frames of one hand at once, by a new `Corrector`.

    `positions` (F, 26, 3), metres, world; `rotations` (F, 26, 4), quaternions x y z w; `times_ns`
    (F,), whole nanoseconds that increase; `radii` (26,) or (F, 26), metres; `placement` one or (F,)
    by `nade.placement`. The rest as for `Corrector`.

    A frame whose positions are all NaN is one in which the hand was not tracked: it comes back as
    it is, `HandStatus.UNTRACKED`. So does a hand that cannot be used; `faults` says why. What is
    not changed comes back bit for bit; what is changed is computed from float32 numbers. On top of
    the corrections it costs about 8 microseconds a frame.
    """
    given_at = np.asarray(positions)
    given_turn = np.asarray(rotations)
    if given_at.ndim != 3:
        raise ValueError(f"positions: expected the shape (any, 26, 3), found {given_at.shape}")
    count = len(given_at)
    if radii is not None and np.ndim(radii) == 1:
        radii = np.broadcast_to(np.asarray(radii), (count, np.shape(radii)[0]))
    hands = joints(given_at, given_turn, radii)
    times = numbers("times_ns", times_ns, (count,), np.int64)
    back = np.flatnonzero(times[1:] <= times[:-1])
    if len(back) > 0:
        raise ValueError(f"times_ns: expected times that increase, frame {back[0] + 1} does not")
    placed = placements(placement, count)
    results: npt.NDArray[Any] = np.zeros(count, _RESULT)
    is_missing = np.isnan(hands["position"]).all(axis=(1, 2))
    results["joints"][is_missing] = hands[is_missing]
    results["status"][is_missing] = HandStatus.UNTRACKED
    results["fault"][is_missing] = Fault.NOT_FINITE
    corrector = Corrector(method, feel, release, hand_length, flesh)
    corrector._run(
        choice("side", side, SIDES),
        hands,
        surface,
        times.tolist(),
        placed,
        0,
        results,
        np.flatnonzero(~is_missing).tolist(),
    )
    drawn = results["joints"]
    return Correction(
        positions=_as_given(drawn["position"], hands["position"], given_at),
        rotations=_as_given(drawn["rotation"], hands["rotation"], given_turn),
        velocities=results["velocity_mps"],
        statuses=results["status"],
        faults=results["fault"],
        contact_counts=results["contact_count"],
        contacts=results["contacts"],
    )


def _as_given(
    drawn: npt.NDArray[Any], tracked: npt.NDArray[Any], given: npt.NDArray[Any]
) -> npt.NDArray[Any]:
    """`drawn`, and where it is what was `tracked` the numbers that were given, of more digits."""
    is_same = (drawn == tracked) | (np.isnan(drawn) & np.isnan(tracked))
    kept = is_same.all(axis=-1, keepdims=True)
    return np.where(kept, given, drawn).astype(np.result_type(given.dtype, np.float32), copy=False)
