// SPDX-License-Identifier: BSD-3-Clause
// Decides when a filter that writes a folder writes it, and when it leaves it as it is.
#pragma once

#include <vtkType.h>

#include <string>

class vtkAlgorithm;

namespace cactus
{

/// The state for which a filter's folder was written. A filter writes after changes of its own properties and connections, and on
/// the user's request, not because its input has changed.
class KeptFolder
{
public:
  /// Tells whether it was written for the filter's present properties and connections.
  bool isWritten(vtkAlgorithm* self) const;
  /// Records that it was written, and when its input was last changed.
  void noteWritten(vtkAlgorithm* self, vtkMTimeType newestInput);
  /// Returns a remark if the input has changed since; once for each change, else empty.
  std::string remark(const std::string& folder, vtkMTimeType newestInput);

private:
  vtkMTimeType Time = 0;      ///< of the properties and connections; 0: nothing was written
  vtkMTimeType InputTime = 0; ///< of the input that was written, or for which a remark was given
};

/// Makes a filter write its folder, whether or not anything has changed; returns whether it succeeded.
bool writeNow(vtkAlgorithm* self);

} // namespace cactus
