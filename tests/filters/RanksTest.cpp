// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the memory of a machine is divided among the processes of a run on it.
#include "Ranks.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace
{

const char* const variables[] = { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "PMI_LOCAL_SIZE", "MV2_COMM_WORLD_LOCAL_SIZE",
  "JSM_NAMESPACE_LOCAL_SIZE", "SLURM_STEP_TASKS_PER_NODE" };

class Ranks : public testing::Test
{
protected:
  void SetUp() override { TearDown(); }
  void TearDown() override
  {
    for (const char* variable : variables)
    {
      unsetenv(variable);
    }
  }
};

TEST_F(Ranks, AreAllOnThisMachineWhereNobodySaysOtherwise)
{
  EXPECT_EQ(cactus::processesOnThisMachine(1), 1);
  EXPECT_EQ(cactus::processesOnThisMachine(12), 12);
}

TEST_F(Ranks, AreAsManyAsTheLauncherSays)
{
  for (const char* variable : variables)
  {
    SCOPED_TRACE(variable);
    setenv(variable, "4", 1);
    EXPECT_EQ(cactus::processesOnThisMachine(12), 4);
    EXPECT_EQ(cactus::processesOnThisMachine(2), 2); // a separate run inside another's
    unsetenv(variable);
  }
  setenv("SLURM_STEP_TASKS_PER_NODE", "3(x2),1", 1);
  EXPECT_EQ(cactus::processesOnThisMachine(7), 3);
  setenv("SLURM_STEP_TASKS_PER_NODE", "nonsense", 1);
  EXPECT_EQ(cactus::processesOnThisMachine(7), 7);
}

} // namespace
