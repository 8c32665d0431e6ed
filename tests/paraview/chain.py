# SPDX-License-Identifier: BSD-3-Clause
"""A small chain of all stages, and a value of each that cannot work."""

import os

from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, StrandReader,
                             SubstrateCertificate, SubstrateStatistics, SubstrateWriter)

STRANDS = "6\n2\n2\n-1 0 -4 0.7\n-1 0 4 0.7\n2\n1 0 -4 0.7\n1 0 4 0.7\n"


class Chain:
    """The stages by name, none of which has run. `folder` is where files go."""

    def __init__(self, folder):
        self.strands = os.path.join(folder, "two.strands")
        with open(self.strands, "w") as file:
            file.write(STRANDS)
        self.reader = StrandReader(FileName=self.strands)
        self.bundle = BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.2, MinimumRadius=0.4, MeanDispersion=2, GrownFibreVolumeFraction=0)
        self.optimizer = CapsuleOptimizer(Input=self.bundle)
        self.growth = FibreRadialGrowth(Input=OutputPort(self.optimizer, 0), VoxelSize=0.15, GrowthIterations=1)
        self.surface = MyelinSurface(Input=self.growth)
        measured = {"Fibres": OutputPort(self.optimizer, 0), "Outer": OutputPort(self.surface, 0), "Inner": OutputPort(self.surface, 1)}
        self.statistics = SubstrateStatistics(**measured)
        self.certificate = SubstrateCertificate(**measured)
        self.writer = SubstrateWriter(FolderName=os.path.join(folder, "substrate"), **measured)

    def bad_values(self):
        """(stage, its property, a value that cannot work, what the error says)."""
        missing = self.strands + ".missing"
        return (
            (self.reader, "FileName", missing, "missing"),
            (self.bundle, "Side", -6, "Side"),
            (self.optimizer, "MaximumIterations", -1, "MaximumIterations"),
            (self.growth, "VoxelSize", -1, "VoxelSize"),
            (self.surface, "GRatio", -1, "GRatio"),
            (self.statistics, "NumberOfBins", 0, "NumberOfBins"),
            (self.certificate, "MinimumGap", -2, "MinimumGap"),
            (self.writer, "FolderName", "", "FolderName"),
        )
