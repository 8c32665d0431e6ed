# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 200
"""What the XML says of outputs, from which pages and help are made, is what comes out: every array, and no other, but for the field data of earlier
stages, which go along."""

import os
import re

from cactus_testing import CactusTestCase, fetch, main, proxies
from paraview import simple
from paraview.simple import OutputPort

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def said():
    """{name: [{(place, array's name)} and the page that has more, for each output]} in the XML."""
    found = {}
    for _, element in proxies():
        for output in element.findall("Hints/Output"):
            arrays = {(one.get("of"), one.get("name")) for one in output}
            found.setdefault(element.get("name"), []).append((arrays, output.get("described")))
    return found


def names(data):
    """The same of a data object; of blocks, those of the first."""
    if data.IsA("vtkCompositeDataSet"):
        every = data.NewIterator()
        return names(every.GetCurrentDataObject())
    if data.IsA("vtkTable"):
        places = {"rows": data.GetRowData(), "field": data.GetFieldData()}
    else:
        places = {"points": data.GetPointData(), "cells": data.GetCellData(), "field": data.GetFieldData()}
    return {(place, arrays.GetArrayName(i)) for place, arrays in places.items() for i in range(arrays.GetNumberOfArrays())}


class FilterPages(CactusTestCase):
    expected = r"from where the fibres run on straight"  # TractFibres, of fibres that the optimiser has cut off in the domain

    def made(self):
        """One of every stage, on a small substrate."""
        bundle = simple.BundleInitializer(Border="Walls", Side=5, MinimumRadius=0.4, MeanDispersion=1)
        optimiser = simple.CapsuleOptimizer(Input=bundle)
        fibres = OutputPort(optimiser, 0)
        grown = simple.FibreRadialGrowth(Input=fibres)
        surfaces = simple.MyelinSurface(Input=grown)
        outer = OutputPort(surfaces, 0)
        strands, tract = (os.path.join(self.folder, name) for name in ("bundle.strands", "bundle.trx"))
        simple.SaveData(strands, proxy=fibres)
        simple.SaveData(tract, proxy=fibres)
        mask = simple.HistologyMask(Outer=outer)
        streamlines = simple.TractogramReader(FileName=tract)
        image = os.path.join(self.folder, "NAME.nii.gz")  # which names the array
        simple.SaveData(image, proxy=grown)
        simple.SubstrateWriter(Outer=outer, FolderName=os.path.join(self.folder, "read")).UpdatePipeline()
        return {
            "BundleInitializer": bundle,
            "CurvedBundles": simple.CurvedBundles(Side=5, MinimumRadius=0.4),
            "CapsuleOptimizer": optimiser,
            "FibreRadialGrowth": grown,
            "MyelinSurface": surfaces,
            "FibreField": simple.FibreField(Input=grown),
            "SubstrateStatistics": simple.SubstrateStatistics(Fibres=outer),
            "SubstrateCertificate": simple.SubstrateCertificate(Outer=outer),
            "SubstrateSampler": simple.SubstrateSampler(Outer=outer, HarmonicsOrder="4", Peaks=1),
            "SubstrateWriter": simple.SubstrateWriter(Outer=outer, FolderName=os.path.join(self.folder, "written")),
            "SubstrateProduction": simple.SubstrateProduction(Input=fibres, FolderName=os.path.join(self.folder, "produced")),
            "HistologyMask": mask,
            "Lesion": simple.Lesion(Outer=outer, MyelinLoss=0.3),
            "HistologyRadii": simple.HistologyRadii(Input=mask, LeaveOutBorder=0),
            "Placement": simple.Placement(Input=outer),
            "StrandReader": simple.StrandReader(FileName=strands),
            "SubstrateReader": simple.SubstrateReader(FileName=os.path.join(self.folder, "read")),
            "TractogramReader": streamlines,
            "NiftiReader": simple.NiftiReader(FileName=image),
            "TractFibres": simple.TractFibres(Input=streamlines, Side=5, MinimumRadius=0.4),
        }

    def test_every_output_is_as_described(self):
        described, made = said(), self.made()
        self.assertEqual(set(described), set(made))
        along = {one for outputs in described.values() for arrays, _ in outputs for one in arrays if one[0] == "field"}
        for name, proxy in made.items():
            self.assertEqual(len(described[name]), proxy.SMProxy.GetNumberOfOutputPorts(), name)
            for port, (wanted, page) in enumerate(described[name]):
                with self.subTest(name=name, port=port):
                    found = names(fetch(proxy, port))
                    if name == "Placement":  # which has besides what came in
                        wanted |= names(fetch(made["MyelinSurface"], port))
                    elif page:  # which has the others
                        with open(os.path.join(ROOT, "docs", page.partition("#")[0]), encoding="utf-8") as file:
                            words = set(re.findall(r"[\w.-]+", " ".join(re.findall(r"`([^`]*)`", file.read()))))
                        wanted |= {one for one in found if one[1] in words}
                    self.assertEqual(found - along, wanted - along)
                    self.assertLessEqual(wanted & along, found)


if __name__ == "__main__":
    main()
