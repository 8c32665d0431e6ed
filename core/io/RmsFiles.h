// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

namespace cactus
{

/// Throws InvalidInput if voxels of this size (µm) do not fill the domain, at whose faces RMS mirrors the substrate, or if there
/// are too many.
void requireRmsVoxels(const Domain& domain, double voxelSize);

/// Writes `intra/` and, where there are outer surfaces and labels hold the space between them, `extra/`: two simulations for the
/// realistic microstructure simulator (RMS; Lee et al. 2021, J Neurosci Methods 350:109018), each with
///
///   fiber.txt           labels of voxels of contents.voxelSize: 1 where walkers are, 0 elsewhere; z runs fastest, x slowest
///   simParamInput.txt   step (ms), steps, walkers, gradients, compartments, voxel size (µm), voxels along x, y, z
///   diffusivity.txt     µm²/ms, of label 0 and of label 1
///   T2.txt              ms, likewise
///   bval.txt, bvec.txt  ms/µm² and unit vectors, those of MC/DC's scheme
///
/// A voxel is what most of it is (see SampledSubstrate). Two simulations, since RMS lets walkers go from any label but 0 into any
/// other.
///
/// RMS's walkers cross the faces between two voxels only. So where less than 90 % of the voxels outside are connected, or less
/// than 90 % of the volume outside by substrate.certificate is left, `extra/` is not written, and substrate.remarks says so, with
/// the gap and the voxels that would do. Voxels inside, of which each axon's are looked at by themselves, are refused where they
/// are not connected, and warned of where volume is lost. Where more than a tenth of the fibres come nearer to another one than a
/// voxel, substrate.remarks has a warning. substrate.notes gets what was counted of the labels that are written.
///
/// Throws what requireRmsVoxels() does, InvalidInput where VoxelSize leaves no voxel to walkers, and where voxels inside two
/// fibres share a face, through which walkers would go from one into the other; OutOfMemory, FileError and Cancelled.
void writeRms(const SubstrateFolderContents& contents, WrittenSubstrate& substrate, FolderWriter& writer, const Context& context);

} // namespace cactus
