"""nade keeps a tracked hand on the surface it strokes.

    import nade

    recording = nade.read_recording("stroke.jsonl.gz")
    table = nade.Plane()
    corrected = nade.correct_recording(recording, table)
    nade.write_recording("corrected.jsonl.gz", corrected)

Units and frames: metres, seconds, times in whole nanoseconds; right-handed, +Y up; quaternions
x y z w, lengths from 0.5 to 2 are made unit. A hand has 26 joints in the order of XrHandJointEXT
(`JOINT_NAMES`), in frames as OpenXR has them: -Z to the fingertip, +Y to the back of the hand, for
both hands.

Errors: `NadeError`, TypeError and ValueError, with one sentence that names the argument. A call
that failed has changed nothing.
"""

from ._hands import (
    CONTACT,
    JOINT,
    JOINT_NAMES,
    Correction,
    Corrector,
    Fault,
    Flesh,
    HandStatus,
    Result,
    Skin,
    correct,
    joints,
    rest_hand,
)
from ._library import ErrorCode, NadeError, library as _loaded
from ._measure import measure
from ._recordings import (
    RecordedHand,
    Recording,
    RecordingWarning,
    correct_recording,
    read_recording,
    write_recording,
)
from ._surfaces import (
    PLACEMENT,
    Box,
    Capsule,
    Custom,
    Cylinder,
    Ellipsoid,
    Feel,
    Group,
    HeightField,
    Hull,
    Mesh,
    MeshReport,
    Plane,
    Plate,
    Scene,
    Sphere,
    Surface,
    SurfacePoint,
    placement,
)

__version__: str = _loaded.nade_version().decode()

__all__ = [
    "CONTACT",
    "JOINT",
    "JOINT_NAMES",
    "PLACEMENT",
    "Box",
    "Capsule",
    "Correction",
    "Corrector",
    "Custom",
    "Cylinder",
    "Ellipsoid",
    "ErrorCode",
    "Fault",
    "Feel",
    "Flesh",
    "Group",
    "HandStatus",
    "HeightField",
    "Hull",
    "Mesh",
    "MeshReport",
    "NadeError",
    "Plane",
    "Plate",
    "RecordedHand",
    "Recording",
    "RecordingWarning",
    "Result",
    "Scene",
    "Skin",
    "Sphere",
    "Surface",
    "SurfacePoint",
    "__version__",
    "correct",
    "correct_recording",
    "joints",
    "measure",
    "placement",
    "read_recording",
    "rest_hand",
    "write_recording",
]
