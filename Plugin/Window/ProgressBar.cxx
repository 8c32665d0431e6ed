// SPDX-License-Identifier: BSD-3-Clause
#include "ProgressBar.h"

#include <pqProgressWidget.h>

#include <QApplication>
#include <QStatusBar>

namespace cactus
{

pqProgressWidget* progressBar()
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    for (QStatusBar* bar : window->findChildren<QStatusBar*>())
    {
      if (auto* progress = bar->findChild<pqProgressWidget*>())
      {
        return progress;
      }
    }
  }
  return nullptr;
}

QStatusBar* statusBar()
{
  pqProgressWidget* progress = progressBar();
  return progress != nullptr ? qobject_cast<QStatusBar*>(progress->parentWidget()) : nullptr;
}

} // namespace cactus
