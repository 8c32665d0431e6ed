# SPDX-License-Identifier: BSD-3-Clause
"""Substrates of fibres that other generators and microscopes give: each file goes through the chain to a certificate, and a line says
how far its fibres were changed on the way.

Run it with ./cactus pvpython examples/other_generators.py [FILE...]. A FILE is a table of CATERPillar (.csv, .swc), a JSON file of the
White Matter Generator, a strand file, or a folder of centre lines as text: a file per axon, x,y,z in units of 0.5 µm first and the
diameter in mm in column 7, as the folder XNH_data of the White Matter Generator has them. Without a FILE the script makes a small file
of each of the first two kinds and takes these.
"""

import glob
import json
import math
import os
import random
import sys

from paraview import servermanager, simple

from output_folder import make_folder

SIDE = 10.0  # µm, of the files made here
CENTRE_LINE_UNIT, CENTRE_LINE_DIAMETER_UNIT = 0.5, 1000.0  # µm


def wavy_axons(seed):
    """Axons along z that wave beside each other, with beads, as lists of (x, y, z, outer radius): a point every fifth of a radius."""
    draw = random.Random(seed)
    for row in range(5):
        for column in range(5):
            radius, phase, wave = draw.uniform(0.45, 0.85), draw.uniform(0.0, 6.3), draw.uniform(3.0, 6.0)
            count = round(SIDE / (0.2 * radius))
            axon = []
            for i in range(count + 1):
                z = SIDE * i / count
                x = 1.0 + 2.0 * column + 0.3 * math.sin(6.28 * z / wave + phase)
                y = 1.0 + 2.0 * row + 0.3 * math.cos(6.28 * z / wave + 2.0 * phase)
                axon.append((x, y, z, radius * (1.0 + 0.15 * math.sin(1.7 * z + phase))))
            yield axon


def write_spheres(path):
    """A table as CATERPillar writes it, with the file beside it that has the voxel's side."""
    with open(path, "w", encoding="ascii") as file:
        file.write("cell_type cell_id component component_id X Y Z inner_radius outer_radius\n")
        for number, axon in enumerate(wavy_axons(1)):
            for x, y, z, radius in axon:
                file.write(f"axon {number} axon 0 {x:.6g} {y:.6g} {z:.6g} {0.7 * radius:.6g} {radius:.6g}\n")
    with open(path.replace(".csv", "_growth_info.txt"), "w", encoding="ascii") as file:
        file.write(f"Voxel Size {SIDE}\n")


def write_ellipsoids(path):
    """A file as the White Matter Generator writes it, with round ellipsoids."""
    axons = []
    for axon in wavy_axons(2):
        centred = [([x - SIDE / 2, y - SIDE / 2, z - SIDE / 2], r) for x, y, z, r in axon]
        ellipsoids = [
            {"position": at, "shape": [r, 0, 0, 0, r, 0, 0, 0, r], "axonDiameter": 1.4 * r, "myelinDiameter": 2 * r} for at, r in centred
        ]
        axons.append({"gRatio": 0.7, "ellipsoids": ellipsoids})
    with open(path, "w", encoding="ascii") as file:
        json.dump({"voxelSize": [SIDE] * 3, "axons": axons, "cells": []}, file)


def write_centre_lines(folder, path):
    """The centre lines of a folder as one strand file, moved so that the cube that holds their middle parts is centred on the origin."""
    axons = []
    for name in sorted(glob.glob(os.path.join(folder, "*.txt"))):
        with open(name, encoding="ascii") as file:
            rows = [[float(word) for word in line.split(",")] for line in file if line.strip()]
        axons.append([[CENTRE_LINE_UNIT * value for value in row[:3]] + [0.5 * CENTRE_LINE_DIAMETER_UNIT * row[6]] for row in rows])
    if not axons:
        sys.exit(f"other_generators: there is no centre line (*.txt) in {folder}")
    points = [point for axon in axons for point in axon]
    lower = [min(point[axis] for point in points) for axis in range(3)]
    upper = [max(point[axis] for point in points) for axis in range(3)]
    side = max(high - low for low, high in zip(lower, upper))
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{side}\n{len(axons)}\n")
        for axon in axons:
            file.write(f"{len(axon)}\n")
            for *place, radius in axon:
                centred = [value - 0.5 * (low + high) for value, low, high in zip(place, lower, upper)]
                file.write(" ".join(f"{value:.9g}" for value in (*centred, radius)) + "\n")


def first_row(source, port=0):
    table = servermanager.Fetch(source, idx=port)
    return {table.GetColumnName(i): table.GetValue(0, i).ToDouble() for i in range(table.GetNumberOfColumns())}


def number(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def make(path):
    """The chain with one file; whether its substrate is certified."""
    given = simple.StrandReader(FileName=path)
    before = simple.SubstrateStatistics(Fibres=given)
    before.UpdatePipeline()
    optimised = simple.CapsuleOptimizer(Input=given)
    grown = simple.FibreRadialGrowth(Input=simple.OutputPort(optimised, 0), VoxelSize=0.1)
    surfaces = simple.MyelinSurface(Input=grown)
    outer, inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
    certificate = simple.SubstrateCertificate(Fibres=simple.OutputPort(optimised, 0), Outer=outer, Inner=inner)
    after = simple.SubstrateStatistics(Fibres=simple.OutputPort(optimised, 0), Outer=outer, Inner=inner)
    for each in (certificate, after):
        each.UpdatePipeline()
    fibres = servermanager.Fetch(optimised, idx=0)
    certified = first_row(certificate)["Certified"] == 1
    print(
        f"{os.path.basename(path)}: {fibres.GetNumberOfCells()} fibres, length {100 * number(fibres, 'LengthIncrease'):+.1f} %, "
        f"tangents {number(fibres, 'InitialTangentDispersion'):.1f}° -> {number(fibres, 'TangentDispersion'):.1f}°, "
        f"capsules {first_row(before)['CapsuleVolumeFraction']:.3f} -> {first_row(after)['CapsuleVolumeFraction']:.3f} of the domain, "
        f"surfaces {first_row(after)['FVF']:.3f}, "
        f"{'certified' if certified else 'NOT certified'}",
        flush=True,
    )
    return certified


def main():
    files = sys.argv[1:]
    if not files:
        names = ("spheres.csv", "spheres_growth_info.txt", "ellipsoids.json")
        spheres, _, ellipsoids = make_folder("other_generators", "cactus-other-generators", names)
        write_spheres(spheres)
        write_ellipsoids(ellipsoids)
        files = [spheres, ellipsoids]
    for i, path in enumerate(files):
        if os.path.isdir(path):
            (files[i],) = make_folder("other_generators", "cactus-other-generators", (os.path.basename(os.path.abspath(path)) + ".strands",))
            write_centre_lines(path, files[i])
    certified = [make(path) for path in files]
    sys.exit(0 if all(certified) else 1)


if __name__ == "__main__":
    main()
