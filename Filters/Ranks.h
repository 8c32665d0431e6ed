// SPDX-License-Identifier: BSD-3-Clause
// What the processes of a parallel run have to know of each other.
#pragma once

namespace cactus
{

/// How many processes this run has.
int processCount();

/// Whether this one is the first of them, which speaks for all.
bool isFirstProcess();

/// How many processes of this run share this machine's memory: as the launcher of the run tells in the environment (Open MPI,
/// MPICH, Intel MPI, MVAPICH, Slurm, jsrun); all of them where it does not. Without an exchange, which would wait for ranks that
/// do not ask.
int processesOnThisMachine();

/// The same for a run of `processes`.
int processesOnThisMachine(int processes);

} // namespace cactus
