// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqDataRepresentation;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Restores colours after an error. A slice that is shown for the first time is coloured by an array of its points; after an
/// error, the only array that ParaView finds is the message (field data Error), which it then keeps looking for.
class ErrorColours : public QObject
{
public:
  /// Lives as long as `core`.
  explicit ErrorColours(pqPVApplicationCore* core);

private:
  void mend(pqPipelineSource* source);
};

} // namespace cactus
