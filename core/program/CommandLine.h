// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/WholeNumber.h"

#include <string>

/// The options of the command.
struct CommandLine
{
  std::string recipe;                        ///< a file, or a substrate folder
  std::string output;                        ///< empty if none is named
  int threads = 0;                           ///< 0: as in the recipe
  int progress = cactus::usualProgressPause; ///< seconds between lines of progress without a terminal; 0: none
  bool wantsHelp = false;
  bool wantsVersion = false;
};

/// Parses the arguments. Throws cactus::InvalidInput for invalid ones.
CommandLine parseCommandLine(int count, char** arguments);

/// The help text of the command.
extern const char* const commandHelp;
