// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPropertyWidgetInterface.h>

#include <QObject>

namespace cactus
{

/// Lets panels of this plugin's filters be as narrow as others. ParaView makes a choice as wide as its longest entry, so that the
/// panel is wider than its dock and has to be scrolled sideways. Here it is only as wide as necessary; its list has the whole
/// entries.
class NarrowChoices : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit NarrowChoices(QObject* parent);

  /// Called by ParaView for each property of each panel.
  void createDefaultWidgetDecorators(pqPropertyWidget* widget) override;
};

} // namespace cactus
