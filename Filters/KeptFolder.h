// SPDX-License-Identifier: BSD-3-Clause
// For filters that write a folder: when they do, and when they leave it as it is.
#pragma once

#include <vtkType.h>

#include <string>

class vtkAlgorithm;

namespace cactus
{

/// What a filter's folder was written for. A filter writes for changes of its own properties and connections, and when its user
/// says so, not because what comes in has changed.
class KeptFolder
{
public:
  /// Whether it was written for the properties and connections that the filter has now.
  bool isWritten(vtkAlgorithm* self) const;
  /// Notes that it was, and when what came in had been changed last.
  void noteWritten(vtkAlgorithm* self, vtkMTimeType newestInput);
  /// What is to be said where what comes in has changed since; once for each change, else empty.
  std::string remark(const std::string& folder, vtkMTimeType newestInput);

private:
  vtkMTimeType Time = 0;      ///< of the properties and connections; 0: nothing was written
  vtkMTimeType InputTime = 0; ///< of the input that was written, or of which it was said that it was not
};

/// Has a filter write its folder, whatever has or has not changed; whether it could.
bool writeNow(vtkAlgorithm* self);

} // namespace cactus
