// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqDataRepresentation;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Colours what comes after an error as if the error had not been. What is shown for the first time as a slice is coloured by an
/// array of its points; where an error has left nothing, the only array that ParaView finds is the message (field data Error),
/// which it then goes on looking for.
class ErrorColours : public QObject
{
public:
  /// Lives as long as `core`.
  explicit ErrorColours(pqPVApplicationCore* core);

private:
  void mend(pqPipelineSource* source);
};

} // namespace cactus
