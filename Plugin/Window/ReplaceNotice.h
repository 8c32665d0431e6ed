// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPropertyWidgetInterface.h>

#include <QObject>

namespace cactus
{

/// Says in the dialog in which File > Save Data asks for the format of a substrate folder that there is such a folder already, so
/// that OK replaces it and Cancel does not. ParaView's own dialog asks this of files only.
class ReplaceNotice : public QObject, public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit ReplaceNotice(QObject* parent);

  /// Called by ParaView for each property of each panel.
  void createDefaultWidgetDecorators(pqPropertyWidget* widget) override;
};

} // namespace cactus
