# SPDX-License-Identifier: BSD-3-Clause
"""ParaView offers each filter and format for the data that it can take, and for no other: what its menu of filters and its list of
formats ask of the proxies, for all that a chain makes and for data of other origin."""

import os
import re

import nibabel
import numpy
from cactus_testing import UNPARTED, CactusTestCase, main
from paraview import servermanager, simple

FIBRES = {"CapsuleOptimizer", "FibreRadialGrowth", "SubstrateProduction", "SubstrateStatistics"}
LABELS = {"FibreField", "MyelinSurface"}
LINES = {"TractFibres"}
SURFACES = {"HistologyMask", "Lesion", "SubstrateCertificate", "SubstrateSampler", "SubstrateStatistics", "SubstrateWriter"}
FIBRE_FILES = {"strands", "tck", "trx"}
SURFACE_FILES = {"substrate"}
IMAGE_FILES = {"nii"}


def asked(prototype):
    """The input that ParaView's menu asks: Input, or the first by name."""
    names = []
    each = servermanager.PropertyIterator(prototype)
    for one in each:
        if one.IsA("vtkSMInputProperty"):
            names.append(each.GetKey())
    return prototype.GetProperty("Input" if "Input" in names else sorted(names)[0])


def is_offered(name, source):
    """Whether the menu of filters has `name` for a source."""
    asked_property = asked(servermanager.ProxyManager().GetPrototypeProxy("filters", name))
    asked_property.RemoveAllUncheckedProxies()
    asked_property.AddUncheckedInputConnection(source.SMProxy, source.Port)
    try:
        return bool(asked_property.IsInDomains())
    finally:
        asked_property.RemoveAllUncheckedProxies()


def formats(source):
    """Endings of ours among those that File > Save Data lists."""
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    if factory.GetNumberOfRegisteredPrototypes() == 0:
        factory.UpdateAvailableWriters()
    listed = factory.GetSupportedFileTypes(source.SMProxy, source.Port)
    return set(re.findall(r"\*\.(\w+)", listed)) & (FIBRE_FILES | SURFACE_FILES | IMAGE_FILES)


class Offers(CactusTestCase):
    expected = UNPARTED

    def assertOffered(self, source, filters, files=frozenset(), port=0):
        source = simple.OutputPort(source, port) if port or source.Port == 0 else source
        source.UpdatePipeline()
        self.assertEqual({name for name in FIBRES | LINES | LABELS | SURFACES if is_offered(name, source)}, set(filters))
        self.assertEqual(formats(source), set(files))

    def bundle(self, seed=1):
        return simple.BundleInitializer(Border="Walls", Side=5, FibreVolumeFraction=0.3, GrownFibreVolumeFraction=0.5, Seed=seed)

    def test_the_chain(self):
        bundle = self.bundle()
        optimizer = simple.CapsuleOptimizer(Input=bundle)
        fibres, outer = simple.OutputPort(optimizer, 0), None
        grown = simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.2)
        surfaces = simple.MyelinSurface(Input=grown)
        outer = simple.OutputPort(surfaces, 0)
        for data in (bundle, fibres):
            self.assertOffered(data, FIBRES | LINES, FIBRE_FILES)
        self.assertOffered(optimizer, (), port=1)
        self.assertOffered(grown, LABELS, IMAGE_FILES)
        self.assertOffered(outer, SURFACES, SURFACE_FILES)
        self.assertOffered(surfaces, SURFACES, SURFACE_FILES, port=1)
        self.assertOffered(surfaces, (), port=2)
        self.assertOffered(simple.SubstrateCertificate(Outer=outer), ())
        self.assertOffered(simple.SubstrateStatistics(Fibres=outer), ())
        self.assertOffered(simple.SubstrateSampler(Outer=outer), (), IMAGE_FILES)

    def test_a_tractogram_without_radii(self):
        """It is one, too, when it has got ids by saving."""
        path = os.path.join(self.folder, "plain.tck")
        nibabel.streamlines.TckFile(nibabel.streamlines.Tractogram([numpy.arange(9, dtype="f4").reshape(3, 3)], affine_to_rasmm=numpy.eye(4))).save(path)
        for _ in range(2):
            tract = simple.TractogramReader(FileName=path)
            self.assertOffered(tract, LINES, {"tck", "trx"})
            path = os.path.join(self.folder, "plain.trx")
            simple.SaveData(path, proxy=tract)

    def test_blocks(self):
        both = simple.GroupDatasets(Input=[self.bundle(), self.bundle(2)])
        self.assertOffered(both, FIBRES | LINES, FIBRE_FILES)
        fields = simple.FibreField(Input=simple.FibreRadialGrowth(Input=self.bundle(), VoxelSize=0.2), Select="All fibres")
        self.assertOffered(fields, ())
        contours = simple.Contour(Input=fields, ContourBy=["POINTS", "Field"], Isosurfaces=[0])
        self.assertOffered(contours, SURFACES, SURFACE_FILES)

    def test_files(self):
        path = os.path.join(self.folder, "two.strands")
        with open(path, "w", encoding="utf-8") as file:
            file.write("6\n2\n2\n-1 0 -4 0.7\n-1 0 4 0.7\n2\n1 0 -4 0.7\n1 0 4 0.7\n")
        self.assertOffered(simple.StrandReader(FileName=path), FIBRES | LINES, FIBRE_FILES)

    def test_other_data(self):
        for source in (simple.Sphere(), simple.Line()):
            self.assertOffered(source, LINES)  # what cells they have, ParaView does not tell
        self.assertOffered(simple.Wavelet(), (), IMAGE_FILES)

    def test_other_inputs_of_a_filter(self):
        """Once the first is connected, each input takes its own, as in Change Input."""
        bundle = self.bundle()
        surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=bundle, VoxelSize=0.2))
        outer, inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
        certificate = simple.SubstrateCertificate(Outer=outer)
        certificate.UpdatePipeline()
        for name, source, fits in (("Fibres", simple.OutputPort(bundle, 0), True), ("Fibres", inner, False),
                                   ("Inner", inner, True), ("Inner", simple.OutputPort(bundle, 0), False)):
            place = certificate.SMProxy.GetProperty(name)
            place.RemoveAllUncheckedProxies()
            place.AddUncheckedInputConnection(source.SMProxy, source.Port)
            self.assertEqual(bool(place.IsInDomains()), fits, name)
            place.RemoveAllUncheckedProxies()


if __name__ == "__main__":
    main()
