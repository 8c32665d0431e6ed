// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks.h"

#include <vtkMultiProcessController.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace cactus
{

namespace
{

/// What a rank tells the others in an exchange.
enum State
{
  Done = 0,
  GoOn = 1,
  Stop = 2
};

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

/// What the first rank that still works says; Done where none does.
int exchange(int state)
{
  std::vector<int> states(static_cast<std::size_t>(processCount()), Done);
  controller()->AllGather(&state, states.data(), 1);
  const auto first = std::find_if(states.begin(), states.end(), [](int one) { return one != Done; });
  return first != states.end() ? *first : Done;
}

} // namespace

int processCount()
{
  return controller() != nullptr ? controller()->GetNumberOfProcesses() : 1;
}

RankAgreement::RankAgreement(bool isNeeded)
  : IsNeeded(isNeeded && processCount() > 1)
{
}

RankAgreement::~RankAgreement()
{
  while (this->IsNeeded && exchange(Done) != Done)
  {
  }
}

bool RankAgreement::decide(bool wanted)
{
  return this->IsNeeded ? exchange(wanted ? Stop : GoOn) == Stop : wanted;
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
    // Slurm lists all nodes, "4(x2),3": the first is taken for all.
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
