// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

class QWidget;
class pqPVApplicationCore;

namespace cactus
{

/// Adds to ParaView's menu Help: the tutorial, in a window that shows all pages of docs/ (their text, without pictures), and an
/// example for each preset, which sets up the four filters with its values.
class HelpMenu : public QObject
{
public:
  /// Lives as long as `core`.
  explicit HelpMenu(pqPVApplicationCore* core);

private:
  void showTutorial();

  QPointer<QWidget> Handbook;
};

} // namespace cactus
