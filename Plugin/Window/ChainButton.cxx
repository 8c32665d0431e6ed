// SPDX-License-Identifier: BSD-3-Clause
#include "ChainButton.h"

#include "PluginProxies.h"

#include <pqApplicationCore.h>
#include <pqObjectBuilder.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqSourcesMenuReaction.h>
#include <pqUndoStack.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyManager.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>

#include <QAction>
#include <QIcon>
#include <QMainWindow>
#include <QToolBar>

namespace cactus
{

ChainButton::ChainButton(pqPVApplicationCore* core)
  : QObject(core)
{
  QMainWindow* window = mainWindow();
  if (window == nullptr)
  {
    return;
  }
  QToolBar* bar = window->addToolBar(menuCategory);
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->setObjectName("CactusToolBar"); // by which ParaView keeps its place
  QAction* action = bar->addAction(QIcon(":/cactus/Substrate.svg"), "CACTUS substrate");
  action->setObjectName("CactusSubstrate");
  action->setToolTip(
    "Sets up Bundle Initializer, Capsule Optimizer, Fibre Radial Growth and Myelin Surface, one behind the other. "
    "Choose values in their panels; Apply makes the substrate.");
  connect(action, &QAction::triggered, this, [] { setUp(0); });
}

void ChainButton::setUp(int preset)
{
  vtkSMSessionProxyManager* manager = vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  if (manager == nullptr)
  {
    return; // between two servers
  }
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  BEGIN_UNDO_SET("CACTUS substrate");
  pqPipelineSource* first = pqSourcesMenuReaction::createSource("sources", "BundleInitializer");
  if (first != nullptr && preset != 0)
  {
    vtkSMPropertyHelper(first->getProxy(), "Preset").Set(preset);
    first->getProxy()->UpdateVTKObjects();
  }
  pqPipelineSource* last = first;
  for (const char* name : { "CapsuleOptimizer", "FibreRadialGrowth", "MyelinSurface" })
  {
    last = last != nullptr ? builder->createFilter("filters", name, last, 0) : nullptr;
  }
  END_UNDO_SET();
  vtkSMProxySelectionModel* active = manager->GetSelectionModel("ActiveSources");
  if (active != nullptr && last != nullptr)
  {
    active->SetCurrentProxy(first->getProxy(), vtkSMProxySelectionModel::CLEAR_AND_SELECT);
  }
}

} // namespace cactus
