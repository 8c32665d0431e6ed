// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

/// Output of the command on standard error: messages, and progress: one changing line on a terminal, else line after line, as
/// suits the log of a job.
class Terminal
{
public:
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// Sets the time between lines of progress without a terminal; 0, the default: there are none.
  void setPause(std::chrono::seconds pause);
  /// Updates the line of progress, at most ten times a second, or prints it when the pause is over.
  void progress(double fraction, const std::string& message);
  /// Prints "cactus-grow: …", on one line.
  void say(const std::string& message);

private:
  void clear();

  bool IsTerminal;
  std::chrono::steady_clock::duration Pause;      ///< between two updates of the progress
  bool IsShown = false;                           ///< whether a line of progress is shown
  std::chrono::steady_clock::time_point LastTime; ///< of the last progress; initially the time of construction
};
