// SPDX-License-Identifier: BSD-3-Clause
#include "QuickLaunch.h"

#include "PluginProxies.h"

#include <pqPVApplicationCore.h>
#include <pqProxyGroupMenuManager.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>

#include <QAction>
#include <QApplication>
#include <QMainWindow>
#include <QStringList>

#include <algorithm>

namespace cactus
{
namespace
{

/// Returns the menus whose actions the search shows.
QList<pqProxyGroupMenuManager*> searchedMenus()
{
  QList<pqProxyGroupMenuManager*> menus;
  for (const QWidget* widget : QApplication::topLevelWidgets())
  {
    if (const QMainWindow* window = qobject_cast<const QMainWindow*>(widget))
    {
      menus += window->findChildren<pqProxyGroupMenuManager*>();
    }
  }
  // Context menus have their own actions.
  menus.erase(
    std::remove_if(menus.begin(), menus.end(), [](const pqProxyGroupMenuManager* menu) { return !menu->supportsQuickLaunch(); }),
    menus.end());
  return menus;
}

/// Tells whether an action of ParaView's menus creates a proxy of this plugin.
bool makesOneOfThisPlugin(const QAction* action)
{
  vtkSMSessionProxyManager* manager = vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  const QStringList groupAndName = action->data().toStringList();
  return manager != nullptr && groupAndName.size() == 2 &&
         isOfThisPlugin(manager->GetPrototypeProxy(groupAndName[0].toUtf8().data(), groupAndName[1].toUtf8().data()));
}

} // namespace

QuickLaunch::QuickLaunch(pqPVApplicationCore* core)
  : QObject(core)
{
  core->registerForQuicklaunch(&this->entries);
  connect(core, &pqPVApplicationCore::aboutToShowQuickLaunch, this, [this] { this->makeEntries(); });
}

void QuickLaunch::makeEntries()
{
  qDeleteAll(this->entries.findChildren<QAction*>());
  for (const pqProxyGroupMenuManager* menu : searchedMenus())
  {
    for (QAction* action : menu->actions())
    {
      if (makesOneOfThisPlugin(action))
      {
        this->addEntry(action);
      }
    }
  }
}

void QuickLaunch::addEntry(QAction* menuAction)
{
  QAction* entry = new QAction(menuAction->icon(), QString("%1 %2").arg(menuCategory, menuAction->text()), &this->entries);
  // The search of 5.11 distinguishes actions by their names; that of 5.13 takes help and requirements from group and name of the
  // proxy.
  entry->setObjectName(QString("%1 %2").arg(menuCategory, menuAction->objectName()));
  entry->setData(menuAction->data());
  const auto follow = [entry, menuAction]
  {
    entry->setEnabled(menuAction->isEnabled());
    entry->setStatusTip(menuAction->statusTip());
  };
  follow();
  // The menus may update their state only after this.
  connect(menuAction, &QAction::changed, entry, follow);
  connect(entry, &QAction::triggered, menuAction, &QAction::trigger);
}

} // namespace cactus
