// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPropertyWidgetInterface.h>

#include <QObject>

namespace cactus
{

/// Makes the button Write of this plugin's filters use the values in their panels. ParaView's buttons use the applied values, so
/// that a newly entered folder would not be the one that is written.
class WriteButtons : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit WriteButtons(QObject* parent);

  /// Called by ParaView for each property of each panel.
  void createDefaultWidgetDecorators(pqPropertyWidget* widget) override;
};

} // namespace cactus
