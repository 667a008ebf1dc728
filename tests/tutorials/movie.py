#!/usr/bin/env python3
"""The movie of the main tutorial, by the ffmpeg of the distribution: ./Alltest -all movie.

    movie.py BIN FOLDER    BIN: directory of the applications; FOLDER: where the case is run, and rbcShear.mp4 stays

The tutorial runs at its own resolution. The movie has a picture for each result; its pictures are those of renderCase -series, but for compression,
and each differs from the one before.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

import matplotlib.image
import numpy

TUTORIAL = pathlib.Path(__file__).resolve().parents[2] / "tutorials/rbcShear/Ca0.02"
VIEW = ["-frame", "cells", "-fluid", "-arrows", "-size", "800x600"]
EVERY = 0.1  # of strain


def said(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
    return done.stdout


def ran(case):
    if case.exists():
        shutil.rmtree(case)
    said("cloneCase", TUTORIAL, case, "-set", f"system/control.yaml:/write/strain={EVERY}")
    for program in (["membraneMesh"], ["particleFill"], ["mpirun", "-np", "2", "dmpFlow"]):
        said(*program, "-case", case, "-quiet")


def pictures(folder):
    return [matplotlib.image.imread(file)[:, :, :3] for file in sorted(folder.glob("*.png"))]


def main():
    folder = pathlib.Path(sys.argv[2]).resolve()
    os.environ["PATH"] = f"{pathlib.Path(sys.argv[1]).resolve()}:{os.environ['PATH']}"
    case, film = folder / "case", folder / "rbcShear.mp4"
    ran(case)
    results = (case / "results/rbc.pvd").read_text().count("timestep=")
    assert results == round(6 / EVERY) + 1, results
    said("renderCase", "-case", case, "-movie", film, "-fps", 10, *VIEW)
    probed = json.loads(said("ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_streams", "-of", "json", film))["streams"][0]
    assert (probed["codec_name"], probed["pix_fmt"], probed["width"], probed["height"]) == ("h264", "yuv420p", 800, 600), probed
    assert int(probed["nb_read_frames"]) == results and abs(float(probed["duration"]) - results / 10) < 0.11, probed

    for name in ("frames", "series"):
        shutil.rmtree(folder / name, ignore_errors=True)
        (folder / name).mkdir()
    said("ffmpeg", "-nostdin", "-loglevel", "error", "-i", film, folder / "frames/%04d.png")
    said("renderCase", "-case", case, "-series", "-output", folder / "series/frame.png", *VIEW)
    frames, series = pictures(folder / "frames"), pictures(folder / "series")
    assert len(frames) == len(series) == results, (len(frames), len(series), results)
    lost = [float(numpy.abs(frame - picture).mean()) for frame, picture in zip(frames, series)]
    moved = [float(numpy.abs(picture - before).mean()) for before, picture in zip(series, series[1:])]
    print(f"{results} pictures, {film.stat().st_size} bytes; compression changes a colour by {max(lost):.4f} at most, a picture differs from the one "
          f"before by {min(moved):.4f} at least, on average over its points")
    assert max(lost) < 0.01 and min(moved) > 1e-4, (max(lost), min(moved))


if __name__ == "__main__":
    main()
