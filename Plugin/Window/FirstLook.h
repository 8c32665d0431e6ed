// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class pqPVApplicationCore;
class pqPipelineSource;

namespace cactus
{

/// Fits the camera to the first data of this plugin in a render view. ParaView does so when something is shown for the first
/// time, even if an error has left nothing visible; the result of the next Apply would then be seen from within. It fits the
/// camera again when the data become larger or smaller, for example by another Side, as long as nobody has moved the camera.
class FirstLook : public QObject
{
public:
  /// Lives as long as `core`.
  explicit FirstLook(pqPVApplicationCore* core);

  /// Fits it again, unless somebody has moved it, after something has been hidden.
  static void fitAgain(pqPipelineSource* source);
};

} // namespace cactus
