// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPropertyWidgetInterface.h>

#include <QObject>

namespace cactus
{

/// Shows a number that stands for something else, such as -1 for "as made", as a choice beside the number's line.
///
/// A property says so by <Hints><Code value="-1" text="as made" otherwise="0.9"/></Hints> in its XML. Its line is hidden while it
/// has this value. The other entry of the choice brings back the last other value, or `otherwise`.
class CodeChoices : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit CodeChoices(QObject* parent);

  /// Called by ParaView for each property of each panel.
  void createDefaultWidgetDecorators(pqPropertyWidget* widget) override;
};

} // namespace cactus
