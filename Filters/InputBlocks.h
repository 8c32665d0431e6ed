// SPDX-License-Identifier: BSD-3-Clause
// One data set or many blocks of them: what filters see is the list of blocks.
#pragma once

#include <vtkType.h>

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataObject;
class vtkPolyData;

namespace cactus
{

/// A part of an input, and how to speak of it.
struct InputBlock
{
  vtkPolyData* data = nullptr;
  std::string name; ///< "" for an input of one part, else "block 2 (Name)"
};

/// The parts of an input that hold cells, in their order: those of a composite data set (multi-block, partitioned), whatever
/// its levels, or the input itself. Null and empty parts are left out. `expected` ends the message, "fibres are polylines
/// (vtkPolyData)". Throws InvalidInput for data of another type.
std::vector<InputBlock> polyDataBlocks(vtkDataObject* input, const std::string& expected);

/// All data sets of an input, of any type, empty ones too.
std::vector<vtkDataObject*> leavesOf(vtkDataObject* input);

/// A field data array of the input, or of the first of its blocks that has one of that name; null where there is none.
vtkAbstractArray* fieldArray(vtkDataObject* input, const char* name);

/// When the input or one of its blocks was last changed.
vtkMTimeType changeTime(vtkDataObject* input);

} // namespace cactus
