// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include <vtkMultiProcessController.h>

#include <algorithm>
#include <cstdlib>

namespace cactus
{

namespace
{

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

} // namespace

int processCount()
{
  return controller() != nullptr ? controller()->GetNumberOfProcesses() : 1;
}

bool isFirstProcess()
{
  return controller() == nullptr || controller()->GetLocalProcessId() == 0;
}

int processesOnThisMachine()
{
  return processesOnThisMachine(processCount());
}

int processesOnThisMachine(int processes)
{
  for (const char* variable : { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "PMI_LOCAL_SIZE", "MV2_COMM_WORLD_LOCAL_SIZE",
         "JSM_NAMESPACE_LOCAL_SIZE", "SLURM_STEP_TASKS_PER_NODE" })
  {
    // Slurm lists all nodes, "4(x2),3": the first number is used for all.
    const char* text = std::getenv(variable);
    const long local = text != nullptr ? std::strtol(text, nullptr, 10) : 0;
    if (local > 0)
    {
      return static_cast<int>(std::min<long>(local, processes));
    }
  }
  return processes;
}

} // namespace cactus
