// SPDX-License-Identifier: BSD-3-Clause
#include "WholePanels.h"

#include "PluginProxies.h"

#include <pqPVApplicationCore.h>
#include <vtkSMOutputPort.h>
#include <vtkSMProxyManager.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>

#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QScrollArea>
#include <QScrollBar>
#include <QTimer>

namespace cactus
{
namespace
{

/// Returns the source or filter whose panel is shown; null if there is none. (pqActiveObjects knows it, too, but it includes a
/// header that Debian's package of ParaView lacks.)
vtkSMProxy* activeSource()
{
  vtkSMSessionProxyManager* proxies = vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  vtkSMProxySelectionModel* selection = proxies != nullptr ? proxies->GetSelectionModel("ActiveSources") : nullptr;
  vtkSMProxy* current = selection != nullptr ? selection->GetCurrentProxy() : nullptr;
  vtkSMOutputPort* port = vtkSMOutputPort::SafeDownCast(current);
  return port != nullptr ? port->GetSourceProxy() : current;
}

/// ParaView's window, the dock of the properties and its scrolled content; null if they do not exist.
struct Properties
{
  QMainWindow* window = nullptr;
  QDockWidget* dock = nullptr;
  QScrollArea* panel = nullptr;
};

Properties properties()
{
  for (QWidget* widget : QApplication::topLevelWidgets())
  {
    QMainWindow* window = qobject_cast<QMainWindow*>(widget);
    QDockWidget* dock = window != nullptr ? window->findChild<QDockWidget*>("propertiesDock") : nullptr;
    if (dock != nullptr)
    {
      return { window, dock, dock->findChild<QScrollArea*>("scrollArea") };
    }
  }
  return {};
}

} // namespace

WholePanels::WholePanels(pqPVApplicationCore* core)
  : QObject(core)
{
  if (const QScrollArea* panel = properties().panel)
  {
    // The panel's width is known only after its layout.
    QObject::connect(panel->horizontalScrollBar(), &QScrollBar::rangeChanged, this,
      [this] { QTimer::singleShot(0, this, [this] { this->giveRoom(); }); });
  }
}

void WholePanels::giveRoom()
{
  const Properties shown = properties();
  if (shown.panel == nullptr || shown.dock->isFloating() || !isOfThisPlugin(activeSource()))
  {
    return;
  }
  const int missing = shown.panel->horizontalScrollBar()->maximum();
  const int wanted = shown.panel->viewport()->width() + missing;
  if (missing > 0 && wanted > this->widest)
  {
    this->widest = wanted;
    shown.window->resizeDocks({ shown.dock }, { shown.dock->width() + missing }, Qt::Horizontal);
  }
}

} // namespace cactus
