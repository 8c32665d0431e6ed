// SPDX-License-Identifier: BSD-3-Clause
#include "WriteButtons.h"

#include "PluginProxies.h"

#include <pqPropertyWidget.h>
#include <pqProxyWidget.h>
#include <vtkSMProperty.h>
#include <vtkSMProxy.h>

#include <QPushButton>

#include <cstring>

namespace cactus
{
namespace
{

/// Gives a proxy all values in the panel around `widget`, as Apply does, but without an update.
void applyPanelAround(const QWidget* widget)
{
  if (const pqProxyWidget* panel = panelAround(widget))
  {
    panel->apply();
  }
}

} // namespace

WriteButtons::WriteButtons(QObject* parent)
  : QObject(parent)
{
}

void WriteButtons::createDefaultWidgetDecorators(pqPropertyWidget* widget)
{
  const QPushButton* button = widget->findChild<QPushButton*>();
  if (button == nullptr || !isOfThisPlugin(widget->proxy()) || std::strcmp(widget->property()->GetXMLName(), "Write") != 0)
  {
    return;
  }
  // Slots are called in the order of their connections.
  QObject::disconnect(button, SIGNAL(clicked()), widget, SLOT(buttonClicked()));
  QObject::connect(button, &QPushButton::clicked, widget, [widget] { applyPanelAround(widget); });
  QObject::connect(button, SIGNAL(clicked()), widget, SLOT(buttonClicked()));
}

} // namespace cactus
