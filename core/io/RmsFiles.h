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

/// Writes `intra/` and, if there are outer surfaces, `extra/`: two simulations for the realistic microstructure simulator
/// (RMS; Lee et al. 2021, J Neurosci Methods 350:109018), each with
///
///   fiber.txt           labels of voxels of contents.voxelSize: 1 where walkers are, 0 elsewhere; z runs fastest, x slowest
///   simParamInput.txt   step (ms), steps, walkers, gradients, compartments, voxel size (µm), voxels along x, y, z
///   diffusivity.txt     µm²/ms, of label 0 and of label 1
///   T2.txt              ms, likewise
///   bval.txt, bvec.txt  ms/µm² and unit vectors, those of MC/DC's scheme
///
/// A voxel belongs to its largest compartment (see SampledSubstrate). There are two simulations because RMS lets walkers pass
/// from any label but 0 into any other. Throws as requireRmsVoxels() does, InvalidInput if VoxelSize leaves no voxel to walkers,
/// or if voxels inside two fibres share a face, through which walkers would pass from one into the other; OutOfMemory, FileError
/// and Cancelled.
void writeRms(const SubstrateFolderContents& contents, FolderWriter& writer, const Context& context);

} // namespace cactus
