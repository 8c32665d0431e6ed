# SPDX-License-Identifier: BSD-3-Clause
"""The names and defaults that scripts rely on: they may be added to, not changed."""

from cactus_testing import CactusTestCase, main, make, proxies
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

# None: the property is public, its default is not.
NAMES = {
    "BundleInitializer": {
        "Side": 30,
        "FibreVolumeFraction": 0.6,
        "RadiusDistribution": "Gamma",
        "GammaShape": 2.4,
        "GammaScale": 0.25,
        "MinimumRadius": 0.2,
        "MaximumRadius": 2.0,
        "MeanDispersion": 5,
        "DispersionModel": "Coherent",
        "NumberOfBundles": 1,
        "CrossingAngle": 90,
        "Border": "Cut",
        "Length": 0,
        "CalibreModel": "Lognormal",
        "CalibreVariation": 0.25,
        "CalibreCorrelationLength": 1.3,
        "BeadAmplitude": 0.6,
        "BeadSpacing": 5.1,
        "BeadSpacingDeviation": 2.3,
        "BeadLength": 2,
        "SectionAxisRatio": 0.85,
        "GRatio": 0,
        "UnmyelinatedFraction": 0,
        "UnmyelinatedRadius": 0.12,
        "UnmyelinatedRadiusDeviation": 0.05,
        "UnmyelinatedCluster": 8,
        "Direction": [0, 0, 1],
        "Mixing": "Interpenetrating",
        "CrossingStyle": "Interwoven",
        "GrownFibreVolumeFraction": 0.9,
        "Seed": 1,
    },
    "CapsuleOptimizer": {
        "MaximumIterations": 3000,
        "OverlapTolerance": 1e-3,
        "OverlapWeight": None,
        "CurvatureWeight": None,
        "LengthWeight": None,
        "RadiusWeight": None,
        "CompactnessWeight": None,
        "StepSize": None,
        "TrimToDomain": 1,
        "NumberOfThreads": 0,
        "TimeBudget": 0,
    },
    "FibreRadialGrowth": {
        "VoxelSize": 0.1,
        "TargetFibreVolumeFraction": -1,
        "GrowthIterations": 0,
        "MinimumGap": 0.02,
        "SurfaceRoughness": 0,
        "SeedDensity": 0,
        "Seed": 1,
        "NumberOfThreads": 0,
    },
    "MyelinSurface": {"MyelinFollowsAxon": 0, "SwellingAmplitude": 0, "SwellingSpacing": 5.1, "SwellingLength": 2, "NodeLength": 0, "InternodeFactor": 100, "ParanodeLength": 2, "NodeConstriction": 0.7,
                      "InternodeLoss": 0, "InternodeOrder": "Random", "RemyelinatedFraction": 0, "RemyelinatedGRatio": 0.85},
    "SubstrateCertificate": {"MinimumGap": -1, "CutSpacing": 1.0},
    "SubstrateStatistics": {},
    "StrandReader": {"FileName": None},
    "SubstrateReader": {"FileName": None},
    "NiftiReader": {"FileName": None, "LengthUnit": "Millimetre"},
    "CurvedBundles": {"Shape": "Bend", "BendRadius": 30, "FanAngle": 30, "KissDistance": 0, "Side": 30, "Margin": 3, "Seed": 1},
    "SubstrateWriter": {"MinimumGap": -1},
    "Placement": {"Place": "By position", "ScaleFactor": 1},
}
CHOICES = {
    ("BundleInitializer", "RadiusDistribution"): ["Gamma", "Lognormal", "Table", "Histogram"],
    ("BundleInitializer", "DispersionModel"): ["Watson", "Cone", "Coherent", "Harmonics", "Peaks"],
    ("BundleInitializer", "Border"): ["Cut", "Walls", "Periodic across", "Periodic"],
    ("BundleInitializer", "Mixing"): ["Interpenetrating", "Layers"],
    ("BundleInitializer", "CrossingStyle"): ["Interwoven", "Sheets"],
    ("BundleInitializer", "CalibreModel"): ["Lognormal", "Beads"],
    ("CurvedBundles", "Shape"): ["Bend", "Fan", "Kiss"],
}
PORTS = {
    "CapsuleOptimizer": ["Fibres", "Convergence"],
    "SubstrateCertificate": ["Certificate", "Fibres", "Verdict"],
    "SubstrateStatistics": ["Substrate", "Fibres", "Histograms", "Profiles", "Summary"],
}


class PublicNames(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.elements = {element.get("name"): element for _, element in proxies()}

    def test_properties_and_defaults(self):
        for name, properties in NAMES.items():
            proxy = make(self.elements[name], {"vtkPolyData": vtkPolyData(), "vtkImageData": vtkImageData()})
            for one, default in properties.items():
                with self.subTest(proxy=name, property=one):
                    value = getattr(proxy, one)
                    if default is not None:
                        self.assertEqual(list(value) if isinstance(default, list) else value, default)

    def test_choices(self):
        for (name, one), choices in CHOICES.items():
            entries = self.elements[name].findall(f"*[@name='{one}']/EnumerationDomain/Entry")
            self.assertEqual([entry.get("text") for entry in entries], choices, one)

    def test_output_ports(self):
        for name, ports in PORTS.items():
            self.assertEqual([port.get("name") for port in self.elements[name].findall("OutputPort")], ports)


if __name__ == "__main__":
    main()
