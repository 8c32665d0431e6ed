// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/WholeNumber.h"

#include <string>

/// What the command was told.
struct CommandLine
{
  std::string recipe;                        ///< a file, or a substrate folder
  std::string output;                        ///< empty where none is named
  int threads = 0;                           ///< 0: what the recipe says
  int progress = cactus::usualProgressPause; ///< seconds between lines of progress where there is no terminal; 0: none
  bool wantsHelp = false;
  bool wantsVersion = false;
};

/// Throws cactus::InvalidInput for what is no use of the command.
CommandLine parseCommandLine(int count, char** arguments);

/// How to use the command.
extern const char* const commandHelp;
