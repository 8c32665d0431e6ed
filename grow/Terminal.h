// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

/// What the command's user sees on standard error: lines, and its progress: one that changes where that is a
/// terminal, else one after the other, as the log of a job wants it.
class Terminal
{
public:
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// How long to wait between lines of progress where there is no terminal; 0, the default: there are none.
  void setPause(std::chrono::seconds pause);
  /// Changes the line of progress, at most ten times a second, or says it when the pause is over.
  void progress(double fraction, const std::string& message);
  /// "cactus-grow: …", on one line.
  void say(const std::string& message);

private:
  void clear();

  bool IsTerminal;
  std::chrono::steady_clock::duration Pause;      ///< between two changes of the progress
  bool IsShown = false;                           ///< a line of progress
  std::chrono::steady_clock::time_point LastTime; ///< of progress; at first when this was made
};
