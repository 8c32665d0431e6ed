// SPDX-License-Identifier: BSD-3-Clause
#include "PluginProxies.h"

#include <pqProxyWidget.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProxy.h>

#include <QApplication>
#include <QMainWindow>

#include <cstring>

namespace cactus
{

bool isOfThisPlugin(vtkSMProxy* proxy)
{
  vtkPVXMLElement* hints = proxy != nullptr ? proxy->GetHints() : nullptr;
  vtkPVXMLElement* shown = hints != nullptr ? hints->FindNestedElementByName("ShowInMenu") : nullptr;
  const char* shownIn = shown != nullptr ? shown->GetAttribute("category") : nullptr;
  return shownIn != nullptr && std::strcmp(shownIn, menuCategory) == 0;
}

const pqProxyWidget* panelAround(const QWidget* widget)
{
  while (widget != nullptr && qobject_cast<const pqProxyWidget*>(widget) == nullptr)
  {
    widget = widget->parentWidget();
  }
  return qobject_cast<const pqProxyWidget*>(widget);
}

QMainWindow* mainWindow()
{
  for (QWidget* widget : QApplication::topLevelWidgets())
  {
    if (QMainWindow* window = qobject_cast<QMainWindow*>(widget))
    {
      return window;
    }
  }
  return nullptr;
}

} // namespace cactus
