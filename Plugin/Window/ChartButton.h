// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

class QToolButton;
class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// A button in the window's status bar that charts how the optimiser converged, in a view of its own beside the active one. It is
/// there from the first Apply of a CapsuleOptimizer, for the one that was applied last, until that is deleted.
class ChartButton : public QObject
{
public:
  /// Lives as long as `core`.
  explicit ChartButton(pqPVApplicationCore* core);

private:
  void chart();

  QPointer<QToolButton> Button;
  QPointer<pqPipelineSource> Optimiser; ///< the one that was applied last
};

} // namespace cactus
