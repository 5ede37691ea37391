"""The metrics, by the program `nade`."""

from __future__ import annotations

import json
import os
import subprocess
import warnings
from typing import Any, Optional, Sequence

from ._library import ErrorCode, NadeError
from ._recordings import Path, RecordingWarning

_MISUSE = 2


def measure(
    tracked: Path,
    corrected: Path,
    object: Optional[str] = None,
    at: Optional[Sequence[float]] = None,
    turn: Optional[Sequence[float]] = None,
    scale: Optional[float] = None,
    program: Path = "nade",
) -> dict[str, Any]:
    """How good a corrected recording is: what `nade measure TRACKED CORRECTED --json -` says.

    Runs the program `nade`, which the wheel does not bring: build it, and put it on PATH or name it
    as `program`. The metrics need the mesh of the hand, and are those of docs/metrics.md.

    `object` is the program's: "plane", "sphere", "sphere:RADIUS", "dog" or a mesh file; its sphere
    touches y = 0 from below. `at` (3,) in metres, `turn` (4,) a quaternion x y z w, and `scale`
    place it. What is not given is that of the corrected recording's header. Raises
    FileNotFoundError where there is no such program, `NadeError` where it fails.
    """
    command = [os.fspath(program), "measure", os.fspath(tracked), os.fspath(corrected)]
    command += ["--json", "-"]
    if object is not None:
        command += ["--object", object]
    for name, values in (("--at", at), ("--turn", turn)):
        if values is not None:
            command.append(f"{name}={','.join(repr(float(value)) for value in values)}")
    if scale is not None:
        command.append(f"--scale={float(scale)!r}")
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        sentence = f"{command[0]}: expected the program nade, found none; see nade's README"
        raise FileNotFoundError(error.errno, sentence) from error
    said = [line for line in done.stderr.splitlines() if line]
    if done.returncode != 0:
        code = ErrorCode.ARGUMENT if done.returncode == _MISUSE else ErrorCode.DATA
        raise NadeError(code, said[-1] if said else f"{command[0]}: failed: {done.returncode}")
    for line in said:
        warnings.warn(line, RecordingWarning, stacklevel=2)
    report: dict[str, Any] = json.loads(done.stdout)
    return report
