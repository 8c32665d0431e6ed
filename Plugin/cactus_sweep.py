# SPDX-License-Identifier: BSD-3-Clause
"""Many substrates, and a table of what came out. The plugin holds this module: where it is loaded, every script can say, after it has
imported paraview,

    from paraview import simple
    from cactus_sweep import sweep

    def make(folder, dispersion_deg, seed):
        bundle = simple.BundleInitializer(MeanDispersion=dispersion_deg, Seed=seed)
        fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
        simple.SubstrateProduction(Input=fibres, FolderName=folder).UpdatePipeline()

    sweep(make, "my-sweep", dispersion_deg=[0, 10, 20], seed=range(1, 6))

and runs as it is, in pvpython or on all ranks of a batch job (mpiexec -n 4 pvbatch --sym script.py).
"""

import csv
import itertools
import os
import sys
import traceback

from paraview import servermanager, simple
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController

# What the table has of each substrate's certificate.csv, where nothing else is asked for.
REACHED = ("OuterSurfaces", "FVF", "AVF", "AggregateGRatio", "SmallestGap_um", "Triangles", "Certified")


def sweep(make, folder, reached=REACHED, **values):
    """Calls make(folder of the case, name=value, ...) for every combination of the values, and writes sweep.csv in `folder`: a row for each.

    values: by name, what to go through (a list, a range, ...), or one value for all. The names are those of make's arguments and of the table's columns, so
        a unit belongs into them (dispersion_deg). A case's folder is called by all names and values.
    make: makes one substrate in the folder that it is given, as SubstrateProduction or SubstrateWriter writes it. What it leaves in ParaView's pipeline
        is deleted after it. What it does beside its arguments is not known here: after a change of it, name another folder.
    reached: the quantities of certificate.csv that the table has.

    A case whose folder has a certificate is not made again: a sweep that was stopped goes on, and one that asks for more makes what is missing. Several
    ranks take the cases by turns, each as if it were alone, so that the bits are the same, and wait for each other at the end. Where a case does not
    come out, the others are made all the same, and the script ends with an error.
    """
    lists = [[value] if isinstance(value, str) or not hasattr(value, "__iter__") else list(value) for value in values.values()]
    cases = [dict(zip(values, case)) for case in itertools.product(*lists)]
    table, header = os.path.join(folder, "sweep.csv"), [*values, *reached]
    world = vtkMultiProcessController.GetGlobalController()
    rank, ranks = world.GetLocalProcessId(), world.GetNumberOfProcesses()
    if ranks > 1 and not servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode():
        _refuse("several ranks share the cases only where each runs the script: start pvbatch with --sym")
    if os.path.exists(table) and not _is_ours(table, reached):
        _refuse(f"{table} is there already, and is no table of a sweep with these columns: name another folder")
    os.makedirs(folder, exist_ok=True)

    # Each rank works as if it were alone, so that no stage waits for the others.
    alone = vtkDummyController()
    vtkMultiProcessController.SetGlobalController(alone)
    try:
        for case in cases[rank::ranks]:
            if not _is_made(_place(folder, case)):
                print(f"{_place(folder, case)} (rank {rank})", flush=True)
                _make_one(make, _place(folder, case), case)
    finally:  # also where Ctrl-C ends the script
        vtkMultiProcessController.SetGlobalController(world)
        world.Barrier()

    made = [case for case in cases if _is_made(_place(folder, case))]
    if rank == 0:
        rows = [header, *([*map(str, case.values()), *_certificate(_place(folder, case), reached)] for case in made)]
        with open(table, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(rows)
        print("\n".join("".join(f"{_short(value):>16}" for value in row) for row in rows))
        print(f"{len(made)} of {len(cases)} cases are in {os.path.abspath(folder)}", flush=True)
    if len(made) < len(cases):
        _refuse("not every case came out, as the errors above say")


def _place(folder, case):
    """The folder of a case."""
    return os.path.join(folder, "_".join(f"{name}-{value}" for name, value in case.items()).replace(os.sep, "-"))


def _is_made(place):
    """Folders of substrates are written whole or not at all."""
    return os.path.exists(os.path.join(place, "certificate.csv"))


def _make_one(make, place, case):
    """Calls make. What it throws is shown, and no more: other ranks would wait at the end for one that left."""
    before = set(_sources())
    try:
        make(place, **case)
    except (Exception, SystemExit):  # a script's own may be any
        traceback.print_exc()
    sources = _sources()
    for number in sorted(set(sources) - before, reverse=True):
        simple.Delete(sources[number])


def _sources():
    """What is in the pipeline, by numbers in the order in which it was made."""
    return {int(proxy.GetGlobalIDAsString()): proxy for proxy in simple.GetSources().values()}


def _certificate(place, reached):
    with open(os.path.join(place, "certificate.csv"), newline="", encoding="utf-8") as file:
        values = {line["quantity"]: line["value"] for line in csv.DictReader(file)}
    return [values.get(name, "") for name in reached]


def _short(value):
    """What is printed of a value: numbers with six digits, words as far as there is room."""
    try:
        return f"{float(value):.6g}"
    except ValueError:
        return value[:15]


def _is_ours(table, reached):
    with open(table, encoding="utf-8", errors="replace") as file:
        return file.readline().strip().endswith("," + ",".join(reached))


def _refuse(why):
    print(f"sweep: {why}", file=sys.stderr, flush=True)
    sys.exit(1)
