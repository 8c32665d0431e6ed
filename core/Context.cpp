// SPDX-License-Identifier: BSD-3-Clause
#include "Context.h"

#include "Error.h"

#include <omp.h>

namespace cactus
{

int Context::threadCount() const
{
  return threads > 0 ? threads : omp_get_max_threads();
}

void Context::checkpoint() const
{
  if (stopRequested())
  {
    throw Cancelled("stopped by the user");
  }
}

} // namespace cactus
