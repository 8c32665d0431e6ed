// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

/// What the command's user sees on standard error: lines, and one of progress where that is a terminal.
class Terminal
{
public:
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// Changes the line of progress, at most ten times a second.
  void progress(double fraction, const std::string& message);
  /// "cactus-grow: …", on one line.
  void say(const std::string& message);

private:
  void clear();

  bool IsTerminal;
  bool IsShown = false; ///< a line of progress
  std::chrono::steady_clock::time_point LastTime;
};
