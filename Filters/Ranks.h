// SPDX-License-Identifier: BSD-3-Clause
// What the processes of a parallel run have to know of each other.
#pragma once

namespace cactus
{

/// Makes one decision of what the ranks decide each for itself, so that all stop at the same point of the same work.
///
/// Made by every rank that is asked for the work, the ones that have nothing to do too: each exchange waits for all of them, and
/// the destructor goes on answering until the last has come to its end, by a result or by an exception. So ranks may ask
/// differently often, and none waits for one that has left.
class RankAgreement
{
public:
  /// Exchanges nothing where `isNeeded` is false, or there is one process only.
  explicit RankAgreement(bool isNeeded);
  ~RankAgreement();
  RankAgreement(const RankAgreement&) = delete;
  RankAgreement& operator=(const RankAgreement&) = delete;

  /// What the first rank that still works wants.
  bool decide(bool wanted);

private:
  bool IsNeeded;
};

/// How many processes this run has.
int processCount();

/// How many processes of this run share this machine's memory: as the launcher of the run tells in the environment (Open MPI,
/// MPICH, Intel MPI, MVAPICH, Slurm, jsrun); all of them where it does not. Without an exchange, which would wait for ranks that
/// do not ask.
int processesOnThisMachine();

/// The same for a run of `processes`.
int processesOnThisMachine(int processes);

} // namespace cactus
