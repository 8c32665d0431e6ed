// SPDX-License-Identifier: BSD-3-Clause
// The processes of a parallel run.
#pragma once

namespace cactus
{

/// Returns the number of processes of this run.
int processCount();

/// Tells whether this is the first process, which reports for all.
bool isFirstProcess();

/// Returns how many processes of this run share this machine's memory, from the launcher's environment variables (Open MPI,
/// MPICH, Intel MPI, MVAPICH, Slurm, jsrun); all of them without such a variable. It is not collective, since some ranks may not
/// call it.
int processesOnThisMachine();

/// Does the same for a run of `processes`.
int processesOnThisMachine(int processes);

} // namespace cactus
