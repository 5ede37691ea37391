"""Our recordings, JSON Lines, plain or gzip: see docs/formats.md of nade."""

from __future__ import annotations

import dataclasses
import gzip
import json
import os
import pathlib
import shutil
import stat
import warnings
import zlib
from typing import IO, Any, Iterator, Optional, Union, cast

import numpy as np
import numpy.typing as npt

from . import _library
from ._hands import Flesh, HandStatus, correct
from ._library import JOINT_COUNT, SIDES, ErrorCode, NadeError
from ._surfaces import Feel, Scene, Surface

Path = Union[str, "os.PathLike[str]"]

_FORMAT = "nade-recording"
_VERSION = 1
_FARTHEST_M = 1e6
_LATEST_NS = 4_000_000_000_000_000_000
_LONGEST_LINE = 16 << 20
_UNIT_TOLERANCE = 1e-3  # of the squared norm
_NUMBERS = 8  # of a joint: position, rotation, radius
_WRIST, _MIDDLE_KNUCKLE = 1, 12


class RecordingWarning(UserWarning):
    """Something in a recording was left out or mended; says what and where."""


@dataclasses.dataclass
class RecordedHand:
    """One hand in the F frames of a recording. NaN where it is not tracked."""

    positions: npt.NDArray[np.float64]  #: (F, 26, 3), metres
    rotations: npt.NDArray[np.float64]  #: (F, 26, 4), quaternions x y z w
    radii: npt.NDArray[np.float64]  #: (F, 26), joint to skin in metres, 0 where unknown
    confidence: npt.NDArray[np.float64]  #: (F,), the tracker's own, 0 to 1
    #: By frame, the file's other keys of the hand, such as "status" and "contact".
    other: dict[int, dict[str, Any]] = dataclasses.field(default_factory=dict)

    @classmethod
    def untracked(cls, frames: int) -> "RecordedHand":
        """A hand that is in none of the frames."""
        return cls(
            positions=np.full((frames, JOINT_COUNT, 3), np.nan),
            rotations=np.full((frames, JOINT_COUNT, 4), np.nan),
            radii=np.full((frames, JOINT_COUNT), np.nan),
            confidence=np.full(frames, np.nan),
        )

    @property
    def is_tracked(self) -> npt.NDArray[np.bool_]:
        """(F,), whether the hand is in each frame."""
        tracked: npt.NDArray[np.bool_] = ~np.isnan(self.positions).all(axis=(1, 2))
        return tracked


@dataclasses.dataclass
class Recording:
    """F frames of two hands, world coordinates, metres."""

    times_ns: npt.NDArray[np.int64]  #: (F,), on the source's own clock, increasing
    left: RecordedHand
    right: RecordedHand
    #: The file's first line, without "format" and "version".
    header: dict[str, Any] = dataclasses.field(default_factory=dict)
    #: By frame, the file's other keys of the frame, such as "head".
    other: dict[int, dict[str, Any]] = dataclasses.field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.times_ns)


def _wrong(place: str, sentence: str) -> NadeError:
    return NadeError(ErrorCode.DATA, f"{place}: {sentence}")


def _kind(value: Any) -> str:
    if value is None:
        return "none"
    kinds = ((bool, "true or false"), (str, "a string"), (list, "a list"), (dict, "an object"))
    return next((name for kind, name in kinds if isinstance(value, kind)), "a number")


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


class _Lines:
    """The JSON values of a file's lines, with their places."""

    def __init__(self, path: Path) -> None:
        self.name = os.fspath(path)
        self.line = 0

    @property
    def place(self) -> str:
        return f"{self.name}: line {self.line}"

    def warn(self, sentence: str, depth: int) -> None:
        """`depth`: how many calls it is below `read_recording`."""
        warnings.warn(sentence, RecordingWarning, stacklevel=2 + depth)

    def values(self, file: IO[bytes]) -> Iterator[Any]:
        while True:
            try:
                text = file.readline(_LONGEST_LINE + 1)
            except EOFError:
                self.warn(f"{self.place}: cut off after this line", 3)
                return
            except (gzip.BadGzipFile, zlib.error) as error:
                sentence = f"damaged gzip data after this line: {error}"
                raise _wrong(self.place, sentence) from error
            if not text:
                return
            self.line += 1
            if len(text) > _LONGEST_LINE:
                raise _wrong(self.place, f"expected a line up to {_LONGEST_LINE >> 20} MiB")
            if self.line == 1 and text.startswith(b"\xef\xbb\xbf"):
                text = text[3:]
            if not text.strip(b" \t\r\n"):
                continue
            try:
                value = json.loads(text.decode("utf-8"))
            except (ValueError, RecursionError) as error:
                if not text.endswith(b"\n"):
                    self.warn(f"{self.place}: cut off here; the line is left out", 3)
                    return
                raise _wrong(self.place, f"expected JSON: {error}") from error
            yield value


def _hand_numbers(value: Any, place: str) -> npt.NDArray[np.float64]:
    """The joints of a hand, (26, 8); a joint with a number that is not finite is NaN there."""
    joints = value.pop("joints", None)
    if not isinstance(joints, list) or len(joints) != JOINT_COUNT:
        found = len(joints) if isinstance(joints, list) else _kind(joints)
        hint = "; `nade convert` adds the palm" if found == JOINT_COUNT - 1 else ""
        raise _wrong(place, f"joints: expected {JOINT_COUNT} joints, found {found}{hint}")
    for i, joint in enumerate(joints):
        if not isinstance(joint, list) or len(joint) != _NUMBERS:
            found = len(joint) if isinstance(joint, list) else _kind(joint)
            raise _wrong(place, f"joint {i}: expected {_NUMBERS} numbers, found {found}")
        for number in joint:
            if number is not None and not _is_number(number):
                found = _kind(number)
                raise _wrong(place, f"joint {i}: expected 8 numbers, found {found} among them")
    try:
        numbers = np.array(joints, np.float64)
    except OverflowError:
        numbers = np.full((JOINT_COUNT, _NUMBERS), np.nan)
    far = np.argwhere(np.isfinite(numbers) & (np.abs(numbers) > _FARTHEST_M))
    if len(far) > 0:
        i, k = far[0]
        sentence = f"joint {i}: expected numbers up to {_FARTHEST_M:g}, found {numbers[i, k]:g}"
        raise _wrong(place, sentence)
    negative = np.flatnonzero(numbers[:, 7] < 0.0)
    if len(negative) > 0:
        i = negative[0]
        sentence = f"joint {i}: expected a radius of 0 or more, found {numbers[i, 7]:g}"
        raise _wrong(place, sentence)
    return numbers


def _confidence(value: dict[str, Any], place: str) -> float:
    confidence = value.pop("confidence", 1.0)
    if not _is_number(confidence) or not 0.0 <= confidence <= 1.0:
        raise _wrong(place, f"confidence: expected a number from 0 to 1, found {confidence!r}")
    return float(confidence)


def _time(frame: dict[str, Any], last: Optional[int], place: str) -> int:
    time = frame.pop("t", None)
    if isinstance(time, float) and time.is_integer() and abs(time) <= 2**53:
        time = int(time)
    if not isinstance(time, int) or isinstance(time, bool):
        raise _wrong(place, f"t: expected a time in whole nanoseconds, found {time!r}")
    if abs(time) > _LATEST_NS:
        raise _wrong(place, f"t: expected a time up to {_LATEST_NS} ns from 0, found {time}")
    if last is not None and time <= last:
        raise _wrong(place, f"t: expected a time after {last}, found {time}")
    return time


def _fault(numbers: npt.NDArray[np.float64]) -> Optional[str]:
    """Why a hand that was read cannot be used."""
    if not np.isfinite(numbers).all():
        return "a number of a joint is not finite"
    length = np.linalg.norm(numbers[:, 3:7], axis=1)
    if not ((length >= 0.5) & (length <= 2.0)).all():
        return "a rotation's length is not 0.5 to 2"
    at = numbers[:, :3]
    if not (np.linalg.norm(at - at[_WRIST], axis=1) < 0.5).all():
        return "a joint is half a metre or more from the wrist"
    if not np.linalg.norm(at[_MIDDLE_KNUCKLE] - at[_WRIST]) >= 1e-3:
        return "wrist and middle knuckle less than a millimetre apart"
    return None


class _Reader:
    """Puts a file's frames into arrays."""

    def __init__(self, path: Path) -> None:
        self.lines = _Lines(path)
        self.times: list[int] = []
        self.other: dict[int, dict[str, Any]] = {}
        self.hands: dict[str, dict[int, tuple[npt.NDArray[np.float64], float, dict[str, Any]]]]
        self.hands = {side: {} for side in SIDES}
        self.left_out: list[str] = []
        self.made_unit: list[str] = []

    def read(self, file: IO[bytes]) -> Recording:
        values = self.lines.values(file)
        header = next(values, None)
        if not isinstance(header, dict):
            place = f"{self.lines.name}: line {max(self.lines.line, 1)}"
            raise _wrong(place, "expected a recording's header, found none")
        for key, expected in (("format", _FORMAT), ("version", _VERSION)):
            found = header.pop(key, None)
            if type(found) is not type(expected) or found != expected:
                raise _wrong(self.lines.place, f"expected the {key} {expected!r}, found {found!r}")
        for value in values:
            self._read_frame(value)
        for places in (self.left_out, self.made_unit):
            if places:
                more = f" (and {len(places) - 1} more)" if len(places) > 1 else ""
                self.lines.warn(places[0] + more, 2)
        return Recording(
            times_ns=np.array(self.times, np.int64),
            left=self._hand("left"),
            right=self._hand("right"),
            header=header,
            other=self.other,
        )

    def _read_frame(self, frame: Any) -> None:
        place = self.lines.place
        if not isinstance(frame, dict):
            raise _wrong(place, f"expected a frame, found {_kind(frame)}")
        time = _time(frame, self.times[-1] if self.times else None, place)
        for side in SIDES:
            value = frame.pop(side, None)
            if value is None:
                continue
            if not isinstance(value, dict):
                raise _wrong(place, f"{side}: expected a hand, found {_kind(value)}")
            self._read_hand(value, side, f"{place}: {side}")
        if frame:
            self.other[len(self.times)] = frame
        self.times.append(time)

    def _read_hand(self, value: dict[str, Any], side: str, place: str) -> None:
        numbers = _hand_numbers(value, place)
        confidence = _confidence(value, place)
        fault = _fault(numbers)
        if fault is not None:
            self.left_out.append(f"{place}: {fault}; the hand is left out of the frame")
            return
        rotations = numbers[:, 3:7]
        squared = np.einsum("jk,jk->j", rotations, rotations)
        odd = np.abs(squared - 1.0) > _UNIT_TOLERANCE
        if odd.any():
            rotations[odd] /= np.sqrt(squared[odd])[:, np.newaxis]
            joint = int(np.flatnonzero(odd)[0])
            sentence = f"joint {joint}: the quaternion is not of unit length; it is made so"
            self.made_unit.append(f"{place}: {sentence}")
        self.hands[side][len(self.times)] = (numbers, confidence, value)

    def _hand(self, side: str) -> RecordedHand:
        hand = RecordedHand.untracked(len(self.times))
        for i, (numbers, confidence, other) in self.hands[side].items():
            hand.positions[i] = numbers[:, :3]
            hand.rotations[i] = numbers[:, 3:7]
            hand.radii[i] = numbers[:, 7]
            hand.confidence[i] = confidence
            if other:
                hand.other[i] = other
        return hand


def read_recording(path: Path) -> Recording:
    """A recording in nade's own format, plain or gzip.

    Raises `NadeError` with a sentence that names file and line where the file is not one, OSError
    where it cannot be read. Warns with `RecordingWarning` where the file is cut off, where a hand
    cannot be used and is left out, and where rotations are made unit, as docs/formats.md has it.
    Other formats, and hands of 25 joints, are turned into this one by the program `nade convert`.
    """
    with open(path, "rb") as file:
        if file.peek(2)[:2] != b"\x1f\x8b":
            return _Reader(path).read(file)
        with gzip.GzipFile(fileobj=file) as packed:
            return _Reader(path).read(cast(IO[bytes], packed))


def _checked_hand(hand: RecordedHand, side: str, frames: int) -> None:
    """Refuses what a reader would, and arrays of other shapes."""
    if not isinstance(hand, RecordedHand):
        raise TypeError(f"{side}: expected a RecordedHand, found {type(hand).__name__}")
    shapes = {
        "positions": (frames, JOINT_COUNT, 3),
        "rotations": (frames, JOINT_COUNT, 4),
        "radii": (frames, JOINT_COUNT),
        "confidence": (frames,),
    }
    tracked = None
    for name, shape in shapes.items():
        values = _library.numbers(f"{side}: {name}", getattr(hand, name), shape, np.float64)
        tracked = hand.is_tracked if tracked is None else tracked
        flat = values[tracked].reshape(int(tracked.sum()), -1)
        frame = np.flatnonzero(tracked)
        bad = np.flatnonzero(~np.isfinite(flat).all(axis=1))
        if len(bad) > 0:
            raise ValueError(f"{side}: {name}: frame {frame[bad[0]]}: expected finite numbers")
        least = 0.0 if name in ("radii", "confidence") else -_FARTHEST_M
        most = 1.0 if name == "confidence" else _FARTHEST_M
        bad = np.flatnonzero(((flat < least) | (flat > most)).any(axis=1))
        if len(bad) > 0:
            sentence = f"expected numbers from {least:g} to {most:g}"
            raise ValueError(f"{side}: {name}: frame {frame[bad[0]]}: {sentence}")


def _checked_times(recording: Recording) -> list[int]:
    times = _library.numbers("times_ns", recording.times_ns, (None,), np.int64)
    if len(times) > 0 and not (np.abs(times.astype(np.float64)) <= _LATEST_NS).all():
        raise ValueError(f"times_ns: expected times up to {_LATEST_NS} ns from 0")
    back = np.flatnonzero(times[1:] <= times[:-1])
    if len(back) > 0:
        raise ValueError(f"times_ns: expected times that increase, frame {back[0] + 1} does not")
    return [int(time) for time in times]


def _text(name: str, known: dict[str, Any], other: dict[str, Any]) -> bytes:
    """A line with the known keys first, whatever the others say about them."""
    value = {**known, **other, **known}
    try:
        line = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: expected keys that JSON can hold: {error}") from error
    return line.encode("utf-8", "replace") + b"\n"


def _write_lines(recording: Recording, file: Any) -> None:
    times = _checked_times(recording)
    hands = {}
    for side in SIDES:
        hand = getattr(recording, side)
        _checked_hand(hand, side, len(times))
        joints = [hand.positions, hand.rotations, np.asarray(hand.radii)[:, :, np.newaxis]]
        hands[side] = (hand, hand.is_tracked, np.concatenate(joints, axis=2, dtype=np.float64))
    file.write(_text("header", {"format": _FORMAT, "version": _VERSION}, recording.header))
    for i, time in enumerate(times):
        frame: dict[str, Any] = {"t": time}
        for side, (hand, tracked, numbers) in hands.items():
            if tracked[i]:
                known = {"joints": numbers[i].tolist(), "confidence": float(hand.confidence[i])}
                frame[side] = {**known, **hand.other.get(i, {}), **known}
        file.write(_text(f"frame {i}", frame, recording.other.get(i, {})))


def write_recording(path: Path, recording: Recording) -> None:
    """Writes a recording in nade's own format; gzip where the name ends in .gz.

    Numbers come back bit for bit. The file appears whole or not at all, and what stood there before
    stays if anything fails. Raises ValueError or TypeError for what `read_recording` would refuse.
    """
    # Where a link points, so that the link stays one.
    target = pathlib.Path(os.path.realpath(path))
    is_packed = target.name.lower().endswith(".gz") or os.fspath(path).lower().endswith(".gz")
    is_special = target.exists() and not stat.S_ISREG(target.stat().st_mode)
    beside = target if is_special else target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        with open(beside, "wb") as raw:
            if is_packed:
                # Without name and time the same recording gives the same file.
                with gzip.GzipFile(filename="", mode="wb", fileobj=raw, mtime=0) as packed:
                    _write_lines(recording, packed)
            else:
                _write_lines(recording, raw)
            raw.flush()
            if not is_special:
                os.fsync(raw.fileno())
        if is_special:
            return
        if target.exists():
            shutil.copymode(target, beside)
        os.replace(beside, target)
    except BaseException:
        if not is_special:
            beside.unlink(missing_ok=True)
        raise


def correct_recording(
    recording: Recording,
    surface: Union[Surface, Scene, None],
    placement: Optional[npt.NDArray[Any]] = None,
    method: str = "nade",
    feel: Optional[Feel] = None,
    release: float = 0.2,
    hand_length: Optional[float] = None,
    flesh: Optional[dict[str, Flesh]] = None,
) -> Recording:
    """Both hands of a recording, corrected by `correct`; what else it has stays.

    The header gets "method", "tool" and, where `feel` has them, "softness" and "friction", each
    hand its "status". `placement` is one or (F,) by `nade.placement`; `flesh` by side.
    """
    if not isinstance(recording, Recording):
        raise TypeError(f"recording: expected a Recording, found {type(recording).__name__}")
    if recording.header.get("method"):
        raise ValueError("recording: expected a tracked recording, found a corrected one")
    hands = {}
    for side in SIDES:
        tracked: RecordedHand = getattr(recording, side)
        drawn = correct(
            tracked.positions,
            tracked.rotations,
            recording.times_ns,
            surface,
            side=side,
            radii=tracked.radii,
            placement=placement,
            method=method,
            feel=feel,
            release=release,
            hand_length=hand_length,
            flesh=(flesh or {}).get(side),
        )
        names = {i: HandStatus(drawn.statuses[i]).name.lower() for i in range(len(recording))}
        hands[side] = RecordedHand(
            positions=drawn.positions,
            rotations=drawn.rotations,
            radii=tracked.radii.copy(),
            confidence=tracked.confidence.copy(),
            other={
                int(i): {**tracked.other.get(int(i), {}), "status": names[int(i)]}
                for i in np.flatnonzero(tracked.is_tracked)
            },
        )
    header = dict(recording.header)
    header["method"] = method
    header["tool"] = f"nade {_library.library.nade_version().decode()}"
    if feel is not None and feel.softness_m > 0.0:
        header["softness"] = feel.softness_m
    if feel is not None and feel.friction > 0.0:
        header["friction"] = feel.friction
    return Recording(
        times_ns=recording.times_ns.copy(), header=header, other=dict(recording.other), **hands
    )
