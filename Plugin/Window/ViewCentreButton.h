// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPropertyWidgetInterface.h>

#include <QObject>

namespace cactus
{

/// Adds a button to the panel of Placement that takes the position from the view: the centre about which it rotates, which
/// ParaView's Pick Center puts where the user clicks on an image, a tract or a surface.
class ViewCentreButton : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit ViewCentreButton(QObject* parent);

  /// Called by ParaView for each property of each panel.
  void createDefaultWidgetDecorators(pqPropertyWidget* widget) override;
};

} // namespace cactus
