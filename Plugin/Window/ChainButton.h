// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqPVApplicationCore;

namespace cactus
{

/// Adds a toolbar with one button, which sets up the four filters of a substrate, one behind the other. They wait for Apply, with
/// the panel of the first one shown; Undo takes them away together.
class ChainButton : public QObject
{
public:
  /// Lives as long as `core`.
  explicit ChainButton(pqPVApplicationCore* core);

  /// Sets up the four filters, with the values of a preset (0: none).
  static void setUp(int preset);
};

} // namespace cactus
