// SPDX-License-Identifier: BSD-3-Clause
#include "KeptFolder.h"

#include "FilterSupport.h"

#include <vtkAlgorithm.h>
#include <vtkMultiProcessController.h>

namespace cactus
{

bool KeptFolder::isWritten(vtkAlgorithm* self) const
{
  return this->Time == self->GetMTime();
}

void KeptFolder::noteWritten(vtkAlgorithm* self, vtkMTimeType newestInput)
{
  this->InputTime = newestInput;
  this->Time = self->GetMTime();
}

std::string KeptFolder::remark(const std::string& folder, vtkMTimeType newestInput)
{
  if (newestInput == this->InputTime)
  {
    return "";
  }
  this->InputTime = newestInput;
  return "what comes in has changed since " + folder +
         " was written, which stays as it is: press Write, or in a script call InvokeCommand(\"Write\"), to write it "
         "again, or give another FolderName";
}

bool writeNow(vtkAlgorithm* self)
{
  self->Modified();
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isParallel = controller != nullptr && controller->GetNumberOfProcesses() > 1;
  self->UpdatePiece(isParallel ? controller->GetLocalProcessId() : 0, isParallel ? controller->GetNumberOfProcesses() : 1, 0);
  return errorOf(self->GetOutputDataObject(0)).empty();
}

} // namespace cactus
