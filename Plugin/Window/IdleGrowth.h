// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPropertyWidgetInterface.h>

#include <QObject>

namespace cactus
{

/// Hides Growth Iterations in panels where it has no effect: where fibres grow until they fill the fraction that they were made
/// for.
class IdleGrowth : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit IdleGrowth(QObject* parent);

  /// Called by ParaView for each property of each panel.
  void createDefaultWidgetDecorators(pqPropertyWidget* widget) override;
};

} // namespace cactus
