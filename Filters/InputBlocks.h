// SPDX-License-Identifier: BSD-3-Clause
// Splits an input, one data set or many, into the list of blocks that filters work on.
#pragma once

#include <vtkType.h>

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataObject;
class vtkPolyData;

namespace cactus
{

/// A part of an input, and its name in messages.
struct InputBlock
{
  vtkPolyData* data = nullptr;
  std::string name; ///< "" for an input of one part, else "block 2 (Name)"
};

/// Returns the non-empty parts of an input, in their order: those of a composite data set (multi-block, partitioned) at any
/// level, or the input itself. `expected` ends the message, "fibres are polylines (vtkPolyData)". Throws InvalidInput for data of
/// another type.
std::vector<InputBlock> polyDataBlocks(vtkDataObject* input, const std::string& expected);

/// Returns all data sets of an input, of any type, empty ones too.
std::vector<vtkDataObject*> leavesOf(vtkDataObject* input);

/// Returns a field data array of the input, or of the first of its blocks that has one of that name; null if there is none.
vtkAbstractArray* fieldArray(vtkDataObject* input, const char* name);

/// Returns when the input or one of its blocks was last changed.
vtkMTimeType changeTime(vtkDataObject* input);

} // namespace cactus
