// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkWeakPointer.h>

#include <QElapsedTimer>
#include <QList>
#include <QObject>
#include <QPointer>

class QToolButton;
class QWidget;
class pqPVApplicationCore;
class pqPipelineSource;
class pqProgressWidget;
class vtkAlgorithm;
class vtkObject;

namespace cactus
{

/// Makes the abort button beside the progress bar work while a source or filter of this plugin runs in this process. ParaView up
/// to 6.0 never enables it, and takes no clicks during a run. While the mouse is at the progress bar, clicks on the button are
/// taken each time that progress is reported. Where the mouse is outside the window, it is asked whether that is to be closed:
/// what runs is stopped then, and the window closes. All else that a user does waits, as it does without this class.
class StopButton : public QObject
{
public:
  /// Lives as long as `core`.
  explicit StopButton(pqPVApplicationCore* core);

  /// Holds back what would change the window or the pipeline while clicks are taken.
  bool eventFilter(QObject* object, QEvent* event) override;

private:
  void watch(pqPipelineSource* source);
  void takeClicks(vtkObject* algorithm, unsigned long, void*);
  void end(vtkObject*, unsigned long, void*);
  /// Closes the window when nothing runs any more.
  void closeSoon();

  QPointer<pqProgressWidget> Bar;
  QPointer<QToolButton> Button;
  vtkWeakPointer<vtkAlgorithm> Running;
  QElapsedTimer SinceClicks;
  QList<QPointer<QWidget>> ToPaint; ///< views whose painting was held back
  bool IsTaking = false;
  bool IsToClose = false; ///< as soon as nothing runs
};

} // namespace cactus
