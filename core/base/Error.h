// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Numbers.h"

#include <stdexcept>
#include <string>

namespace cactus
{

/// Base of everything core throws. The message names the parameter, fibre or file and says what to do.
class Error : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A parameter or an input that cannot be worked with (out of range, NaN, empty, degenerate).
class InvalidInput : public Error
{
public:
  using Error::Error;
};

/// A valid request that cannot be met; the message says how far it got.
class Infeasible : public Error
{
public:
  using Error::Error;
};

/// The work needs more memory than the machine can give.
class OutOfMemory : public Error
{
public:
  using Error::Error;
};

/// A file or folder that cannot be read or written; the message names the path and, if known, the line.
class FileError : public Error
{
public:
  using Error::Error;
};

/// Thrown when the caller stops a long operation that has no partial result.
class Cancelled : public Error
{
public:
  explicit Cancelled(const std::string& message = "stopped by the user, and nothing is kept: change a property to run it again")
    : Error(message)
  {
  }
};

/// Joins the parts of a message; numbers have four significant digits, whatever the locale.
template <typename... Parts>
std::string text(const Parts&... parts)
{
  TextStream out;
  out.precision(4);
  (out << ... << parts);
  return out.str();
}

/// Throws InvalidInput with `message` unless `good`.
inline void require(bool good, const char* message)
{
  if (!good)
  {
    throw InvalidInput(message);
  }
}

} // namespace cactus
