// SPDX-License-Identifier: BSD-3-Clause
#include "ViewCentreButton.h"

#include "PluginProxies.h"

#include <pqPropertyWidget.h>
#include <pqProxyWidget.h>
#include <vtkSMProperty.h>
#include <vtkSMProxy.h>
#include <vtkSMProxyManager.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMUncheckedPropertyHelper.h>

#include <QBoxLayout>
#include <QPushButton>

#include <array>
#include <string>

namespace cactus
{
namespace
{

constexpr std::array<const char*, 3> coordinates{ "PositionX", "PositionY", "PositionZ" };

/// Returns the active view if it is one that rotates about a centre; otherwise null.
vtkSMProxy* rotatingView()
{
  vtkSMSessionProxyManager* manager = vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  vtkSMProxySelectionModel* active = manager != nullptr ? manager->GetSelectionModel("ActiveView") : nullptr;
  vtkSMProxy* view = active != nullptr ? active->GetCurrentProxy() : nullptr;
  return view != nullptr && view->GetProperty("CenterOfRotation") != nullptr ? view : nullptr;
}

/// Puts the view's centre into the lines of the panel around `widget`, as if somebody had typed it.
void takeCentre(const QWidget* widget)
{
  vtkSMProxy* view = rotatingView();
  const pqProxyWidget* panel = panelAround(widget);
  if (view == nullptr || panel == nullptr)
  {
    return;
  }
  for (pqPropertyWidget* line : panel->findChildren<pqPropertyWidget*>())
  {
    for (unsigned axis = 0; line->property() != nullptr && axis < 3; ++axis)
    {
      if (std::string(line->property()->GetXMLName()) == coordinates[axis])
      {
        vtkSMUncheckedPropertyHelper(line->property()).Set(vtkSMPropertyHelper(view, "CenterOfRotation").GetAsDouble(axis));
        Q_EMIT line->changeAvailable();
        Q_EMIT line->changeFinished();
      }
    }
  }
}

} // namespace

ViewCentreButton::ViewCentreButton(QObject* parent)
  : QObject(parent)
{
}

void ViewCentreButton::createDefaultWidgetDecorators(pqPropertyWidget* widget)
{
  QBoxLayout* row = qobject_cast<QBoxLayout*>(widget->layout());
  if (row == nullptr || !isOfThisPlugin(widget->proxy()) || widget->property() == nullptr ||
      std::string(widget->property()->GetXMLName()) != coordinates[0])
  {
    return;
  }
  QPushButton* button = new QPushButton("View's centre", widget);
  button->setObjectName("ViewCentre");
  button->setToolTip(
    "Takes the position of the point about which the view rotates. To place a substrate on an image or a tract, click "
    "there with Pick Center, in ParaView's toolbar, first.");
  row->addWidget(button);
  QObject::connect(button, &QPushButton::clicked, widget, [widget] { takeCentre(widget); });
}

} // namespace cactus
