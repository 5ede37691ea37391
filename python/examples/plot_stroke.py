#!/usr/bin/env python3
"""Draws what nade does to a stroke on a table: heights before and after, into a picture.

    plot_stroke.py [RECORDING] [-o PICTURE]

Without a recording it makes a hand that comes down, strokes, and leaves. Needs matplotlib.
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import nade

SHOWN = ("palm", "index_tip", "little_tip")


def made_stroke(frames: int = 270, rate_hz: float = 90.0) -> nade.Recording:
    """A right hand that is pressed up to 25 mm into the table."""
    rest = nade.rest_hand("right")
    time_s = np.arange(frames) / rate_hz
    way = np.zeros((frames, 1, 3))
    way[:, 0, 1] = 0.06 - 0.085 * np.sin(np.pi * time_s / time_s[-1])
    way[:, 0, 2] = -0.08 * time_s
    right = nade.RecordedHand(
        positions=rest["position"] + way,
        rotations=np.repeat(rest["rotation"][np.newaxis], frames, axis=0),
        radii=np.zeros((frames, len(nade.JOINT_NAMES))),
        confidence=np.ones(frames),
    )
    times_ns = np.round(1e9 * time_s).astype(np.int64)
    left = nade.RecordedHand.untracked(frames)
    return nade.Recording(times_ns, left, right, {"source": "plot_stroke"})


def draw(tracked: nade.Recording, drawn: nade.Recording, picture: str) -> None:
    time_s = 1e-9 * (tracked.times_ns - tracked.times_ns[0])
    sides = [side for side in ("left", "right") if getattr(tracked, side).is_tracked.any()]
    figure, rows = plt.subplots(len(sides), 1, squeeze=False, sharex=True, layout="constrained")
    for axes, side in zip(rows[:, 0], sides):
        for number, name in enumerate(SHOWN):
            joint = nade.JOINT_NAMES.index(name)
            color = f"C{number}"
            before = 1e3 * getattr(tracked, side).positions[:, joint, 1]
            after = 1e3 * getattr(drawn, side).positions[:, joint, 1]
            axes.plot(time_s, before, color=color, linestyle=":")
            axes.plot(time_s, after, color=color, label=name.replace("_", " "))
        axes.axhline(0.0, color="grey", linewidth=0.8)
        axes.set_ylabel(f"{side}: height of joints, mm")
        axes.legend(title="drawn; dotted: tracked")
    rows[-1, 0].set_xlabel("time, s")
    figure.savefig(picture, dpi=120)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", nargs="?", help="in nade's format; the table is y = 0")
    parser.add_argument("-o", "--output", default="stroke.png", help="the picture to write")
    arguments = parser.parse_args()
    tracked = nade.read_recording(arguments.recording) if arguments.recording else made_stroke()
    drawn = nade.correct_recording(tracked, nade.Plane())
    draw(tracked, drawn, arguments.output)
    print(arguments.output)


if __name__ == "__main__":
    main()
