// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

class QLabel;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Says in the window's status bar what the last Apply reached, for example that no fibres overlap any more. It reads only the
/// summary of the outputs that the server sends anyway. A failed Apply, whose message stands elsewhere, leaves the line empty.
class ReachedLine : public QObject
{
public:
  /// Lives as long as `core`.
  explicit ReachedLine(pqPVApplicationCore* core);

private:
  QPointer<QLabel> Line;
  QPointer<pqPipelineSource> Told; ///< whose line it is, until the window waits for the user again
};

} // namespace cactus
