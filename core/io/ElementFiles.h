// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/FolderWriter.h"
#include "io/SubstrateContents.h"

#include <string>
#include <vector>

namespace cactus
{

/// Writes the input from which tetgen makes tetrahedra for SpinDoctor (Li et al. 2019, NeuroImage 202:116120), and for finite
/// elements in general:
///
///   substrate_dir/substrate_mesh.node, .poly   points (µm); triangles of all surfaces and of the domain's faces, which meet in
///                                              edges and corners only, each with the number of its boundary; a point in each
///                                              part of each compartment, with its number
///   compartments.csv                           the fibre and volume of each compartment
///   substrate_cells, setup_substrate.m         for SpinDoctor, which then makes no cells and surfaces of its own
///
/// Compartments are numbered as in SpinDoctor: axons from 1, then the myelin of each fibre, then the extra-axonal space.
/// Boundaries are numbered in the same way: between axons and myelin, myelin and the extra-axonal space, and those in the
/// domain's faces, of axons, of myelin and of the extra-axonal space. Lines are laid out as SpinDoctor's reader expects them,
/// which takes facets of one triangle each.
///
/// Axons, whose surfaces end just before the domain's faces, are extended to them, but for those that would meet their myelin.
/// Returned is what the user has to know: a sentence on such axons, one where SpinDoctor, which wants an axon and an end of each
/// kind in each fibre, would refuse the mesh, and one where `smallestGap` (µm, between two fibres; NaN for a single one) is too
/// narrow for tetgen. Throws InvalidInput where there are no outer surfaces, or one for which joinInBox() throws; FileError and
/// Cancelled.
std::vector<std::string> writeElementFiles(
  const SubstrateFolderContents& contents, double smallestGap, FolderWriter& writer, const Context& context);

} // namespace cactus
