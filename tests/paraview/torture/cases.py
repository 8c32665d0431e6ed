# SPDX-License-Identifier: BSD-3-Clause
"""What is done to a source, filter, reader or writer, and what it may answer.

A case is known by its name, for example `property/BundleInitializer/Side/nan` or `data/MyelinSurface/Input/blocks-nested`. Each runs
on a proxy that has just given a good result: it gets something bad, is updated, and then gets the good value back. Whatever was bad,

- it ends in a result, or in one clear error: one message, no C++ in it, that names what is wrong;
- after an error all outputs are empty and say so (field data `Error`), after none they hold no number that is not finite;
- the good value then gives the same bits as before, without a message.

Bench.run(name) gives the faults found, as text. A crash or an endless loop is the business of `pool`.
"""

import contextlib
import ctypes
import gc
import hashlib
import json
import math
import os
import re
import resource
import shutil
import socket
import subprocess
import tempfile
import zlib

import nibabel
import numpy
from cactus_testing import environment_of_its_own, produce
from paraview import servermanager, simple
from paraview.servermanager import vtkSMPropertyHelper
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from torture import inputs
from torture.answers import CLASS_MISMATCH, CPLUSPLUS, PIPELINE, THINGS, Reports, fingerprint, is_empty, leaves, marks, not_finite
from torture.files import kept, playground, spoilt_files
from torture.targets import DIRECTIONS, RADII, is_legal, limits, targets, values

# Small enough that every stage takes a fraction of a second.
SMALL = {
    "BundleInitializer": {
        "Side": 4, "FibreVolumeFraction": 0.4, "MinimumRadius": 0.4, "MaximumRadius": 1.2, "MeanDispersion": 5, "RadiusTable": "0.5 0.6 0.7",
        "GrownFibreVolumeFraction": 0,
    },
    "CurvedBundles": {
        "Side": 4, "FibreVolumeFraction": 0.4, "MinimumRadius": 0.4, "MaximumRadius": 1.2, "RadiusTable": "0.5 0.6 0.7",
        "GrownFibreVolumeFraction": 0,
    },
    "TractFibres": {
        "Side": 4, "FibreVolumeFraction": 0.4, "MinimumRadius": 0.4, "MaximumRadius": 1.2, "RadiusTable": "0.5 0.6 0.7",
        "GrownFibreVolumeFraction": 0,
    },
    "FibreRadialGrowth": {"VoxelSize": 0.2, "GrowthIterations": 1},
    "MyelinSurface": {"TargetAxonVolumeFraction": 0.15},
    "SubstrateProduction": {"VoxelSize": 0.2, "GrowthIterations": 1, "TargetAxonVolumeFraction": 0.15},
}
# Large enough that what a stage allocates shows.
LARGE = {
    "BundleInitializer": {"Side": 60, "FibreVolumeFraction": 0.6, "GrownFibreVolumeFraction": 0},
    "CapsuleOptimizer": {"MaximumIterations": 5},
    "FibreRadialGrowth": {"VoxelSize": 0.09},
    "MyelinSurface": {"DecimationError": 0.0},
    "SubstrateProduction": {"VoxelSize": 0.4, "SampledFraction": 0.005, "Format": "Surfaces alone"},
}
# What a substrate of 6 µm must stand within the time limit although it is much work.
COSTLY = {
    "MyelinSurface": [{"SmoothingIterations": 100}, {"SmoothingIterations": 40, "DecimationError": 0.0}, {"GRatio": 0.99}, {"GRatio": 0.05}],
    "FibreRadialGrowth": [{"SurfaceRoughness": 0.5}, {"SeedDensity": 1000.0}, {"TargetFibreVolumeFraction": 0.9}, {"TargetFibreVolumeFraction": 0.999}, {"Margin": 5}],
    "CapsuleOptimizer": [{"OverlapTolerance": 0.0}, {"StepSize": 10}, {"MaximumIterations": 2**31 - 1, "OverlapTolerance": 0}],
    "SubstrateStatistics": [{"CutSpacing": 0.001}],
    "SubstrateCertificate": [{"CutSpacing": 0.001}, {"MinimumGap": 3}],
    "BundleInitializer": [{"FibreVolumeFraction": 0.84}, {"MeanDispersion": 45}, {"MeanDispersion": 1e-300}, {"Margin": 20}],
}
# Quantities that are NaN where there is nothing to measure them at, as their docs say.
MEASURED = ("Length_um", "Dispersion", "MeanBeadAmplitude", "OrientationP2ByAxonVolume")
# Whose arrays are those that came in, as they are.
PASSING_ON = {"NiftiReader", "Placement"}
MEGABYTES = (0.25, 0.5, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64)
SERVER_SECONDS = 120  # for a client to start and to run a chain three times; a server that hangs never comes back
COLD_MEGABYTES = (2, 5, 10, 15, 20, 30, 40, 60, 80, 120, 160, 240)
CHAIN = ("BundleInitializer", "CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface", "SubstrateStatistics", "SubstrateCertificate", "SubstrateWriter")


class Standing:
    """A proxy with good inputs and values, which has given its good result."""

    def __init__(self, bench, target, overrides):
        self.bench, self.target = bench, target
        self.folder = tempfile.mkdtemp(dir=bench.folder)
        self.good = {**SMALL.get(target.name, {}), **overrides}
        if self.good.get("StartPositions"):  # MC/DC starts in boxes within the domain, which these few axons miss
            self.good["Format"] = 1
        if self.good.get("RadiusTableFile"):  # of which only one may be given
            self.good["RadiusTable"] = ""
        for name in target.writes:
            self.good[name] = os.path.join(self.folder, target.good_name)
        if target.reads:
            self.good["FileName"] = bench.good_file(target)
        module = servermanager.writers if target.group == "writers" else simple
        many = bench.good.get("many fibres") if set(target.ports.values()) == {"fibres"} and target.name != "FibreRadialGrowth" else None
        self.data = {port: many or bench.good[kind] for port, kind in target.ports.items()}
        self.inputs = {port: produce(inputs.copy(data)) for port, data in self.data.items()}
        if target.name == "MyelinSurface" and overrides:  # which may need the centre lines, of which only growth knows
            self.inputs["Input"] = simple.FibreRadialGrowth(Input=produce(inputs.copy(bench.good["fibres"])), **SMALL["FibreRadialGrowth"])
        self.proxy = getattr(module, target.name)(**self.inputs)
        for name, value in self.good.items():
            self.set(name, value)
        self.update()
        self.reference = self.state()
        self.measures = measures(self.outputs())
        self.unusual = not_finite(self.outputs())
        errors, _ = bench.reports.take()
        if errors or (self.outputs() and all(is_empty(each) for each in self.outputs())):
            raise RuntimeError(f"the good value gives no result: {errors}")

    def set(self, name, value):
        whole = isinstance(value, float) and self.proxy.SMProxy.GetProperty(name).IsA("vtkSMIntVectorProperty")
        vtkSMPropertyHelper(self.proxy.SMProxy, name).Set(int(value) if whole else value)
        self.proxy.SMProxy.UpdateVTKObjects()

    def reset(self, name):
        for port, producer in self.inputs.items():
            if is_empty(producer.GetClientSideObject().GetOutputDataObject(0)):  # ReleaseInput does that
                producer.GetClientSideObject().SetOutput(inputs.copy(self.data[port]))
                producer.SMProxy.MarkDirty(None)
        if name in self.good:
            self.set(name, self.good[name])
        else:
            self.proxy.SMProxy.GetProperty(name).ResetToDefault()
            self.proxy.SMProxy.UpdateVTKObjects()

    def update(self, *time):
        """As the window does: the pipeline, and what it is told of each output."""
        try:
            self.proxy.UpdatePipeline(*time)
            for port in range(len(self.outputs())):
                self.proxy.GetDataInformation(port)
        except RuntimeError as error:
            self.bench.reports.errors.append(str(error))

    def modify(self):
        """Has it run again at the next update."""
        self.proxy.GetClientSideObject().Modified()
        self.proxy.SMProxy.MarkDirty(None)

    def names_property(self, text):
        return any(one.get("name") in text for one in self.target.numbers + self.target.texts)

    def outputs(self):
        algorithm = self.proxy.GetClientSideObject()
        return [algorithm.GetOutputDataObject(port) for port in range(algorithm.GetNumberOfOutputPorts())]

    def state(self):
        """Fingerprint of the outputs and of the files written."""
        digest = hashlib.sha256(fingerprint(self.outputs()).encode())
        for folder, folders, names in os.walk(self.folder):
            folders.sort()
            for name in sorted(names):
                with open(os.path.join(folder, name), "rb") as file:
                    digest.update(name.encode() + file.read())
        return digest.hexdigest()


class Bench:
    """Runs cases. Keeps the proxies of the last few, as a user does who tries one value after the other."""

    def __init__(self, script):
        self.script = script
        self.folder = tempfile.mkdtemp(prefix="cactus-torture-")
        os.chdir(self.folder)
        with open(RADII, "w") as file:
            file.write(SMALL["BundleInitializer"]["RadiusTable"])
        nibabel.save(nibabel.Nifti1Image(numpy.ones((9, 9, 9, 1), numpy.float32), numpy.eye(4)), DIRECTIONS)  # all alike
        self.reports = Reports()
        self.targets = targets()
        self.good = self._good_data()
        self.small, self.large = self.good, None
        self.standing = {}
        self.files = {}
        self.note = ""

    def all_cases(self):
        return all_cases(self)

    def forget(self):
        """Whatever a case left behind must not speak for the next one."""
        for key in list(self.standing):
            self._drop(key)

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def _good_data(self, large=False):
        """{kind: data object}: what the chain makes, in few voxels or many, and of few fibres or many."""
        settings = {name: {**SMALL.get(name, {}), **(LARGE[name] if large and name != "BundleInitializer" else {})} for name in LARGE}
        settings["BundleInitializer"].pop("RadiusTable")
        chain = [simple.BundleInitializer(**settings["BundleInitializer"])]
        for name in ("CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface"):
            chain.append(getattr(simple, name)(Input=simple.OutputPort(chain[-1], 0), **settings[name]))
        chain[-1].UpdatePipeline()
        chain.append(simple.HistologyMask(Outer=simple.OutputPort(chain[-1], 0), Inner=simple.OutputPort(chain[-1], 1)))
        chain[-1].UpdatePipeline()
        if large:
            chain.append(simple.BundleInitializer(Side=40, FibreVolumeFraction=0.6))
            chain[-1].UpdatePipeline()
        wanted = {"fibres": (1, 0), "image": (2, 0), "outer": (3, 0), "inner": (3, 1), "mask": (4, 0)}
        if large:
            wanted["many fibres"] = (5, 0)
        result = {kind: inputs.copy(chain[one].GetClientSideObject().GetOutputDataObject(port)) for kind, (one, port) in wanted.items()}
        for proxy in reversed(chain):
            simple.Delete(proxy)
        self.reports.take()
        return result

    def good_file(self, target):
        """A file that the reader reads: what the writer for its extension makes of good data."""
        if target.name not in self.files:
            kind, extension = {"NiftiReader": ("image", "nii"), "SubstrateReader": ("outer", "substrate")}.get(target.name, ("fibres", target.reads))
            path = os.path.join(self.folder, "good." + extension)
            simple.SaveData(path, proxy=produce(self.small[kind]))
            self.files[target.name] = os.path.join(path, "manifest.json") if os.path.isdir(path) else path
        return self.files[target.name]

    def stand(self, name, **overrides):
        key = (name, tuple(sorted(overrides.items())))
        if key not in self.standing:
            while len(self.standing) > 3:
                self._drop(next(iter(self.standing)))
            self.standing[key] = Standing(self, self.targets[name], overrides)
        return self.standing[key]

    def _drop(self, key):
        standing = self.standing.pop(key)
        for proxy in [standing.proxy, *standing.inputs.values()]:
            simple.Delete(proxy)

    def run(self, name):
        """Faults found by a case, as a list of text."""
        self.reports.take()
        self.note = ""
        family, *words = name.split("/", 3)
        faults = getattr(self, "run_" + family)(*words)
        if faults:
            self.forget()
        gc.collect()
        return faults

    # What an update may end in --------------------------------------------------------------------------------------------------

    def judge(self, standing, naming=None, must_fail=False, passed_on=None):
        """Faults of what the last update has given. `passed_on`: an array of the input that is none of the filter's business."""
        errors, warnings = self.reports.take()
        self.note = " | ".join(["ERROR " + text for text in errors] + ["warning " + text for text in warnings]) or "result"
        outputs = standing.outputs()
        faults = []
        if len(errors) > 1:
            faults.append(f"{len(errors)} errors for one fault: " + " | ".join(errors))
        if len(warnings) > (4 if standing.target.name == "SubstrateProduction" else 2):  # which is four stages
            faults.append(f"{len(warnings)} warnings: " + " | ".join(warnings))
        for text in errors + warnings:
            if CPLUSPLUS.search(text):
                faults.append("speaks C++: " + text)
        mismatch = bool(errors) and CLASS_MISMATCH.match(errors[0])  # VTK's own words, before any filter is asked
        if errors:
            if naming and not re.search(naming, errors[0]):
                faults.append(f"does not name {naming}: {errors[0]}")
            elif not naming and not (THINGS.search(errors[0]) or mismatch or standing.names_property(errors[0])) or PIPELINE.search(errors[0]):
                faults.append(f"does not say what is wrong: {errors[0]}")
            for port, data in enumerate(outputs):
                if not is_empty(data):
                    faults.append(f"output {port} is not empty after an error: {errors[0]}")
                elif not mismatch and data is not None and not any(text.strip() and text.strip() in errors[0] for text in marks(data)):
                    faults.append(f"output {port} is not marked with the error ({marks(data)}): {errors[0]}")
        else:
            if must_fail:
                faults.append("accepted without an error" + (f" (warned: {warnings[0]})" if warnings else ""))
            for port, data in enumerate(outputs):
                if marks(data):
                    faults.append(f"output {port} is marked with an error that nobody reported: {marks(data)}")
            if outputs and all(is_empty(data) for data in outputs) and not warnings:
                faults.append("no result, and not a word")
            unusual = {one for one in not_finite(outputs) - standing.unusual if not passed_on or not one.endswith(passed_on)}
            unusual = {one for one in unusual if one.split(".")[-1] not in MEASURED}
            if unusual and not warnings and standing.target.name not in PASSING_ON:
                faults.append("without a word, not finite: " + ", ".join(sorted(unusual)))
        return faults

    def recovered(self, standing):
        """Faults of the good value after a bad one."""
        standing.update()
        errors, _ = self.reports.take()
        if errors:
            return ["the good value then fails: " + " | ".join(errors)]
        if standing.state() != standing.reference:
            empty = standing.outputs() and all(is_empty(each) for each in standing.outputs())
            return ["the good value then gives " + ("nothing" if empty else "another result")]
        return []

    # Families of cases ----------------------------------------------------------------------------------------------------------

    def run_bounds(self, name, one):
        """Every number has limits that the panel shows."""
        element = self.targets[name].number(one)
        if element.find("BooleanDomain") is not None or element.find("EnumerationDomain") is not None:
            return []
        if element.get("name") in ("Direction", "OrientationVoxel"):  # of any length; of an image that only the filter knows
            return []
        low, high = limits(element)
        needed = {"min": low} if element.tag == "IntVectorProperty" else {"min": low, "max": high}
        return [f"the XML gives no {end}" for end, limit in needed.items() if limit is None]

    def run_property(self, name, one, value):
        target = self.targets[name]
        element = target.number(one)
        number = values(element)[value]
        standing = self.stand(name, **target.switches(element))
        standing.set(one, number)
        standing.update()
        illegal = not is_legal(element, number) and element.find("BooleanDomain") is None
        faults = self.judge(standing, naming=one if illegal else None, must_fail=illegal)
        by_default = str(element.get("default_values")) in (value, f"{number:g}")  # a choice that has to be made
        depends = any(each.get("name") in self.note for each in target.numbers if each.get("name") not in one)  # the XML cannot say that
        if value in ("min", "max") and not by_default and not depends and re.match(rf"ERROR {one} (is|must)\b", self.note):
            faults.append(f"the XML allows what the filter refuses: {self.note}")
        standing.reset(one)
        return faults + self.recovered(standing)

    def run_text(self, name, one, what):
        target = self.targets[name]
        element = next(each for each in target.texts if each.get("name") == one)
        standing = self.stand(name)
        place = tempfile.mkdtemp(dir=self.folder)
        text = playground(place, standing.good)[what]
        before = kept(place)
        os.chdir(place)
        try:
            for switch, number in target.switches(element).items():
                standing.set(switch, number)
            if one == "RadiusTableFile":  # of which only one may be given
                standing.set("RadiusTable", "")
            standing.set(one, text)
            standing.update()
            faults = self.judge(standing)
            if kept(place) != before:
                faults.append("a user's files are gone or changed")
            left = [each for each in os.listdir(place) if "partial" in each or each.endswith(".tmp")]
            if left:
                faults.append(f"leaves {left} behind")
        finally:
            os.chdir(self.folder)
        for switch in target.switches(element):
            standing.reset(switch)
        standing.reset(one)
        if one == "RadiusTableFile":
            standing.reset("RadiusTable")
        faults += self.recovered(standing)
        shutil.rmtree(place, ignore_errors=True)
        return faults

    def run_file(self, name, what):
        target = self.targets[name]
        standing = self.stand(name)
        with open(self.good_file(target), "rb") as file:
            spoilt = spoilt_files(file.read())[what]
        path = os.path.join(self.folder, "spoilt." + target.reads)
        with open(path, "wb") as file:
            file.write(spoilt)
        standing.set("FileName", path)
        standing.update()
        faults = self.judge(standing)
        standing.reset("FileName")
        os.remove(path)
        return faults + self.recovered(standing)

    def _with_input(self, standing, port, producer, must_equal=False, passed_on=None):
        setattr(standing.proxy, port, producer)
        standing.update()
        faults = self.judge(standing, passed_on=passed_on)
        if must_equal and not faults and standing.outputs():
            if is_empty(standing.outputs()[0]) or measures(standing.outputs()) != standing.measures:
                faults.append("is not the result of all blocks together")
        setattr(standing.proxy, port, standing.inputs[port])
        faults += self.recovered(standing)
        simple.Delete(producer)
        return faults

    def run_data(self, name, port, what):
        target = self.targets[name]
        standing = self.stand(name)
        good = self.small[target.ports[port]]
        spoilt = inputs.spoilers(good)[what](inputs.copy(good))
        joined = what in inputs.JOINED and target.ports[port] not in ("image", "mask")
        where, *name, _ = what.split(".") if "." in what else (what, "")
        passed_on = "field." + ".".join(name) if where == "field" and name != ["Domain"] else None
        return self._with_input(standing, port, produce(spoilt), must_equal=joined, passed_on=passed_on)

    def run_source(self, name, port, source):
        standing = self.stand(name)
        made = servermanager._getPyProxy(servermanager.ProxyManager().NewProxy("sources", source))
        return self._with_input(standing, port, made)

    def run_missing(self, name, port):
        """An input that is not connected."""
        standing = self.stand(name)
        target = self.targets[name]
        if port not in target.optional:
            return []  # ParaView asks for it before any filter does
        setattr(standing.proxy, port, None)
        standing.update()
        faults = self.judge(standing)
        setattr(standing.proxy, port, standing.inputs[port])
        return faults + self.recovered(standing)

    def run_memory(self, name, megabytes):
        """With so little address space left that an allocation fails, at one stage or another."""
        if self.large is None:
            self.large = self._good_data(large=True)
        self.good = self.large
        try:
            standing = self.stand(name, **LARGE.get(name, {}))
        finally:
            self.good = self.small
        standing.modify()
        for output in standing.outputs():
            output.Initialize()
        with address_space(float(megabytes)):
            standing.update()
        faults = self.judge(standing)
        standing.modify()
        return faults + self.recovered(standing)

    def run_costly(self, name, number):
        """Legal, and much work: a result or an error within the time limit."""
        standing = self.stand(name, **({"VoxelSize": 0.1} if name == "FibreRadialGrowth" else {}))
        chosen = COSTLY[name][int(number)]
        producer = None
        if name == "MyelinSurface":
            fibres = produce(self.small["fibres"])
            producer = simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.1)
            standing.proxy.Input = producer
        for one, value in chosen.items():
            standing.set(one, value)
        standing.update()
        faults = self.judge(standing)
        for one in chosen:
            standing.reset(one)
        if producer is not None:
            standing.proxy.Input = standing.inputs["Input"]
        faults += self.recovered(standing)
        if producer is not None:
            simple.Delete(producer)
            simple.Delete(fibres)
        return faults

    def run_stop(self, name):
        """Stopped by the user as soon as it tells of its progress; and then asked again."""
        standing = self.stand(name)
        algorithm = standing.proxy.GetClientSideObject()
        had_data = [not is_empty(data) for data in standing.outputs()]
        standing.modify()
        observer = algorithm.AddObserver("ProgressEvent", lambda *_: algorithm.SetAbortExecute(1))
        standing.update()
        algorithm.RemoveObserver(observer)
        errors, warnings = self.reports.take()
        faults = []
        if len(set(errors + warnings)) > 1:  # each output is asked for by itself
            faults.append("more than one message: " + " | ".join(errors + warnings))
        standing.update()
        told = self.reports.take()
        for port, data in enumerate(standing.outputs()):
            if had_data[port] and is_empty(data) and not marks(data) and not any(told):
                faults.append(f"output {port} is empty without a word, when asked a second time")
        standing.modify()
        return faults + self.recovered(standing)

    def run_time(self, name, port):
        """Data that change with time: good, then nothing, then not a number, then good."""
        global _steps
        standing = self.stand(name)
        good = self.small[self.targets[name].ports[port]]
        kind = {"vtkPolyData": 0, "vtkImageData": 6}[good.GetClassName()]
        spoil = inputs.put(math.nan) if kind == 0 else inputs.spoilers(good).get("depth-one-nan", inputs.bare)
        bad = spoil(inputs.copy(good))
        _steps = [good, good.NewInstance(), bad, good]
        source = simple.ProgrammableSource()
        for one, value in {
            "OutputDataSetType": "vtkPolyData" if kind == 0 else "vtkImageData",
            "Script": "from torture import cases; cases.time_step(self)",
            "ScriptRequestInformation": "from torture import cases; cases.time_information(self)",
        }.items():
            setattr(source, one, value)
        setattr(standing.proxy, port, source)
        faults = []
        standing.proxy.UpdatePipelineInformation()
        passed_on = Pipeline.TIME_STEPS().Length(standing.proxy.GetClientSideObject().GetOutputInformation(0)) == len(_steps) if standing.outputs() else False
        for time in range(len(_steps) if passed_on else 1):  # VTK passes on the times of the first input
            standing.update(float(time))
            found = self.judge(standing)
            keeps = "Write" in self.note  # its folder, where only what comes in has changed
            if time == 2 and not keeps and name not in PASSING_ON and not found and not any(marks(data) for data in standing.outputs()) and standing.outputs():
                found = ["accepts what is not a number"]
            if time in (0, 3) and not found and standing.outputs() and is_empty(standing.outputs()[0]):
                found = ["no result"]
            faults += [f"at time {time}: {each}" for each in found]
        setattr(standing.proxy, port, standing.inputs[port])
        faults += self.recovered(standing)
        simple.Delete(source)
        return faults

    def run_chain(self, name):
        """A fault anywhere in the chain: one message, all that follows empty and marked, and all well again afterwards."""
        folder = tempfile.mkdtemp(dir=self.folder)
        made = chain(os.path.join(folder, "x"))

        def update():
            for stage in reversed(made):
                made[stage].UpdatePipeline()
            result = {}
            for stage in made:
                algorithm = made[stage].GetClientSideObject()
                result[stage] = [algorithm.GetOutputDataObject(port) for port in range(algorithm.GetNumberOfOutputPorts())]
            return result

        try:
            good = {stage: fingerprint(outputs) for stage, outputs in update().items()}
            faults = [f"the good chain reports: {text}" for text in self.reports.take()[0]]
            one = first_length(self.targets[name])
            keep = exchange(made[name], one, math.nan)
            outputs = update()
            errors, warnings = self.reports.take()
            self.note = " | ".join(errors)
            if len(errors) != 1 or one not in errors[0]:
                faults.append(f"one error that names {one} was expected: " + " | ".join(errors))
            if warnings:
                faults.append("warns besides: " + " | ".join(warnings))
            for stage in following(made, name):
                for port, data in enumerate(outputs[stage]):
                    if not is_empty(data):
                        faults.append(f"{stage}'s output {port} is not empty")
                    elif not marks(data):
                        faults.append(f"{stage}'s output {port} is not marked")
            exchange(made[name], one, keep)
            after = {stage: fingerprint(outputs) for stage, outputs in update().items()}
            faults += [f"the good value then fails: {text}" for text in self.reports.take()[0]]
            faults += [f"{stage} is another one afterwards" for stage in made if after[stage] != good[stage]]
        finally:
            for proxy in reversed(list(made.values())):
                simple.Delete(proxy)
            shutil.rmtree(folder, ignore_errors=True)
        return faults

    def _in_another_process(self, *arguments):
        """Runs this test's script once more; the faults that it tells."""
        command = [os.readlink("/proc/self/exe"), self.script, *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=SERVER_SECONDS, cwd=self.folder)
        told = [line for line in done.stdout.splitlines() if line.startswith("{")]
        if done.returncode != 0 or not told:
            return [f"the process ended with {done.returncode}: " + " | ".join((done.stdout + done.stderr).splitlines()[-5:])]
        told = json.loads(told[-1])
        self.note = told["note"]
        return told["faults"]

    def run_cold(self, megabytes):
        """A whole chain in a process that has just been started, with so much memory left."""
        return self._in_another_process("--cold", megabytes)

    def run_server(self, ranks, name):
        """A fault and its mending, in a client of a server on so many ranks."""
        with socket.socket() as probe:
            probe.bind(("localhost", 0))
            port = probe.getsockname()[1]
        environment = environment_of_its_own()
        environment.update({"OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
        command = ["pvserver", f"--server-port={port}", "--force-offscreen-rendering"]
        if int(ranks) > 1:
            command = ["mpiexec", "--oversubscribe", "-n", ranks] + command
        server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        try:
            for line in server.stdout:
                if "Accepting connection" in line:
                    break
            return self._in_another_process("--client", str(port), name)
        except subprocess.TimeoutExpired:
            return ["client and server hang"]
        finally:
            server.terminate()
            try:
                server.wait(5)
            except subprocess.TimeoutExpired:
                server.kill()
                server.wait()
            server.stdout.close()


def chain(folder):
    """{stage: proxy} of the whole chain, not updated."""
    made = {}

    def add(stage, **inputs_):
        chosen = {name: value for name, value in SMALL.get(stage, {}).items() if name != "RadiusTable"}
        made[stage] = getattr(simple, stage)(**inputs_, **chosen)
        return made[stage]

    fibres = simple.OutputPort(add("CapsuleOptimizer", Input=add("BundleInitializer")), 0)
    surfaces = add("MyelinSurface", Input=add("FibreRadialGrowth", Input=fibres))
    outer, inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
    add("SubstrateStatistics", Fibres=fibres, Outer=outer, Inner=inner)
    add("SubstrateCertificate", Outer=outer, Inner=inner, Fibres=fibres)
    add("SubstrateWriter", Outer=outer, Inner=inner, Fibres=fibres, FolderName=folder)
    return {stage: made[stage] for stage in ("BundleInitializer", *[stage for stage in made if stage != "BundleInitializer"])}


def following(made, name):
    """The stage and all that follow it."""
    stages = list(made)
    return stages[stages.index(name) :] if name in stages[:4] else [name]


def first_length(target):
    return next(each for each in target.numbers if each.tag == "DoubleVectorProperty").get("name")


def exchange(proxy, one, value):
    """Sets a number, and gives back what it was."""
    helper = vtkSMPropertyHelper(proxy.SMProxy, one)
    before = helper.GetAsDouble()
    helper.Set(value)
    proxy.SMProxy.UpdateVTKObjects()
    return before


def cold(megabytes):
    """What `--cold` does: the chain with so much address space left, then without a limit. Tells {faults, note} as JSON."""
    reports = Reports()
    folder = tempfile.mkdtemp()
    made = chain(os.path.join(folder, "x"))
    with address_space(float(megabytes)):
        for stage in reversed(made):
            made[stage].UpdatePipeline()
    errors, _ = reports.take()
    faults = [f"{len(errors)} errors: " + " | ".join(errors)] if len(errors) > 1 else []
    faults += ["speaks C++: " + text for text in errors if CPLUSPLUS.search(text)]
    for proxy in made.values():
        proxy.GetClientSideObject().Modified()
        proxy.SMProxy.MarkDirty(None)
    for stage in reversed(made):
        made[stage].UpdatePipeline()
    after, _ = reports.take()
    faults += ["with memory enough it then fails: " + text for text in after]
    if not faults:
        for stage, proxy in made.items():
            if all(is_empty(proxy.GetClientSideObject().GetOutputDataObject(port)) for port in range(proxy.GetClientSideObject().GetNumberOfOutputPorts())):
                faults.append(f"with memory enough {stage} gives nothing")
    shutil.rmtree(folder, ignore_errors=True)
    os.write(1, (json.dumps({"faults": faults, "note": " | ".join(errors) or "result"}) + "\n").encode())
    os._exit(0)


def client(port, name):
    """What `--client` does: on a server, a fault in stage `name` and its mending."""
    simple.Connect("localhost", int(port))
    folder = tempfile.mkdtemp()
    made = chain(os.path.join(folder, "x"))

    def update():
        for stage in reversed(made):
            made[stage].UpdatePipeline()
        return {
            stage: [servermanager.Fetch(proxy, idx=output) for output in range(proxy.SMProxy.GetNumberOfOutputPorts())] for stage, proxy in made.items()
        }

    good = {stage: fingerprint(outputs) for stage, outputs in update().items()}
    keep = exchange(made[name], first_length(targets()[name]), math.nan)
    outputs = update()
    faults = []
    for stage in following(made, name):
        faults += [f"{stage}'s output {number} is not empty" for number, data in enumerate(outputs[stage]) if not is_empty(data)]
    exchange(made[name], first_length(targets()[name]), keep)
    after = {stage: fingerprint(outputs) for stage, outputs in update().items()}
    faults += [f"{stage} is another one afterwards" for stage in made if after[stage] != good[stage]]
    shutil.rmtree(folder, ignore_errors=True)
    os.write(1, (json.dumps({"faults": faults, "note": ""}) + "\n").encode())
    os._exit(0)


_steps = []


def time_information(source):
    info = source.GetOutputInformation(0)
    times = [float(time) for time in range(len(_steps))]
    info.Set(Pipeline.TIME_STEPS(), times, len(times))
    info.Set(Pipeline.TIME_RANGE(), [times[0], times[-1]], 2)
    if _steps[0].IsA("vtkImageData"):
        info.Set(Pipeline.WHOLE_EXTENT(), _steps[0].GetExtent(), 6)


def time_step(source):
    time = source.GetOutputInformation(0).Get(Pipeline.UPDATE_TIME_STEP())
    source.GetOutputDataObject(0).ShallowCopy(_steps[int(time or 0)])


def measures(outputs):
    """What a result must keep when its input comes in blocks: how much there is of everything, and the sorted ids."""
    result = []
    for data in outputs:
        for each in leaves(data):
            row = [each.GetClassName()]
            if each.IsA("vtkDataSet"):
                row += [each.GetNumberOfPoints(), each.GetNumberOfCells(), tuple(round(x, 6) for x in each.GetBounds())]
            else:
                row += [each.GetNumberOfElements(6)]
            result.append(tuple(row))
    return result


@contextlib.contextmanager
def address_space(megabytes):
    """Leaves so much address space for what is mapped now, and gives the rest back afterwards."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm") as file:
        mapped = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (mapped + int(megabytes * 2**20), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


# All cases -----------------------------------------------------------------------------------------------------------------------


def sources():
    """ParaView's own sources that need neither file nor connection."""
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    iterator = manager.GetProxyDefinitionManager().NewSingleGroupIterator("sources")
    iterator.InitTraversal()
    ours = set(targets())
    left_out = re.compile("Selection|TrivialProducer|LiveProgrammable|MultiServer|TemporalCache|Test3D|FastUniformGrid|BlockSelectors|SplineSource")
    while not iterator.IsDoneWithTraversal():
        name = iterator.GetProxyName()
        prototype = manager.GetPrototypeProxy("sources", name)
        names, properties = [], prototype.NewPropertyIterator()
        properties.Begin()
        while not properties.IsAtEnd():
            names.append(properties.GetKey())
            properties.Next()
        if name not in ours and not left_out.search(name) and not any("File" in each or "Directory" in each for each in names):
            yield name
        iterator.GoToNextItem()


def all_cases(bench):
    """{name: whether it belongs to the short run} of every case."""
    result = {}

    def add(name, always=True, share=1.0):
        """`share`: how many of such cases the short run takes, picked by their name."""
        result[name] = always and (zlib.crc32(name.encode()) % 1000) < 1000 * share

    from_paraview = list(sources())
    for name, target in bench.targets.items():
        for one in target.numbers:
            add(f"bounds/{name}/{one.get('name')}")
            for value in values(one):
                important = value in ("nan", "1e300", "-1", "0", "min", "max", "beyond-min", "beyond-max", "2^31-1")
                add(f"property/{name}/{one.get('name')}/{value}", share=0.18 if important else 0.05)
        for one in target.texts:
            place = tempfile.mkdtemp()
            for what in playground(place, {}):
                add(f"text/{name}/{one.get('name')}/{what}", share=0.2)
            shutil.rmtree(place)
        if target.reads:
            with open(bench.good_file(target), "rb") as file:
                for what in spoilt_files(file.read()):
                    add(f"file/{name}/{what}")
        for port, kind in target.ports.items():
            data = bench.good[kind]
            for what in inputs.spoilers(data):
                if what.count("."):
                    share = 0.008
                elif what.startswith("empty-"):
                    share = 0.1
                else:
                    share = 0.15 if port in ("Input", "Outer") or what in inputs.COMPOSITES else 0.08
                add(f"data/{name}/{port}/{what}", share=share)
            for source in from_paraview:
                add(f"source/{name}/{port}/{source}", share=0.15)
            add(f"time/{name}/{port}")
            add(f"missing/{name}/{port}")
        for megabytes in MEGABYTES:
            add(f"memory/{name}/{megabytes}", share=0.6)
        for number in range(len(COSTLY.get(name, []))):
            add(f"costly/{name}/{number}")
        add(f"stop/{name}")
    for name in CHAIN:
        add(f"chain/{name}")
        for ranks in (1, 2):
            add(f"server/{ranks}/{name}", always=ranks == 1, share=0.3)
    for megabytes in COLD_MEGABYTES:
        add(f"cold/{megabytes}", share=0.6)
    return result
